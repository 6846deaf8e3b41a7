"""A matrix that is given as such: a Jacobian, or an inertia matrix, without the arm that has it."""

from __future__ import annotations

from dataclasses import dataclass

from derive.expression import Call, Matrix, free_symbols, walk

ANGULAR = ("cos", "sin", "tan")


@dataclass(frozen=True, slots=True)
class GivenMatrix:
    """The matrix (m by n) and the variables it depends on; of n variables the j-th moves by column j."""

    value: Matrix
    variables: tuple[str, ...] = ()

    @property
    def sliding(self) -> tuple[str, ...]:
        """The variables that stand in no sine or cosine."""
        calls = [node for node in walk(self.value) if isinstance(node, Call) and node.function in ANGULAR]
        turning = frozenset().union(*map(free_symbols, calls))
        return tuple(name for name in self.variables if name not in turning)
