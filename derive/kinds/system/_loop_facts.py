"""What the words read of a closed loop."""

from __future__ import annotations

from derive.derivation import PageFacts, Phrase
from derive.expression import Expr, Symbol
from derive.kinds.system._plant import AtPoint


class LoopAtPoint(AtPoint):
    hidden: Phrase | None = None  # what grows cancels out of the output


class Facts(PageFacts):
    family: Phrase
    through: Expr
    input: Symbol
    output: Symbol
    motor: tuple[str, ...]
    order: int
    reach: Phrase | None  # of the gains
    derivative: Phrase | None  # that cannot be built
    tracks: Phrase | None  # a constant reference without error
    cancelled: Phrase | None
    at: LoopAtPoint | None
    drawn: bool
