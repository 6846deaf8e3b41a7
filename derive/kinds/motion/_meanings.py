"""What the names of a motion mean in numbers: each move made by itself, and the motion so far."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.algebra.numbers.floats import Point
from derive.derivation import Phrase
from derive.expression import Expr, Indexed, Product, Symbol
from derive.kinds.fields import TREES
from derive.kinds.meanings import Chain, Names, column_of, skew_of, valued
from derive.kinds.motion._factors import IDENTITY, NO_ROW, PLACED, Factors
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


def axes_told(factors: Factors) -> bool:
    """Whether each factor is called by its axis: x, y or z by its letter, another by a name with a line."""
    return all(
        factor.name.lower[0] == factor.axis
        and (
            factor.axis.name == factor.move.axis
            if isinstance(factor.move.axis, str)
            else factor.axis in factors.work.known
        )
        for factor in factors.factors
    )


def order_told(factors: Factors, reason: Phrase | None) -> bool:
    """Whether the axes of the moves after the first are taken as it is told."""
    taken = {move.about for move in factors.moves[1:]}
    noun = Phrase("rotation" if factors.size == 3 else "move")
    if reason is None:
        return taken == {"world", "current"}
    wanted = {"one-factor": set[str](), "about-world": {"world"}, "about-current": {"current"}}
    return wanted.get(reason.key) == taken and reason.about == {"noun": noun}


def order_chains(factors: Factors, reason: Phrase | None, whole: Symbol) -> Iterator[Chain]:
    """The order in which the factors stand where all axes are taken alike."""
    names, key = tuple(factor.name for factor in factors.factors), reason.key if reason else ""
    if key == "about-world":
        yield whole, Product(names[::-1])
    if key == "about-current":
        yield whole, Product(names)


def placed_chains(factors: Factors, placed_moves: Sequence[Phrase]) -> Iterator[Chain]:
    """The motion after each move, as the words tell it: the product so far, made of the one before it by
    multiplying the new factor on from the side that is told."""
    sides = {key: (kind, side) for (kind, side), key in PLACED.items()}
    before: Expr | None = None
    for k, placed in enumerate(placed_moves, 1):
        factor, product = (placed.about.get(name) for name in ("factor", "product"))
        move = factors.factors[k - 1].move
        if isinstance(factor, TREES):
            yield factors.factors[k - 1].name, factor
        if before is not None and isinstance(factor, TREES) and isinstance(product, TREES):
            kind, side = sides[placed.key]
            put = factor * before if side == "left" else before * factor
            yield (_reached(k), product, put) if kind == move.kind else (_reached(k), NO_ROW)
        before = _reached(k)


def _reached(k: int) -> Symbol:
    return Symbol(f"reached after {k}")
