"""What is given of an encoder or of a switched voltage."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.formulas.with_units import measured
from derive.derivation import Phrase
from derive.expression import ONE, ZERO
from derive.given.datum import Datum
from derive.kinds.problem import Problem
from derive.mechanics.sensing import Encoder, Incremental, PulseWidth

IN_QUESTIONS = True


def data(sensor: Encoder | PulseWidth, problem: Problem) -> Iterator[Datum]:
    """A sentence for each size."""
    if isinstance(sensor, PulseWidth):
        for key in ("high", "low", "duty", "mean", "frequency"):
            if (value := getattr(sensor, key)) is not None and (key, value) != ("low", ZERO):
                yield Datum(Phrase(key, {"value": measured(value, UNITS.get(key, ""))}))
        return
    disc = sensor.disc
    if isinstance(disc, Incremental):
        known = (
            Phrase("incremental", {"lines": disc.lines}) if disc.lines != ZERO else Phrase("incremental-disc")
        )
        yield Datum(known, words=("incremental",))
        yield Datum(
            Phrase("one-edge") if disc.edges == ONE else Phrase("edges", {"edges": disc.edges}),
            words=("edge",),
        )
    else:
        known = Phrase("absolute", {"bits": disc.bits}) if disc.bits != ZERO else Phrase("absolute-disc")
        yield Datum(known, words=("absolute",))
        if disc.turn_bits != ZERO:
            yield Datum(Phrase("turn-bits", {"bits": disc.turn_bits}), words=("turn|revolution",))
    if sensor.gear is not None:
        yield Datum(Phrase("gear", {"gear": sensor.gear}), words=("gear|times as fast",))


UNITS = {"high": "V", "low": "V", "mean": "V", "frequency": "Hz"}
