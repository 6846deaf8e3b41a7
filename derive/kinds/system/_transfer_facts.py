"""What the words read of a transfer function."""

from __future__ import annotations

from derive.derivation import PageFacts, Record
from derive.expression import Expr, Symbol
from derive.kinds.system._plant import AtPoint


class Eliminated(Record):
    signal: Symbol
    equation: tuple[Expr, Expr]
    put: tuple[Symbol, ...]
    explicit: bool


class Facts(PageFacts):
    motor: tuple[str, ...]
    eliminations: tuple[str, ...]  # steps
    input: Symbol
    output: Symbol
    disturbed: bool  # it is not the usual input
    order: int
    proper: bool
    vanishes: bool
    integrates: bool
    cancelled: int
    at: AtPoint | None
