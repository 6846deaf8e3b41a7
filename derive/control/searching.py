"""When a curve of modes first reaches a level, last leaves a band, and is highest: by halving intervals.

An interval is left out where the curve certainly does nothing of the kind in it, and looked at closely
only where the curve certainly rises or falls all along. So nothing is missed between samples. Where it only
touches a level, the curve counts as not beyond it.
"""

from __future__ import annotations

from collections.abc import Callable
from heapq import heappop, heappush

from flint import arb

from derive.control.modes import Curve
from derive.errors import NotDerivable

MOST = 10_000  # intervals that are looked at
FINEST = 2.0**-60  # of the time, the width of an interval that is not halved again
FIRST = 2.0**-200  # of the end: a time that is the beginning
HALVINGS = 80


def first_above(curve: Curve, level: arb, end: arb) -> arb | None:
    """When it first exceeds a level that it begins below; None where it does not before the end."""
    pending, looked = [(arb(0), end)], 0
    while pending:
        left, right = pending.pop()
        looked = _counted(looked)
        value = curve.over(left, right)
        if value < level:
            continue
        if value > level:
            return left
        slope = curve.slope.over(left, right)
        if slope < 0:
            continue
        if slope > 0 or _is_fine(left, right, end):
            if curve.at(right) > level:
                return _crossing(lambda t: curve.at(t) > level, left, right)
            continue
        middle = _middle(left, right)
        pending += [(middle, right), (left, middle)]
    return None


def last_outside(curve: Curve, band: arb, begins_outside: bool, end: arb) -> arb:
    """When it is last further from zero than a band, within which it is at the end; 0 where it never is."""

    def outside(time: arb) -> bool:
        return begins_outside if time == 0 else bool(abs(curve.at(time)) > band)

    pending, looked = [(arb(0), end)], 0
    while pending:
        left, right = pending.pop()
        looked = _counted(looked)
        value = abs(curve.over(left, right))
        if value < band:
            continue
        if value > band:
            return right
        slope = curve.slope.over(left, right)
        if slope > 0 or slope < 0 or _is_fine(left, right, end):
            if outside(left):
                return _crossing(lambda t: not outside(t), left, right)
            continue
        middle = _middle(left, right)
        pending += [(left, middle), (middle, right)]
    return arb(0)


def highest(curve: Curve, begins: arb, small: float, end: arb) -> tuple[arb, arb]:
    """(time, value) where it is highest, its beginning included; what is below `small` counts as none."""
    best, looked = (arb(0), begins.max(arb(small))), 0
    pending: list[tuple[float, int, arb, arb]] = []

    def add(left: arb, right: arb) -> None:
        value = curve.over(left, right)
        if not value < best[1]:
            heappush(pending, (-float(value.upper()), looked, left, right))

    def better(time: arb) -> tuple[arb, arb]:
        return max(best, (time, curve.at(time)), key=lambda found: float(found[1].mid()))

    add(arb(0), end)
    while pending:
        bound, _, left, right = heappop(pending)
        looked = _counted(looked)
        if -bound <= best[1]:
            break
        if _is_fine(left, right, end):
            best = better(_middle(left, right))
            continue
        slope = curve.slope.over(left, right)
        if slope > 0 or slope < 0:
            continue  # its ends belong to its neighbours too, or are the beginning and the end
        bend = curve.slope.slope.over(left, right)
        if bend < 0:
            best = better(_crossing(lambda t: curve.slope.at(t) < 0, left, right))
        elif not bend > 0:
            middle = _middle(left, right)
            add(left, middle)
            looked += 1
            add(middle, right)
    return best


def _middle(left: arb, right: arb) -> arb:
    return ((left + right) / 2).mid()


def _is_fine(left: arb, right: arb, end: arb) -> bool:
    return bool(right - left < right * FINEST) or bool(right < end * FIRST)


def _crossing(is_past: Callable[[arb], bool], left: arb, right: arb) -> arb:
    """Where a statement becomes true, by bisection."""
    for _ in range(HALVINGS):
        middle = _middle(left, right)
        left, right = (left, middle) if is_past(middle) else (middle, right)
    return _middle(left, right)


def _counted(looked: int) -> int:
    if looked >= MOST:
        raise NotDerivable(
            f"the response swings so often that {MOST} intervals do not tell when it settles and how high "
            "it goes"
        )
    return looked + 1
