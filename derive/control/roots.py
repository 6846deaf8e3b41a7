"""Roots of polynomials with real numbers as coefficients, isolated in ball arithmetic.

What is decided about them is decided exactly: how often one is a root, by the square-free parts; whether
it lies on the imaginary axis, by what the even and the odd part of these share. Only then are they
approximated, with a precision that is raised until the balls are apart and clear of the axes.
"""

from __future__ import annotations

import random
from collections.abc import Collection, Hashable, Iterator, Sequence
from dataclasses import dataclass
from dataclasses import field as field_of
from fractions import Fraction
from functools import lru_cache
from typing import Any

from flint import acb, acb_poly, arb, ctx, fmpq

from derive.algebra.numbers.balls import FEWEST_BITS, MOST_BITS, number_ball
from derive.algebra.scalar import Scalar
from derive.control.exact import Coefficients, field, square_free, symmetric
from derive.errors import NotDerivable

PARTS = 16  # values are whole multiples of 1/PARTS, so that coefficients are exact

ACCURATE = 64  # bits of a root, in its real and in its imaginary part


@dataclass(frozen=True, slots=True)
class Root:
    """A root as a ball, and how often it is one; a part that is zero is exactly so."""

    ball: acb
    power: int

    @property
    def value(self) -> complex:
        """Rounded once."""
        return complex(float(self.ball.real.mid()), float(self.ball.imag.mid()))


def roots(coefficients: Sequence[Scalar]) -> tuple[complex, ...]:
    """Every root (coefficients highest power first), as often as it is one, the rightmost first.

    Raises NotDerivable where two are not told apart.
    """
    return tuple(root.value for root in isolated(coefficients) for _ in range(root.power))


def isolated(coefficients: Sequence[Scalar], bits: int = ACCURATE) -> tuple[Root, ...]:
    """The distinct roots, accurate to `bits` in both parts, sorted as `roots` are.

    Raises NotDerivable where MOST_BITS do not tell two of them apart.
    """
    values = field(coefficients)
    keys = tuple(k if isinstance(k, fmpq) else k.key() for k in values)
    found = [root for part in _known_parts(_Polynomial(keys, values)) for root in part.roots(bits)]
    return tuple(sorted(found, key=lambda root: _order(root.value)))


def in_ball(value: Any) -> arb:
    """A number of the field of coefficients, at the working precision of FLINT."""
    return arb(value) if isinstance(value, fmpq) else number_ball(value)


def as_json(root: complex) -> float | dict[str, float]:
    """A float, or {"re", "im"}."""
    return root.real if root.imag == 0 else {"re": root.real, "im": root.imag}


def _order(root: complex) -> tuple[float, float, float]:
    return -root.real, abs(root.imag), -root.imag


# -- parts of a polynomial ----------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Part:
    """Roots of one multiplicity: those of a square-free polynomial in s, or in s^2 where `even`. None of
    the former lies on the imaginary axis."""

    coefficients: Coefficients
    power: int
    even: bool

    def roots(self, bits: int) -> Iterator[Root]:
        precision = max(FEWEST_BITS, 2 * bits)
        while precision <= MOST_BITS:
            with ctx.workprec(precision):
                balls = _balls(self.coefficients)
                found = None if balls is None else [*_square_roots(balls)] if self.even else balls
            if found is not None and all(_is_settled(ball, bits) for ball in found):
                return (Root(ball, self.power) for ball in found)
            precision *= 2
        raise NotDerivable(f"two roots lie so close together that {MOST_BITS} bits do not tell them apart")


@dataclass(frozen=True, slots=True)
class _Polynomial:
    """Coefficients, the same where their keys are."""

    keys: tuple[Hashable, ...]
    values: Coefficients = field_of(compare=False)


@lru_cache(maxsize=64)
def _known_parts(polynomial: _Polynomial) -> tuple[_Part, ...]:
    """What was found of a polynomial before is not sought again."""
    return tuple(_parts(polynomial.values))


def _parts(values: Coefficients) -> Iterator[_Part]:
    """Roots at the origin are a part of their own. What balls show is not asked for exactly: that no root is
    repeated, and that no two lie symmetric to the origin."""
    zeros = next((place for place, k in enumerate(reversed(values)) if k), 0)
    if zeros:
        yield _Part((fmpq(1), fmpq(0)), zeros, False)
    values = values[: len(values) - zeros]
    with ctx.workprec(FEWEST_BITS):
        balls = _balls(values) if len(values) > 1 else []
    simple = square_free(values) if balls is None else [(values, 1)][: len(balls)]
    for polynomial, power in simple:
        lopsided = balls is not None and not any(a.overlaps(-b) for a in balls for b in balls)
        even, rest = ((), polynomial) if lopsided else symmetric(polynomial)
        if len(even) > 1:
            yield _Part(even, power, True)
        if len(rest) > 1:
            yield _Part(rest, power, False)


def are_coprime(left: Coefficients, right: Coefficients) -> bool:
    """Whether balls show that two polynomials in numbers share no root."""
    with ctx.workprec(FEWEST_BITS):
        balls = _balls(right) if len(right) > 1 else []
        if balls is None:
            return False
        polynomial = acb_poly([in_ball(k) for k in reversed(left)])
        return not any(polynomial(ball).contains(0) for ball in balls)


def _is_settled(ball: acb, bits: int) -> bool:
    """Whether both parts are known well enough, the sign of the real one at least."""
    return all(part == 0 or part.rel_accuracy_bits() >= bits for part in (ball.real, ball.imag))


def _square_roots(balls: Sequence[acb]) -> Iterator[acb]:
    """s of s^2; of a negative one exactly on the imaginary axis."""
    for ball in balls:
        if ball.imag == 0 and ball.real < 0:
            half = acb(0, (-ball.real).sqrt())
        else:
            half = acb(ball.real.sqrt()) if ball.imag == 0 else ball.sqrt()
        yield half
        yield -half


# -- isolation ----------------------------------------------------------------------------------------


def _balls(coefficients: Coefficients) -> list[acb] | None:
    """Disjoint balls with one root each, real ones with an imaginary part that is exactly zero; None where
    the working precision is too low."""
    polynomial = acb_poly([in_ball(k) for k in reversed(coefficients)])
    if len(coefficients) == 2:
        return [acb((-polynomial[0] / polynomial[1]).real)]
    try:
        starts = polynomial.roots()
    except ValueError:  # not isolated with coefficients this accurate
        return None
    found = [_refined(polynomial, start) for start in starts]
    if any(not ball.is_finite() for ball in found) or _touch(found):
        return None
    return _paired(found)


def _refined(polynomial: acb_poly, start: acb) -> acb:
    """By Newton's method, with the radius n |p / p'| within which there is a root."""
    slope, point = polynomial.derivative(), start.mid()
    for _ in range(max(4, ctx.prec.bit_length() - 3)):
        point = (point - polynomial(point) / slope(point)).mid()
    radius = arb((polynomial.degree() * polynomial(point) / slope(point)).abs_upper())
    return acb(arb(point.real, radius), arb(point.imag, radius))


def _touch(balls: Sequence[acb]) -> bool:
    return any(a.overlaps(b) for k, a in enumerate(balls) for b in balls[:k])


def _paired(balls: Sequence[acb]) -> list[acb] | None:
    """With each conjugate exactly so: a ball that meets its mirror image and no other's is real."""
    found: list[acb] = []
    for ball in balls:
        mirrored = [other for other in balls if other.overlaps(ball.conjugate())]
        if len(mirrored) != 1:
            return None
        if mirrored[0] is ball:
            found.append(acb(ball.real))
        elif ball.imag > 0:
            found += [ball, ball.conjugate()]
        elif not ball.imag < 0:
            return None
    return found


def points(names: Sequence[str], positive: Collection[str], count: int) -> Iterator[dict[str, Fraction]]:
    """Values anyone gets again; every second point has negative ones too, `positive` names apart."""
    draw = random.Random(" ".join(names))
    for k in range(count):
        yield {
            name: Fraction(draw.randint(1, 6 * PARTS), PARTS)
            * (1 if name in positive or k % 2 else draw.choice((1, -1)))
            for name in names
        }
