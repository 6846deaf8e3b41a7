"""A matrix that is given as such: a Jacobian, or an inertia matrix, without the arm that has it."""

from __future__ import annotations

from dataclasses import dataclass

from derive.expression import Matrix


@dataclass(frozen=True, slots=True)
class GivenMatrix:
    """The matrix (m by n) and the variables it depends on; of n variables the j-th moves by column j."""

    value: Matrix
    variables: tuple[str, ...] = ()
