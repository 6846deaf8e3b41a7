"""Exact scalars in normal form: a polynomial of a ring, over another where there is a fraction.

`==` decides equality: both sides over a common denominator have the same reduced polynomial.
Scalars of different rings mix; the result lives in the union of the rings.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping
from fractions import Fraction
from functools import lru_cache, reduce
from operator import mul
from typing import Union

from flint import fmpq_mpoly

from derive.algebra.angles import Form
from derive.algebra.bounds import multiplied
from derive.algebra.calculus import derivative, with_rates
from derive.algebra.fixed_angles.zero_recognition import vanishes
from derive.algebra.generators import RADIAN, Opaque
from derive.algebra.lowest_terms import lowest_terms
from derive.algebra.multivariate import grouped
from derive.algebra.rationals import as_fraction, to_flint
from derive.algebra.ring import Ring, carry, ring
from derive.errors import DivisionByZero, NotDerivable

Like = Union["Scalar", int, Fraction]


class Scalar:
    """numerator / denominator in a ring; `denominator` is None for 1. Immutable."""

    __slots__ = ("denominator", "numerator", "ring")

    def __init__(self, ring: Ring, numerator: fmpq_mpoly, denominator: fmpq_mpoly | None = None) -> None:
        self.ring = ring
        self.numerator = numerator
        self.denominator = denominator

    # -- where scalars come from ------------------------------------------------------------------

    @staticmethod
    def of(value: Like) -> Scalar:
        """A number as a scalar; a scalar is left as it is."""
        return value if isinstance(value, Scalar) else _constant(value)

    @staticmethod
    def symbol(name: str) -> Scalar:
        """The scalar of a letter, or of a function by its name (`generators.Opaque`)."""
        home = ring(symbols=(name,))
        return Scalar(home, home.gen(name))

    # -- arithmetic -------------------------------------------------------------------------------

    def __add__(self, other: Like) -> Scalar:
        a, b = _together(self, other)
        if a.denominator is None and b.denominator is None:
            return Scalar(a.ring, a.numerator + b.numerator)
        if a.denominator == b.denominator:
            return fraction(a.ring, a.numerator + b.numerator, a.denominator)
        p, q = a.denominator or a.ring.one, b.denominator or b.ring.one
        return fraction(a.ring, multiplied(a.numerator, q) + multiplied(b.numerator, p), multiplied(p, q))

    def __neg__(self) -> Scalar:
        return Scalar(self.ring, -self.numerator, self.denominator)

    def __sub__(self, other: Like) -> Scalar:
        return self + (-Scalar.of(other))

    def __mul__(self, other: Like) -> Scalar:
        if not isinstance(other, Scalar):  # a number leaves nothing to reduce
            return Scalar(self.ring, self.numerator * to_flint(other), self.denominator if other else None)
        a, b = _together(self, other)
        if a.denominator is None and b.denominator is None:
            return a._times_polynomial(b)
        product = a.ring.reduce(multiplied(a.numerator, b.numerator))
        return fraction(a.ring, product, _times(a.denominator, b.denominator))

    def _times_polynomial(self, other: Scalar) -> Scalar:
        """The product of polynomials of one ring; most that a matrix multiplies are 0 or 1."""
        p, q = self.numerator, other.numerator
        if not p or q.is_one():
            return self
        return other if not q or p.is_one() else Scalar(self.ring, self.ring.reduce(multiplied(p, q)))

    def __truediv__(self, other: Like) -> Scalar:
        a, b = _together(self, other)
        if not b:
            raise DivisionByZero("a division by an expression that is always zero")
        top = a.numerator if b.denominator is None else a.numerator * b.denominator
        return fraction(a.ring, top, _times(a.denominator, b.numerator))

    def __pow__(self, exponent: int) -> Scalar:
        if exponent < 0:
            return Scalar.of(1) / self**-exponent
        result, base = Scalar(self.ring, self.ring.one), self
        while exponent:
            result = result * base if exponent & 1 else result
            exponent >>= 1
            base = base * base if exponent else base
        return result

    __radd__ = __add__
    __rmul__ = __mul__

    def __rsub__(self, other: Like) -> Scalar:
        return Scalar.of(other) - self

    def __rtruediv__(self, other: Like) -> Scalar:
        return Scalar.of(other) / self

    # -- comparison -------------------------------------------------------------------------------

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scalar | int | Fraction):
            return NotImplemented
        a, b = _together(self, other)
        if a.denominator is None and b.denominator is None:
            return bool(a.numerator == b.numerator) or vanishes(a.numerator - b.numerator, a.ring)
        left = a.numerator if b.denominator is None else a.numerator * b.denominator
        right = b.numerator if a.denominator is None else b.numerator * a.denominator
        return vanishes(a.ring.reduce(left - right), a.ring)

    def __hash__(self) -> int:
        raise TypeError("scalars are equal across rings and have no hash")

    def __bool__(self) -> bool:
        return not vanishes(self.numerator, self.ring)

    def __repr__(self) -> str:
        bottom = "" if self.denominator is None else f" / ({self.denominator})"
        return f"{self.numerator}{bottom}"

    def key(self) -> Hashable:
        """The same for the same polynomials of the same ring: to remember what was found for them."""
        return _Key(self)

    # -- parts ------------------------------------------------------------------------------------

    @property
    def constant(self) -> Fraction | None:
        """The value of a scalar without generators; None for any other."""
        if self.denominator is not None or not self.numerator.is_constant():
            return None
        return as_fraction(self.numerator.leading_coefficient()) if self else Fraction(0)

    def generators(self) -> Iterator[str]:
        """The names of the generators that occur."""
        degrees = list(self.numerator.degrees())
        if self.denominator is not None:
            degrees = [max(pair) for pair in zip(degrees, self.denominator.degrees(), strict=True)]
        return (name for name, degree in zip(self.ring.names, degrees, strict=True) if degree > 0)

    def letters(self) -> frozenset[str]:
        """The names of the symbols and angles it rests on, however deep inside functions; `pi` apart."""
        return frozenset().union(*map(self.ring.letters, self.generators()))

    def into(self, home: Ring) -> Scalar:
        """The same scalar in a larger ring. Raises ValueError where that cannot hold it."""
        if self.ring is home:
            return self
        bottom = None if self.denominator is None else carry(self.denominator, self.ring, home)
        return Scalar(home, carry(self.numerator, self.ring, home), bottom)

    # -- calculus ---------------------------------------------------------------------------------

    def diff(self, name: str) -> Scalar:
        """The partial derivative by a symbol or an angle, all other names being constants. Raises
        NotDerivable where there is no rule."""
        if self.denominator is not None:
            u, v = Scalar(self.ring, self.numerator), Scalar(self.ring, self.denominator)
            return (u.diff(name) * v - u * v.diff(name)) / (v * v)
        if self.ring.layered:
            return _along_generators(self, name)
        home = with_rates(self.ring, name)
        return fraction(home, *derivative(self.into(home).numerator, home, name))

    def substitute(self, values: Mapping[str, Scalar]) -> Scalar:
        """The scalar with symbols replaced. The names must not stand inside sines, cosines or roots, which
        stay as they are (see `substitution`)."""
        names = [name for name in self.ring.symbols if name in values]
        if not names:
            return self
        home = common_ring([self, *(values[name] for name in names)])
        top = _replaced(self.numerator, self.ring, home, values)
        return top if self.denominator is None else top / _replaced(self.denominator, self.ring, home, values)


@lru_cache(maxsize=256)
def _constant(value: int | Fraction) -> Scalar:
    base = ring()
    return Scalar(base, base.constant(value))


def trig(form: Form) -> tuple[Scalar, Scalar]:
    """(cosine, sine) of a form, polynomials of a ring that is made for it."""
    home = ring().with_angle(form)
    pair = home.trig(form)
    if pair is None:
        raise ValueError(f"no ring for {form}")
    return Scalar(home, pair[0]), Scalar(home, pair[1])


def angle_of(form: Form) -> Scalar:
    """The angle that a form stands for."""
    return sum((_atom_of(atom) * n for atom, n in form.parts), Scalar.of(0))


def _atom_of(atom: str) -> Scalar:
    """What an atom of a form stands for."""
    if isinstance(atom, Opaque):
        return Scalar.of(atom.arguments[0])
    if atom == RADIAN:
        return Scalar.of(1)
    factors = (factor.partition("^") for factor in atom.split("*"))
    return reduce(mul, (Scalar.symbol(name) ** int(power or 1) for name, _, power in factors))


def fraction(home: Ring, top: fmpq_mpoly, bottom: fmpq_mpoly | None) -> Scalar:
    """top / bottom in lowest terms; None is a bottom of 1."""
    return Scalar(home, *lowest_terms(home, top, bottom))


def common_ring(scalars: Iterable[Scalar]) -> Ring:
    """The smallest ring that holds all the scalars, its generators in their order."""
    rings = dict.fromkeys(scalar.ring for scalar in scalars)
    return reduce(Ring.union, rings, ring())


def _together(left: Scalar, right: Like) -> tuple[Scalar, Scalar]:
    if not isinstance(right, Scalar):
        return left, Scalar(left.ring, left.ring.constant(right))
    if left.ring is right.ring:
        return left, right
    home = left.ring.union(right.ring)
    return left.into(home), right.into(home)


def _times(left: fmpq_mpoly | None, right: fmpq_mpoly | None) -> fmpq_mpoly | None:
    if left is None or right is None:
        return right if left is None else left
    return left * right


def _along_generators(value: Scalar, name: str) -> Scalar:
    """The derivative of a scalar without a denominator where there are functions of functions: by the chain
    rule over the generators. Each contributes its own rate, and the arguments are scalars themselves, so this
    goes as deep as they do. Raises NotDerivable where the name stands inside a function that has none."""
    home = value.ring
    total = Scalar.of(0)
    for place in range(len(home.names)):
        slope = value.numerator.derivative(place)
        if slope != 0 and (rate := _rate(home, place, name)):
            total = total + Scalar(home, home.reduce(slope)) * rate
    return total


def _rate(home: Ring, place: int, name: str) -> Scalar:
    """The derivative of one generator: with r^n = u that of r is u'/(n r^(n - 1))."""
    roots, angles, generator = len(home.roots), len(home.angles), home.names[place]
    if place < roots:
        root = home.roots[place]
        rate = Scalar(home, home.polynomial(root.radicand)).diff(name)
        below = Scalar(home, home.gen(root.name)) ** (root.degree - 1) * root.degree
        return rate / below if rate else rate
    if place < roots + 2 * angles:
        is_cosine, k = divmod(place - roots, angles)
        rate = angle_of(home.angles[k]).diff(name)
        c, s = (Scalar(home, each) for each in home.pair(k))
        return -s * rate if is_cosine else c * rate
    if isinstance(generator, Opaque):
        return _function_rate(generator, name)
    return Scalar.of(int(generator == name))


def _function_rate(generator: Opaque[Scalar], name: str) -> Scalar:
    """Of a function of functions, which knows its own rule."""
    rates = [argument.diff(name) for argument in generator.arguments]
    if not any(rates):
        return Scalar.of(0)
    if generator.rate is None:
        raise NotDerivable(f"the derivative of {generator.function} by {name} is not known")
    return generator.rate(Scalar.symbol(generator), *generator.arguments, *rates)


def _replaced(polynomial: fmpq_mpoly, source: Ring, home: Ring, values: Mapping[str, Scalar]) -> Scalar:
    """Term by term, powers of each replaced symbol collected."""
    total = Scalar(home, home.zero)
    places = {source.index[name]: values[name].into(home) for name in source.symbols if name in values}
    for powers, rest in grouped(polynomial, places).items():
        term = Scalar(home, carry(rest, source, home))
        for value, power in zip(places.values(), powers, strict=True):
            term = term * value**power if power else term
        total = total + term
    return total


class _Key:
    """A scalar by its polynomials; its hash looks at no more than their shape, for they may be long."""

    __slots__ = ("hash", "scalar")

    def __init__(self, scalar: Scalar) -> None:
        top = scalar.numerator
        shape = (*map(int, top.degrees()), str(top.leading_coefficient())) if top else ()
        self.scalar = scalar
        self.hash = hash((id(scalar.ring), len(top), shape))

    def __hash__(self) -> int:
        return self.hash

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _Key) or self.hash != other.hash:
            return False
        a, b = self.scalar, other.scalar
        return a.ring is b.ring and a.numerator == b.numerator and _same(a.denominator, b.denominator)


def _same(left: fmpq_mpoly | None, right: fmpq_mpoly | None) -> bool:
    if left is None or right is None:
        return left is right
    return bool(left == right)
