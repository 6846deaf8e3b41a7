"""What the names of a polynomial trajectory mean in numbers: all conditions at both ends solved at once."""

from __future__ import annotations

from dataclasses import dataclass
from math import perm
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as value_of
from derive.expression import Expr, Symbol
from derive.kinds.meanings import Names
from derive.kinds.profile._ends import RATES, Ends, t
from derive.mechanics.profile import Journey

if TYPE_CHECKING:
    from numpy.typing import NDArray

FINE = 2001  # moments at which a peak is looked for


@dataclass(frozen=True, slots=True)
class BothEnds:
    """A journey in a time, by a polynomial; what stands at its ends is called as the `ends` say."""

    journey: Journey
    time: Expr
    ends: Ends

    @property
    def order(self) -> int:
        return self.ends.order

    def names(self, at: Point) -> Names:
        """The coefficients; place, velocity and acceleration at the time t; the peaks of the whole motion."""
        a, T = self.coefficients(at), value_of(self.time, at)
        found: dict[Expr, Any] = {Symbol(f"a_{k}"): value for k, value in enumerate(a)}
        found |= self._given(at)
        found |= {Symbol(name): float(_derivative(a, rate)(at[t.name])) for rate, name in enumerate(RATES)}
        velocity, acceleration = (_greatest(a, rate, T) for rate in (1, 2))
        way = value_of(self.journey.end, at) - value_of(self.journey.start, at)
        found[Symbol("v_peak")] = velocity
        found[Symbol("a_peak")] = abs(acceleration) * (1 if way > 0 else -1)
        return found

    def _given(self, at: Point) -> dict[Expr, Any]:
        """The names at both ends, and that of the time."""
        names = (*self.ends.start, *self.ends.end, self.ends.T)
        trees = (*self._starts, *self._stops, self.time)
        return {
            name: value_of(tree, at)
            for name, tree in zip(names, trees, strict=True)
            if isinstance(name, Symbol)
        }

    @property
    def _starts(self) -> tuple[Expr, ...]:
        journey = self.journey
        return (journey.start, journey.start_velocity, journey.start_acceleration)[: self.order]

    @property
    def _stops(self) -> tuple[Expr, ...]:
        journey = self.journey
        return (journey.end, journey.end_velocity, journey.end_acceleration)[: self.order]

    def coefficients(self, at: Point) -> NDArray[Any]:
        """From all conditions as one linear system."""
        import numpy as np

        order = self.order
        T = value_of(self.time, at)
        rows = [
            [perm(k, rate) * moment ** (k - rate) if k >= rate else 0.0 for k in range(2 * order)]
            for moment in (0.0, T)
            for rate in range(order)
        ]
        return np.linalg.solve(rows, [value_of(tree, at) for tree in (*self._starts, *self._stops)])


def _derivative(a: NDArray[Any], rate: int) -> Any:
    import numpy as np

    return np.polynomial.Polynomial(a).deriv(rate)


def _greatest(a: NDArray[Any], rate: int, T: float) -> float:
    """The derivative where it is greatest in size: looked for twice, the second time more closely."""
    import numpy as np

    of, low, high = _derivative(a, rate), 0.0, T
    for _ in range(2):
        times = np.linspace(low, high, FINE)
        best, step = times[np.argmax(abs(of(times)))], (high - low) / (FINE - 1)
        low, high = max(best - step, 0.0), min(best + step, T)
    return float(of(best))
