"""An arm in section against the arm in numbers, whose axes are seen by moving its joints."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import Point, number
from derive.derivation import Said, Table
from derive.expression import Expr, Symbol
from derive.kinds.checks import close, random_points
from derive.kinds.fields import TREES
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.facts import Facts
from derive.kinds.robot._reach.in_numbers import InNumbers
from derive.kinds.robot._reach.swept import Sample
from derive.kinds.robot._seen import axis_seen
from derive.mechanics.chain import Chain

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

GRID, FEWER = 241, 61  # values of each of two joints, and of each of more
BEYOND, NEAR, TO_AXIS = 1e-7, 1e-3, 1e-2  # of the size: how far a grid may pass an extreme, or miss it
TOLERANCE, APART, STEPS = 1e-8, 1e-4, 30
COARSE = 48
COARSER = 5  # of grids with fewer values
PLACES = 3  # of which two have one number, where there are two
POINTS, TURN, SMALL = 2, 0.7, 1e-6


@dataclass(frozen=True)
class SectionSeen:
    """An arm in numbers, its first row and the others that move its point."""

    arm: InNumbers

    @property
    def others(self) -> tuple[int, ...]:
        return tuple(row for row in self.arm.shape.rows if row != self.arm.shape.rows[0])

    @cached_property
    def values(self) -> tuple[Array, ...]:
        """A grid of values of the other joints."""
        import numpy as np

        count = {1: GRID**2, 2: GRID}.get(len(self.others), FEWER)
        axes = [np.linspace(*self.arm.limits[row], count) for row in self.others]
        return tuple(np.meshgrid(*axes, indexing="ij"))

    @cached_property
    def reached(self) -> tuple[Array, Array]:
        """(rho, z) on that grid."""
        return self.seen(*self.values)

    def seen(self, *values: Array) -> tuple[Array, Array]:
        """(rho, z) at values of the other joints."""
        import numpy as np

        flat = dict(zip(self.others, (each.ravel() for each in values), strict=True))
        places = self.arm.moved(flat)
        z, o = self.arm.lines[self.arm.shape.rows[0]]
        assert o is not None
        height, away = places @ z, places - o
        away = away - (away @ z)[:, None] * z
        shape = values[0].shape
        return np.linalg.norm(away, axis=1).reshape(shape), height.reshape(shape)

    def extremes(self, told: Mapping[str, float]) -> Iterator[bool]:
        """Whether r_min, r_max, z_min and z_max are come near to, and not passed."""
        size = max(told["r_max"], told["z_max"] - told["z_min"])
        yield from self._ends(told, size, (0, "r_min", "r_max"), (1, "z_min", "z_max"))

    def distances(self, told: Mapping[str, float]) -> Iterator[bool]:
        """The same of r_min and r_max alone."""
        return self._ends(told, told["r_max"], (0, "r_min", "r_max"))

    def _ends(self, told: Mapping[str, float], size: float, *ends: tuple[int, str, str]) -> Iterator[bool]:
        coarse = 1 if len(self.others) < 3 else COARSER
        for k, low, high in ends:
            values = self.reached[k]
            least, most = float(values.min()), float(values.max())
            # where a sheet meets the axis, or nearly, distances grow at once
            near = TO_AXIS if told[low] < TO_AXIS * size and low == "r_min" else NEAR
            yield told[low] - BEYOND * size <= least <= told[low] + coarse * near * size
            yield told[high] - coarse * NEAR * size <= most <= told[high] + BEYOND * size

    def on_sphere(self, center: Array, radius: float, ends: tuple[float, float]) -> Iterator[bool]:
        """Whether the point stays at a distance from a center, and between heights above it along the first
        axis, which are met."""
        import numpy as np

        (w, o), (rho, z) = self.arm.lines[self.arm.shape.rows[0]], self.reached
        assert o is not None
        middle = float(center @ w)
        yield float(np.linalg.norm(np.cross(center - o, w))) < BEYOND * radius
        yield float(np.abs(np.hypot(rho, z - middle) - radius).max()) < BEYOND * radius
        for told, met in zip(ends, (float(z.min()) - middle, float(z.max()) - middle), strict=True):
            yield abs(told - met) < NEAR * radius

    def counts(self, samples: Sequence[Sample]) -> Iterator[bool]:
        """Whether so many values of the joints lead to each place."""
        for each in samples:
            yield len(self._found(each)) == each.count

    def are_all(self, samples: Sequence[Sample]) -> bool:
        """Whether the table has the number of every place of some values at random that is not alone with
        it."""
        import numpy as np

        draw = random.Random("places")
        limits = [self.arm.limits[row] for row in self.others]
        counts = []
        for _ in range(PLACES):
            (rho,), (z,) = self.seen(*(np.array([draw.uniform(*each)]) for each in limits))
            counts.append(len(self._found(Sample(float(rho), float(z), 0))))
        told = {each.count for each in samples}
        return all(each in told for each in counts if counts.count(each) > 1)

    def _found(self, sample: Sample) -> list[Array]:
        """By Newton's method from everywhere on a coarse grid; values that differ by whole turns are one."""
        import numpy as np

        axes = [np.linspace(*self.arm.limits[row], COARSE) for row in self.others]
        starts = [each.ravel() for each in np.meshgrid(*axes, indexing="ij")]
        q = np.array(starts)
        for _ in range(STEPS):
            off, J = self._off(q, sample)
            det = J[0, 0] * J[1, 1] - J[0, 1] * J[1, 0]
            det = np.where(np.abs(det) < 1e-12, np.inf, det)
            step = np.array([J[1, 1] * off[0] - J[0, 1] * off[1], J[0, 0] * off[1] - J[1, 0] * off[0]]) / det
            length = np.maximum(1.0, np.abs(step).max(axis=0) / 0.3)
            q = q - step / length
        off, _ = self._off(q, sample)
        met = q[:, np.abs(off).max(axis=0) < TOLERANCE * max(1.0, sample.rho)].T
        found: list[Array] = []
        for each in met:
            own = np.array([self._home(x, row) for x, row in zip(each, self.others, strict=True)])
            if np.isnan(own).any():
                continue
            gaps = (self._gap(own, other) for other in found)
            if all(gap > APART for gap in gaps):
                found.append(own)
        return found

    def _off(self, q: Array, sample: Sample) -> tuple[Array, Array]:
        """What is missing (2 by N), and its derivatives by differences (2 by 2 by N)."""
        import numpy as np

        h = 1e-6
        here = np.array(self.seen(*q))
        rates = []
        for k in range(2):
            ahead, back = q.copy(), q.copy()
            ahead[k] += h
            back[k] -= h
            rates.append((np.array(self.seen(*ahead)) - np.array(self.seen(*back))) / (2 * h))
        wanted = np.array([[sample.rho], [sample.z]])
        return here - wanted, np.stack(rates, axis=1)

    def _home(self, value: float, row: int) -> float:
        """Within the limits, by whole turns; nan where it is not."""
        low, high = self.arm.limits[row]
        if self.arm.found.joint(row).type == "revolute":
            value -= math.tau * math.floor((value - low) / math.tau)
        return value if low <= value <= high else math.nan

    def _gap(self, one: Array, other: Array) -> float:
        gaps = []
        for a, b, row in zip(one, other, self.others, strict=True):
            turns = self.arm.found.joint(row).type == "revolute"
            gaps.append(abs(math.remainder(a - b, math.tau)) if turns else abs(a - b))
        return max(gaps)

    def is_closed_in(self, sample: Sample) -> bool:
        """Whether no way leads from a place that is not reached out of what is."""
        size, low, _ = self.cells
        return not self.outside[math.floor(sample.rho / size), math.floor((sample.z - low) / size) + 2]

    def has_void(self) -> bool:
        """Whether five cells across each other are neither reached nor open to the outside."""
        *_, taken = self.cells
        closed = ~taken & ~self.outside
        across = closed[:-2, :-2] & closed[1:-1, 1:-1] & closed[2:, 2:] & closed[2:, :-2] & closed[:-2, 2:]
        return bool(across.any())

    @cached_property
    def cells(self) -> tuple[float, float, Array]:
        """How large cells of the section are, the least height, and which of them are reached."""
        import numpy as np

        rho, z = self.reached
        low, high = float(z.min()), float(z.max())
        size = max(float(rho.max()), high - low) / COARSE
        taken = np.zeros((math.ceil(float(rho.max()) / size) + 3, math.ceil((high - low) / size) + 5), bool)
        taken[(rho / size).astype(int).ravel(), ((z - low) / size).astype(int).ravel() + 2] = True
        return size, low, taken

    @cached_property
    def outside(self) -> Array:
        """Which cells a way leads to from outside, past none that is reached."""
        import numpy as np

        *_, taken = self.cells
        found = np.zeros(taken.shape, bool)
        ways = [(taken.shape[0] - 1, 0)]
        while ways:
            i, j = ways.pop()
            inside = 0 <= i < taken.shape[0] and 0 <= j < taken.shape[1]
            if inside and not (taken[i, j] or found[i, j]):
                found[i, j] = True
                ways += (i - 1, j), (i + 1, j), (i, j - 1), (i, j + 1)
        return found


def section_at(problem: Problem, found: Chain, point: Tracked, first: int, at: Point) -> list[float]:
    """rho^2 and z at a point of all names, by poses and differences."""
    import numpy as np

    oracle = oracle_of(problem)
    here = dict(oracle.at(at))
    z, o = axis_seen(problem, found, first, here)
    T = oracle.tool(here) if point.frame > len(problem.subject.links) else oracle.poses(here)[point.frame]
    p = T[:3, :3] @ np.array([number(x, here) for x in point.offset]) + T[:3, 3]
    away = p - o
    return [float(away @ away - (away @ z) ** 2), float(p @ z)]


def square_told(
    problem: Problem, found: Chain, point: Tracked, first: int, line: Sequence[Expr], name: Symbol
) -> Iterator[bool]:
    """Whether both sides of a line for the square of a distance with this name are what poses give."""
    for at in random_points(problem.symbols, POINTS, problem.moving):
        here = dict(oracle_of(problem).at(at))
        square, _ = section_at(problem, found, point, first, here)
        sides = [number(each, {**here, name.name: math.sqrt(square)}) for each in line]
        yield close(sides, [square] * len(sides), SMALL)


def determinant_at(problem: Problem, point: Tracked, columns: Sequence[int], at: Point) -> float:
    """-2 det J of the velocity of the point, by differences of the poses."""
    import numpy as np

    oracle = oracle_of(problem)
    J = oracle.jacobian(oracle.at(at), point.frame, point.offset)
    return float(-2 * np.linalg.det(J[:3, columns]))


def moved_by(problem: Problem, found: Chain, point: Tracked, first: Said, others: Said) -> Iterator[bool]:
    """Whether the first of these variables changes neither rho nor z, and each other one something."""
    assert isinstance(first, Symbol) and isinstance(others, tuple)
    row = next(i for i, joint in found.moving if joint.variable == first.name)
    for at in random_points(problem.symbols, POINTS):
        here = dict(oracle_of(problem).at(at))
        seen = section_at(problem, found, point, row, here)
        for each in (first, *others):
            assert isinstance(each, Symbol)
            there = {**here, each.name: here[each.name] + TURN}
            yield close(section_at(problem, found, point, row, there), seen, SMALL) == (each == first)


def listed(table: Table) -> list[Sample]:
    """The rows of a table as they stand in it."""
    rows = ([number(cell, {}) for cell in row if isinstance(cell, TREES)] for row in table.rows)
    return [Sample(rho, z, round(count)) for rho, z, count in rows]


def called_so(facts: Facts, told: Mapping[str, float], void: bool) -> Iterator[bool]:
    """Whether a hole along the axis and a void are told just where they are."""
    assert facts.section and facts.description
    key, counts = facts.description.key, facts.section.counts
    yield ("pierced" in key) == (told["r_min"] > 0)
    yield ("hollow" in key) == (counts is not None and "void" in counts.key) == void
