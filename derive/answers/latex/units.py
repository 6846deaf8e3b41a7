r"""A number with its unit, as keys have it: `0.69 s`, `t_r = 0.69\,\text{s}`, `2\ \mathrm{m/s^2}`, `25\%`."""

from __future__ import annotations

import re

from derive.algebra.formulas.grammar import parse
from derive.algebra.formulas.units import ANY, INSTEAD, UNITS
from derive.errors import FormulaError
from derive.expression import Expr

_SPACE = r"(?:\s|~|\\[,;:! ])*"
_MEASURED = re.compile(
    rf"{_SPACE}(?:[\w\\{{}}^()]+{_SPACE}(?:=|\\approx|≈){_SPACE})?"
    rf"(?P<number>-?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?){_SPACE}"
    rf"(?:\\(?:text|textrm|mathrm|mbox)\s*\{{{_SPACE}(?P<set>[^{{}}]*){_SPACE}\}}"
    r"|(?P<plain>%|[A-Za-z][\w/^ ]*))[\s.]*"
)
_LONGEST = 200
_NAME = re.compile(r"[A-Za-z]+")


def measured(text: str) -> Expr | None:
    """What a text stands for that is nothing but a number and a unit, or per cent; None for any other."""
    plain = text.replace(r"\%", "%").replace("$", "")
    found = _MEASURED.fullmatch(plain) if len(plain) <= _LONGEST else None
    if not found:
        return None
    unit = (found["set"] or found["plain"] or "").strip()
    if unit == "%":
        return parse(f"{found['number']}/100")
    unit = _NAME.sub(lambda name: INSTEAD.get(name[0], name[0]), unit)
    if not set(_NAME.findall(unit)) <= UNITS.keys():
        return None
    try:
        return parse(f"{found['number']} {unit}", dimension=ANY)
    except FormulaError:
        return None
