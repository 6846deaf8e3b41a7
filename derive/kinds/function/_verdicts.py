"""What is said of stationary points: the rule that tells them apart, and which values are the greatest."""

from __future__ import annotations

from collections.abc import Sequence

from derive.derivation import Phrase, Said
from derive.expression import ZERO, Call, Expr, Relation, Symbol
from derive.kinds.function._extremes import Reach
from derive.kinds.function._stationary import Point, is_flat_saddle

HESSIAN = Symbol("H")


def tests_of(variables: int, constraints: int, found: Sequence[Point]) -> tuple[Phrase, ...]:
    """How maxima and minima are told, where second derivatives tell them."""
    if not any(point.minors for point in found):
        return ()
    count, odd = variables - constraints, constraints % 2 == 1
    minors = minors_of(variables, constraints)
    if not constraints:
        det = Relation(Call("det", (HESSIAN,)), "!=", ZERO)
        by_minors = Phrase("minors", {"det": det, "minors": minors})
        return Phrase("by-the-hessian"), by_minors if count > 1 else Phrase("curvature")
    border = Phrase("by-the-border-of-one" if constraints == 1 else "by-the-border")
    if count == 1:
        return border, Phrase("odd-determinant" if odd else "even-determinant")
    return border, Phrase("odd-minors" if odd else "even-minors", {"count": count, "minors": minors})


def minors_of(variables: int, constraints: int) -> tuple[Expr, ...]:
    """What the minors are called by which maxima and minima are told: the only one is the determinant."""
    sizes = range(2 * constraints + 1, constraints + variables + 1)
    return (Call("det", (HESSIAN,)),) if len(sizes) == 1 else tuple(Symbol(f"D_{size}") for size in sizes)


def flat_test(found: Sequence[Point], constrained: bool) -> Phrase | None:
    """What tells a saddle point where the last minor vanishes."""
    if not any(map(is_flat_saddle, found)):
        return None
    return Phrase("flat-along" if constrained else "flat")


def reached(
    limits: Reach, name: Symbol, greatest: Expr | None, smallest: Expr | None, constraints: int
) -> Phrase | None:
    """Why there is a greatest or a smallest value, and which that is."""
    both: dict[str, Expr | None] = {"name": name, "greatest": greatest, "smallest": smallest}
    about: dict[str, Said] = {key: tree for key, tree in both.items() if tree is not None}
    if len(about) == 1:
        return None
    if limits.highest == "compact":
        key = "compact-of-one" if constraints == 1 else "compact"
        return Phrase(key, about) if len(about) == 3 else None
    return Phrase("falls" if greatest else "grows", about)
