"""What the words read of encoders and of switched voltages."""

from __future__ import annotations

from derive.derivation import PageFacts
from derive.expression import Expr, Relation, Symbol


class ResolutionFacts(PageFacts):
    edges: Expr | None  # that are counted; None of an absolute encoder
    gear: Expr | None
    drawn: bool


class SpeedFacts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    n: Expr
    T: Expr
    gear: Symbol | None


class VoltageFacts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    inverse: bool
    timed: bool
    high: Expr
    low: Expr | None  # zero
    duty: Expr


class SizeFacts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    gear: Symbol | None
    found: tuple[tuple[str, Relation], ...]  # the line of each size, and between which it lies
