"""Where captions go: near what they name, none on another and none on a line.

A caption may stand beside any of its places, in sixteen directions and at growing distances, the wanted one
first. It takes the first that is free; where none is, it takes one that only captions are in the way of, and
they look for another. What is far from its place gets a thin line to it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise, product
from math import atan2, pi
from typing import Any

from derive.derivation import Place
from derive.render.drawing.lettering import Written

SWINGS = tuple(side * k * pi / 8 for k in range(9) for side in ((1, -1) if 0 < k < 8 else (1,)))
STEPS = (0.0, 3.0, 7.0, 12.0, 18.0, 26.0, 36.0, 48.0)  # points beyond the first distance
FAR = 11.0  # points beyond it from which on a caption needs a line to its place
ORDER = tuple(sorted(product(STEPS, SWINGS), key=lambda each: each[0] + 7 * abs(each[1])))
AIR = 1.3  # points that stay free round a caption
CLEAR = 2.0  # points between it and its line, which would be read as a part of an index
BESIDE, ABOVE = 7.0, 4.0  # points between two beside each other, read as a product, and above, as a fraction
ALONG = 6  # places of a line to a caption that are looked at
UPON, MET, HIDDEN = 1000.0, 60.0, 12.0  # what it costs to stand on a line, to meet a caption, to cross a line
FIXED = 400.0  # and to meet a caption that moves no more
FINE = 1.0  # squares of paper to a point
EDGE = 90.0  # points round all lines that captions may stand on
SIDES = ((0, 0), (1, 1), (1, -1), (-1, 1), (-1, -1))  # of a line, whose squares are covered
THICK = 3.0  # points: half of what is thicker than any letter is high
MOST_MOVES = 8  # of one caption that others are in the way of


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
    """Thick lines, kept as the squares of paper that they cover."""

    lines: list[tuple[Place, Place, float]] = field(default_factory=list)

    def add(self, places: Sequence[Place], half: float) -> None:
        """A line through places, and half its width."""
        self.lines += [(a, b, half) for a, b in pairwise(places)]

    def cross(self, box: Box) -> bool:
        """Whether a line enters a box."""
        return any(box.grown(half).crossed(a, b) for a, b, half in self.lines)

    def covered(self) -> Covered:
        """The paper with these lines on it."""
        import numpy as np

        rows = np.array([(*a, *b, half) for a, b, half in self.lines] or [(0.0,) * 5])
        start, way, halves = rows[:, :2], rows[:, 2:4] - rows[:, :2], rows[:, 4]
        counts = (np.abs(way).max(axis=1) * FINE).astype(int) + 2
        first = np.repeat(counts.cumsum() - counts, counts)
        share = (np.arange(counts.sum()) - first) / np.repeat(counts - 1, counts)
        middle = np.repeat(start, counts, axis=0) + share[:, None] * np.repeat(way, counts, axis=0)
        reach = np.repeat(halves, counts)[:, None]
        inked = np.concatenate([middle + reach * side for side in SIDES])
        low = inked.min(axis=0) - EDGE
        cells = ((inked - low) * FINE).astype(int)
        ink = np.zeros(tuple(cells.max(axis=0) + int(EDGE * FINE)), dtype=np.int32)
        ink[cells[:, 0], cells[:, 1]] = 1
        for a, b, half in self.lines:
            if half > THICK:  # a wall, along an axis
                box = Box(min(a[0], b[0]), min(a[1], b[1]), max(a[0], b[0]), max(a[1], b[1])).grown(half)
                x, y = int((box.left - low[0]) * FINE), int((box.low - low[1]) * FINE)
                ink[x : int((box.right - low[0]) * FINE) + 1, y : int((box.high - low[1]) * FINE) + 1] = 1
        sums = np.zeros((ink.shape[0] + 1, ink.shape[1] + 1), dtype=np.int32)
        sums[1:, 1:] = ink.cumsum(axis=0).cumsum(axis=1)
        return Covered((float(low[0]), float(low[1])), sums)


@dataclass(frozen=True, slots=True)
class Covered:
    """How much of the paper is covered to the left of and below each of its squares, from a place on."""

    start: Place
    sums: Any

    def within(self, boxes: Any) -> Any:
        """How many covered squares are in each of some boxes (n by 4: left, low, right, high)."""
        import numpy as np

        left, right = (self._index(boxes[:, k], 0) for k in (0, 2))
        low, high = (self._index(boxes[:, k], 1) for k in (1, 3))
        right, high = (
            np.minimum(right + 1, self.sums.shape[0] - 1),
            np.minimum(high + 1, self.sums.shape[1] - 1),
        )
        s = self.sums
        return s[right, high] - s[left, high] - s[right, low] + s[left, low]

    def _index(self, along: Any, k: int) -> Any:
        import numpy as np

        return np.clip(((along - self.start[k]) * FINE).astype(int), 0, self.sums.shape[k] - 1)


def placed(wanted: Sequence[Wanted], lines: Lines) -> tuple[list[Box], list[tuple[Place, Place]]]:
    """A box for each, and the lines to their places of those that are far from them."""
    import numpy as np

    covered = lines.covered()
    choices = [_Choices.of(one, covered) for one in wanted]
    boxes = np.full((len(wanted), 4), np.nan)  # nothing meets what is not placed yet
    tips = np.full((len(wanted), ALONG, 2), np.nan)  # places of the lines to captions
    taken = [0] * len(wanted)
    moves = [0] * len(wanted)
    waiting = list(range(len(wanted)))
    while waiting:
        k = waiting.pop(0)
        moves[k] += 1
        fixed = np.array([move >= MOST_MOVES for move in moves])
        taken[k], away = choices[k].best(boxes, tips, fixed, k)
        boxes[k], tips[k] = choices[k].boxes[taken[k]], choices[k].tips[taken[k]]
        for other in away:
            boxes[other] = tips[other] = np.nan
            waiting.append(other)
    found = [Box(*map(float, box)) for box in boxes]
    leaders = [
        (choice.places[n], box.grown(CLEAR).nearest(choice.places[n]))
        for choice, n, box in zip(choices, taken, found, strict=True)
        if choice.far[n]
    ]
    return found, leaders


@dataclass(frozen=True, slots=True)
class _Choices:
    """Where one caption could stand, the wanted places first: its boxes, the places that these belong to,
    which need a line to theirs and where that runs, and what each costs by itself."""

    boxes: Any  # n by 4: left, low, right, high
    places: tuple[Place, ...]
    far: tuple[bool, ...]
    tips: Any  # n by ALONG by 2: places along the line to its place, not numbers where it needs none
    cost: Any  # n

    @classmethod
    def of(cls, one: Wanted, covered: Covered) -> _Choices:
        import numpy as np

        if one.upon:
            box = _about(*one.upon, one.what)
            alone = np.array([[box.left, box.low, box.right, box.high]])
            return cls(alone, (one.upon,), (False,), np.full((1, ALONG, 2), np.nan), np.zeros(1))
        boxes = np.stack([_around(one.what, *spot) for spot in one.spots], axis=1).reshape(-1, 4)
        roomy = boxes + np.array([-AIR, -AIR, AIR, AIR])
        cost = UPON * (covered.within(roomy) > 0) + np.arange(len(boxes)) / len(one.spots)
        places = tuple(place for place, _, _ in one.spots) * len(ORDER)
        far = np.array([step >= FAR for step, _ in ORDER for _ in one.spots])
        at = np.array(places)
        tips = np.where(far[:, None, None], _along(at, boxes), np.nan)
        across = covered.within(np.concatenate([tips, tips], axis=2)[far][:, 2:].reshape(-1, 4)) > 0
        cost[far] += HIDDEN * across.reshape(-1, ALONG - 2).any(axis=1)
        cost[far] += np.hypot(*(at[far] - at[0]).T)  # a line leads to the place that is wanted first
        return cls(boxes, places, tuple(map(bool, far)), tips, cost)

    def best(self, boxes: Any, tips: Any, fixed: Any, k: int) -> tuple[int, list[int]]:
        """The cheapest box among those that stand, and the captions that have to make way for it."""
        import numpy as np

        with np.errstate(invalid="ignore"):
            meets = (
                (self.boxes[:, None, 0] - BESIDE < boxes[None, :, 2])
                & (boxes[None, :, 0] < self.boxes[:, None, 2] + BESIDE)
                & (self.boxes[:, None, 1] - ABOVE < boxes[None, :, 3])
                & (boxes[None, :, 1] < self.boxes[:, None, 3] + ABOVE)
            )
        meets[:, k] = False
        weights = np.where(fixed, FIXED, MET)
        cost, seen = self.cost + meets @ weights, set[int]()
        while (best := int(np.argmin(cost))) not in seen:  # lines are looked at where they may decide
            seen.add(best)
            meets[best] |= _run(tips, self.boxes[best]) | _run(self.tips[best], boxes)
            meets[best, k] = False
            cost[best] = self.cost[best] + meets[best] @ weights
        return best, [int(j) for j in np.flatnonzero(meets[best]) if not fixed[j]]


def _along(places: Any, boxes: Any) -> Any:
    """Places along the lines from some places to the nearest ones of boxes (n by ALONG by 2)."""
    import numpy as np

    ends = np.clip(places, boxes[:, :2], boxes[:, 2:])
    return places[:, None] + np.linspace(0.0, 1.0, ALONG)[None, :, None] * (ends - places)[:, None]


def _run(tips: Any, boxes: Any) -> Any:
    """Whether lines run into a box, or a line into boxes (n by ALONG by 2, n by 4)."""
    near = boxes[..., None, :]
    inside = (tips > near[..., :2] - AIR) & (tips < near[..., 2:] + AIR)
    return inside.all(axis=-1).any(axis=-1)


def _around(what: Written, place: Place, towards: float, gap: float) -> Any:
    """The boxes that touch circles round a place, in the order in which they are wanted (n by 4)."""
    import numpy as np

    steps, swings = np.array(ORDER).T
    dx, dy = np.cos(towards + swings), np.sin(towards + swings)
    half = np.array([what.wide / 2, what.high / 2])
    with np.errstate(divide="ignore"):
        reach = np.minimum(half[0] / np.abs(dx), half[1] / np.abs(dy))
    away = gap + steps + np.minimum(reach, np.hypot(*half))
    middle = np.stack([place[0] + away * dx, place[1] + away * dy], axis=1)
    return np.concatenate([middle - half, middle + half], axis=1)


def _about(x: float, y: float, what: Written) -> Box:
    return Box(x - what.wide / 2, y - what.high / 2, x + what.wide / 2, y + what.high / 2)


def direction(towards: Place) -> float:
    """The angle of a direction on paper (rad)."""
    return atan2(towards[1], towards[0])
