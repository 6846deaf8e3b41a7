"""Step responses of random functions against residues at 50 digits.

Their poles are repeated, clustered, a million times apart, lightly damped.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from fractions import Fraction
from math import factorial

import mpmath
import pytest

from derive.algebra.scalar import Scalar
from derive.control.response import StepResponse, step_response

NEARLY = 1e-9


def decimal(size: float) -> Fraction:
    return Fraction(f"{size:.3g}")


def times(left: Sequence[Fraction], right: Sequence[Fraction]) -> list[Fraction]:
    found = [Fraction(0)] * (len(left) + len(right) - 1)
    for i, a in enumerate(left):
        for j, b in enumerate(right):
            found[i + j] += a * b
    return found


def factors(draw: random.Random) -> list[tuple[Fraction, ...]]:
    """Factors of a denominator, s + p or s^2 + 2 zeta w s + w^2."""
    kind = draw.choice(("real", "stiff", "pair", "light", "repeated", "cluster"))
    p = decimal(10 ** draw.uniform(-1, 1))
    if kind == "real":
        return [(Fraction(1), p)]
    if kind == "stiff":
        return [(Fraction(1), decimal(10 ** draw.uniform(-3, 3)))]
    if kind == "repeated":
        return [(Fraction(1), p)] * draw.randint(2, 5)
    if kind == "cluster":
        apart = decimal(10 ** draw.uniform(-8, -2))
        return [(Fraction(1), p * (1 + k * apart)) for k in range(draw.randint(2, 4))]
    zeta = decimal(draw.uniform(0.05, 0.95) if kind == "pair" else 10 ** draw.uniform(-3, -1.3))
    return [(Fraction(1), 2 * zeta * p, p * p)]


def poles(found: Sequence[tuple[Fraction, ...]]) -> list[tuple[mpmath.mpc, int]]:
    each: list[mpmath.mpc] = [mpmath.mpc(0)]
    for factor in found:
        _, *rest = (mpmath.mpf(k.numerator) / k.denominator for k in factor)
        if len(rest) == 1:
            each.append(mpmath.mpc(-rest[0]))
        else:
            root = mpmath.sqrt(mpmath.mpc(rest[0] ** 2 - 4 * rest[1]))
            each += [(-rest[0] + root) / 2, (-rest[0] - root) / 2]
    return [(p, each.count(p)) for p in dict.fromkeys(each)]


def response(num: Sequence[Fraction], den: Sequence[tuple[Fraction, ...]]) -> Callable[[float], float]:
    """y(t), each pole's part by the series of what the other poles leave."""
    terms, all_poles = [], poles(den)
    for p, m in all_poles:
        series = [mpmath.mpc(0)] * m
        left = [mpmath.mpc(mpmath.mpf(k.numerator) / k.denominator) for k in num]
        for k in range(min(m, len(left))):  # the numerator about p, by Horner
            for j in range(1, len(left)):
                left[j] += p * left[j - 1]
            series[k] = left.pop()
        for q in [q for q, n in all_poles if q != p for _ in range(n)]:  # divided by (s - q)
            before = mpmath.mpc(0)
            for k in range(m):
                series[k] = before = (series[k] - before) / (p - q)
        terms += [(p, series[m - 1 - k] / factorial(k), k) for k in range(m)]

    def y(time: float) -> float:
        t = mpmath.mpf(time)
        return float(mpmath.re(sum(c * t**k * mpmath.exp(p * t) for p, c, k in terms)))

    return y


@pytest.mark.parametrize("seed", range(16))
def test_figures(seed: int) -> None:
    draw = random.Random(seed)
    den = factors(draw)
    while len(den) < draw.choice((1, 2, 3, 4)):
        den += factors(draw)
    whole = [Fraction(1)]
    for factor in den:
        whole = times(whole, factor)
    num = [decimal(10 ** draw.uniform(-5, 5)) * whole[-1]]
    for _ in range(draw.randint(0, min(2, len(whole) - 2))):
        num = times(num, [decimal(draw.choice((1, 1, -1)) * 10 ** draw.uniform(-1, 1)), Fraction(1)])
    found = step_response([Scalar.of(k) for k in num], [Scalar.of(k) for k in whole])
    with mpmath.workdps(50):
        y = response(num, den)
        check(found, lambda time: y(time) / float(num[-1] / whole[-1]))


def check(found: StepResponse, share: Callable[[float], float]) -> None:
    assert found.rises and found.settling_time is not None and found.overshoot is not None
    low, high, settled, top = *found.rises, found.settling_time, 1 + found.overshoot / 100
    assert share(low) == pytest.approx(0.1, abs=NEARLY)
    assert share(high) == pytest.approx(0.9, abs=NEARLY)
    assert abs(share(settled) - 1) == pytest.approx(0.02, abs=NEARLY)
    if found.peak_time:
        assert share(found.peak_time) == pytest.approx(top, rel=NEARLY)
    for k in range(1, 81):
        assert share(low * k / 81) <= 0.1 + NEARLY
        assert share(high * k / 81) <= 0.9 + NEARLY
        assert share(settled * k / 40) <= top * (1 + NEARLY)
        assert abs(share(settled * (1 + k / 60)) - 1) <= 0.02 + NEARLY
