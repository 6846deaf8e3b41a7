"""A polynomial in sines and cosines as a product: a_2 a_3 s_3 (a_2 c_2 + a_3 c_23)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import combinations
from operator import mul

from flint import fmpq_mpoly

from derive.algebra.bounds import spend
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.multivariate import grouped
from derive.algebra.rationals import as_fraction, measure, to_flint
from derive.algebra.scalar import Scalar, common_ring
from derive.algebra.solving.half_angles import HalfAngles, Halved, half_angles

MOST_TERMS = 120  # of a column that is still worth writing


class TooLong(ArithmeticError):
    """What is asked for outgrew what is worth writing."""


@dataclass(frozen=True, slots=True, eq=False)
class Factored:
    """`constant` (free of the names) times the product of the factors, each to its power."""

    constant: Scalar
    factors: tuple[tuple[Scalar, int], ...]

    @property
    def value(self) -> Scalar:
        """The product, multiplied out."""
        return reduce(mul, (factor**power for factor, power in self.factors), self.constant)


A_HALF_ANGLE = 10  # units of work that a term in half angles takes


def effort(scalar: Scalar, names: Iterable[str]) -> int:
    """What `factored` costs, in terms of half angles; some 100,000 of them a second."""
    home, terms = scalar.ring, scalar.numerator.to_dict()
    total = len(terms)
    for k in half_angles(home, names).places:
        c, s = home.pair_index(k)
        total *= 1 + max((int(powers[c]) + int(powers[s]) for powers in terms), default=0)
    roots = {root.name for root in home.roots} & set(scalar.generators())
    return int(total * 4 ** len(roots))


def factored(scalar: Scalar, names: Iterable[str]) -> Factored:
    """The factors of a polynomial that hold any of the names, primitive, and all else in front.

    Where half angles bring nothing more, a factor is the whole. Zero is its own constant.
    """
    names = tuple(names)
    home = scalar.ring
    if not scalar or not depends(scalar, names):
        return Factored(scalar, ())
    halves = half_angles(home, names)
    found = halves.factors(halves.of(scalar.numerator))
    moving = [(primitive(Scalar(home, part)), power) for part, power in _whole(halves, found)]
    factors = tuple((part, power) for part, power in moving if depends(part, names))
    product = reduce(mul, (part**power for part, power in factors), Scalar.of(1))
    constant = _quotient(scalar, product, names)
    if constant is None:
        return Factored(Scalar.of(1), ((scalar, 1),))
    return Factored(constant, factors)


def common_factor(scalars: Sequence[Scalar], names: Iterable[str]) -> tuple[Scalar, list[Scalar]]:
    """(factor, quotients): the greatest polynomial that divides all the scalars, none of which may be a
    fraction."""
    home = common_ring(scalars)
    spend(A_HALF_ANGLE * sum(effort(scalar.into(home), names) for scalar in scalars))
    halves = half_angles(home, names)
    several = [halves.of(scalar.into(home).numerator) for scalar in scalars]
    shared = halves.common([each for each in several if each.part != 0])
    found = halves.factors(shared)
    number = Halved(halves.context.constant(1), tuple(0 for _ in halves.places))
    even = reduce(mul, (part**power for part, power in _pairs(halves, found)), number)
    rest = [each // even if each.part != 0 else each for each in several]
    quotients = [halves.back(each) if each.part != 0 else home.zero for each in rest]
    return Scalar(home, halves.back(even)), [Scalar(home, quotient) for quotient in quotients]


def primitive_column(column: ScalarMatrix, names: Iterable[str]) -> ScalarMatrix:
    """A column (n by 1) of the same direction, without fractions and common factors. Raises TooLong."""
    column = ScalarMatrix.of(column.rows)
    below = [entry.denominator for entry in column.entries if entry.denominator is not None]
    multiple = reduce(_least_multiple, below, column.ring.one)
    whole = [_times(entry, multiple) for entry in column.entries]
    if not any(whole):
        return column
    if sum(len(entry.numerator) for entry in whole) > MOST_TERMS:
        raise TooLong
    names = tuple(names)
    found = _divided(whole, names)
    for (
        root
    ) in column.ring.roots:  # w divides w a + w^2 too, where w^2 is written out: then w^2 divides w times it
        if not root.is_sign and root.degree == 2 and any(root.name in e.generators() for e in found):
            times = Scalar(column.ring, column.ring.gen(root.name))
            found = min(found, _divided([entry * times for entry in found], names), key=_terms)
    return ScalarMatrix.column(found)


def _divided(entries: Sequence[Scalar], names: tuple[str, ...]) -> list[Scalar]:
    """The entries without their common factors and numbers."""
    _, quotients = common_factor(entries, names)
    content = measure(as_fraction(each) for entry in quotients for each in entry.numerator.coeffs())
    return [entry / content for entry in quotients]


def _terms(entries: Sequence[Scalar]) -> int:
    return sum(len(entry.numerator) for entry in entries)


def primitive(scalar: Scalar) -> Scalar:
    """The scalar over the greatest number that leaves whole coefficients."""
    numbers = scalar.numerator.coeffs()
    content = numbers[0] if len(numbers) == 1 else to_flint(measure(map(as_fraction, numbers)))
    return Scalar(scalar.ring, scalar.numerator / content)


def depends(scalar: Scalar, names: Iterable[str]) -> bool:
    """Whether it holds one of the names."""
    return not scalar.letters().isdisjoint(names)


def _quotient(scalar: Scalar, product: Scalar, names: tuple[str, ...]) -> Scalar | None:
    """What is left in front, if that is free of the names."""
    product = product.into(scalar.ring) if product.ring is not scalar.ring else product
    constant = scalar / product
    if constant.denominator is None and not depends(constant, names):
        return constant
    return None


def _times(entry: Scalar, multiple: fmpq_mpoly) -> Scalar:
    """The entry times a multiple of its denominator, divided before anything is reduced: afterwards the
    two might no longer share a factor."""
    home = entry.ring
    over = multiple if entry.denominator is None else divmod(multiple, entry.denominator)[0]
    return Scalar(home, home.reduce(entry.numerator * over))


def _least_multiple(a: fmpq_mpoly, b: fmpq_mpoly) -> fmpq_mpoly:
    return divmod(a * b, a.gcd(b))[0]


def _whole(halves: HalfAngles, found: list[tuple[Halved, int]]) -> list[tuple[fmpq_mpoly, int]]:
    """Factors that are polynomials in sines and cosines; those of odd degree are put together."""
    even = _pairs(halves, found)
    rest = _left(found, even)
    if rest is not None:
        even = [*even, (rest, 1)]
    return [(halves.back(part), power) for part, power in even]


def _pairs(halves: HalfAngles, found: list[tuple[Halved, int]]) -> list[tuple[Halved, int]]:
    """Even factors, and products of two odd ones: u v is s/2 and so on."""
    left = dict(enumerate(found))
    pairs: list[tuple[Halved, int]] = []
    for one, two in _couples(halves, found):
        (part, power), (other, power_of_other) = left[one], left[two]
        shared = min(power, power_of_other)
        if shared:
            pairs.append((part * other, shared))
            left[one], left[two] = (part, power - shared), (other, power_of_other - shared)
    for part, power in left.values():
        if not any(part.parity) and power:
            pairs.append((part, power))
        elif power > 1:
            pairs.append((part**2, power // 2))
    return pairs


def _couples(halves: HalfAngles, found: list[tuple[Halved, int]]) -> list[tuple[int, int]]:
    """Odd factors of the same parity, those first that are each other a quarter turn on."""
    odd = [k for k, (part, _) in enumerate(found) if any(part.parity)]
    couples = [(a, b) for a, b in combinations(odd, 2) if found[a][0].parity == found[b][0].parity]
    return sorted(couples, key=lambda pair: not _turned(halves, found[pair[0]][0], found[pair[1]][0]))


def _turned(halves: HalfAngles, one: Halved, two: Halved) -> bool:
    """Whether half a turn of one angle, (u, v) -> (v, -u), takes one to the other."""
    for k in range(len(halves.places)):
        turned = _turn(halves, one, k)
        if turned == two.part or turned == -two.part:
            return True
    return False


def _turn(halves: HalfAngles, halved: Halved, k: int) -> fmpq_mpoly:
    t, degree = halves.context.gen(k), halved.degrees[k]
    parts = grouped(halved.part, (k,)).items()
    return sum((rest * (-t) ** (degree - power) for (power,), rest in parts), halves.context.constant(0))


def _left(found: list[tuple[Halved, int]], even: list[tuple[Halved, int]]) -> Halved | None:
    """The product of the odd factors that no other one completes; even, for the whole is."""
    whole = reduce(mul, (part**power for part, power in found))
    for part, power in even:
        whole = whole // part**power
    return whole if any(whole.degrees) or not whole.part.is_constant() else None
