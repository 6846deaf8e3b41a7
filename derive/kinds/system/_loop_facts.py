"""What the words read of a closed loop."""

from __future__ import annotations

from derive.derivation import PageFacts, Phrase
from derive.expression import Expr, Symbol
from derive.kinds.system._plant import AtPoint


class LoopAtPoint(AtPoint):
    hidden: bool = False  # what grows cancels out of the output


class Facts(PageFacts):
    family: str
    through: Expr
    input: Symbol
    output: Symbol
    motor: tuple[str, ...]
    differentiates: bool
    order: int
    realisable: bool
    tracks: Phrase | None  # a constant reference without error
    cancelled: int
    at: LoopAtPoint | None
