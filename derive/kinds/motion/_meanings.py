"""What the names of a motion mean in numbers: each move made by itself, and the motion so far."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.algebra.numbers.floats import Point
from derive.expression import Expr, Indexed, Product, Symbol
from derive.kinds.meanings import Chain, Names, column_of, skew_of, valued
from derive.kinds.motion._factors import IDENTITY, NO_ROW, Factors, Placed
from derive.mechanics.oracle import made


def meant(factors: Factors, whole: Symbol, at: Point) -> Names:
    """The factors and the whole (3 by 3 or 4 by 4) as the moves make them, the motion after each move as
    `reached`, and what stands in Rodrigues' formula."""
    import numpy as np

    size = factors.size
    names: dict[Expr, object] = {NO_ROW: np.zeros((1, 3)), IDENTITY: np.eye(3)}
    letters: dict[Expr, float] = {Symbol(name): value for name, value in at.items()}
    for factor in factors.factors:
        names[factor.name] = made((factor.move,), at)[:size, :size]
        names[_reached(factor.index)] = made(factors.moves[: factor.index], at)[:size, :size]
        if not isinstance(factor.move.axis, str):
            along = np.array([valued(part, letters) for part in factor.move.axis])
            unit = along / np.linalg.norm(along)
            names[factor.axis], names[Indexed("S", (factor.axis,))] = column_of(unit), skew_of(unit)
    return {**names, whole: made(factors.moves, at)[:size, :size]}


def order_told(factors: Factors, mode: str) -> bool:
    """Whether the axes of the moves after the first are taken as it is told."""
    taken = {move.about for move in factors.moves[1:]}
    return taken == {"single": set(), "mixed": {"world", "current"}}.get(mode, {mode})


def order_chains(factors: Factors, mode: str, whole: Symbol) -> Iterator[Chain]:
    """The order in which the factors stand where all axes are taken alike."""
    names = tuple(factor.name for factor in factors.factors)
    if mode == "world":
        yield whole, Product(names[::-1])
    if mode == "current":
        yield whole, Product(names)


def placed_chains(placed_moves: Sequence[Placed]) -> Iterator[Chain]:
    """The motion after each move, as the words tell it: the product so far, made of the one before it by
    multiplying the new factor on from the side that is told."""
    before: Expr | None = None
    for k, placed in enumerate(placed_moves, 1):
        reached: tuple[Expr, ...] = (_reached(k), placed.product)
        if before is not None:
            left = placed.side == "left"
            reached = (*reached, placed.factor * before if left else before * placed.factor)
        yield reached
        before = _reached(k)


def _reached(k: int) -> Symbol:
    return Symbol(f"reached after {k}")
