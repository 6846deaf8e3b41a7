"""The response of a transfer function to a unit step, in numbers, and what is read off it.

The function is brought to controllable canonical form in a time scaled by its poles and stepped with the
exact matrix exponential, so that no error of integration enters.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy

SAMPLES = 4096
FINEST = 65536  # samples at most, where fast and slow poles stand side by side
BAND = 0.02  # settled: within this share of the steady state
LOW, HIGH = 0.1, 0.9  # what the rise time is taken between


@dataclass(frozen=True, slots=True)
class StepResponse:
    """y(t) for a unit step at t = 0. Times in seconds, overshoot in percent; None where a response has no
    such number: one that grows or swings for ever has no steady state, one that returns to zero no rise.
    """

    times: tuple[float, ...]
    values: tuple[float, ...]
    steady_state: float | None
    rise_time: float | None = None
    settling_time: float | None = None
    overshoot: float | None = None
    peak_time: float | None = None


def step_response(num: Sequence[float], den: Sequence[float], poles: Sequence[complex]) -> StepResponse:
    """The response of num/den (highest power first, proper), whose poles are given."""
    import numpy

    curve = _Curve(num, den, poles)
    stable = all(pole.real < 0 for pole in poles)
    horizon = _horizon(poles)
    if not stable:
        times, values = curve.sampled(horizon, 1024)
        return StepResponse(tuple(times.tolist()), tuple(values.tolist()), None)
    fastest = max((abs(pole) for pole in poles), default=1.0)
    count = min(FINEST, max(SAMPLES, 1 << int(numpy.ceil(numpy.log2(horizon * fastest * 20)))))
    times, values = curve.sampled(horizon, count)
    return _measured(curve, times, values, num[-1] / den[-1] if num else 0.0)


def _measured(curve: _Curve, times: Any, values: Any, final: float) -> StepResponse:
    """The numbers of a response that settles, and the part of it worth drawing."""
    import numpy

    scale = float(numpy.max(numpy.abs(values), initial=0.0))
    if abs(final) <= 1e-12 * max(scale, 1.0):
        return StepResponse(tuple(times[::8].tolist()), tuple(values[::8].tolist()), 0.0)
    share = values / final
    outside = numpy.nonzero(numpy.abs(share - 1) > BAND)[0]
    settled = 0.0
    if len(outside):
        last = int(outside[-1])
        level = 1 + BAND if share[last] > 1 else 1 - BAND
        settled = curve.crossing(times, share, last, level, final)
    low, high = (_first_above(curve, times, share, level, final) for level in (LOW, HIGH))
    peak = int(numpy.argmax(share))
    over = max(0.0, curve.peak(times, peak, final) - 1)
    shown = times <= (1.6 * settled or times[-1])
    every = max(1, int(shown.sum()) // 800)
    return StepResponse(
        tuple(times[shown][::every].tolist()),
        tuple(values[shown][::every].tolist()),
        final,
        high - low,
        settled,
        100 * over if over > 1e-6 else 0.0,
        float(times[peak]) if over > 1e-6 else None,
    )


def _first_above(curve: _Curve, times: Any, share: Any, level: float, final: float) -> float:
    import numpy

    above = numpy.nonzero(share >= level)[0]
    first = int(above[0])
    return 0.0 if first == 0 else curve.crossing(times, share, first - 1, level, final)


def _horizon(poles: Sequence[complex]) -> float:
    """Long enough to see what a response does: ten time constants of the slowest pole; a few of the
    fastest growing one; some periods or seconds of one that does neither."""
    growing = [pole.real for pole in poles if pole.real > 0]
    if growing:
        return 4.0 / max(growing)
    decaying = [-pole.real for pole in poles if pole.real < 0]
    swinging = [abs(pole.imag) for pole in poles if pole.real == 0 and pole.imag]
    times = [12.0 / min(decaying)] if decaying else []
    times += [20.0 / min(swinging)] if swinging else []
    return max(times, default=10.0)


class _Curve:
    """y(t) by the matrix exponential of [x; 1], time in units of `unit`."""

    def __init__(self, num: Sequence[float], den: Sequence[float], poles: Sequence[complex]) -> None:
        import numpy

        sizes = [abs(pole) for pole in poles if pole]
        self.unit = float(numpy.exp(-numpy.mean(numpy.log(sizes)))) if sizes else 1.0
        order = len(den) - 1
        speeds = self.unit ** -numpy.arange(order, -1, -1.0)
        a = numpy.asarray(den) * speeds
        b = numpy.concatenate((numpy.zeros(order + 1 - len(num)), num)) * speeds
        a, b = a / a[0], b / a[0]
        self.direct = float(b[0])
        self.output = numpy.append(b[1:] - b[0] * a[1:], b[0])
        self.matrix = numpy.zeros((order + 1, order + 1))
        self.matrix[:order, :order] = numpy.eye(order, k=-1)
        if order:
            self.matrix[0, :order] = -a[1:]
            self.matrix[0, order] = 1.0

    def sampled(self, horizon: float, count: int) -> tuple[Any, Any]:
        """`count + 1` equal steps from 0 to the horizon; doubled, for speed."""
        import numpy

        transition = exponential(self.matrix * (horizon / count / self.unit))
        states = numpy.zeros((len(self.matrix), 1))
        states[-1, 0] = 1.0
        while states.shape[1] <= count:
            states = numpy.hstack((states, transition @ states))
            transition = transition @ transition
        return numpy.linspace(0.0, horizon, count + 1), self.output @ states[:, : count + 1]

    def at(self, time: float) -> float:
        return float(self.output @ exponential(self.matrix * (time / self.unit))[:, -1])

    def crossing(self, times: Any, share: Any, before: int, level: float, final: float) -> float:
        """Where y/final crosses a level between one sample and the next, by bisection."""
        left, right = float(times[before]), float(times[min(before + 1, len(times) - 1)])
        side = share[before] > level
        for _ in range(40):
            middle = (left + right) / 2
            if (self.at(middle) / final > level) == side:
                left = middle
            else:
                right = middle
        return (left + right) / 2

    def peak(self, times: Any, place: int, final: float) -> float:
        """The largest y/final, by golden section between the neighbours of the largest sample."""
        left, right = float(times[max(place - 1, 0)]), float(times[min(place + 1, len(times) - 1)])
        for _ in range(40):
            third = (right - left) * 0.381966
            if self.at(left + third) / final < self.at(right - third) / final:
                left += third
            else:
                right -= third
        return self.at((left + right) / 2) / final


def exponential(matrix: numpy.ndarray[Any, Any]) -> Any:
    """e^matrix, by its series after scaling and squared back (Golub and Van Loan, section 9.3)."""
    import numpy

    size = float(numpy.abs(matrix).sum(axis=1).max(initial=0.0))
    halvings = max(0, int(numpy.ceil(numpy.log2(size))) + 2) if size > 0 else 0
    scaled = matrix / 2**halvings
    total = term = numpy.eye(len(matrix))
    for k in range(1, 16):
        term = term @ scaled / k
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total
