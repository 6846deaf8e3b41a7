"""Linear forms in angles, the arguments of sines and cosines: `theta1 + 2*theta2 + 5/36*pi`.

A form has a part that moves and a part that is fixed: an angle in degrees is a multiple of pi, one in radians
a multiple of 1, any other constant angle an atom of its own, `sqrt(2)`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from flint import fmpq_mat

from derive.algebra.opaque import Opaque
from derive.algebra.rationals import Rational, lowest, to_flint

PI = "pi"  # the atom of fixed angles in degrees
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

    @property
    def moving(self) -> Form:
        """The part that holds names."""
        return _parted(self)[0]

    @property
    def fixed(self) -> Form:
        """The part that is a number."""
        return _parted(self)[1]

    def __str__(self) -> str:
        return "+".join(atom if n == 1 else f"{n}*{atom}" for atom, n in self.parts)


def letters_of(atom: str) -> frozenset[str]:
    """The names in an atom or a symbol: a product such as `w*t^2`, or a function and its arguments."""
    if isinstance(atom, Opaque):
        return frozenset().union(*(argument.letters() for argument in atom.arguments))
    return frozenset(factor.partition("^")[0] for factor in atom.split("*")) - {PI, RADIAN}


def is_fixed(atom: str) -> bool:
    """Whether an atom is a number: no name stands in it."""
    return not letters_of(atom)


@lru_cache(maxsize=4096)
def _parted(form: Form) -> tuple[Form, Form]:
    fixed = tuple(part for part in form.parts if is_fixed(part[0]))
    return Form(tuple(part for part in form.parts if part not in fixed)), Form(fixed)


def first_quarter(form: Form) -> tuple[int, int, Form]:
    """(sign, sign, angle): the cosine and the sine of a fixed form are these signs times those of an angle
    between 0 and 90 degrees, where it is a multiple of pi; of any other, one whose first part is positive."""
    if form.without(PI).parts:
        return (1, 1, form) if form.parts[0][1] > 0 else (1, -1, form.scaled(-1))
    turns = form.of_atom(PI)
    half_turns = round(turns)
    rest = turns - half_turns
    sign = -1 if half_turns % 2 else 1
    return sign, sign if rest > 0 else -sign, Form.of({PI: abs(rest)})


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
