"""What is given of a matrix: its entries."""

from __future__ import annotations

from collections.abc import Iterator

from derive.derivation import Phrase
from derive.given.datum import Datum
from derive.kinds.problem import Problem
from derive.mechanics.matrices import GivenMatrix
from derive.names import named


def data(given: GivenMatrix, problem: Problem) -> Iterator[Datum]:
    """The matrix by the name that answers have for it."""
    name = named("J", given.value, problem.taken)
    yield Datum(Phrase("matrix"), equations=((name, given.value),), ours=frozenset({name.name}))
