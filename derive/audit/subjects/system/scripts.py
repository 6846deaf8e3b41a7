"""Generated scripts: the formulas that are typed in them; they are not run here."""

from __future__ import annotations

import re
from collections.abc import Iterator

import sympy

from derive.audit.asked import Asked, Beyond, Test
from derive.audit.points import Point
from derive.audit.putting_back import put_back
from derive.audit.subjects.system.plant import Plant, S, sympified

LINE = re.compile(r"^(\w+) = ([-+*/^().\w ]+?);?\s*(?:[%#].*)?$", re.MULTILINE)
WHY = "the script is not run here; its G and its values were compared"


def model(asked: Asked, point: Point) -> Iterator[Test]:
    """G as it is typed, with the values that are typed above it."""
    plant = Plant(asked)
    there = plant.transfer(plant.at(asked.here)).subs(S, sympified(point, S))
    for name in ("matlab", "python"):
        lines = dict(LINE.findall(str(asked.results[name])))
        if "G" in lines:
            typed = {n: _number(v) for n, v in lines.items() if re.fullmatch(r"[-+.\deE]+", v)}
            G = asked.read(lines["G"].replace("^", "**")).subs(typed).subs(S, sympified(point, S))
            yield put_back(name, point, G, there, "its G is another")
        yield Beyond(name, WHY)


def _number(text: str) -> sympy.Rational:
    return sympy.Rational(text)
