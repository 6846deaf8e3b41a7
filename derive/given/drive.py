"""What is given of a drive: the inertias of its rotor and its load, the gear, and the torques."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.formulas.with_units import measured
from derive.derivation import Phrase
from derive.given.datum import Datum
from derive.kinds.problem import Problem
from derive.mechanics.sensing import Drive

IN_QUESTIONS = True


def data(drive: Drive, problem: Problem) -> Iterator[Datum]:
    """A sentence for each."""
    yield Datum(Phrase("inertias", {"rotor": measured(drive.rotor), "load": measured(drive.load)}))
    for key in ("gear", "torque", "load_torque"):
        if (value := getattr(drive, key)) is not None:
            yield Datum(
                Phrase(key, {"value": measured(value)}), words=("gear" if key == "gear" else "torque",)
            )
