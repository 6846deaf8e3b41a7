"""Proofs that hold around a point: there every root splits into roots of its factors, and signs are known.

sqrt(a b) is sqrt(a) sqrt(b) where both are positive and sqrt(-a) sqrt(-b) where both are not, so that no
normal form holds everywhere. Around a point where no factor is zero the signs stay as they are; with each
root split into those of its irreducible factors, which are independent, the normal form decides. Whoever
wants more asks around several points.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from functools import reduce
from operator import mul

from flint import fmpq_mpoly

from derive.algebra.exact_values import multiple
from derive.algebra.formulas.quantities import rational
from derive.algebra.multivariate import factored
from derive.algebra.normal import Names, Walk
from derive.algebra.numbers.floats import generator_numbers
from derive.algebra.rationals import as_fraction
from derive.algebra.ring import Ring, ring
from derive.algebra.roots_and_functions import root
from derive.algebra.scalar import Scalar
from derive.algebra.values import Value
from derive.answers.budget import affordable, parts_of
from derive.answers.points import Point
from derive.errors import FormulaError, NotDerivable
from derive.expression import Call, Expr, Number, Product, Quotient, Sum, Symbol, is_negative, walk

ZERO = 1e-9  # as against the size of the terms: a sign that rounding could turn is none

NO_PROOF = (NotDerivable, FormulaError, ValueError, ArithmeticError, RecursionError, KeyError)
INVERSE = ("atan2", "atan", "acos", "asin")
MOST_TURNS = 64


@dataclass(frozen=True, slots=True)
class Around(Walk):
    """A walk around a point. `asked` are the values whose signs were looked up, with these signs."""

    point: Mapping[str, float] = field(default_factory=dict)
    asked: list[tuple[Scalar, int]] = field(default_factory=list)

    def sign(self, of: Scalar) -> int:
        """1 or -1. Raises NotDerivable for what is as good as zero there."""
        found = sign_at(of, self.point)
        self.asked.append((of, found))
        return found

    def absolute(self, of: Scalar) -> Scalar:
        """The absolute value around the point. Raises NotDerivable for what is as good as zero there."""
        return of * self.sign(of)

    def root(self, of: Scalar) -> Scalar:
        """The square root, split. Raises NotDerivable where it is not real."""
        if of.constant is not None:
            return root(of)
        if of.denominator is not None:
            bottom = Scalar(of.ring, of.denominator)
            whole = Scalar(of.ring, of.ring.reduce(of.numerator * of.denominator))
            return self.root(whole) / self.absolute(bottom)
        if self.sign(of) < 0:
            raise NotDerivable("the root of a negative number")
        outside, left = self._sines(of)
        content, factors = factored(left)
        parts = [outside, root(Scalar.of(abs(as_fraction(content))))]
        for factor, power in factors:
            positive = self.absolute(Scalar(of.ring, of.ring.reduce(factor)))
            parts.append(positive ** (power // 2) * (root(positive) if power % 2 else 1))
        return reduce(mul, parts)

    def _sines(self, of: Scalar) -> tuple[Scalar, fmpq_mpoly]:
        """(|sines|, what is left): each factor 1 - cos^2 is the square of a sine."""
        outside, left = Scalar.of(1), of.numerator
        for k in range(len(of.ring.angles)):
            c, s = of.ring.pair(k)
            quotient, rest = divmod(left, 1 - c * c)
            while rest == 0:
                outside, left = outside * self.absolute(Scalar(of.ring, s)), quotient
                quotient, rest = divmod(left, 1 - c * c)
        return outside, left

    # -- what a walk asks of it -------------------------------------------------------------------

    def _call(self, function: str, arguments: tuple[Expr, ...]) -> Value:
        match function:
            case "sqrt":
                return self.root(self.scalar(arguments[0]))
            case "abs":
                return self.absolute(self.scalar(arguments[0]))
            case "sign":
                return Scalar.of(self.sign(self.scalar(arguments[0])))
            case "exp":
                return self._exponential(arguments[0])
        return Walk._call(self, function, arguments)

    def _exponential(self, of: Expr) -> Value:
        """exp(2 x - y) as exp(x)^2/exp(y)."""
        if isinstance(of, Sum):
            return reduce(mul, (self.scalar(Call("exp", (term,))) for term in of.terms))
        if is_negative(of):
            return 1 / self.scalar(Call("exp", (-of,)))
        times, rest = self._multiple(of)
        if rest is None or times.denominator != 1 or not 1 < times <= MOST_TURNS:
            return Walk._call(self, "exp", (of,))
        return self.scalar(Call("exp", (rest,))) ** int(times)

    def _power(self, base: Expr, exponent: Expr) -> Value:
        value = rational(exponent)
        if value is not None and value.denominator == 2:
            return self.root(self.scalar(base)) ** int(2 * value)
        if value is None and isinstance(exponent, Sum):
            return reduce(mul, (self.scalar(base**term) for term in exponent.terms))
        if value is None and is_negative(exponent):
            return 1 / self.scalar(base ** (-exponent))
        return Walk._power(self, base, exponent)

    def trig(self, angle: Expr) -> tuple[Scalar, Scalar]:
        """(cosine, sine) of an angle, its inverse functions and halves of them resolved."""
        match angle:
            case Call("atan2", (y, x)):
                return self._direction(self.scalar(y), self.scalar(x))
            case Call("atan", (slope,)):
                return self._direction(self.scalar(slope), Scalar.of(1))
            case Call("acos", (cosine,)):
                c = self.scalar(cosine)
                return c, self.root(1 - c * c)
            case Call("asin", (sine,)):
                s = self.scalar(sine)
                return self.root(1 - s * s), s
            case Symbol() if angle in self.names:
                return self.trig(self.names[angle])
            case Product() | Quotient():
                times, rest = self._multiple(angle)
                if rest is not None and self._has_inverse(rest):
                    return self._times(times, rest)
        c, s = Walk.trig(self, angle)
        return (c.into(self.home), s.into(self.home)) if _holds(self.home, (c, s)) else (c, s)

    def _direction(self, y: Scalar, x: Scalar) -> tuple[Scalar, Scalar]:
        length = self.root(x * x + y * y)
        return x / length, y / length

    def _multiple(self, angle: Expr) -> tuple[Fraction, Expr | None]:
        """(3/2, atan(x)) for 3 atan(x)/2; the rest is None where it is no single thing."""
        if isinstance(angle, Quotient):
            below = self._constant(angle.denominator)
            times, rest = self._multiple(angle.numerator)
            return (times / below, rest) if below else (times, None)
        if not isinstance(angle, Product):
            return Fraction(1), angle
        known = {factor: self._constant(factor) for factor in angle.factors}
        others = [factor for factor in angle.factors if known[factor] is None]
        numbers = [value for factor in angle.factors if (value := known[factor]) is not None]
        times = reduce(mul, numbers, Fraction(1))
        if len(others) != 1:
            return times, None
        more, inner = self._multiple(others[0])
        return times * more, inner

    def _constant(self, factor: Expr) -> Fraction | None:
        """The number that a factor is, sin^2 + cos^2 too."""
        return rational(factor) if self._has_inverse(factor) else self.scalar(factor).constant

    def _times(self, times: Fraction, angle: Expr) -> tuple[Scalar, Scalar]:
        if abs(times) > MOST_TURNS:
            raise NotDerivable("an angle of too many turns")
        if times.denominator == 1:
            return multiple(self.trig(angle), int(times))
        if times.denominator != 2 or not (isinstance(angle, Call) and angle.function in INVERSE):
            raise NotDerivable("a part of an angle")
        c, s = self.trig(angle)
        half = self.root((1 + c) * Fraction(1, 2))  # not negative: the angle is between -pi and pi
        return multiple((half, s / (2 * half)), int(2 * times))


def proved_around(
    published: Expr, derived: Expr, names: tuple[Names, Names], points: Iterable[Point], angle: bool = False
) -> bool:
    """Whether two scalars are equal around every one of the points, and there is one; as angles up to whole
    turns. Their values must agree there: a direction alone does not tell an angle from its turns."""
    if not affordable((published, derived), names):
        return False
    home = _common_angles((published, derived), names)
    known: list[list[tuple[Scalar, int]]] = []
    for point in points:
        at = {name: float(value) for name, value in point.items()}
        if any(_stands(signs, at) for signs in known):
            continue
        asked: list[tuple[Scalar, int]] = []
        one, other = (Around(each, home, point=at, asked=asked) for each in names)
        try:
            if not (_directions if angle else _values)(published, derived, one, other):
                return False
        except NO_PROOF:
            return False
        known.append(asked)
    return bool(known)


def _common_angles(trees: tuple[Expr, Expr], names: tuple[Names, Names]) -> Ring:
    """A ring with the angles of both sides, so that both split a root in the same way: phi/2 beside phi."""
    rings = [ring()]
    for tree, known in zip(trees, names, strict=True):
        for part in parts_of(tree, known):
            if isinstance(part, Call) and part.function in ("cos", "sin", "tan"):
                angle = part.arguments[0]
                if not any(node in known or isinstance(node, Call) for node in walk(angle)):
                    with suppress(*NO_PROOF):  # without a ring for both the proof fails: undecided
                        rings += [each.ring for each in Walk({}).trig(angle)]
    return reduce(Ring.union, rings)


def _holds(home: Ring, pair: tuple[Scalar, Scalar]) -> bool:
    return all(home.trig(form) is not None for each in pair for form in each.ring.angles) and all(
        root.name in home.index for each in pair for root in each.ring.roots
    )


def is_principal(angle: Expr) -> bool:
    """Whether an angle is between -pi and pi by nature."""
    match angle:
        case Call(function):
            return function in INVERSE
        case Product((Number(n), Call("atan" | "asin"))):
            return abs(n) <= 2
        case Product((Number(n), Call("atan2" | "acos"))):
            return abs(n) <= 1
    return False


def _values(published: Expr, derived: Expr, one: Around, other: Around) -> bool:
    return one.scalar(published) == other.scalar(derived)


def _directions(published: Expr, derived: Expr, one: Around, other: Around) -> bool:
    c, s = one.trig(published)
    cosine, sine = other.trig(derived)
    return bool(c == cosine and s == sine)


def _stands(signs: Iterable[tuple[Scalar, int]], point: Mapping[str, float]) -> bool:
    """Whether all signs are at a point what they are known to be."""
    try:
        return all(sign_at(value, point) == sign for value, sign in signs)
    except NO_PROOF:
        return False


def sign_at(of: Scalar, point: Mapping[str, float]) -> int:
    """1 or -1. Raises NotDerivable for what is as good as zero, KeyError for what has no value there."""
    generators = generator_numbers(of, point)
    total = 1
    for polynomial in (of.numerator, of.denominator):
        if polynomial is not None:
            terms = [
                float(as_fraction(k))
                * math.prod(value ** int(e) for value, e in zip(generators, powers, strict=True) if e)
                for powers, k in polynomial.terms()
            ]
            value = math.fsum(terms)
            if abs(value) <= ZERO * math.fsum(map(abs, terms)):
                raise NotDerivable("a sign that is not known")
            total *= 1 if value > 0 else -1
    return total
