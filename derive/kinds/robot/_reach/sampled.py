"""A limited workspace against configurations of the arm in numbers: all lie in it, no part of it is without
one, and it is as large as is told."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers import floats as numeric
from derive.derivation import Claim, Step
from derive.expression import Expr, free_symbols
from derive.kinds.checks import close, random_points, route
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.ranged import R_MAX, R_MIN
from derive.kinds.robot._reach.shapes import Shape
from derive.kinds.robot._reach.spans import Span
from derive.kinds.robot._seen import axis_seen, motion
from derive.mechanics.chain import Chain

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

Values = dict[str, float]
Limits = tuple[float, float]
TRIES, POINTS = 200, 2
EACH = {1: 2001, 2: 301, 3: 61, 4: 21, 5: 11, 6: 7, 7: 5}  # values of a joint, by their number
CELLS = {1: 40, 2: 24, 3: 9}  # of the bounding box in each direction, by its dimensions
THROWN = 200_000  # places at random in the bounding box
FAR = 12.0  # where a slide has no end
NEAR = 4.0  # up to where an endless workspace is looked at
SMALL = 1e-6
CURVE, LOOSE = 20_001, 2e-3  # values of the second joint; radians, where a place is read off between two
APART = 0.25  # the ends of a range that is drawn; typed ones are taken as they are
CLOSE = 0.03  # relative: of a size by that
TOUCHING = 0.02  # relative: how near a grid of joint values comes to an extreme
HOLLOW = {"annulus": True, "stadium-hole": True, "sector-hole": True, "outside": True, "shell": True,
          "outside-ball": True, "disc": False, "full-ball": False, "sector": False}  # fmt: skip


@dataclass(frozen=True)
class Sampled:
    """A shape, and the arm `at` one set of lengths and limits."""

    problem: Problem
    found: Chain
    point: Tracked
    shape: Shape
    at: Values

    # -- the arm ----------------------------------------------------------------------------------

    @cached_property
    def limits(self) -> dict[int, Limits]:
        """Of each row that moves the point; what slides without end goes far."""
        found = {}
        for row in self.shape.rows:
            joint = self.found.joint(row)
            ends = self.problem.subject.ranges.get(joint.variable)
            usual = (-math.pi, math.pi) if joint.type == "revolute" else (-FAR, FAR)
            found[row] = (self._number(ends[0]), self._number(ends[1])) if ends else usual
        return found

    @cached_property
    def here(self) -> Values:
        """A configuration within the limits."""
        own = {
            self.found.joint(row).variable: low + 0.55 * (high - low)
            for row, (low, high) in self.limits.items()
        }
        return {**self.at, **own}

    def _number(self, tree: Expr) -> float:
        return numeric.number(tree, self.at)

    @cached_property
    def lines(self) -> dict[int, tuple[Array, Array | None]]:
        """Of each row its direction, and a point on the axis of one that turns."""
        found: dict[int, tuple[Array, Array | None]] = {}
        for row in self.shape.rows:
            if self.found.joint(row).type == "revolute":
                found[row] = axis_seen(self.problem, self.found, row, self.here)
            else:
                way = motion(self.problem, self.found, row, self.here)[:3, 3]
                found[row] = way / float((way @ way) ** 0.5), None
        return found

    @cached_property
    def start(self) -> Array:
        """The point (3) in that configuration."""
        import numpy as np

        oracle, point = oracle_of(self.problem), self.point
        last = point.frame > len(self.problem.subject.links)
        T = oracle.tool(self.here) if last else oracle.poses(self.here)[point.frame]
        offset = [self._number(x) for x in point.offset]
        return np.array(T[:3, :3] @ offset + T[:3, 3])

    @cached_property
    def places(self) -> Array:
        """Where the point is (N by 3) on a grid of the joint variables."""
        import numpy as np

        count = EACH[len(self.shape.rows)]
        axes = [np.linspace(*self.limits[row], count) for row in self.shape.rows]
        values = [each.ravel() for each in np.meshgrid(*axes, indexing="ij")]
        return self.moved(dict(zip(self.shape.rows, values, strict=True)))

    def moved(self, values: Mapping[int, Array]) -> Array:
        """Where the point is (N by 3) with the joints of these rows at N values each, the others as they
        are."""
        import numpy as np

        places = np.tile(self.start, (next(iter(values.values())).size, 1))
        for row, value in reversed([*values.items()]):
            moved = value - self.here[self.found.joint(row).variable]
            direction, through = self.lines[row]
            if through is None:
                places = places + moved[:, None] * direction
            else:
                places = through + _turned(places - through, direction, moved)
        return places

    # -- the shape --------------------------------------------------------------------------------

    def holds(self, places: Array, margin: float) -> Array:
        """Which places (N by 3) lie within the shape as told, by at least a margin."""
        import numpy as np

        shape, inside = self.shape, np.ones(len(places), dtype=bool)
        if shape.kind == "box":
            for row, span in zip(shape.rows, shape.sides, strict=True):
                inside &= self._between(self._along(row, places), span, margin)
            return inside
        if shape.kind == "ball":
            return self._in_ball(places, margin)
        z = self.lines[self.first][0]
        lift = next((row for row in shape.rows if row != self.first and self._lifts(row)), None)
        if lift and shape.lift:
            inside &= self._between(self._along(lift, places), shape.lift, margin)
        else:
            inside &= np.abs((places - self.start) @ z) < SMALL
        away = places - self.center
        away = away - (away @ z)[:, None] * z
        if shape.kind == "bent":
            return inside & self._in_reach_of_bends(away, z, margin)
        if shape.rail is None:
            inside &= self._between(np.linalg.norm(away, axis=1), shape.distance, margin)
            return inside & self._turned_so(away, z, margin)
        u, own = self.lines[shape.rows[self.rail]][0], self.variable(shape.rows[self.rail])
        low, high = self._ends(shape.rail)
        x = away @ u + self.here[own]
        y2 = np.sum(away**2, axis=1) - (away @ u) ** 2
        nearest = np.hypot(np.maximum(0.0, np.maximum(low - x, x - high)), np.sqrt(np.maximum(y2, 0.0)))
        furthest = np.hypot(np.maximum(np.abs(x - low), np.abs(x - high)), np.sqrt(np.maximum(y2, 0.0)))
        r_min, r_max = self._ends(shape.distance)
        slack = margin or -SMALL
        swept: Array = inside & (nearest <= r_max - slack) & (furthest >= r_min + slack)
        return swept

    def _in_reach_of_bends(self, away: Array, z: Array, margin: float) -> Array:
        """Which of these (N by 3), square to the first axis, two links reach by one of their bends, the
        second joint moved through its range and the first one then to where the place is."""
        import numpy as np

        first, second = (row for row in self.shape.rows if self.found.joint(row).type == "revolute")
        start, side = self.planar(self.start - self.center, z)
        (low, high), own = self.limits[first], self.here[self.variable(first)]
        q = np.linspace(*self.limits[second], CURVE)
        places = self.moved({second: q}) - self.center
        r = np.linalg.norm(places - (places @ z)[:, None] * z, axis=1)
        angles = np.arctan2(places @ side, places @ start)
        rho, phi = np.linalg.norm(away, axis=1), np.arctan2(away @ side, away @ start)
        slack = margin / np.maximum(rho, margin + SMALL) if margin > 0 else -np.full(len(rho), LOOSE)
        found = np.zeros(len(away), dtype=bool)
        for a, b in pairwise(_turns(r)):
            branch = slice(a, b + 1) if r[b] > r[a] else slice(b, a - 1 if a else None, -1)
            bent = np.interp(rho, r[branch], np.unwrap(angles[branch]))
            off = own + phi - bent - (low + high) / 2
            off = np.abs(off - math.tau * np.round(off / math.tau))
            within = (rho >= r[branch][0] + (margin or -SMALL)) & (rho <= r[branch][-1] - (margin or -SMALL))
            found |= within & (off <= (high - low) / 2 - slack)
        return found

    def bends(self, second: int) -> Iterator[Limits]:
        """The parts of a range in which the distance from the first axis only grows or only shrinks."""
        import numpy as np

        q = np.linspace(*self.limits[second], CURVE)
        z = self.lines[self.first][0]
        places = self.moved({second: q}) - self.center
        r = np.linalg.norm(places - (places @ z)[:, None] * z, axis=1)
        for a, b in pairwise(_turns(r)):
            yield float(q[a]), float(q[b])

    @staticmethod
    def planar(start: Array, z: Array) -> tuple[Array, Array]:
        """The direction of a place, seen along an axis, and what is to the left of it."""
        import numpy as np

        flat = start - (start @ z) * z
        flat = flat / np.linalg.norm(flat)
        return flat, np.cross(z, flat)

    def _in_ball(self, places: Array, margin: float) -> Array:
        import numpy as np

        shape = self.shape
        away = places - self.center
        z = self.lines[self.first][0]
        r, height = np.linalg.norm(away, axis=1), away @ z
        flat = away - height[:, None] * z
        inside = self._between(r, shape.distance, margin)
        inside &= np.linalg.norm(flat, axis=1) >= self._number(shape.side) + (margin or -SMALL)
        if shape.rise:
            low, high = (self._number(each) for each in shape.rise[1:])
            rise = height / np.maximum(r, SMALL)
            angle = np.arcsin(np.clip(rise, -1, 1))
            slack = margin / np.maximum(r, margin + SMALL) if margin > 0 else SMALL * 10
            least, most = math.asin(max(-1.0, low)), math.asin(min(1.0, high))
            sign = 1 if margin > 0 else -1
            poles = (least + math.pi / 2 < SMALL, math.pi / 2 - most < SMALL)
            inside &= poles[0] | (angle >= least + sign * slack)
            inside &= poles[1] | (angle <= most - sign * slack)
        held: Array = inside & self._turned_so(flat, z, margin)
        return held

    def _turned_so(self, away: Array, z: Array, margin: float) -> Array:
        """Which of these (N by 3), square to the first axis, are between the ends of its joint."""
        import numpy as np

        if self.shape.turn is None:
            return np.ones(len(away), dtype=bool)
        start = self.start - self.center
        start = start - (start @ z) * z
        side = np.cross(z, start)
        own = self.here[self.variable(self.first)]
        low, high = (self._number(each) for each in self.shape.turn)
        length = np.linalg.norm(away, axis=1)
        slack = (
            margin / np.maximum(length, margin + SMALL) if margin > 0 else -SMALL / np.maximum(length, SMALL)
        )
        angle = own + np.arctan2(away @ side, away @ start)
        off = angle - (low + high) / 2
        off = np.abs(off - math.tau * np.round(off / math.tau))
        inside: Array = off <= (high - low) / 2 - slack
        return inside

    def _between(self, values: Array, span: Span, margin: float) -> Array:
        low, high = self._ends(span)
        slack = margin or -SMALL * max(1.0, low if math.isfinite(low) else 1.0)
        if high - low < SMALL:  # a surface
            slack = -SMALL * 10
        inside: Array = (values >= low + slack if low > SMALL or low < 0 else values >= low - SMALL) & (
            values <= high - slack
        )
        return inside

    def _ends(self, span: Span) -> Limits:
        low = -math.inf if span.low is None else self._number(span.low)
        return low, math.inf if span.high is None else self._number(span.high)

    def _along(self, row: int, places: Array) -> Array:
        """The value of a joint that slides, by how far a place is along its way."""
        found: Array = (places - self.start) @ self.lines[row][0] + self.here[self.variable(row)]
        return found

    def variable(self, row: int) -> str:
        return self.found.joint(row).variable

    @property
    def first(self) -> int:
        return next(row for row in self.shape.rows if self.found.joint(row).type == "revolute")

    def _lifts(self, row: int) -> bool:
        import numpy as np

        along = np.cross(self.lines[row][0], self.lines[self.first][0])
        return self.lines[row][1] is None and float(np.linalg.norm(along)) < SMALL

    @property
    def rail(self) -> int:
        return next(k for k, row in enumerate(self.shape.rows) if row < self.first and not self._lifts(row))

    @cached_property
    def center(self) -> Array:
        """From where distances count, in the configuration that is looked at."""
        import numpy as np

        if self.shape.center is not None:
            return np.array(numeric.matrix_numbers(self.shape.center, self.here)).ravel()
        if self.shape.kind == "box":
            return self.start
        through = self.lines[self.first][1]
        assert through is not None
        return through

    # -- what is held -----------------------------------------------------------------------------

    @cached_property
    def basis(self) -> Array:
        """Directions (k by 3) that span the workspace."""
        import numpy as np

        if self.shape.kind == "box":
            return np.array([self.lines[row][0] for row in self.shape.rows])
        if self.shape.kind == "ball" or any(self._lifts(row) for row in self.shape.rows if row != self.first):
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
        low, high = self._ends(self.shape.distance)
        size = high if math.isfinite(high) else FAR
        yield bool(r.min() <= low + TOUCHING * size)
        yield not math.isfinite(high) or bool(r.max() >= high - TOUCHING * size)

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
        """Whether as many of the places thrown at random lie within the shape."""
        import numpy as np

        seen = (self.places - self.center) @ self.basis.T
        k = seen.shape[1]
        low, high = (getattr(seen, pick)(axis=0) for pick in ("min", "max"))
        thrown = low + (high - low) * np.random.default_rng(0).random((THROWN, k))
        share = float(self.holds(self._placed(thrown), 0.0).mean())
        return close(share * float(np.prod(high - low)) / told, 1.0, CLOSE)

    def _placed(self, seen: Array) -> Array:
        import numpy as np

        rest = self.start - self.center
        rest = rest - (rest @ self.basis.T) @ self.basis
        return np.array(self.center + rest + seen @ self.basis)

    @property
    def _is_endless(self) -> bool:
        return any(high >= FAR for _, high in self.limits.values())


def _turns(values: Array) -> list[int]:
    """Where these begin, turn round, and end."""
    import numpy as np

    return [0, *(int(k) + 1 for k in np.flatnonzero(np.diff(np.sign(np.diff(values))))), len(values) - 1]


def _turned(away: Array, z: Array, by: Array) -> Array:
    """Each row of `away` turned about z by its angle (Rodrigues)."""
    import numpy as np

    c, s = np.cos(by)[:, None], np.sin(by)[:, None]
    return np.array(away * c + np.cross(z, away) * s + (away @ z)[:, None] * (1 - c) * z)


def claims(
    problem: Problem, found: Chain, point: Tracked, shape: Shape, steps: Sequence[Step],
    told: Mapping[str, Expr],
) -> Iterator[Claim]:  # fmt: skip
    """About the region and its size, at lengths and limits drawn at random where they are letters."""
    oracle = oracle_of(problem)
    drawn = [dict(oracle.at(at)) for at in random_points(problem.symbols, TRIES)]
    points = [at for at in drawn if _in_order(problem, at)][:POINTS]
    tried = [Sampled(problem, found, point, shape, at) for at in points]
    yield route("inside", (each.is_inside() for each in tried))
    yield route("touching", (held for each in tried for held in each.touches()))
    yield route("filled", (each.is_filled() for each in tried))
    yield route("lines", (held for at in points for held in _lines(steps, at, told)))
    yield route("called", (held for at in points for held in _called(shape, at)))
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


def _called(shape: Shape, at: Values) -> Iterator[bool]:
    """Whether there is a hole just where that is said."""
    yield True
    if shape.called in HOLLOW and shape.distance.low is not None:
        yield (numeric.number(shape.distance.low, at) > SMALL) == HOLLOW[shape.called]
