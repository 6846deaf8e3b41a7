"""Laws of motion from rest to rest that keep one shape, in numbers: sampled, and their least time by search.

Nothing here knows a formula of the laws: a polynomial is what its conditions at both ends make it, the
cycloid has a sine for its acceleration, and how fast a motion is comes from differences of its places.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from math import factorial, inf, perm, tau
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from derive.errors import NotAsWritten
from derive.mechanics.course import Course, Piece

if TYPE_CHECKING:
    from numpy.typing import NDArray

Law: TypeAlias = Literal["cubic", "quintic", "cycloidal"]
CONDITIONS = {"cubic": 2, "quintic": 3}  # at each end
FINE = 4001  # shares of the time at which a motion is looked at
HALVINGS = 60
TERMS = 31  # of the series of a sine over one turn
NEARLY = 1e-5  # of a motion, between its curve and the samples


@cache
def places(law: Law) -> NDArray[Any]:
    """From 0 to 1, at equal times."""
    import numpy as np

    shares = np.linspace(0, 1, FINE)
    if law in CONDITIONS:
        found: NDArray[Any] = np.polyval(_coefficients(CONDITIONS[law])[::-1], shares)
        return found
    once = _integrated(np.sin(tau * shares))
    twice = _integrated(once)
    whole: float = twice[-1]
    return twice / whole


def _integrated(values: NDArray[Any]) -> NDArray[Any]:
    import numpy as np

    return np.concatenate([[0.0], np.cumsum(values[1:] + values[:-1])]) / (2 * (FINE - 1))


def _coefficients(order: int) -> NDArray[Any]:
    """At rest, with as many derivatives zero, at both ends."""
    import numpy as np

    rows = [
        [perm(k, rate) * share ** (k - rate) if k >= rate else 0 for k in range(2 * order)]
        for share in (0, 1)
        for rate in range(order)
    ]
    ends = [0.0] * (2 * order)
    ends[order] = 1.0
    return np.linalg.solve(rows, ends)


def rates(law: Law, d: float, time: float) -> tuple[NDArray[Any], NDArray[Any]]:
    """Velocity and acceleration at equal times, by differences; the ends by those beside them."""
    import numpy as np

    q, step = d * places(law), time / (FINE - 1)
    strong = np.empty_like(q)
    strong[1:-1] = (q[2:] - 2 * q[1:-1] + q[:-2]) / step**2
    strong[0], strong[-1] = 2 * strong[1] - strong[2], 2 * strong[-2] - strong[-3]
    return np.gradient(q, step, edge_order=2), strong


def peaks(law: Law, d: float, time: float) -> tuple[float, float]:
    """The greatest velocity and acceleration in size."""
    fast, strong = rates(law, d, time)
    return float(abs(fast).max()), float(abs(strong).max())


def least_time(law: Law, d: float, v_max: float = inf, a_max: float = inf) -> float:
    """The shortest time in which no limit is exceeded, by halving; 0 without limits."""

    def kept(time: float) -> bool:
        fast, strong = peaks(law, d, time)
        return fast <= v_max and strong <= a_max

    if v_max == a_max == inf:
        return 0.0
    low, high = 0.0, 1.0
    while not kept(high):
        low, high = high, 2 * high
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (low, middle) if kept(middle) else (middle, high)
    return high


def course(law: Law, d: float, time: float, start: float = 0.0) -> Course:
    """To be drawn, as one polynomial; the cycloid by as many terms of its series as digits need."""
    if law in CONDITIONS:
        share = _coefficients(CONDITIONS[law]).tolist()
    else:
        share = [0.0] * (TERMS + 1)
        for k in range(3, TERMS + 1, 2):
            share[k] = -((-1) ** (k // 2)) * tau ** (k - 1) / factorial(k)
    found = [d * c / time**k for k, c in enumerate(share)]
    found[0] += start
    drawn = Piece(0.0, time, tuple(found))
    if any(abs(drawn.at(time * share) - start - d * q) > NEARLY * abs(d) for share, q in _looked_at(law)):
        raise NotAsWritten(f"the curve of the {law} law is another one")
    return (drawn,)


def _looked_at(law: Law) -> Iterator[tuple[float, float]]:
    """Some shares of the time, with the place there."""
    whole = places(law)
    for k in range(0, FINE, (FINE - 1) // 8):
        yield k / (FINE - 1), float(whole[k])
