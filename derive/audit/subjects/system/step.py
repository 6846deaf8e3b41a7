"""The response to a unit step: the modes of the inverse transform, and what is read off their sum."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

import mpmath
import numpy as np
import sympy

from derive.audit.asked import EVALUATED, Asked, Holds, Same, Test
from derive.audit.points import Point, floating
from derive.audit.putting_back import put_back
from derive.audit.subjects.system.loops import response_of
from derive.audit.subjects.system.plant import S
from derive.audit.subjects.system.rationals import lowest, roots

Array: TypeAlias = np.ndarray[Any, Any]
LOW, HIGH, BAND = 0.1, 0.9, 0.02
FIGURES = ("rise_time", "settling_time", "overshoot")
NEAR = mpmath.mpf(10) ** -6  # of figures found by halving
HALVINGS = 80
CLOSE = 1e-3  # below the band: a swing between samples may pass it
EACH_TURN, LASTING = 40, 14.0  # samples of a turn of a mode; time constants until it has died away
MOST = 400_000
NONE = (None, "none")


@dataclass(frozen=True, slots=True)
class Mode:
    """sum c_k t^k e^(pole t)."""

    pole: complex
    c: tuple[complex, ...]


def step_response(asked: Asked, point: Point) -> Iterator[Test]:
    """The figures, where the response comes to rest at a value that is not zero."""
    num, den = lowest(response_of(asked, asked.here))
    poles = roots(den)
    if any(pole.real > -1e-9 * abs(pole) - 1e-12 for pole in poles):
        yield from _nothing(asked, "steady_state", *FIGURES)
        return
    final = num.as_expr().subs(S, 0) / den.as_expr().subs(S, 0)
    yield put_back("steady_state", point, asked.result("steady_state"), final, "T(0) is another")
    yield Same(EVALUATED + "steady_state", floating(point.at(final)))
    if final == 0:
        yield from _nothing(asked, *FIGURES)
        return
    for name, value in _figures(_modes(num, den, poles), float(floating(point.at(final)))).items():
        for each in (name, EVALUATED + name):
            ours = asked.result(each)
            yield put_back(each, point, ours, mpmath.mpf(value), f"it is {value:.8g}", NEAR)


def _nothing(asked: Asked, *names: str) -> Iterator[Test]:
    """A response that never comes to rest, or comes back to nothing, has none of these figures."""
    for name in names:
        yield Holds(name, asked.results[name] in NONE, "the response has no such number")
        yield Holds(EVALUATED + name, asked.evaluated.get(name) in NONE, "the response has no such number")


def _modes(num: sympy.Poly, den: sympy.Poly, poles: list[mpmath.mpc]) -> list[Mode]:
    """Partial fractions of num/(den s): at each pole the series of what is left without it."""
    every = [mpmath.mpc(0), *poles]
    lead = floating(mpmath.mpmathify(sympy.N(den.LC(), 50)))
    top = [mpmath.mpmathify(sympy.N(k, 50)) / lead for k in num.all_coeffs()]
    found = []
    for pole in dict.fromkeys(every):
        times = every.count(pole)
        series = _shifted(top, pole, times)
        for other in every:
            if other != pole:
                series = _divided(series, pole - other)
        powers = [series[times - 1 - k] / mpmath.factorial(k) for k in range(times)]
        found.append(Mode(complex(pole), tuple(map(complex, powers))))
    return found


def _shifted(polynomial: list[Any], pole: mpmath.mpc, count: int) -> list[Any]:
    """The first coefficients of its series about the pole."""
    found = []
    for k in range(count):
        found.append(mpmath.polyval(polynomial, pole) / mpmath.factorial(k))
        n = len(polynomial) - 1
        polynomial = [(n - i) * each for i, each in enumerate(polynomial[:-1])] or [mpmath.mpf(0)]
    return found


def _divided(series: list[Any], gap: mpmath.mpc) -> list[Any]:
    """A series divided by x + gap."""
    found: list[Any] = []
    for k, each in enumerate(series):
        found.append((each - (found[k - 1] if k else 0)) / gap)
    return found


def _figures(modes: list[Mode], final: float) -> dict[str, float]:
    """Found on samples as close as each mode needs, then by halving."""

    def share(t: Array | float) -> Any:
        """y over its steady state."""
        terms = (np.polyval(mode.c[::-1], t) * np.exp(mode.pole * np.asarray(t)) for mode in modes)
        return np.real(sum(terms)) / final

    times = _samples(modes)
    values = share(times)
    low = _first(lambda t: share(t) - LOW, times, values - LOW)
    high = _first(lambda t: share(t) - HIGH, times, values - HIGH)
    settled = _last(lambda t: abs(share(t) - 1) - BAND, times, abs(values - 1) - BAND)
    best = int(values.argmax())
    top = values[best]
    if 0 < best < len(times) - 1:
        top = max(top, share(_highest(share, times[best - 1], times[best + 1])))
    over = max(0.0, float(top - 1) * 100)
    return {"rise_time": high - low, "settling_time": settled, "overshoot": over if over > 1e-7 else 0.0}


def _samples(modes: list[Mode]) -> Array:
    """Times: for each mode evenly while it lasts, and all of them together."""
    found = [np.zeros(1)]
    for mode in modes:
        if mode.pole.real < 0:
            lasting = (LASTING + 2 * len(mode.c)) / -mode.pole.real
            count = int(EACH_TURN * (LASTING + lasting * abs(mode.pole.imag) / (2 * np.pi)))
            found.append(np.linspace(0, lasting, min(count, MOST)))
    return np.unique(np.concatenate(found))


def _first(of: Callable[[float], Any], times: Array, values: Array) -> float:
    k = int(np.flatnonzero(values >= 0)[0])
    return _halved(of, times[k - 1], times[k]) if k else 0.0


def _last(of: Callable[[float], Any], times: Array, values: Array) -> float:
    """When a function is above zero for the last time; a swing that passes it between samples counts too."""
    k = int(np.flatnonzero(values > 0)[-1])
    start = times[k]
    tops = 1 + np.flatnonzero((values[1:-1] >= values[:-2]) & (values[1:-1] >= values[2:]))
    for i in tops[(tops > k) & (values[tops] > -CLOSE)]:
        peak = _highest(of, times[i - 1], times[i + 1])
        if of(peak) > 0:
            start, k = peak, int(i)
    return _halved(of, start, times[k + 1])


def _halved(of: Callable[[float], Any], left: float, right: float) -> float:
    """Where a function changes its sign."""
    sign = of(left) > 0
    for _ in range(HALVINGS):
        middle = (left + right) / 2
        left, right = (middle, right) if (of(middle) > 0) == sign else (left, middle)
    return (left + right) / 2


def _highest(of: Callable[[float], Any], left: float, right: float) -> float:
    for _ in range(HALVINGS):
        one, two = left + (right - left) / 3, right - (right - left) / 3
        left, right = (one, right) if of(one) < of(two) else (left, two)
    return (left + right) / 2
