"""What the words read of a state space."""

from __future__ import annotations

from derive.derivation import PageFacts, Phrase
from derive.expression import Expr, Symbol
from derive.kinds.system._plant import AtPoint


class Facts(PageFacts):
    physical: bool
    motor: tuple[str, ...]
    disturbance: Symbol | None
    inside: Phrase | None  # signals of a motor
    law: tuple[Expr, ...]
    output_law: tuple[Expr, ...]
    matrices: tuple[Symbol, ...]
    form: Phrase | None  # of the transfer function from which the state is read off
    hidden: Phrase | None  # motions
    cancelled: tuple[Expr, ...]
    final: tuple[tuple[Expr, ...], ...]
    at: AtPoint | None
