"""One slip in the text of a result, a sign, a sine or a number: the audit of arms contradicts it."""

from __future__ import annotations

import copy
import random
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import mpmath
import pytest

from derive.audit.asked import Asked
from derive.audit.engine import Contradicted, audit
from derive.audit.points import Point
from derive.audit.text import Unreadable
from derive.auditing import answers
from derive.build import assemble
from derive.kinds.registry import kinds_of
from derive.render.questions import example_of
from derive.sheet.load import load_sheet
from derive.writing import render

SLIP = re.compile(r" [+-] |(?<!\w)(?:sin|cos)(?!\w)|(?<![\w.])\d+(?![\w.])")
OTHER = {" + ": " - ", " - ": " + ", "sin": "cos", "cos": "sin"}
TRIES = 4  # slips in the example of a kind
WORDS = ("description", "names", "when")


def texts(value: Any, route: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The routes to the texts in the results."""
    pairs = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, part in pairs:
        yield from texts(part, (*route, key))
    if isinstance(value, str) and not set(route) & set(WORDS):
        yield route


def slipped(results: Any, route: tuple[Any, ...], dice: random.Random) -> tuple[Any, str, str] | None:
    """The results with one slip, the text as it was and as it is."""
    found = copy.deepcopy(results)
    part = found
    for key in route[:-1]:
        part = part[key]
    text = part[route[-1]]
    if not (places := list(SLIP.finditer(text))):
        return None
    place = dice.choice(places)
    other = OTHER.get(place[0]) or str(int(place[0]) + 1)
    part[route[-1]] = text[: place.start()] + other + text[place.end() :]
    return found, text, part[route[-1]]


def differ(asked: Asked, one: str, other: str) -> bool:
    """Whether two texts mean different things."""
    point = Point(3, False)
    try:
        with mpmath.workdps(60):
            return bool(abs(point.at(asked.read(one)) - point.at(asked.read(other))) > 1e-20)
    except (Unreadable, ZeroDivisionError, ValueError):
        return False


@pytest.mark.parametrize("module", sorted(kinds_of("robot").values()))
def test_a_slip_is_contradicted(module: str, tmp_path: Path) -> None:
    path = tmp_path / "sheet.yaml"
    path.write_text(example_of(module), encoding="utf-8")
    sheet, dice, tried = load_sheet(path), random.Random(module), 0
    for _, asked in answers(sheet, render(assemble(sheet), "json")):
        routes = list(texts(asked.results)) if asked.subject_name == "robot" else []
        dice.shuffle(routes)
        for route in routes:
            made = slipped(asked.results, route, dice)
            if made is None or tried == TRIES or not differ(asked, *made[1:]):
                continue
            tried += 1
            assert isinstance(audit(replace(asked, results=made[0])), Contradicted), (route, *made[1:])
