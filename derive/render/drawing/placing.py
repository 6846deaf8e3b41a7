"""Where captions go: near what they name, none on another and none on a line.

A caption may stand beside any of its places, in sixteen directions and at growing distances, the wanted one
first. It takes the first that is free; where none is, it takes one that only captions are in the way of, and
they look for another. What is far from its place gets a thin line to it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, product
from math import atan2, cos, hypot, pi, sin

from derive.derivation import Place
from derive.render.drawing.lettering import Written

SWINGS = tuple(side * k * pi / 8 for k in range(9) for side in ((1, -1) if 0 < k < 8 else (1,)))
STEPS = (0.0, 3.0, 7.0, 12.0, 18.0, 26.0, 36.0, 48.0)  # points beyond the first distance
FAR = 14.0  # points beyond it from which on a caption needs a line to its place
AIR = 1.3  # points that stay free round a caption
CELL = 24.0  # points: lines are looked up by squares of paper
MOST_MOVES = 12  # of one caption that others are in the way of


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle on paper."""

    left: float
    low: float
    right: float
    high: float

    @property
    def middle(self) -> Place:
        return (self.left + self.right) / 2, (self.low + self.high) / 2

    def grown(self, by: float) -> Box:
        return Box(self.left - by, self.low - by, self.right + by, self.high + by)

    def meets(self, other: Box) -> bool:
        """Whether both cover a place."""
        return (
            self.left < other.right
            and other.left < self.right
            and self.low < other.high
            and other.low < self.high
        )

    def crossed(self, a: Place, b: Place) -> bool:
        """Whether a straight line from place to place enters it (Liang and Barsky)."""
        first, last = 0.0, 1.0
        for start, way, low, high in (
            (a[0], b[0] - a[0], self.left, self.right),
            (a[1], b[1] - a[1], self.low, self.high),
        ):
            if abs(way) < 1e-9:
                if not low < start < high:
                    return False
                continue
            enter, leave = sorted(((low - start) / way, (high - start) / way))
            first, last = max(first, enter), min(last, leave)
        return first < last

    def nearest(self, place: Place) -> Place:
        """Its place nearest to another."""
        return min(max(place[0], self.left), self.right), min(max(place[1], self.low), self.high)


@dataclass(frozen=True, slots=True)
class Wanted:
    """What is to be written beside one of some places, each with the direction in which and the distance from
    which on it should stand; `upon` it where there is no direction."""

    what: Written
    spots: tuple[tuple[Place, float, float], ...] = ()
    upon: Place | None = None


@dataclass(slots=True)
class Lines:
    """Thick lines by the squares of paper that they cross."""

    cells: dict[tuple[int, int], list[tuple[Place, Place, float]]] = field(default_factory=dict)

    def add(self, places: Sequence[Place], half: float) -> None:
        """A line through places, and half its width."""
        for a, b in pairwise(places):
            box = Box(min(a[0], b[0]), min(a[1], b[1]), max(a[0], b[0]), max(a[1], b[1])).grown(half)
            for cell in _cells(box):
                self.cells.setdefault(cell, []).append((a, b, half))

    def cross(self, box: Box) -> bool:
        """Whether a line enters a box."""
        return any(
            box.grown(half).crossed(a, b) for cell in _cells(box) for a, b, half in self.cells.get(cell, ())
        )


def placed(wanted: Sequence[Wanted], lines: Lines) -> tuple[list[Box], list[tuple[Place, Place]]]:
    """A box for each, and the lines to their places of those that are far from them."""
    boxes: dict[int, Box] = {}
    leaders: dict[int, tuple[Place, Place]] = {}
    moves = [0] * len(wanted)
    waiting = list(range(len(wanted)))
    while waiting:
        k = waiting.pop(0)
        moves[k] += 1
        box, leader, away = _choice(wanted[k], k, boxes, leaders, lines, moves)
        for other in away:
            boxes.pop(other)
            leaders.pop(other, None)
            waiting.append(other)
        boxes[k] = box
        if leader:
            leaders[k] = leader
    return [boxes[k] for k in range(len(wanted))], list(leaders.values())


def _choice(
    one: Wanted, k: int, boxes: dict[int, Box], leaders: dict[int, tuple[Place, Place]], lines: Lines,
    moves: Sequence[int],
) -> tuple[Box, tuple[Place, Place] | None, list[int]]:  # fmt: skip
    """The first free box; else the one that the fewest captions are in the way of, and which these are."""
    best: tuple[float, Box, tuple[Place, Place] | None, list[int]] | None = None
    for rank, (box, leader) in enumerate(_boxes(one)):
        roomy = box.grown(AIR)
        crossed = 0 if one.upon else lines.cross(roomy) + (2 * bool(leader and _through(leader, boxes)))
        way = [j for j, other in boxes.items() if roomy.meets(other)]
        way += [j for j, line in leaders.items() if j not in way and roomy.crossed(*line)]
        if not crossed and not way:
            return box, leader, []
        fixed = sum(moves[j] >= MOST_MOVES for j in way)
        cost = 1000 * crossed + 400 * fixed + 60 * len(way) + rank
        if best is None or cost < best[0]:
            best = (cost, box, leader, [j for j in way if moves[j] < MOST_MOVES])
        if one.upon:
            break
    assert best is not None
    return best[1:]


def _boxes(one: Wanted) -> Iterator[tuple[Box, tuple[Place, Place] | None]]:
    """Every box, the wanted ones first, and the line that it would need."""
    if one.upon:
        yield _about(*one.upon, one.what), None
        return
    for step, swing in sorted(product(STEPS, SWINGS), key=lambda each: each[0] + 7 * abs(each[1])):
        for place, towards, gap in one.spots:
            box = _beside(place, one.what, towards + swing, gap + step)
            far = step >= FAR
            yield box, (place, box.nearest(place)) if far else None


def _through(line: tuple[Place, Place], boxes: dict[int, Box]) -> bool:
    return any(box.crossed(*line) for box in boxes.values())


def _beside(place: Place, what: Written, angle: float, gap: float) -> Box:
    """The box that touches a circle round a place, in a direction."""
    dx, dy = cos(angle), sin(angle)
    reach = min(
        (what.wide / 2) / abs(dx) if abs(dx) > 1e-9 else 1e9,
        (what.high / 2) / abs(dy) if abs(dy) > 1e-9 else 1e9,
    )
    away = gap + min(reach, hypot(what.wide, what.high) / 2)
    return _about(place[0] + away * dx, place[1] + away * dy, what)


def _about(x: float, y: float, what: Written) -> Box:
    return Box(x - what.wide / 2, y - what.high / 2, x + what.wide / 2, y + what.high / 2)


def _cells(box: Box) -> Iterator[tuple[int, int]]:
    for i in range(int(box.left // CELL), int(box.right // CELL) + 1):
        for j in range(int(box.low // CELL), int(box.high // CELL) + 1):
            yield i, j


def direction(towards: Place) -> float:
    """The angle of a direction on paper (rad)."""
    return atan2(towards[1], towards[0])
