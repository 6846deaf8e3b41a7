"""The response of a transfer function to a unit step, and what is read off it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import acb, arb, ctx, fmpq

from derive.algebra.numbers.balls import number_ball, number_sign
from derive.algebra.scalar import Scalar
from derive.control.modes import Curve
from derive.control.searching import first_above, highest, last_outside
from derive.errors import NotDerivable

BAND = Fraction(2, 100)  # settled: within this share of the steady state
LOW, HIGH = Fraction(1, 10), Fraction(9, 10)  # what the rise time is taken between
SMALL = 1e-9  # of the steady state: overshoot that counts as none
SAMPLES, MOST_SAMPLES = 800, 4000  # of the curve as it is drawn
EACH_SWING = 20  # samples, so that it is drawn as one
VISIBLE = 5e-3  # of the largest mode: one that is seen


@dataclass(frozen=True, slots=True)
class StepResponse:
    """y(t) for a unit step at t = 0. Times in seconds, overshoot in percent; None where a response has no
    such number: one that grows or swings for ever has no steady state, one that returns to zero no rise.

    `rises` are the times it rises between; `times` and `values` are the part of the curve worth drawing.
    """

    curve: Curve
    times: tuple[float, ...]
    values: tuple[float, ...]
    steady_state: float | None
    rises: tuple[float, float] | None = None
    settling_time: float | None = None
    overshoot: float | None = None
    peak_time: float | None = None

    @property
    def rise_time(self) -> float | None:
        """From 10 to 90 % of the steady state [s]; None where it has none."""
        return None if self.rises is None else self.rises[1] - self.rises[0]

    def at(self, time: float) -> float:
        """y there."""
        with ctx.workprec(self.curve.bits):
            return float(self.curve.at(arb(time)))

    def transform(self, s: complex) -> complex:
        """The Laplace transform of y there."""
        with ctx.workprec(self.curve.bits):
            return complex(self.curve.transform(acb(s)))


def step_response(num: Sequence[Scalar], den: Sequence[Scalar]) -> StepResponse:
    """The response of num/den: numbers, highest power first, proper and without common factors.

    Raises NotDerivable where poles are not told apart, and where a response swings too often to be searched.
    """
    curve = Curve.of_step(num, den)
    with ctx.workprec(curve.bits):
        poles = [complex(mode.pole) for mode in curve.modes[1:]]
        if curve.modes[0].factor.degree() > 0 or any(pole.real >= 0 for pole in poles):
            return StepResponse(curve, *_sampled(curve, _horizon(curve)), None)
        if not num or not num[-1]:
            return StepResponse(curve, *_sampled(curve, _horizon(curve)), 0.0)
        return _measured(curve, num, den)


def _measured(curve: Curve, num: Sequence[Scalar], den: Sequence[Scalar]) -> StepResponse:
    """The numbers of a response that settles somewhere else than at zero."""
    last = num[-1] / den[-1]
    final = number_ball(last)
    start = num[0] / den[0] / last if len(num) == len(den) else Scalar.of(0)
    away = curve.without_constant().scaled(1 / final)  # from the steady state, as a share of it
    end = away.end(SMALL)

    def reached(level: Fraction) -> arb:
        if number_sign(start - level) >= 0:
            return arb(0)
        found = first_above(away, _ball(level - 1), end)
        if found is None:
            raise NotDerivable("the response does not reach its steady state within the time looked at")
        return found

    low, high = reached(LOW), reached(HIGH)
    begins_outside = number_sign((start - 1) * (start - 1) - BAND * BAND) > 0
    settled = last_outside(away, _ball(BAND), begins_outside, end)
    peak, over = highest(away, number_ball(start - 1), SMALL, end)
    exceeds = bool(over > SMALL)
    times, values = _sampled(curve, 1.6 * float(settled) or _horizon(curve))
    return StepResponse(
        curve, times, values, float(final), (float(low), float(high)), float(settled),
        100 * float(over) if exceeds else 0.0, float(peak) if exceeds else None,
    )  # fmt: skip


def _ball(value: Fraction) -> arb:
    return arb(fmpq(value.numerator, value.denominator))


# -- the curve as it is drawn -------------------------------------------------------------------------


def _sampled(curve: Curve, horizon: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Times and values; where it swings very often, of the beginning only."""
    swings = horizon * _fastest_swing(curve) / (2 * math.pi)
    wanted = EACH_SWING * swings
    count = round(min(MOST_SAMPLES, max(SAMPLES, wanted)))
    step = horizon / count * min(1.0, MOST_SAMPLES / max(wanted, 1.0))
    times = tuple(k * step for k in range(count + 1))
    return times, tuple(float(curve.at(arb(time))) for time in times)


def _fastest_swing(curve: Curve) -> float:
    """The largest frequency [rad/s] that is seen."""
    sizes = [(float(mode.size(arb(0)).mid()), abs(complex(mode.pole).imag)) for mode in curve.modes]
    seen = VISIBLE * max(size for size, _ in sizes)
    return max(frequency for size, frequency in sizes if size >= seen)


def _horizon(curve: Curve) -> float:
    """Long enough to see what a response does: ten time constants of the slowest pole; a few of the
    fastest growing one; some periods or seconds of one that does neither."""
    poles = [complex(mode.pole) for mode in curve.modes[1:]]
    growing = [pole.real for pole in poles if pole.real > 0]
    if growing:
        return 4.0 / max(growing)
    decaying = [-pole.real for pole in poles if pole.real < 0]
    swinging = [abs(pole.imag) for pole in poles if pole.real == 0 and pole.imag]
    times = [12.0 / min(decaying)] if decaying else []
    times += [20.0 / min(swinging)] if swinging else []
    return max(times, default=10.0)
