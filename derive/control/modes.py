"""A step response as a sum of modes: the exact inverse of its Laplace transform, in ball arithmetic."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from flint import acb, acb_poly, arb, ctx

from derive.algebra.numbers.balls import MOST_BITS
from derive.algebra.scalar import Scalar
from derive.control.exact import Coefficients, field
from derive.control.roots import Root, in_ball, isolated
from derive.errors import NotDerivable

BITS = 256  # of the working precision, at first
CLEAR = 100  # bits by which errors are smaller than the curve
ENOUGH = 40  # bits by which what an expansion leaves out is smaller
NEAR = 2.0  # |pole| * radius up to which a mode is expanded about the middle of an interval
ORDER = 20  # of that expansion, at least


@dataclass(frozen=True)
class Mode:
    """e^(pole t) times a polynomial in t; its real part counts. A pair of poles is one mode."""

    pole: acb
    factor: acb_poly

    @cached_property
    def coefficients(self) -> list[acb]:
        """Of the polynomial in t, the constant term first."""
        return [*self.factor.coeffs()]

    def at(self, time: arb) -> acb:
        """The complex value at a time [s]."""
        return self.factor(acb(time)) * (self.pole * time).exp()

    def slope(self) -> Mode:
        """The derivative by time, a mode of the same pole."""
        return Mode(self.pole, self.factor * self.pole + self.factor.derivative())

    def transform(self, s: acb) -> acb:
        """Of its real part, half of it and half of its conjugate."""
        pairs = [(self.pole, self.coefficients)]
        pairs.append((self.pole.conjugate(), [k.conjugate() for k in self.coefficients]))
        terms = (
            k * math.factorial(power) / (s - pole) ** (power + 1)
            for pole, coefficients in pairs
            for power, k in enumerate(coefficients)
        )
        return sum(terms, acb(0)) / 2

    def size(self, time: arb) -> arb:
        """What it is at most there."""
        powers = (abs(k) * time**power for power, k in enumerate(self.coefficients))
        return sum(powers, arb(0)) * (self.pole.real * time).exp()


@dataclass(frozen=True)
class Curve:
    """The sum of modes. Everything is enclosed: a ball certainly holds what it stands for. `order` is that of
    expansions, `bits` the working precision it should be evaluated with."""

    modes: tuple[Mode, ...]
    order: int = ORDER
    bits: int = BITS

    @staticmethod
    def of_step(num: Sequence[Scalar], den: Sequence[Scalar]) -> Curve:
        """The response of num/den (highest power first, proper) to a unit step: the partial fractions of
        num/(s den). The mode at the origin comes first. Raises NotDerivable.
        """
        top, bottom = field(num), field([*den, Scalar.of(0)])
        bits = BITS
        while bits <= MOST_BITS:
            roots = isolated([*den, Scalar.of(0)], bits)
            with ctx.workprec(bits):
                modes = tuple(_modes(top, bottom, roots))
                error, size = _error(modes), _size(modes)
                if not top or error < size * arb(2) ** -CLEAR:
                    lost = _lost(modes, size)
                    return Curve(modes, _order(lost), CLEAR + ENOUGH + math.ceil(lost))
            bits *= 2
        raise NotDerivable(f"poles lie so close together that {MOST_BITS} bits do not give the response")

    @cached_property
    def _exponentials(self) -> tuple[acb_poly, ...]:
        return tuple(_exponential(mode.pole, self.order) for mode in self.modes)

    @cached_property
    def slope(self) -> Curve:
        """The derivative by time."""
        return self._of(mode.slope() for mode in self.modes)

    def scaled(self, by: arb) -> Curve:
        """The curve times a number."""
        return self._of(Mode(mode.pole, mode.factor * by) for mode in self.modes)

    def without_constant(self) -> Curve:
        """Without what stays: a stable curve less its steady state."""
        return self._of(mode for mode in self.modes if mode.pole != 0)

    def _of(self, modes: Iterable[Mode]) -> Curve:
        return Curve(tuple(modes), self.order, self.bits)

    def at(self, time: arb) -> arb:
        """The value at a time [s]."""
        return sum((mode.at(time).real for mode in self.modes), arb(0))

    def transform(self, s: acb) -> acb:
        """Its Laplace transform: k! c_k / (s - p)^(k + 1) of each term."""
        return sum((mode.transform(s) for mode in self.modes), acb(0))

    def over(self, left: arb, right: arb) -> arb:
        """All values between two times. What is slow there is expanded about the middle all at once, so
        that modes which nearly cancel do; what is fast counts by its size."""
        middle, radius = (left + right) / 2, (right - left) / 2
        near = acb_poly([acb(0)])
        total = left_over = arb(0)
        for mode, exponential in zip(self.modes, self._exponentials, strict=True):
            reach = float((abs(mode.pole) * radius).mid())
            if reach > NEAR:
                total = total + mode.at(arb(middle, radius)).real
                continue
            there = mode.factor(acb_poly([acb(middle), acb(1)])) * (mode.pole * middle).exp()
            near = near + there * exponential
            left_over = left_over + _rest(there, radius, reach, self.order)
        value = near(acb(arb(0, radius))).real + total
        return value + arb(0, left_over.abs_upper())

    def beyond(self, time: arb) -> arb:
        """What the curve is at most from a time on that `settling` allows."""
        return sum((mode.size(time) for mode in self.modes), arb(0))

    def end(self, small: float) -> arb:
        """A time from which on the curve, all of whose modes die away, is smaller."""
        slowest = min((abs(float(mode.pole.real.mid())) for mode in self.modes), default=1.0)
        powers = max((mode.factor.degree() for mode in self.modes), default=0)
        time = arb(max(powers, 1) / slowest)
        while not self.beyond(time) < small:
            time = time * 1.5
        return time


def _modes(top: Coefficients, bottom: Coefficients, roots: Sequence[Root]) -> Iterator[Mode]:
    """The origin first; of each pair the upper one, doubled."""
    numerator = acb_poly([acb(in_ball(k)) for k in reversed(top)])
    lead = in_ball(bottom[0])
    for root in sorted(roots, key=lambda root: root.ball != 0):
        if root.ball.imag < 0:
            continue
        others = [other for other in roots if other is not root]
        weight = acb(1 if root.ball.imag == 0 else 2) / lead
        yield Mode(root.ball, _factor(numerator * weight, root, others))


def _factor(numerator: acb_poly, root: Root, others: Sequence[Root]) -> acb_poly:
    """c_1 + c_2 t + ... + c_m t^(m - 1)/(m - 1)!, with c_k/(s - p)^k in the partial fractions."""
    about = numerator(acb_poly([root.ball, acb(1)]))
    taylor = [about[k] for k in range(root.power)]  # of (s - p)^m Y about p: c_m, ..., c_1
    for other in others:
        apart = root.ball - other.ball
        for _ in range(other.power):
            taylor = _divided(taylor, apart)
    if root.ball.imag == 0:
        taylor = [acb(k.real) for k in taylor]
    return acb_poly([k / math.factorial(power) for power, k in enumerate(reversed(taylor))])


def _divided(series: Sequence[acb], apart: acb) -> list[acb]:
    """By apart + x."""
    found, before = [], acb(0)
    for k in series:
        before = (k - before) / apart
        found.append(before)
    return found


# -- how good an expansion has to be ------------------------------------------------------------------


def _scale(mode: Mode) -> arb:
    """A time in which the mode changes."""
    return arb(1) if mode.pole == 0 else 1 / abs(mode.pole.mid())


def _error(modes: Sequence[Mode]) -> arb:
    """How wrong the curve can be within a time constant or two, by the radii of the balls."""
    return sum((_spread(mode) for mode in modes), arb(0))


def _spread(mode: Mode) -> arb:
    own = mode.pole.rad() * _scale(mode)
    return sum(
        ((k.rad() + abs(k) * own) * _scale(mode) ** power for power, k in enumerate(mode.coefficients)),
        arb(0),
    )


def _size(modes: Sequence[Mode]) -> arb:
    """Where it ends, if it ends at a value other than zero; else how high it goes, more or less."""
    first, *rest = modes
    settles = first.factor.degree() == 0 and all(mode.pole.real < 0 for mode in rest)
    if settles and abs(first.factor[0]) > 0:
        return abs(first.factor[0])
    return sum((mode.size(_scale(mode)) for mode in modes), arb(0))


def _lost(modes: Sequence[Mode], size: arb) -> float:
    """Bits by which the modes exceed the curve, and cancel."""
    largest = sum((_spread_of(mode) for mode in modes), arb(0))
    return math.log2(float((largest / size).mid())) if largest > size else 0.0


def _order(lost: float) -> int:
    """Terms of an expansion after which the rest is small against the curve."""
    order, wanted = ORDER, ENOUGH + lost
    while math.lgamma(order + 2) / math.log(2) - (order + 1) * math.log2(NEAR) < wanted:
        order += 2
    return order


def _spread_of(mode: Mode) -> arb:
    return sum((abs(k) * _scale(mode) ** power for power, k in enumerate(mode.coefficients)), arb(0))


def _exponential(pole: acb, order: int) -> acb_poly:
    """The first terms of e^(p x)."""
    terms, term = [acb(1)], acb(1)
    for k in range(1, order + 1):
        term = term * pole / k
        terms.append(term)
    return acb_poly(terms)


def _rest(factor: acb_poly, radius: arb, reach: float, order: int) -> arb:
    """What those terms leave out: (p r)^(n+1)/(n+1)! e^(p r), times the polynomial."""
    size = sum((abs(k) * radius**power for power, k in enumerate(factor.coeffs())), arb(0))
    return size * arb(reach) ** (order + 1) / arb.fac_ui(order + 1) * arb(reach).exp()
