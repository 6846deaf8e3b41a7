"""Linear forms in angles, the arguments of sines and cosines: `theta1 + 2*theta2 + 5/36*pi`.

A form has a part that moves and a part that is fixed: an angle in degrees is a multiple of pi, one in radians
a multiple of 1, any other constant angle an atom of its own, `sqrt(2)`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache, reduce

from flint import fmpq_mat

from derive.algebra.generators import PI, letters_of
from derive.algebra.rationals import Rational, as_fraction, lowest, to_flint
from derive.errors import NotDerivable

MOST_TURNS = 200  # of an angle by another, as a polynomial


@dataclass(frozen=True, slots=True)
class Form:
    """A sum of atoms with rational coefficients, sorted by atom, no zeros: theta1 + theta2/2."""

    parts: tuple[tuple[str, Rational], ...]

    @staticmethod
    def of(parts: Mapping[str, Rational]) -> Form:
        """The form with these coefficients; zeros are left out."""
        return Form(tuple(sorted((atom, lowest(n)) for atom, n in parts.items() if n)))

    def __add__(self, other: Form) -> Form:
        total = dict(self.parts)
        for atom, coefficient in other.parts:
            total[atom] = total.get(atom, 0) + coefficient
        return Form.of(total)

    def scaled(self, by: Rational) -> Form:
        """The form times a number."""
        return Form.of({atom: n * by for atom, n in self.parts})

    def of_atom(self, atom: str) -> Fraction:
        """The coefficient of one atom."""
        return Fraction(dict(self.parts).get(atom, 0))

    def without(self, atom: str) -> Form:
        """The form without one of its atoms."""
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
    return _combination(form, tuple(basis))


@lru_cache(maxsize=4096)
def _combination(form: Form, basis: tuple[Form, ...]) -> tuple[Fraction, ...] | None:
    if not basis:
        return None if form.parts else ()
    atoms = sorted({atom for member in (form, *basis) for atom, _ in member.parts})
    columns = [dict(member.parts) for member in (*basis, form)]
    table = [to_flint(column.get(atom, 0)) for atom in atoms for column in columns]
    reduced, rank = fmpq_mat(len(atoms), len(columns), table).rref()
    if rank > len(basis):
        return None
    entries = (reduced[row, len(basis)] for row in range(len(basis)))
    return tuple(map(as_fraction, entries))


def multiples(form: Form, angles: Sequence[Form]) -> tuple[Fraction, ...] | None:
    """How often each of the angles is in the moving part of a form (a fixed angle never is); None where they
    do not make it up."""
    moving = [k for k, angle in enumerate(angles) if angle.moving.parts]
    found = combination(form.moving, [angles[k].moving for k in moving])
    if found is None:
        return None
    often = dict(zip(moving, found, strict=True))
    return tuple(often.get(k, Fraction(0)) for k in range(len(angles)))


def require_few(form: Form, times: Iterable[Fraction]) -> None:
    """Raises NotDerivable where an angle is so many times another that the one's sine fills pages in those
    of the other."""
    if any(max(abs(n.numerator), n.denominator) > MOST_TURNS for n in times):
        raise NotDerivable(
            f"the angle {form} is more than {MOST_TURNS} times another, or as small a part of one: "
            "sines of both are no polynomials that could be written down"
        )


def fixed_parts(form: Form, angles: Sequence[Form], times: Sequence[Fraction]) -> Iterator[Form]:
    """What is left of a form beside these multiples: a multiple of pi, and any other number."""
    taken = (angle.scaled(-n) for angle, n in zip(angles, times, strict=True) if n)
    rest = reduce(Form.__add__, taken, form).fixed
    yield Form.of({PI: rest.of_atom(PI)})
    yield rest.without(PI)
