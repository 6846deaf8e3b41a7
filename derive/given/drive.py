"""What is given of a drive: the inertias of its rotor and its load, the gear, and the torques."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.formulas.with_units import measured
from derive.derivation import Phrase, Said
from derive.expression import ZERO, Expr
from derive.given.datum import Datum
from derive.kinds.problem import Problem
from derive.mechanics.gearing import Stage
from derive.mechanics.sensing import Drive

IN_QUESTIONS = True


def data(drive: Drive, problem: Problem) -> Iterator[Datum]:
    """A sentence for each."""
    inertias = {name: measured(size) for name, size in _inertias(drive)}
    if inertias:
        yield Datum(Phrase("inertias" if len(inertias) > 1 else next(iter(inertias)), inertias))
    for index, stage in enumerate(drive.stages, 1):
        said: dict[str, Said] = {"said": _stage(stage)}
        each = Phrase("stage", {**said, "stage": str(index)}) if drive.stages[1:] else Phrase("train", said)
        yield Datum(each, words=(WORDS[stage.form],))
        if stage.inertia is not None:
            about = {"stage": str(index), "value": measured(stage.inertia)}
            yield Datum(Phrase("shaft", about), words=("shaft",))
    for key in ("gear", "torque", "load_torque"):
        if (value := getattr(drive, key)) is not None:
            yield Datum(
                Phrase(key, {"value": measured(value)}), words=("gear" if key == "gear" else "torque",)
            )


def _inertias(drive: Drive) -> Iterator[tuple[str, Expr]]:
    yield from ((name, getattr(drive, name)) for name in ("rotor", "load") if getattr(drive, name) != ZERO)


def _stage(stage: Stage) -> Phrase:
    """One stage; wheels with their sizes."""
    if stage.form == "ratio":
        return Phrase("stage-ratio", {"value": stage.sizes[0]})
    sizes = (Phrase(stage.measured, {"size": measured(size)}) for size in stage.sizes)
    wheels = dict(zip(("first", "second"), sizes, strict=True))
    return Phrase(f"stage-{stage.form}", wheels)


WORDS = {
    "gears": "gear|spur|pinion", "ring": "ring|internal", "belt": "belt", "crossed": "crossed",
    "harmonic": "harmonic", "planetary": "planet", "ratio": "ratio|to 1|reduc|gear",
}  # fmt: skip
