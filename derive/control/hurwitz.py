"""What must hold for a first column of Routh to have one sign, said as briefly as can be."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

from flint import fmpq_mpoly

from derive.algebra.multivariate import factored
from derive.algebra.rationals import as_fraction
from derive.algebra.readable.form import readable
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar, common_ring
from derive.algebra.solving.polynomials import coefficients, known_sign, monomials
from derive.control.roots import roots
from derive.expression import ZERO, Expr, Relation

Bound: TypeAlias = tuple[str, int, Fraction]  # a symbol above (1) or below (-1) a number


def conditions(column: Sequence[Scalar], positive: Collection[str]) -> tuple[Scalar, ...]:
    """Polynomials that are positive exactly where the entries all have one sign; the simplest first.

    `positive` are symbols known to be so. What can never hold stays, as it is.
    """
    lead, *rest = _in_one_ring(column)
    sign = known_sign(lead, positive)
    known = _Known(set(positive) | {"pi"}, [])
    pending = [_plain(entry * (sign or lead), known) for entry in rest]
    pending += [radical for entry in rest for radical in known.radicals(entry)]
    found = []
    while pending := [each for each in pending if known.reduced(each).constant != 1]:
        simplest = min(pending, key=lambda each: _size(known.reduced(each)))
        pending.remove(simplest)
        left = known.reduced(simplest)
        said = simplest if left.constant is not None else left
        found += [] if said in found else [said]
        known.learn(left)
    return tuple(_strongest(found, _assumed(found, positive)))


def _plain(value: Scalar, known: _Known) -> Scalar:
    """What decides the sign; a number stays what it is."""
    return value if value.constant is not None else known.reduced(value)


@dataclass(slots=True)
class _Known:
    """Symbols known to be positive, and products of irreducible polynomials with their signs."""

    symbols: set[str]
    products: list[tuple[tuple[fmpq_mpoly, ...], int]]

    def reduced(self, value: Scalar) -> Scalar:
        """What decides the sign of a value; 1 where it is positive, -1 or 0 where it is not."""
        if not value:
            return Scalar.of(0)
        sign, odd, even = self._factors(value)
        for product, own in self.products:
            if all(factor in odd for factor in product):
                odd = [factor for factor in odd if factor not in product]
                sign *= own
            even = [factor for factor in even if factor not in product]
        left = Scalar(value.ring, value.ring.one)
        for factor in [*odd, *even, *even]:
            left = left * Scalar(value.ring, factor)
        return left * sign

    def _factors(self, value: Scalar) -> tuple[int, list[fmpq_mpoly], list[fmpq_mpoly]]:
        """The sign of what has a known one, the factors that change their sign, and those to an even power,
        which must only not be zero; one below is not zero anyway."""
        top, above = factored(value.numerator)
        sign = 1 if as_fraction(top) > 0 else -1
        below: list[tuple[fmpq_mpoly, int]] = []
        if value.denominator is not None:
            bottom, below = factored(value.denominator)
            sign = sign if as_fraction(bottom) > 0 else -sign
        odd, even = [], []
        for factor, power in [*above, *((each, -int(power)) for each, power in below)]:
            own = known_sign(Scalar(value.ring, factor), self.symbols)
            alone = len(above) == 1 and not below and sign > 0
            if alone and self._may_vanish(Scalar(value.ring, factor)):
                even.append(factor)  # sqrt(a) > 0 is a > 0
            elif own is not None:
                sign *= own if power % 2 else 1
            elif power % 2:
                odd.append(factor)
            elif power > 0:
                even.append(factor)
        return sign, odd, even

    def radicals(self, value: Scalar) -> list[Scalar]:
        """The square roots among its factors above that are not negative, but may be zero."""
        factors = [Scalar(value.ring, factor) for factor, _ in factored(value.numerator)[1]] if value else []
        return [factor for factor in factors if self._may_vanish(factor)]

    def _may_vanish(self, factor: Scalar) -> bool:
        """Whether it is a square root of something that is not known to be positive."""
        if factor not in _root_letters(factor):
            return False
        _, odd, even = self._factors(factor * factor)
        return bool(odd or even)

    def learn(self, condition: Scalar) -> None:
        """That this polynomial is positive."""
        if condition.constant is not None:
            return
        sign, odd, _ = self._factors(condition)
        self.products.append((tuple(odd), sign))
        names = list(condition.generators())
        if sign > 0 and len(odd) == len(names) == 1 and odd[0] == condition.ring.gen(names[0]):
            self.symbols.add(names[0])


def _root_letters(value: Scalar) -> list[Scalar]:
    return [Scalar(value.ring, value.ring.gen(root.name)) for root in value.ring.roots]


def _size(value: Scalar) -> tuple[int, int]:
    degrees = [int(d) for d in value.numerator.degrees()]
    return len(value.numerator), sum(degrees)


# -- conditions on one symbol -------------------------------------------------------------------------


def is_impossible(found: Sequence[Scalar], positive: Collection[str]) -> bool:
    """Whether a condition cannot hold: as a number, or beside the others."""
    bounds = [*_bounds(found), *_assumed(found, positive)]
    if any(a[0] == b[0] and a[1] > b[1] and a[2] >= b[2] for a in bounds for b in bounds):
        return True
    known = _Known(set(positive) | {"pi"}, [])
    for each in _in_one_ring(found):
        left = known.reduced(each)
        if is_never(left) and left.constant != 1:
            return True
        known.learn(left)
    return any(_follows(-each, bounds) for each in found)


def _in_one_ring(values: Sequence[Scalar]) -> list[Scalar]:
    home = common_ring(values)
    return [each.into(home) for each in values]


def _assumed(found: Sequence[Scalar], positive: Collection[str]) -> list[Bound]:
    names = {name for each in found for name in each.generators()}
    return [(name, 1, Fraction(0)) for name in sorted(names & set(positive))]


def _bounds(found: Sequence[Scalar]) -> list[Bound]:
    return [bound for each in found if (bound := _bound(each)) is not None]


def _strongest(found: list[Scalar], assumed: list[Bound]) -> Iterator[Scalar]:
    """Without what the bounds of a symbol imply: wider bounds, and polynomials in it."""
    bounds = [*_bounds(found), *assumed]
    for each in found:
        bound = _bound(each)
        implied = _follows(each, bounds) if bound is None else any(_implies(other, bound) for other in bounds)
        if not implied:
            yield each


def _bound(condition: Scalar) -> Bound | None:
    """symbol > number or symbol < number; None for anything else."""
    numbers = _numbers(condition)
    if numbers is None or len(numbers) != 2:
        return None
    (name,) = condition.generators()
    return name, 1 if numbers[1] > 0 else -1, -numbers[0] / numbers[1]


def _numbers(condition: Scalar) -> list[Fraction] | None:
    """The coefficients of a polynomial in one symbol, the constant term first; None for any other."""
    names = list(condition.generators())
    if len(names) != 1:
        return None
    found = [k.constant if k else Fraction(0) for k in coefficients(condition, names[0])]
    return None if None in found else [k for k in found if k is not None]


def _follows(condition: Scalar, bounds: Sequence[Bound]) -> bool:
    """Whether a polynomial in one symbol is positive all between the bounds of this symbol."""
    numbers = _numbers(condition)
    if numbers is None:
        return False
    own = [bound for bound in bounds if bound[0] in condition.generators()]
    low = max((number for _, sign, number in own if sign > 0), default=None)
    high = min((number for _, sign, number in own if sign < 0), default=None)
    inside = _between(low, high)
    if inside is None or sum(k * inside**power for power, k in enumerate(numbers)) <= 0:
        return False
    real = (root.real for root in roots([Scalar.of(k) for k in reversed(numbers)]) if root.imag == 0)
    return not any((low is None or root > low) and (high is None or root < high) for root in real)


def _between(low: Fraction | None, high: Fraction | None) -> Fraction | None:
    """A number between two; None where there is none."""
    if low is None or high is None:
        return low + 1 if low is not None else high - 1 if high is not None else Fraction(0)
    return (low + high) / 2 if low < high else None


def _implies(closer: Bound, other: Bound) -> bool:
    name, sign, number = other
    return closer[:2] == (name, sign) and (closer[2] - number) * sign > 0


# -- as they are written ------------------------------------------------------------------------------


def written(condition: Scalar, style: Style) -> Relation:
    """The inequality as a person writes it: a b > K, K < 6; a product against zero."""
    _, factors = factored(condition.numerator)
    if sum(int(power) for _, power in factors) != 1:
        return Relation(readable(condition, style), ">", ZERO)
    plus, minus = _parted(condition)
    if minus and (not plus or (_is_number(plus) and not _is_number(minus))):
        over = _number_before(minus)
        return Relation(readable(minus / over, style), "<", _side(plus, over, style))
    over = _number_before(plus) if not minus or _is_number(minus) else Fraction(1)
    return Relation(readable(plus / over, style), ">", _side(minus, over, style))


def _parted(condition: Scalar) -> tuple[Scalar, Scalar]:
    """Terms with a plus, and those with a minus, both as positive ones."""
    plus, minus = Scalar.of(0), Scalar.of(0)
    for term in monomials(condition):
        if as_fraction(term.numerator.leading_coefficient()) > 0:
            plus = plus + term
        else:
            minus = minus - term
    return plus, minus


def _is_number(value: Scalar) -> bool:
    return value.constant is not None


def _number_before(value: Scalar) -> Fraction:
    """What a single term is divided by to stand alone."""
    if len(value.numerator) != 1:
        return Fraction(1)
    return as_fraction(value.numerator.leading_coefficient())


def _side(value: Scalar, over: Fraction, style: Style) -> Expr:
    return readable(value / over, style) if value else ZERO


def is_never(condition: Scalar) -> bool:
    """Whether it is a number, and so cannot hold."""
    return condition.constant is not None
