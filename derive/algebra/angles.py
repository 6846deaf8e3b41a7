"""Linear forms in angles, the arguments of sines and cosines: `theta1 + 2*theta2`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

PI = "pi"  # the atom of fixed angles; every other atom is the name of an angle
RADIAN = "1"  # the atom of fixed angles given as plain numbers


@dataclass(frozen=True, slots=True)
class Form:
    """A sum of atoms with rational coefficients, sorted by atom, no zeros: theta1 + theta2/2."""

    parts: tuple[tuple[str, Fraction], ...]

    @staticmethod
    def of(parts: Mapping[str, Fraction | int]) -> Form:
        return Form(tuple(sorted((atom, Fraction(n)) for atom, n in parts.items() if n)))

    def __add__(self, other: Form) -> Form:
        total = dict(self.parts)
        for atom, coefficient in other.parts:
            total[atom] = total.get(atom, Fraction(0)) + coefficient
        return Form.of(total)

    def scaled(self, by: Fraction | int) -> Form:
        return Form.of({atom: n * by for atom, n in self.parts})

    def of_atom(self, atom: str) -> Fraction:
        """The coefficient of one atom."""
        return dict(self.parts).get(atom, Fraction(0))

    def without(self, atom: str) -> Form:
        return Form(tuple(part for part in self.parts if part[0] != atom))

    def __str__(self) -> str:
        return "+".join(atom if n == 1 else f"{n}*{atom}" for atom, n in self.parts)


def combination(form: Form, basis: Sequence[Form]) -> tuple[Fraction, ...] | None:
    """The coefficients that write `form` in linearly independent `basis`; None if there are none."""
    rows = {atom for member in (form, *basis) for atom, _ in member.parts}
    table = [[b.of_atom(atom) for b in basis] + [form.of_atom(atom)] for atom in sorted(rows)]
    pivots = _eliminate(table, len(basis))
    if any(row[-1] and not any(row[:-1]) for row in table):
        return None
    found = [Fraction(0)] * len(basis)
    for row, col in enumerate(pivots):
        found[col] = table[row][-1]
    return tuple(found)


def _eliminate(table: list[list[Fraction]], columns: int) -> list[int]:
    """Gauss-Jordan in place; returns the pivot columns, one a row."""
    pivots: list[int] = []
    for col in range(columns):
        top = len(pivots)
        pivot = next((r for r in range(top, len(table)) if table[r][col]), None)
        if pivot is None:
            continue
        table[top], table[pivot] = table[pivot], table[top]
        table[top] = [entry / table[top][col] for entry in table[top]]
        for r, row in enumerate(table):
            if r != top and row[col]:
                table[r] = [a - row[col] * b for a, b in zip(row, table[top], strict=True)]
        pivots.append(col)
    return pivots
