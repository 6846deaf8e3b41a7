"""What is wrong with an inertia that is given as a whole matrix."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal
from derive.algebra.signs import sign_of
from derive.errors import NotDerivable, SheetError
from derive.expression import Symbol
from derive.mechanics.plausible import principal_minors
from derive.sheet.source import At
from derive.sheet.subjects.link import Carried, whole_matrix
from derive.sheet.subjects.registry import Known


def matrix_faults(links: Sequence[Carried], at: At, known: Known) -> Iterator[SheetError]:
    """Matrices that are not symmetric, and those that give a turn about some axis a negative energy."""
    names: Names = {Symbol(name): value for name, value in known.where.items()}
    positive = frozenset(name for name, said in known.assumptions.items() if said == "positive")
    for index, link in enumerate(links):
        try:
            matrix = ScalarMatrix.of([normal(entry, names) for entry in row] for row in whole_matrix(link))
        except (NotDerivable, ZeroDivisionError):
            continue
        if not matrix.rows:
            continue
        uneven = [(i, j) for i, j in combinations(range(3), 2) if matrix[i, j] != matrix[j, i]]
        for i, j in uneven:
            places = f"({i + 1}, {j + 1}) and ({j + 1}, {i + 1})"
            message = f"an inertia matrix is symmetric, but entries {places} differ"
            hint = "write the product of inertia in both, its sign included"
            yield at.fault(message, ("links", index, "inertia", j, i), hint)
        if not uneven and any(sign_of(minor, positive) == -1 for minor in principal_minors(matrix)):
            message = f"the inertia matrix of link {index + 1} is not positive semidefinite"
            hint = "no body turns with a negative energy; mind the signs of the products of inertia"
            yield at.fault(message, ("links", index, "inertia"), hint)
