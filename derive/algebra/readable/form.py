"""From a normal form to what a person would write.

The normal form decides; this only finds a short way of saying it. Angles are tried in several
bases (theta1, theta1 + theta2, ... or theta2, theta2 + theta3, ...), contracted to sums of angles,
and nested by common factors.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache, partial, reduce
from math import lcm

from flint import fmpq_mpoly

from derive.algebra.angles import Form, combination
from derive.algebra.bounds import no_charge
from derive.algebra.generators import ITSELF, Opaque
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import walk_in
from derive.algebra.rationals import as_fraction, measure
from derive.algebra.readable.angle_sums import contracted
from derive.algebra.readable.by_rate import nested
from derive.algebra.readable.terms import Alphabet, Style, Terms, terms_of
from derive.algebra.readable.writing import Writing
from derive.algebra.ring import Ring, ring
from derive.algebra.scalar import Scalar
from derive.algebra.values import Value
from derive.errors import NotAsWritten
from derive.expression import (
    ONE,
    Call,
    Expr,
    Matrix,
    Power,
    Product,
    Quotient,
    Symbol,
    multiply,
    negate,
    sqrt,
)

# Above this many terms other bases cost more than a reader gains.
MOST_REBASED = 30
MOST_EXPANDED = 500  # terms in another basis: the cosine of a sum of 12 angles has 2048


def readable(scalar: Scalar, style: Style = Style()) -> Expr:
    """A short expression equal to the scalar, in the style of the sheet. Raises NotDerivable where reading it
    takes more work than an answer may."""
    return as_written(Reading(style).scalar(scalar), scalar)


def as_written(tree: Expr, scalar: Scalar) -> Expr:
    """The tree, read again and found to be the scalar it was made of. Raises NotAsWritten."""
    with no_charge():
        if walk_in(scalar.ring, tree, _leaves_of(scalar.ring)).scalar(tree) != scalar:
            raise NotAsWritten("a value was written down as another one")
    return tree


@lru_cache(maxsize=64)
def _leaves_of(home: Ring) -> dict[Expr, Value]:
    """What names, sines and cosines are in a ring, as far as they were read; first the signs of roots."""
    return {Symbol(root.name): Scalar(home, home.gen(root.name)) for root in home.roots if root.is_sign}


def readable_matrix(matrix: ScalarMatrix, style: Style = Style()) -> Matrix:
    """The matrix of short expressions, of the same shape, entry by entry."""
    reading = Reading(style)
    return Matrix(tuple(tuple(as_written(reading.scalar(e), e) for e in row) for row in matrix.rows))


@dataclass(frozen=True, slots=True)
class Reading:
    """Reads scalars in one style."""

    style: Style = Style()

    def scalar(self, scalar: Scalar) -> Expr:
        """A short tree of a scalar: a polynomial, or a quotient of two with whole coefficients."""
        if scalar.denominator is None:
            return self._polynomial(scalar.ring, scalar.numerator)
        whole = lcm(*(int(k.q) for k in scalar.numerator.coeffs()))
        top = self._polynomial(scalar.ring, scalar.numerator * whole)
        return self._quotient(top, self._polynomial(scalar.ring, scalar.denominator * whole))

    @staticmethod
    def _quotient(top: Expr, bottom: Expr) -> Expr:
        if isinstance(bottom, Product) and bottom.factors[0] == negate(ONE):
            top, bottom = negate(top), multiply(*bottom.factors[1:])
        return Quotient(top, bottom)

    def generator(self, home: Ring, name: str) -> Expr:
        """The tree of a symbol, a root or a function of a ring; arguments are made readable too."""
        if not isinstance(name, Opaque):  # a symbol, a sign, or the root of a number
            found = next((root for root in home.roots if root.name == name), None)
            if found is None or found.is_sign:
                return Symbol(name)
            return sqrt(self._polynomial(home, home.polynomial(found.radicand)))
        arguments = tuple(map(self.scalar, name.arguments))
        if name.function == ITSELF:
            return arguments[0]
        return Power(*arguments) if name.function == "pow" else Call(name.function, arguments)

    def _polynomial(self, home: Ring, polynomial: fmpq_mpoly) -> Expr:
        alphabet = Alphabet(self.style, partial(self.generator, home))
        if len(polynomial) <= 1:
            return self._written(terms_of(Scalar(home, polynomial), alphabet), alphabet)
        best = min(
            (contracted(terms, alphabet) for terms in self._bases(home, polynomial, alphabet)),
            key=lambda terms: (len(terms), _weight(terms)),
        )
        return self._written(best, alphabet)

    @staticmethod
    def _written(terms: Terms, alphabet: Alphabet) -> Expr:
        return Writing(alphabet).tree(nested(terms, alphabet))

    def _bases(self, home: Ring, polynomial: fmpq_mpoly, alphabet: Alphabet) -> Iterator[Terms]:
        """The terms in each basis of the angles worth trying."""
        scalar = Scalar(home, polynomial)
        yield terms_of(scalar, alphabet)
        if len(polynomial) > MOST_REBASED or not _related(scalar):
            return
        for angles in _other_bases(home.angles):
            if _expanded(scalar, angles) <= MOST_EXPANDED:
                yield terms_of(scalar.into(ring(home.roots, angles, home.symbols)), alphabet)


def _expanded(scalar: Scalar, angles: tuple[Form, ...]) -> int:
    """How many terms there are in that basis, before any cancel: 2^(k-1) for a sine of k angles."""
    home = scalar.ring
    doublings = [_doublings(form, angles) for form in home.angles]
    places = [(i, n) for k, n in enumerate(doublings) if n for i in home.pair_index(k)]
    return sum(2 ** sum(int(powers[i]) * n for i, n in places) for powers, _ in scalar.numerator.terms())


@lru_cache(maxsize=1024)
def _doublings(form: Form, angles: tuple[Form, ...]) -> int:
    """How often the addition theorem is used to write the cosine of a form by those of a basis."""
    multiples = combination(form.moving, [each.moving for each in angles if each.moving.parts]) or ()
    return max(sum(abs(int(n)) for n in multiples) - 1, 0)


def _related(scalar: Scalar) -> bool:
    """Whether two of its angles have a part in common; else no other basis is shorter."""
    degrees, home = scalar.numerator.degrees(), scalar.ring
    used = [form for k, form in enumerate(home.angles) if any(degrees[i] > 0 for i in home.pair_index(k))]
    atoms = [atom for form in used for atom, _ in form.moving.parts]
    return len(atoms) > len(set(atoms))


@lru_cache(maxsize=256)
def _other_bases(angles: tuple[Form, ...]) -> tuple[tuple[Form, ...], ...]:
    """Single angles; and for sums that begin with the same angle, the sums without it. Each angle keeps what
    is fixed in it."""
    fixed = tuple(form for form in angles if not form.moving.parts)
    moving = tuple(form for form in angles if form.moving.parts)
    return tuple((*basis, *fixed) for basis in _moving_bases(moving))


def _moving_bases(angles: tuple[Form, ...]) -> tuple[tuple[Form, ...], ...]:
    atoms = sorted({atom for form in angles for atom, _ in form.moving.parts})
    if len(atoms) != len(angles):
        return ()
    singles = tuple(_single(atom, angles) for atom in atoms)
    if set(singles) == set(angles):
        return ()
    found = [singles] if all(_whole(form, singles) for form in angles) else []
    for first in singles:
        atom = first.moving.parts[0][0]
        sums = [form for form in angles if form != first and form.of_atom(atom) == 1]
        if first in angles and sums:
            found.append(tuple(form + first.scaled(-1) if form in sums else form for form in angles))
    return tuple({frozenset(basis): basis for basis in reversed(found)}.values())[::-1]


def _single(atom: str, angles: tuple[Form, ...]) -> Form:
    """The angle by itself, with what is fixed in the sums of which it is made."""
    alone = Form.of({atom: 1})
    multiples = combination(alone, [form.moving for form in angles]) or ()
    parts = (form.fixed.scaled(n) for form, n in zip(angles, multiples, strict=True))
    return reduce(Form.__add__, parts, alone)


def _whole(form: Form, basis: tuple[Form, ...]) -> bool:
    multiples = combination(form.moving, [each.moving for each in basis])
    return multiples is not None and all(n.denominator == 1 for n in multiples)


def _weight(terms: Terms) -> int:
    return sum(power for monomial in terms for _, power in monomial)


def factored_matrix(matrix: ScalarMatrix, style: Style = Style()) -> Expr:
    """The matrix, or `factor * matrix` where a monomial of symbols divides every entry."""
    factor = common_factor(matrix)
    if factor is None:
        return readable_matrix(matrix, style)
    rest = matrix.map(lambda entry: entry / factor)
    return Product((readable(factor, style), readable_matrix(rest, style)))


def common_factor(matrix: ScalarMatrix) -> Scalar | None:
    """The greatest monomial, its number included, that leaves whole coefficients in every entry.

    None where it is a mere number, or where an entry is a fraction.
    """
    entries = [entry for entry in matrix.entries if entry]
    if len(entries) < 2 or any(entry.denominator is not None for entry in entries):
        return None
    powers = reduce(_least, (_least_powers(entry) for entry in entries))
    if not any(powers):
        return None
    number = measure(as_fraction(k) for entry in entries for k in entry.numerator.coeffs())
    home = matrix.ring
    return Scalar(home, home.context.from_dict({powers: 1})) * number


def _least_powers(entry: Scalar) -> tuple[int, ...]:
    return reduce(_least, (tuple(map(int, powers)) for powers, _ in entry.numerator.terms()))


def _least(a: tuple[int, ...], b: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(map(min, a, b))
