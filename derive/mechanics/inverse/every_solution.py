"""From the real roots of an elimination to the joint angles of each.

The null vector of the twelve equations holds the powers of x_4 and x_5, the fourteen equations then the
cosine and the sine of q_1 and q_2, and the loop the last angle (Raghavan and Roth 1993; several solutions
at one root by the eigenvalues of a shift, as Manocha and Canny 1994 have them). Newton's method takes away
what floating point has left.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from flint import fmpq

from derive.mechanics.inverse.raghavan_roth import DEGREE, Elimination, floats
from derive.mechanics.inverse.six_axes import turn

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

Angles = dict[str, float]
Sides = Callable[[Mapping[str, float]], tuple["Array", "Array"]]  # how far off (6), and the Jacobian (6 by 6)
MEETING = 1e-4  # an imaginary part that small is that of two solutions which meet
REAL = 1e-3  # likewise of x_4 and x_5, found in floating point
VANISHING = 1e-9  # of a singular value against the largest
TILT = 0.6  # of x_4 and x_5, so that half a turn is no infinity
SINGULAR = 1e-7
NEAR = 1e-3  # of what comes from a root, in lengths of the arm and in radians
MIXED = 0.37  # of two shifts, so that solutions with one angle in common are told apart
ROUNDS, CLOSE, SAME = 30, 1e-11, 1e-9


class Undecided(Exception):
    """At this pose solutions meet, or form a curve: the arm is singular, or so near to it that rounding
    decides."""


@dataclass(frozen=True)
class Root:
    """A real root x = tan(q/2), infinite for half a turn; `meets` says that two are so near to each other
    that rounding decides whether they are real."""

    x: float
    meets: bool = False

    @property
    def direction(self) -> tuple[fmpq, fmpq]:
        """Cosine and sine of q."""
        if math.isinf(self.x):
            return fmpq(-1), fmpq(0)
        top, bottom = self.x.as_integer_ratio()
        n = top * top + bottom * bottom
        return fmpq(bottom * bottom - top * top, n), fmpq(2 * top * bottom, n)


@dataclass(frozen=True)
class EverySolution:
    """Those of one elimination; `sides` tell how far off the end-effector is at some angles of the joints."""

    elimination: Elimination
    joints: tuple[str, ...]
    sides: Sides

    @cached_property
    def roots(self) -> tuple[Root, ...]:
        """The real ones, isolated by ball arithmetic, in order."""
        polynomial = self.elimination.polynomial
        found = []
        for each, _ in polynomial.numer().complex_roots():
            x, y = float(each.real.mid()), abs(float(each.imag.mid()))
            if y <= MEETING * max(1.0, abs(x)):
                found.append(Root(x, bool(y)))
        if polynomial.degree() < DEGREE and self._vanishes(Root(math.inf)):
            found.append(Root(math.inf))
        return tuple(sorted(found, key=lambda root: root.x))

    @property
    def decides(self) -> bool:
        """Whether no solution is singular, and every root gives one."""
        try:
            return len(self.solutions) >= 0
        except Undecided:
            return False

    def _vanishes(self, root: Root) -> bool:
        import numpy as np

        sizes = np.linalg.svd(floats(self.elimination.matrix(*root.direction)), compute_uv=False)
        return bool(sizes[-1] < VANISHING * sizes[0])

    @cached_property
    def solutions(self) -> tuple[Angles, ...]:
        """Those of every root, in their order. Raises Undecided where the arm is singular, and where a root
        gives none."""
        found: list[Angles] = []
        for root in self.roots:
            starts = [{name: each[name] for name in self.joints} for each in self._at(root)]
            near = [each for each in starts if self._off(each) < NEAR]
            if not near:
                raise Undecided
            found += (self._regular(root, each) for each in near)
        return tuple(each for k, each in enumerate(found) if not any(same(each, one) for one in found[:k]))

    def _off(self, angles: Angles) -> float:
        return float(abs(self.sides(angles)[0]).max())

    def _regular(self, root: Root, start: Angles) -> Angles:
        end = polished(start, self.sides)
        if root.meets or end is None or is_singular(end, self.sides):
            raise Undecided
        return end

    def _at(self, root: Root) -> Iterator[Angles]:
        """The joint angles at a root, but for rounding."""
        import numpy as np

        matrix = floats(self.elimination.matrix(*root.direction))
        _, sizes, V = np.linalg.svd(matrix)
        null = max(1, int((sizes < VANISHING * sizes[0]).sum()))
        space = V[-null:].T.reshape(*self.elimination.powers, null)
        c, s = math.cos(TILT), math.sin(TILT)
        shifts = []
        for low, high in ((space[:-1], space[1:]), (space[:, :-1], space[:, 1:])):
            low, high = (each.reshape(-1, null) for each in (low, high))
            shifts.append(np.linalg.lstsq(c * low + s * high, c * high - s * low, rcond=None)[0])
        _, vectors = np.linalg.eig(shifts[0] + MIXED * shifts[1])
        for vector in vectors.T:
            values = [(vector.conj() @ shift @ vector) / (vector.conj() @ vector) for shift in shifts]
            if max(abs(each.imag) for each in values) < REAL:
                yield self._others(root, *(2 * (math.atan(float(each.real)) + TILT) for each in values))

    def _others(self, root: Root, q_4: float, q_5: float) -> Angles:
        """With the first and second angle by the fourteen equations, and the last by the loop."""
        import numpy as np

        third, found = [float(int(each.p) / int(each.q)) for each in root.direction], self.elimination
        products = np.kron(np.kron([1.0, *third], _circle(q_4)), _circle(q_5))
        q = dict(zip(found.loop.joints[2:5], (math.atan2(third[1], third[0]), q_4, q_5), strict=True))
        eight = np.linalg.lstsq(floats(found.eight), floats(found.nine) @ products, rcond=None)[0]
        table = np.append(0.0, eight).reshape(3, 3)  # by 1, cosine, sine of the first, then of the second
        first, second = found.loop.joints[:2]
        q[first], q[second] = (math.atan2(row[2], row[1]) for row in (table[:, 0], table[0]))
        T = np.eye(4)
        for name, after in zip(found.loop.joints[:5], found.loop.after, strict=False):
            T = T @ turn(q[name]) @ floats(after)
        last = np.linalg.solve(T, np.linalg.inv(floats(found.loop.after[5])))
        q[found.loop.joints[5]] = math.atan2(last[1, 0], last[0, 0])
        return q


def is_singular(angles: Angles, sides: Sides, least: float = SINGULAR) -> bool:
    """Whether the Jacobian is, but for rounding."""
    import numpy as np

    sizes = np.linalg.svd(sides(angles)[1], compute_uv=False)
    return bool(sizes[-1] < least * sizes[0])


def polished(start: Angles, sides: Sides, near: float = SAME) -> Angles | None:
    """By Newton's method, angles from -pi to pi; None where that ends at no solution."""
    import numpy as np

    names, q = list(start), np.array(list(start.values()))
    for _ in range(ROUNDS):
        off, rates = sides(dict(zip(names, map(float, q), strict=True)))
        step = np.linalg.lstsq(rates, off, rcond=1e-9)[0]
        q = q - step
        if np.abs(step).max() < CLOSE:
            break
    off, _ = sides(dict(zip(names, map(float, q), strict=True)))
    if np.abs(off).max() > near:
        return None
    return {name: math.remainder(float(each), 2 * math.pi) for name, each in zip(names, q, strict=True)}


def same(one: Angles, other: Angles) -> bool:
    """Up to whole turns."""
    return all(abs(math.remainder(one[name] - other[name], 2 * math.pi)) < SINGULAR for name in one)


def _circle(q: float) -> Sequence[float]:
    return 1.0, math.cos(q), math.sin(q)
