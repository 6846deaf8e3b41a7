"""Values of names: those of a sheet and of its problems, none defined by itself."""

from __future__ import annotations

from collections.abc import Mapping

from derive.expression import Expr, free_symbols


def cycle(where: Mapping[str, Expr]) -> str:
    """A name whose value leads back to itself, empty if there is none."""
    return next((name for name in where if name in _behind(name, where)), "")


def _behind(name: str, where: Mapping[str, Expr]) -> set[str]:
    """Every name its value rests on."""
    found: set[str] = set()
    ahead = [name]
    while ahead:
        new = (free_symbols(where[ahead.pop()]) & where.keys()) - found
        found |= new
        ahead.extend(new)
    return found
