"""What the words read of a step response, and the names of what is read off it."""

from __future__ import annotations

from derive.derivation import PageFacts
from derive.expression import Expr, Symbol

FIGURES = ("rise_time", "settling_time", "overshoot", "steady_state")
NONE = "none"  # a number that this response does not have


class Facts(PageFacts):
    start: tuple[Expr, Expr]
    origin: tuple[Expr, Expr]
    step: Expr  # its transform
    closed: bool
    input: Symbol
    point: tuple[tuple[Expr, ...], ...]
    poles: tuple[Expr, ...]
    verdict: str
    hidden: bool
    slope: Expr | None
    zero: bool  # the steady state
    rise_time: Expr | None
    settling_time: Expr | None
    overshoot: Expr | None
    peak_time: Expr | None
