"""A workspace checked by a search over the joints, with poses in NumPy, and its links by the axes as seen."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise, product
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers import floats as numeric
from derive.derivation import Claim, Phrase, Step
from derive.expression import Expr, free_symbols
from derive.kinds.checks import close, random_points, route
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.regions import Region, Secondary
from derive.kinds.robot._reach.told import equal_lengths
from derive.kinds.robot._seen import apart, axis_seen
from derive.mechanics.chain import Chain, Joint
from derive.mechanics.reach import moving_joints

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

SMALL = 1e-6
NEAR, TOUCHING = 1e-4, 1e-2  # a search creeps where links of 2, 2 and 4 are folded to nothing
CALLED = {  # what lies between the distances, whether axes are parallel, whether the point slides along them
    "circle": ("surface", True, False), "side-of-a-cylinder": ("surface", True, True),
    "disc": ("solid", True, False), "annulus": ("hollow", True, False),
    "cylinder": ("solid", True, True), "hollow-cylinder": ("hollow", True, True),
    "ball": ("solid", False, False), "hollow-ball": ("hollow", False, False),
    "swung-annulus": ("", False, False),
}  # fmt: skip
SWEEPS = 100  # of a search joint by joint
POINTS, STARTS = 3, 3
FEW = 3  # joints of which many values are tried at once
Values = dict[str, float]


@dataclass(frozen=True)
class Reached:
    """What a point of an arm reaches, against its region and the distances that are told: the largest (1)
    and the smallest (-1)."""

    problem: Problem
    found: Chain
    point: Tracked
    region: Region
    bounds: Mapping[int, Expr]

    def claims(self, steps: Sequence[Step], closed: bool, secondary: Secondary | None) -> Iterator[Claim]:
        """About the distances, every line that leads to them, the lengths, and whether there is a hole."""
        points = list(self._points)
        yield route("largest-distance", (self._reaches(1, at) for at in points))
        several = self.region.kind != "planar" and len(self.region.lengths) > 2
        far_apart = [*self._general][1:2] if several else []
        yield route("smallest-distance", (self._reaches(-1, at) for at in (*points, *far_apart)))
        yield route("lines", (_same(step.chain[1:], at) for step in steps for at in points))
        yield route("link-lengths", (each for at in points for each in self._lengths(at)))
        holes = [numeric.number(self.bounds[-1], at) > SMALL for at in self._general]
        yield route("hole", (not each for each in holes) if closed else max(holes))
        if lengths := equal_lengths(self.region):
            equal = [{**at, lengths[1].name: at[lengths[0].name]} for at in points]
            none = (
                abs(numeric.number(self.bounds[-1], at)) < SMALL and self._reaches(-1, at) for at in equal
            )
            yield route("no-hole", none)
        if secondary:
            yield route("secondary", (each for at in points for each in self._secondary(secondary, at)))

    def is_called(self, description: Phrase, arm: Phrase | None) -> Claim:
        """Whether the region is what it is called: by the distances, the axes, and what slides; and whether
        the joints that swing links in a plane are those that the arm is said to have."""
        ball = description.about.get("ball")
        key = ball.key if isinstance(ball, Phrase) else description.key
        return route("called", (*self._is_called(key, isinstance(ball, Phrase)), *self._swings(arm)))

    def _swings(self, arm: Phrase | None) -> Iterator[bool]:
        if arm and "pair" in arm.about:
            yield arm.about["pair"] == (*self._turning[1:],)
            for at in self._points:
                first, *others = [axis_seen(self.problem, self.found, i, at)[0] for i in self._turning[1:]]
                yield all(apart(first, z) < SMALL for z in others)

    def _is_called(self, key: str, bored: bool) -> Iterator[bool]:
        shape, parallel, slides = CALLED[key]
        bounds = [[numeric.number(self.bounds[sign], at) for sign in (-1, 1)] for at in self._general]
        one = all(close(low, high, SMALL) for low, high in bounds)
        hole = any(low > SMALL for low, _ in bounds)
        yield shape in ("", "surface" if one else "hollow" if hole else "solid")
        for at in self._points:
            axes = [axis_seen(self.problem, self.found, i, at)[0] for i in self._turning]
            yield parallel == all(apart(axes[0], z) < SMALL for z in axes)
            yield slides == any(self._is_moved(joint.variable, at) for joint in self._sliding)
            yield bored == (numeric.number(self.region.side, at) > SMALL and shape != "")
            yield (shape == "") == (numeric.number(self.region.offset, at) > SMALL)

    @property
    def _sliding(self) -> list[Joint]:
        return [joint for _, joint in self.found.moving if joint.type == "prismatic"]

    def _is_moved(self, name: str, at: Values) -> bool:
        """Whether a joint moves the point."""
        return not close(self._place(at), self._place({**at, name: at[name] + 1.0}), SMALL)

    @property
    def _points(self) -> Iterator[Values]:
        oracle = oracle_of(self.problem)
        return (dict(oracle.at(at)) for at in random_points(self.problem.symbols, POINTS))

    @property
    def _general(self) -> Iterator[Values]:
        """Lengths at random, and such that one is by far the longest: then there is a hole if ever."""
        names = sorted(set().union(*map(free_symbols, self.region.lengths)))
        for at in self._points:
            yield at
            yield from ({**at, name: 40.0 * at[name]} for name in names if name in at)

    @cached_property
    def _turning(self) -> list[int]:
        rows = moving_joints(self.found, self.point.position, self.point.last)
        return [i for i in rows if self.found.joint(i).type == "revolute"]

    def _reaches(self, sign: int, at: Values) -> bool:
        """Whether a search comes near to the distance, and never further."""
        torus = self.region.kind == "torus"
        turning = self._turning[1:] if torus and sign < 0 else self._turning
        names = [self.found.joint(i).variable for i in turning]
        bound, size = (numeric.number(tree, at) for tree in (self.bounds[sign], self.region.largest[-1]))

        counted = self._counted(turning[0], at)

        def distance(here: Values) -> float:
            return counted(self._place(here))

        by = _scan if torus and sign > 0 else search
        starts = [{**at, **{name: at[name] + 1.3 * k for name in names}} for k in range(STARTS)]
        best = max((by(distance, start, names, sign) for start in starts), key=lambda each: sign * each)
        beyond = sign * (best - bound)
        near = TOUCHING if bound < TOUCHING * size else NEAR
        return -near * size < beyond < SMALL * size

    def _place(self, here: Values) -> Array:
        """The point (3)."""
        import numpy as np

        oracle, point = oracle_of(self.problem), self.point
        last = point.frame > len(self.problem.subject.links)
        T = oracle.tool(here) if last else oracle.poses(here)[point.frame]
        return np.array(T[:3, :3] @ [numeric.number(x, here) for x in point.offset] + T[:3, 3])

    def _counted(self, i: int, at: Values) -> Callable[[Array], float]:
        """Which distance of a place counts: from an axis, that of joint i, in a plane and where it is swung;
        else from the center."""
        import numpy as np

        if self.region.kind in ("planar", "torus"):
            z, o = axis_seen(self.problem, self.found, i, at)
            return lambda place: apart(z, place - o)
        center = np.array(numeric.matrix_numbers(self.region.center, at)).ravel()
        return lambda place: float(np.linalg.norm(place - center))

    def _lengths(self, at: Values) -> Iterator[bool]:
        """Whether each length is that between two axes, the last one that to the point, seen along them."""
        links = self._turning if self.region.kind == "planar" else self._turning[1:]
        axes = [axis_seen(self.problem, self.found, i, at) for i in links]
        points = [*(o for _, o in axes), self._place(at)]
        z = axes[0][0]
        found = [length for here, there in pairwise(points) if (length := apart(z, there - here)) > SMALL]
        told = [numeric.number(length, at) for length in self.region.lengths]
        yield close(told, found, SMALL)
        if self.region.kind != "planar":
            w, o = axis_seen(self.problem, self.found, self._turning[0], at)
            across = abs((points[0] - o) @ _unit(w, z)), abs((points[-1] - o) @ z)
            told = [numeric.number(tree, at) for tree in (self.region.offset, self.region.side)]
            yield close(told, across, SMALL)

    def _secondary(self, told: Secondary, at: Values) -> Iterator[bool]:
        """Whether the other links reach as far, and leave open as much, as is told."""
        *others, last = (numeric.number(length, at) for length in self.region.lengths)
        yield close(numeric.number(told.far, at), sum(others) - last, SMALL)
        yield close(numeric.number(told.gap, at), max(0.0, 2 * max(others) - sum(others)), SMALL)
        yield close(numeric.number(told.inside, {**at, "r": 5.0}), abs(5.0 - last), SMALL)


def _unit(w: Array, z: Array) -> Array:
    """Square to both directions."""
    import numpy as np

    across = np.cross(w, z)
    return np.array(across / np.linalg.norm(across))


def _same(chain: Sequence[Expr], at: Values) -> bool:
    first, *others = (numeric.number(each, at) for each in chain)
    return all(close(each, first, SMALL) for each in others)


def search(distance: Callable[[Values], float], at: Values, names: list[str], sign: int) -> float:
    """The square of the distance is a + b cos q + c sin q in each joint: its extreme in closed form."""
    here = dict(at)
    for _ in range(SWEEPS):
        before = dict(here)
        for name in names:
            zero, half, quarter = (distance({**here, name: q}) ** 2 for q in (0.0, math.pi, math.pi / 2))
            a, b = (zero + half) / 2, (zero - half) / 2
            c = quarter - a
            if math.hypot(b, c) > 1e-12:
                here[name] = math.atan2(sign * c, sign * b)
        if all(abs(here[name] - before[name]) < 1e-10 for name in names):
            break
    return distance(here)


def _scan(distance: Callable[[Values], float], at: Values, names: list[str], sign: int) -> float:
    """The extreme by ever finer steps around the best so far; the first joint swings everything about the
    axis and is left where it is."""
    wide = 4 if len(names) <= FEW else 2
    here, step = dict(at), math.pi / wide
    while step > 1e-5:
        tried = product(range(-wide, wide + 1), repeat=len(names) - 1)
        places = [{**here, **_moved(here, names[1:], [k * step for k in ks])} for ks in tried]
        here = max(places, key=lambda each: sign * distance(each))
        step /= 3
    return distance(here)


def _moved(here: Values, names: list[str], by: list[float]) -> Values:
    return {name: here[name] + step for name, step in zip(names, by, strict=True)}
