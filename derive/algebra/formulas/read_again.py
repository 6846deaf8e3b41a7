"""A number with its unit read a second time, in floating point and by a table of its own: what stands at the
beginning of every answer, and is held by nothing that is derived from it."""

from __future__ import annotations

import math
import re
from collections.abc import Container

from derive.algebra.numbers.floats import number
from derive.expression import Expr, free_symbols

MEASURED = re.compile(
    r"\s*(?P<value>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    r"\s*(?P<unit>[A-Za-z]*)\s*(?:/\s*(?P<per>[A-Za-z]+)(?:\^(?P<power>\d))?)?\s*"
)
SI = {
    "": 1.0, "m": 1.0, "cm": 0.01, "mm": 0.001, "km": 1000.0, "kg": 1.0, "g": 0.001, "s": 1.0, "ms": 0.001,
    "rad": 1.0, "deg": math.tau / 360, "N": 1.0, "A": 1.0, "V": 1.0, "ohm": 1.0, "H": 1.0, "Hz": 1.0,
}  # fmt: skip
NEARLY = 1e-12


def is_as_typed(text: str, tree: Expr, units: Container[str] = SI) -> bool:
    """Whether the tree of `30 deg`, `0.2 m/s` or `5` has the value typed; true of all other formulas."""
    found = MEASURED.fullmatch(text)
    if not found:
        return True
    unit, per = found["unit"], found["per"] or ""
    if unit not in SI or per not in SI:
        return True
    if free_symbols(tree):  # where a letter is no unit it is a name
        return unit not in units
    value = float(found["value"]) * SI[unit] / SI[per] ** int(found["power"] or 1)
    return math.isclose(number(tree, {}), value, rel_tol=NEARLY)
