"""What is given of a motion: its moves in their order."""

from __future__ import annotations

from collections.abc import Iterator

from derive.derivation import Phrase
from derive.given.datum import Datum
from derive.given.moves import moves_said
from derive.kinds.problem import Problem
from derive.mechanics.motion import Motion


def data(motion: Motion, problem: Problem) -> Iterator[Datum]:
    """A list of the moves."""
    yield Datum(Phrase("moves"), items=(*moves_said(motion.moves),))
