"""What is given of a rotation: its matrix."""

from __future__ import annotations

from collections.abc import Iterator

from derive.derivation import Phrase
from derive.given.datum import Datum, as_typed
from derive.kinds.problem import Problem
from derive.mechanics.rotations import GivenRotation
from derive.names import named


def data(given: GivenRotation, problem: Problem) -> Iterator[Datum]:
    """The matrix by the name that answers have for it."""
    name = named("R", given.matrix, problem.taken)
    key = "any-rotation" if given.names else "rotation"
    equations = ((name, as_typed(given.matrix, given.rounded)),)
    yield Datum(Phrase(key), equations=equations, ours=frozenset({name.name}))
