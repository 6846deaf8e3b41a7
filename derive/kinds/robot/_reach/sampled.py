"""A limited workspace against configurations of the arm in numbers: all lie in it, no part of it is without
one, and it is as large as is told."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers import floats as numeric
from derive.derivation import Claim, Phrase, Said, Step
from derive.expression import ZERO, Expr, free_symbols
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import TREES
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.dexterous import Rings, holds, near_an_end, samples
from derive.kinds.robot._reach.in_numbers import FAR, SMALL, Values
from derive.kinds.robot._reach.inside import Inside
from derive.kinds.robot._reach.ranged import R_MAX, R_MIN
from derive.kinds.robot._reach.shapes import Shape
from derive.mechanics.chain import Chain
from derive.mechanics.oracle.poses import crossing

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]


TRIES, POINTS, RADII = 200, 2, 60
CELLS = {1: 40, 2: 24, 3: 9}  # of the bounding box in each direction, by its dimensions
FINE = {1: 10_000, 2: 400, 3: 50}  # the same, for its size
SPARSE = 13  # of so many places one, where directions are counted
NEAR = 4.0  # up to where an endless workspace is looked at
APART = 0.25  # the ends of a range that is drawn; typed ones are taken as they are
CLOSE = {1: 1e-3, 2: 4e-3, 3: 4e-3}  # relative: of a size by that
AN_END = 0.03  # of the reach: how near to an end of a ring nothing is looked at
TOUCHING = 0.02  # relative: how near a grid of joint values comes to an extreme
HOLLOW = {"annulus": True, "stadium-hole": True, "sector-hole": True, "outside": True, "shell": True,
          "outside-ball": True, "disc": False, "full-ball": False, "sector": False}  # fmt: skip
DIRECTIONS = {"segment": 1, "whole-line": 1, "box": 3, "endless-box": 3, "whole-space": 3}  # most have two
ENDLESS = ("endless", "whole", "outside", "strip")  # what such a one is called
MEASURES = {"area": 2, "volume": 3}
LENS = {"stadium": False, "stadium-hole": True}


@dataclass(frozen=True)
class Sampled(Inside):
    """A shape held to the places of a grid of configurations, and to places at random."""

    @cached_property
    def basis(self) -> Array:
        """Directions (k by 3) that span the workspace."""
        import numpy as np

        if self.shape.kind == "box":
            return np.array([self.lines[row][0] for row in self.shape.rows])
        if self.shape.kind == "ball" or any(self.lifts(row) for row in self.shape.rows if row != self.first):
            return np.eye(3)
        z = self.lines[self.first][0]
        one = np.cross(z, np.eye(3)[int(np.abs(z).argmin())])
        one = one / np.linalg.norm(one)
        return np.array([one, np.cross(z, one)])

    def is_inside(self) -> bool:
        return bool(self.holds(self.places, 0.0).all())

    def touches(self) -> Iterator[bool]:
        """Whether the extremes of the distance are met."""
        import numpy as np

        if self.shape.kind not in ("ring", "bent", "ball"):
            yield True
            return
        away = self.places - self.center
        if self.shape.kind != "ball":
            z = self.lines[self.first][0]
            away = away - (away @ z)[:, None] * z
        r = np.linalg.norm(away, axis=1)
        low, high = self.ends(self.shape.distance)
        size = high if math.isfinite(high) else FAR
        yield bool(r.min() <= low + TOUCHING * size)
        yield not math.isfinite(high) or bool(r.max() >= high - TOUCHING * size)

    def is_called(self) -> Iterator[bool]:
        """Whether it spreads in as many directions as what it is called does, and has a size of so many; and
        the middle of what a rail sweeps is left out just where that is said."""
        import numpy as np

        description = self.shape.description
        base = description.about.get("base")
        key = base.key if isinstance(base, Phrase) else description.key
        parts = [each for each in description.about.values() if isinstance(each, Phrase)]
        yield self._is_endless == any(each.key.startswith(ENDLESS) for each in (description, *parts))
        some = self.places[::SPARSE]
        spread = int(np.linalg.matrix_rank(some - some.mean(axis=0), SMALL * FAR))
        yield spread == DIRECTIONS.get(key, 3 if self.shape.kind == "ball" else 2) + isinstance(base, Phrase)
        yield not self.shape.measure or MEASURES[self.shape.measure] == spread
        if self.shape.kind == "ball" and self.shape.called != "shell-part":
            yield from self._is_bored()
        if self.shape.arm.key == "two-links-within":
            yield self._has_cosine(self.shape.arm.about["function"])
        if key in LENS:
            middle = (self.places.min(axis=0) + self.places.max(axis=0)) / 2
            yield bool(self.holds(middle[None], 0.0)[0]) != LENS[key]

    def _has_cosine(self, told: Said) -> bool:
        """Whether that is the cosine of the angle from the direction of one link to that of the other."""
        import numpy as np

        (z, first), (_, second) = ((z, o) for z, o in self.lines.values() if o is not None)
        one, other = (way - (way @ z) * z for way in (second - first, self.start - second))
        cosine = one @ other / (np.linalg.norm(one) * np.linalg.norm(other))
        return isinstance(told, TREES) and close(numeric.number(told, self.here), cosine)

    def _is_bored(self) -> Iterator[bool]:
        """Whether it keeps away from the first axis just where that is said, by the side that is told."""
        import numpy as np

        z, o = self.lines[self.first]
        least = float(np.linalg.norm((self.places - o) @ crossing(z), axis=1).min())
        size = float(np.abs(self.places - self.center).max())
        side = numeric.number(self.shape.side, self.at)
        yield abs(least - side) <= TOUCHING * size
        bored = self.shape.description.key in ("bored-through", "outside-cylinder")
        yield bored == self.shape.arm.key.endswith("aside") == (side > SMALL)

    def is_filled(self) -> bool:
        """Whether each cell of a coarse grid within the shape, or one beside it, holds a place."""
        import numpy as np

        seen = (self.places - self.center) @ self.basis.T
        near = (
            np.linalg.norm(self.places - self.center, axis=1) <= 2 * NEAR if self._is_endless else slice(None)
        )
        seen = seen[near]
        k = seen.shape[1]
        low, high = (getattr(seen, pick)(axis=0) for pick in ("min", "max"))
        if self._is_endless:
            low, high = np.maximum(low, -NEAR), np.minimum(high, NEAR)
        width = float((high - low).max()) / CELLS[k]
        counts = np.maximum(1, np.ceil((high - low) / width)).astype(int)
        taken = np.zeros(counts + 4, dtype=bool)
        index = np.floor((seen - low) / width).astype(int) + 2
        index = index[((index >= 0) & (index < counts + 4)).all(axis=1)]
        taken[tuple(index.T)] = True
        spread = taken.copy()
        for axis in range(k):
            spread = spread | np.roll(spread, 1, axis) | np.roll(spread, -1, axis)
        middles = np.stack(np.meshgrid(*(np.arange(n) for n in counts), indexing="ij"), -1).reshape(-1, k)
        wanted = self.holds(self._placed(low + (middles + 0.5) * width), 0.5 * width)
        return bool(spread[tuple((middles[wanted] + 2).T)].all())

    def measured(self, told: float) -> bool:
        """Whether as many places lie within the shape, of one in each cell of a fine grid."""
        import numpy as np

        seen = (self.places - self.center) @ self.basis.T
        k = seen.shape[1]
        low, high = (getattr(seen, pick)(axis=0) for pick in ("min", "max"))
        room = TOUCHING * (high - low)
        low, wide = low - room, high - low + 2 * room
        cells = np.stack(np.meshgrid(*[np.arange(FINE[k])] * k, indexing="ij"), -1).reshape(-1, k)
        somewhere = (cells + np.random.default_rng(0).random(cells.shape)) / FINE[k]
        share = float(self.holds(self._placed(low + wide * somewhere), SMALL).mean())  # no looseness
        return close(share * float(np.prod(wide)) / told, 1.0, CLOSE[k])

    def _placed(self, seen: Array) -> Array:
        import numpy as np

        rest = self.start - self.center
        rest = rest - (rest @ self.basis.T) @ self.basis
        return np.array(self.center + rest + seen @ self.basis)

    @property
    def _is_endless(self) -> bool:
        return any(high >= FAR for _, high in self.limits.values())


def claims(
    problem: Problem, found: Chain, point: Tracked, shape: Shape, steps: Sequence[Step],
    told: Mapping[str, Expr], rings: Rings | None,
) -> Iterator[Claim]:  # fmt: skip
    """About the region, its size and where every orientation is possible, at lengths and limits drawn at
    random where they are letters."""
    oracle = oracle_of(problem)
    drawn = [dict(oracle.at(at)) for at in random_points(problem.symbols, TRIES)]
    points = [at for at in drawn if _in_order(problem, at)][:POINTS]
    tried = [Sampled(problem, found, point, shape, at) for at in points]
    yield route("inside", (each.is_inside() for each in tried))
    yield route("touching", (held for each in tried for held in each.touches()))
    yield route("filled", (each.is_filled() for each in tried))
    yield route("lines", (held for at in points for held in _lines(steps, at, told)))
    yield route("called", (held for at in points for held in _called(shape, at)))
    yield route("called", (held for each in tried for held in each.is_called()))
    if rings:
        yield route("orientations", (held for at in points for held in _turned_about(shape, rings, at)))
    if shape.measure:
        size = told[shape.measure]
        yield route("measured", (each.measured(numeric.number(size, each.at)) for each in tried))


def _in_order(problem: Problem, at: Values) -> bool:
    """Whether every range ends after it begins, one in letters well after."""
    return all(
        numeric.number(high - low, at) > (APART if free_symbols(high - low) else 0)
        for low, high in problem.subject.ranges.values()
    )


def _lines(steps: Sequence[Step], at: Values, told: Mapping[str, Expr]) -> Iterator[bool]:
    names = {each: numeric.number(told[each], at) for each in (R_MIN.name, R_MAX.name) if each in told}
    yield True
    for step in steps:
        first, *others = (numeric.number(each, {**at, **names}) for each in step.chain[1:])
        yield from (close(first, other, SMALL) for other in others)
        if step.name in told:
            yield close(first, numeric.number(told[step.name], at), SMALL)


def _turned_round(shape: Shape, at: Values) -> Iterator[bool]:
    """The borders of the ring that the last link may start from, by those of all that is reached: they lie by
    its length within them; a hole that it fills says nothing of them."""
    link, low, high = (
        numeric.number(each, at)
        for each in (shape.link, shape.distance.low or ZERO, shape.distance.high or ZERO)
    )
    yield close(numeric.number(shape.far_start, at), high - 2 * link)
    if low > SMALL:
        yield close(numeric.number(shape.gap or ZERO, at), low + link)


def _turned_about(shape: Shape, rings: Rings, at: Values) -> Iterator[bool]:
    """Whether a distance lies in the rings just where the last link, which ever way it points, starts in the
    ring that the others reach."""
    if rings.pieces is None:
        yield True
        return
    pieces = [(numeric.number(low, at), numeric.number(high, at)) for low, high in rings.pieces]
    link, gap, high = (
        numeric.number(each, at) for each in (shape.link, shape.gap or ZERO, shape.distance.high or ZERO)
    )
    for r in samples(high, RADII):
        if not near_an_end(pieces, r, AN_END * high):
            yield holds(pieces, r) == (r + 2 * link <= high and abs(r - link) >= gap)


# Whether the arm is folded, and whether it is stretched, where its elbow changes the side.
PASSED = {
    "borders-stretched": (False, True), "borders-folded": (True, False), "borders-both": (True, True),
}  # fmt: skip


def _called(shape: Shape, at: Values) -> Iterator[bool]:
    """Whether there is a hole just where that is said, and the elbow changes its side where it is said to."""
    yield True
    if shape.gap is not None and shape.distance.high is not None:
        yield from _turned_round(shape, at)
    if shape.borders is not None and shape.borders.key in PASSED:
        lengths, span = shape.arm.about["lengths"], shape.distance
        assert isinstance(lengths, tuple)
        one, other = (numeric.number(each, at) for each in lengths if isinstance(each, TREES))
        low, high = (numeric.number(end, at) for end in (span.low or ZERO, span.high or ZERO))
        yield (close(low, abs(one - other)), close(high, one + other)) == PASSED[shape.borders.key]
    if shape.borders is not None and isinstance(last := shape.borders.about.get("last"), TREES):
        yield close(numeric.number(last, at), numeric.number(shape.link, at))
    if shape.called in HOLLOW and shape.distance.low is not None:
        yield (numeric.number(shape.distance.low, at) > SMALL) == HOLLOW[shape.called]
