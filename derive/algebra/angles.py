"""Linear forms in angles, the arguments of sines and cosines: `theta1 + 2*theta2`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import fmpq_mat

from derive.algebra.opaque import Opaque
from derive.algebra.rationals import Rational, lowest, to_flint

PI = "pi"  # the atom of fixed angles; every other atom is the name of an angle
RADIAN = "1"  # the atom of fixed angles given as plain numbers


@dataclass(frozen=True, slots=True)
class Form:
    """A sum of atoms with rational coefficients, sorted by atom, no zeros: theta1 + theta2/2."""

    parts: tuple[tuple[str, Rational], ...]

    @staticmethod
    def of(parts: Mapping[str, Rational]) -> Form:
        return Form(tuple(sorted((atom, lowest(n)) for atom, n in parts.items() if n)))

    def __add__(self, other: Form) -> Form:
        total = dict(self.parts)
        for atom, coefficient in other.parts:
            total[atom] = total.get(atom, 0) + coefficient
        return Form.of(total)

    def scaled(self, by: Rational) -> Form:
        return Form.of({atom: n * by for atom, n in self.parts})

    def of_atom(self, atom: str) -> Fraction:
        """The coefficient of one atom."""
        return Fraction(dict(self.parts).get(atom, 0))

    def without(self, atom: str) -> Form:
        return Form(tuple(part for part in self.parts if part[0] != atom))

    @property
    def letters(self) -> frozenset[str]:
        """The names its atoms rest on, `pi` apart."""
        return frozenset().union(*(letters_of(atom) for atom, _ in self.parts))

    def __str__(self) -> str:
        return "+".join(atom if n == 1 else f"{n}*{atom}" for atom, n in self.parts)


def letters_of(atom: str) -> frozenset[str]:
    """The names in an atom or a symbol: a product such as `w*t^2`, or a function and its arguments."""
    if isinstance(atom, Opaque):
        return frozenset().union(*(argument.letters() for argument in atom.arguments))
    return frozenset(factor.partition("^")[0] for factor in atom.split("*")) - {PI, RADIAN}


def combination(form: Form, basis: Sequence[Form]) -> tuple[Fraction, ...] | None:
    """The coefficients that write `form` in linearly independent `basis`; None if there are none."""
    if not basis:
        return None if form.parts else ()
    atoms = sorted({atom for member in (form, *basis) for atom, _ in member.parts})
    columns = [dict(member.parts) for member in (*basis, form)]
    table = [to_flint(column.get(atom, 0)) for atom in atoms for column in columns]
    reduced, rank = fmpq_mat(len(atoms), len(columns), table).rref()
    if rank > len(basis):
        return None
    entries = (reduced[row, len(basis)] for row in range(len(basis)))
    return tuple(Fraction(int(entry.p), int(entry.q)) for entry in entries)
