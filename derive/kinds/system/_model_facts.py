"""What the words read of a model."""

from __future__ import annotations

from derive.derivation import PageFacts
from derive.expression import Expr, Symbol


class Facts(PageFacts):
    closed: bool
    family: str
    motor: tuple[str, ...]
    one_block: bool
    taps: bool
    input: Symbol
    output: Symbol
    reference: Symbol | None  # of a loop
    error: tuple[Expr, Expr] | None
    disturbances: tuple[Symbol, ...]
    controller: Expr | None
    filter: tuple[tuple[Symbol, Expr], ...]
    gains: tuple[tuple[Expr, Expr], ...]
    point: tuple[tuple[Expr, ...], ...]
    drawn: bool
