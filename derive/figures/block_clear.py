"""Whether a block diagram can be read: no wire runs through a block or on another wire, or ends with one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations, pairwise

from derive.derivation import Place

Wire = tuple[str, Sequence[Place]]  # the block it leaves, and its way, along the edges of the paper
Rectangle = tuple[float, float, float, float]  # left, low, right, high
Segment = tuple[Place, Place]
NEAR = 1.0  # points that nothing is


def is_clear(wires: Sequence[Wire], blocks: Sequence[Rectangle]) -> bool:
    """Of wires and blocks, in points."""
    return not (
        any(_apart(a, b) < NEAR for a, b in combinations(blocks, 2))
        or any(_enters(segment, block) for _, way in wires for segment in pairwise(way) for block in blocks)
        or any(one[1][-1] == other[1][-1] for one, other in combinations(wires, 2))
        or any(
            _run_together(a, b)
            for one, other in combinations(wires, 2)
            if one[0] != other[0]
            for a in pairwise(one[1])
            for b in pairwise(other[1])
        )
    )


def _apart(a: Rectangle, b: Rectangle) -> float:
    """How far two rectangles are from each other, the farther way."""
    return max(a[0] - b[2], b[0] - a[2], a[1] - b[3], b[1] - a[3])


def _enters(segment: Segment, block: Rectangle) -> bool:
    return _apart(_covered(segment), block) < -NEAR


def _run_together(a: Segment, b: Segment) -> bool:
    """Whether two segments in one line have more than a place in common."""
    one, other = _covered(a), _covered(b)
    for k in (0, 1):  # both upright, both level
        if abs(one[k] - one[k + 2]) < NEAR and abs(other[k] - other[k + 2]) < NEAR:
            beside = abs(one[k] - other[k]) < NEAR
            along = min(one[3 - k], other[3 - k]) - max(one[1 - k], other[1 - k])
            return beside and along > NEAR
    return False


def _covered(segment: Segment) -> Rectangle:
    (ax, ay), (bx, by) = segment
    return min(ax, bx), min(ay, by), max(ax, bx), max(ay, by)


def corners(places: Iterable[Place]) -> Rectangle:
    """The rectangle about places."""
    found = [*places]
    xs, ys = [x for x, _ in found], [y for _, y in found]
    return min(xs), min(ys), max(xs), max(ys)
