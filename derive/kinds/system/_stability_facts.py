"""What the words read of an answer about stability."""

from __future__ import annotations

from derive.derivation import PageFacts, Table
from derive.expression import Expr, Relation, Symbol
from derive.kinds.system._plant import AtPoint


class StabilityAtPoint(AtPoint):
    failing: tuple[Relation, ...] = ()


class Facts(PageFacts):
    closed: bool
    motor: tuple[str, ...]
    hidden: Expr | None
    degree: int
    factor: Expr | None
    coefficients: str  # "met", "violated", "open"
    array: Table | None
    column: tuple[Expr, ...]
    mended: tuple[str, ...]  # the special cases of the array
    epsilon: Symbol | None  # where it stands in the array
    never: bool
    conditions: tuple[Relation, ...]  # none where they never hold
    marginal: tuple[Relation, ...] | None
    one_sign: tuple[Expr, ...]
    assumed: bool
    symbolic: bool
    limiting: Relation | None
    critical: tuple[tuple[Expr, ...], ...] | None
    changes: int
    axis: tuple[Expr, ...]
    verdict: str
    at: StabilityAtPoint | None
