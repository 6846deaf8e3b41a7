"""Values of names: those of a sheet and of its problems, none defined by itself."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from derive.algebra.normal import Names, normal
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, free_symbols

FALSE = {
    "positive": lambda value: value <= 0,
    "nonnegative": lambda value: value < 0,
    "nonzero": lambda value: value == 0,
    "integer": lambda value: value.denominator != 1,
}  # values that an assumption excludes


def cycle(where: Mapping[str, Expr]) -> str:
    """A name whose value leads back to itself, empty if there is none."""
    return next((name for name in where if name in _behind(name, where)), "")


def contradictions(where: Mapping[str, Expr], assumptions: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """Names whose value is a rational number that what is assumed of them excludes, and what that is."""
    names: Names = {Symbol(name): value for name, value in where.items()}
    for name in where.keys() & assumptions.keys():
        try:
            value = normal(where[name], names).constant
        except (NotDerivable, ValueError, ZeroDivisionError, OverflowError):
            continue  # told where it is used
        excluded = FALSE.get(assumptions[name])
        if value is not None and excluded and excluded(value):
            yield name, assumptions[name]


def _behind(name: str, where: Mapping[str, Expr]) -> set[str]:
    """Every name its value rests on."""
    found: set[str] = set()
    ahead = [name]
    while ahead:
        new = (free_symbols(where[ahead.pop()]) & where.keys()) - found
        found |= new
        ahead.extend(new)
    return found
