"""Values of names: those of a sheet and of its problems, none defined by itself."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from derive.algebra.normal import Names, normal
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Power, Symbol, children, free_symbols

MOST_NESTED = 40  # functions and roots; of ten no reader keeps track

FALSE = {
    "positive": lambda value: value <= 0,
    "nonnegative": lambda value: value < 0,
    "nonzero": lambda value: value == 0,
    "integer": lambda value: value.denominator != 1,
}  # values that an assumption excludes


def cycle(where: Mapping[str, Expr]) -> str:
    """A name whose value leads back to itself, empty if there is none."""
    return next((name for name in where if name in _behind(name, where)), "")


def nested(where: Mapping[str, Expr]) -> str:
    """A name whose value holds too many functions and roots, one within the other, once the values of the
    names in it are put in; empty if there is none. No name may lead back to itself."""
    depths: dict[str, int] = {}
    for name in where:
        path = [name]
        while path:
            ahead = [inner for inner in free_symbols(where[path[-1]]) & where.keys() if inner not in depths]
            if ahead:
                path += ahead
            else:
                last = path.pop()
                depths[last] = _depth(where[last], depths)
    return next((name for name in where if depths[name] > MOST_NESTED), "")


def _depth(expr: Expr, depths: Mapping[str, int]) -> int:
    """How many functions and roots stand one within the other at the most."""
    if isinstance(expr, Symbol):
        return depths.get(expr.name, 0)
    inside = max((_depth(part, depths) for part in children(expr)), default=0)
    return inside + isinstance(expr, Call | Power)


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
