"""What is given of a system: its equations as they were typed, and which of their signals are which."""

from __future__ import annotations

from collections.abc import Iterator

from derive.control.system import System
from derive.derivation import Phrase
from derive.expression import Expr, number, replace
from derive.given.datum import Datum
from derive.kinds.problem import Problem


def data(system: System, problem: Problem) -> Iterator[Datum]:
    """The equations, each delay in its place, then the signals."""
    delays: dict[Expr, Expr] = {delay.fraction: delay.typed for delay in system.delays}
    sides = ((replace(each.left, delays), replace(each.right, delays)) for each in system.equations)
    yield Datum(Phrase("equations" if len(system.equations) > 1 else "equation"), equations=tuple(sides))
    signals = {"input": system.input, "output": system.output}
    yield Datum(Phrase("signals", signals), words=("input|driv|appl|from",))
    if system.disturbance:
        yield Datum(Phrase("disturbance", {"disturbance": system.disturbance}), words=("disturb",))
    for delay in system.delays:
        about = {"delay": delay.typed, "order": number(delay.order)}
        yield Datum(Phrase("delay", about), words=("Pad|fraction|order",))
