"""What is given of a matrix: its entries."""

from __future__ import annotations

from collections.abc import Iterator

from derive.derivation import Phrase
from derive.given.datum import Datum, names
from derive.kinds.problem import Problem
from derive.mechanics.matrices import GivenMatrix
from derive.names import named

INERTIA = ("christoffel", "properties")  # kinds for which it is an inertia matrix


def data(given: GivenMatrix, problem: Problem) -> Iterator[Datum]:
    """The matrix by the name that answers have for it."""
    usual = "D" if any(kind in INERTIA for kind, _ in problem.questions) else "J"
    name = named(usual, given.value, problem.taken)
    yield Datum(Phrase("matrix"), equations=((name, given.value),), ours=frozenset({name.name}))
    if given.variables:
        yield Datum(Phrase("variables", {"names": names(given.variables)}))
