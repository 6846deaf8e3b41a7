"""Values to draw with where a sheet has symbols: lengths like those that are known, angles that show."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from statistics import median

from derive.algebra.numbers.floats import Point, number
from derive.expression import Expr, free_symbols
from derive.mechanics.motion import Move

LENGTHS = (1.0, 0.85, 0.7, 0.55, 0.9, 0.65, 0.8, 0.6)
ANGLES = (0.61, 0.79, 0.52, 0.96, 0.44)  # rad


def typical(
    moves: Sequence[Move], more_lengths: Iterable[Expr], where: Mapping[str, Expr], skip: Iterable[str]
) -> tuple[dict[str, float], float]:
    """A value for every symbol but those of `skip`, and the size of a usual length."""
    by_angle = [move.by for move in moves if move.kind == "rotate"]
    by_length = [move.by for move in moves if move.kind == "translate"] + list(more_lengths)
    known = [abs(size) for expr in by_length if (size := _known(expr, where))]
    usual = median(known) if known else 1.0
    found: dict[str, float] = {}
    for exprs, values, scale in ((by_angle, ANGLES, 1.0), (by_length, LENGTHS, usual)):
        names = dict.fromkeys(name for expr in exprs for name in sorted(names_in(expr, where)))
        for k, name in enumerate(name for name in names if name not in found and name not in skip):
            found[name] = values[k % len(values)] * scale
    return found, usual


def completed(point: Point, where: Mapping[str, Expr]) -> dict[str, float]:
    """The point with the names of `where`, which may rest on each other."""
    found, pending = dict(point), dict(where)
    while pending:
        ready = [name for name, expr in pending.items() if free_symbols(expr) <= found.keys()]
        if not ready:
            return found
        found.update({name: number(pending.pop(name), found) for name in ready})
    return found


def names_in(expr: Expr, where: Mapping[str, Expr]) -> frozenset[str]:
    """The symbols an expression rests on, through `where`."""
    names = free_symbols(expr)
    while inner := names & where.keys():
        names = (names - inner).union(*(free_symbols(where[name]) for name in inner))
    return names


def _known(expr: Expr, where: Mapping[str, Expr]) -> float | None:
    return None if names_in(expr, where) else number(expr, completed({}, where))
