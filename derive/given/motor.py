"""What is given of a motor: how it is controlled, what is observed, and what its letters stand for."""

from __future__ import annotations

from collections.abc import Iterator

from derive.control.system import System
from derive.derivation import Phrase
from derive.expression import symbols
from derive.given.datum import Datum
from derive.kinds.problem import Problem

ELECTRICAL = {"armature": "V_a R_a L_a K_m K_b", "field": "V_f R_f L_f K_m"}


def data(motor: System, problem: Problem) -> Iterator[Datum]:
    """Its terminals with their letters, then its load."""
    control, observed = motor.motor
    letters = dict(zip("VRLmb", symbols(ELECTRICAL[control]), strict=False))
    yield Datum(Phrase(control, letters), words=(control,))
    load = dict(zip("Jb", symbols("J b"), strict=True))
    yield Datum(
        Phrase(observed, load | {"output": motor.output}),
        words=("angle|turn" if observed == "angle" else "speed",),
    )
    if motor.disturbance:
        yield Datum(Phrase("disturbance", {"disturbance": motor.disturbance}), words=("disturb",))
