"""Whether an arm whose rates were integrated comes back with its end-effector to where it began."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, hypot, remainder, sin, tau

from derive.derivation import Phrase, Table
from derive.expression import Approximate
from derive.kinds.path._moving import Driven
from derive.kinds.robot._carried.sampled import Sampled
from derive.mechanics.robot import Robot

SAME, APART = 1e-4, 1e-2  # rad, or of the greatest displacement
MOMENTS = 7


def returns(found: Sampled, driven: Driven) -> Phrase | None:
    """None where the path is not closed, or the joints end too near to their start to be told apart."""
    if not _is_closed(driven):
        return None
    q, turning = found.values[0], _turning(found.robot)
    gaps = [
        abs(remainder(end - start, tau) if turns else end - start)
        for start, end, turns in zip(q[0], q[-1], turning, strict=True)
    ]
    if SAME < max(gaps) < APART:
        return None
    return Phrase("drifts" if max(gaps) >= APART else "comes-back")


def is_so(said: Phrase, table: Table, driven: Driven, robot: Robot) -> Iterator[bool]:
    """Whether the rows of the table at both ends say it."""
    assert driven.ends
    begin, end = driven.ends
    places = [driven.place(begin + k * (end - begin) / MOMENTS) for k in range(MOMENTS + 1)]
    away = [float(abs(each - places[0]).max()) for each in places]
    yield away[-1] < SAME * max(away)
    first, last = ([cell.value for cell in row if isinstance(cell, Approximate)] for row in _ends(table))
    turning = _turning(robot)
    pairs = list(zip(first[1:], last[1:], turning, strict=False))
    apart = max(hypot(cos(a) - cos(b), sin(a) - sin(b)) if turns else abs(a - b) for a, b, turns in pairs)
    yield len(pairs) == len(turning)
    yield (said.key == "drifts") == (apart > SAME)


def _ends(table: Table) -> tuple[tuple[object, ...], tuple[object, ...]]:
    return table.rows[0], table.rows[-1]


def _turning(robot: Robot) -> list[bool]:
    return [link.joint == "revolute" for link in robot.links if link.variable]


def _is_closed(driven: Driven) -> bool:
    if driven.ends is None:
        return False
    start, middle, end = (
        driven.place(driven.ends[0] + by * (driven.ends[1] - driven.ends[0])) for by in (0, 0.37, 1)
    )
    return bool(abs(end - start).max() < SAME * abs(middle - start).max())
