"""What is found at one pose, against the arm as the oracle has it: nothing of the elimination is used
here."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.arrays import arrays
from derive.derivation import Branch, Claim
from derive.expression import Expr, Relation, Symbol, free_symbols
from derive.kinds.checks import close, route
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import TOOL
from derive.kinds.robot._inverse.evaluated import Evaluated, Numbers
from derive.kinds.robot._inverse.everywhere import from_everywhere, three_are_special
from derive.kinds.robot._inverse.facts import Eliminated
from derive.kinds.robot._inverse.target import Target, Values
from derive.kinds.robot._seen import axis_seen
from derive.mechanics.chain import Chain

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

FOUND, SAME, NEAR = 1e-9, 1e-5, 1e-7
LARGEST, BESIDE = 1e7, 0.5  # of a tangent; of an angle beside the pose
FITTED = 40  # pairs of angles
PLACES = 1441  # at which the polynomial is looked at
EQUATIONS = 14  # of the line of an axis
COUNTS = {"no-real-root": 0, "one-real-root": 1}


@dataclass(frozen=True)
class Checks:
    """The solutions at a pose, what is `told` of them, and what is evaluated."""

    problem: Problem
    chain: Chain
    target: Target
    told: Eliminated
    branches: Sequence[Branch]
    values: Evaluated
    roots: Sequence[float]  # of the polynomial, one for each solution

    def claims(self) -> Iterator[Claim]:
        """Of the numbers, of the polynomial, of what is eliminated and of why there is no formula."""
        yield route("as-printed", self._printed())
        yield route("placed", self._placed())
        yield route("every-solution", self._complete())
        yield route("polynomial", self._vanishes())
        yield route("cut-there", self._cut())
        yield route("same-products", self._bilinear())
        yield route("no-formula", self._why())

    @property
    def _entries(self) -> Sequence[dict[str, Any]]:
        entries: Sequence[dict[str, Any]] = self.values.values["solutions"]
        return entries

    @property
    def _numbers(self) -> Numbers:
        assert self.values.numbers is not None
        return self.values.numbers

    @property
    def _there(self) -> Values:
        """The place, with the nearest rotation."""
        return self.target.completed(self._numbers.point)

    def _printed(self) -> Iterator[bool]:
        """Whether every result is what is told at the place."""
        yield len(self.branches) == len(self._entries)
        for branch, entry in zip(self.branches, self._entries, strict=False):
            printed = [arrays(each, {}) for each in branch.values.values()]
            yield close(printed, [entry[name] for name in branch.values], FOUND)

    def _placed(self) -> Iterator[bool]:
        """Whether each brings the end-effector to the pose as typed."""
        numbers, typed = self._numbers, self.target.completed(self._numbers.typed)
        yield self.values.place.out_of_reach == (not self.branches)
        for entry in self._entries:
            angles = {name: entry[name] for name in self.target.joints}
            yield self.target.misses(typed, angles, numbers.size) <= numbers.tolerance

    def _complete(self) -> Iterator[bool]:
        """Whether Newton's method, from starts everywhere, ends at none that is not told."""
        import numpy as np

        zero = {**self._there, **dict.fromkeys(self.target.joints, 0.0)}
        axes = [axis_seen(self.problem, self.chain, i, zero) for i, _ in self.chain.moving]
        pose = np.eye(4)
        for name, (i, j) in self.target.goal.places.items():
            pose[i, j] = self._there[name]
        home = self.target.oracle.tool(zero)
        for end in from_everywhere(axes, home, pose, self._numbers.size):
            q = dict(zip(self.target.joints, map(float, end), strict=True))
            gaps = (self.target.gaps(q, each) for each in self._entries)
            yield any(max(map(abs, gap.values())) < SAME for gap in gaps)
        yield True

    def _vanishes(self) -> Iterator[bool]:
        """Whether the polynomial as printed is zero for every solution, and has as many real roots as it
        is said to have, by its changes of sign along half a circle."""
        import numpy as np

        tree, u = self.told.polynomial.result, self.told.root.name
        yield len(self.roots) == len(self._entries)
        for each, x in zip(self._entries, self.roots, strict=False):
            here = math.tan(each[self.told.unknown.name] / 2)
            yield close(arrays(self.told.half.result, each), here, NEAR)
            yield close(each.get(u, here), here, NEAR)
            apart = abs(math.remainder(2 * (math.atan(x) - math.atan(here)), math.tau))
            yield apart < (BESIDE if self.told.beside else NEAR)
            if abs(x) >= LARGEST:
                continue
            step = 1e-3 * max(1.0, abs(x))
            here, *around = (abs(float(arrays(tree, {u: x + by}))) for by in (0.0, step, -step))
            yield here <= max(around) / 10
        inner = np.tan(np.linspace(-math.pi / 2, math.pi / 2, PLACES)[1:-1])
        places = [-LARGEST, *inner, LARGEST]
        signs = np.sign([float(arrays(tree, {u: float(x)})) for x in places])
        crossed = int((signs[1:] * signs[:-1] < 0).sum())
        told = self.told.roots
        count = COUNTS.get(told.key, told.about.get("count"))
        assert isinstance(count, int)
        yield (len(self._entries) > count) == (self.told.shared is not None)
        yield crossed <= count and (self.told.degree - crossed) % 2 == 0

    def _cut(self) -> Iterator[bool]:
        """Whether the equation of poses holds, and its left side moves with three joints, those said to be
        left or the others."""
        here = {**self._there, **{name: 0.3 * k - 1 for k, name in enumerate(self.target.joints)}}
        left, right = self.told.cut.left, self.told.cut.right
        assert isinstance(left, Symbol) and not isinstance(right, Relation)
        T = self._pose(left.name, here)
        poses = {name: self._pose(name, here) for name in free_symbols(right)}
        yield close(T, arrays(right, poses), FOUND)
        moved = {
            name
            for name in self.target.joints
            if not close(self._pose(left.name, {**here, name: here[name] + 1}), T, FOUND)
        }
        triple = {each.name for each in self.told.triple}
        others = {each.name for each in (*self.told.pair, self.told.last)}
        yield moved in (triple, others)
        yield triple | others == set(self.target.joints) and self.told.unknown.name in triple

    def _bilinear(self) -> Iterator[bool]:
        """Whether what is equal on both sides is linear in each of two angles that turn the line, in each in
        1, its cosine and its sine, by a fit to what it is in any arm; and fourteen things, none of which
        follows from the others by itself."""
        import numpy as np

        drawn = np.random.default_rng(1)
        fixed = [(np.linalg.qr(drawn.normal(size=(3, 3)))[0], drawn.normal(size=(3, 1))) for _ in range(3)]
        angles = drawn.uniform(-math.pi, math.pi, (FITTED, 2))
        by = np.array([[(1.0, math.cos(q), math.sin(q)) for q in both] for both in angles])
        products = np.array([np.outer(one, other).ravel() for one, other in by])
        lines = [_carried(fixed, both) for both in angles]
        names = [each.name for each in self.told.line]
        trees = (*self.told.line, *self.told.equal)

        def seen(tree: Expr, lines: Any) -> Array:
            return np.array([np.ravel(arrays(tree, dict(zip(names, line, strict=True)))) for line in lines])

        anywhere = drawn.normal(size=(FITTED, 2, 3, 1))
        whole = np.hstack([seen(tree, anywhere) for tree in trees])
        yield np.linalg.matrix_rank(whole) == whole.shape[1] == EQUATIONS
        for tree in trees:
            found = seen(tree, lines)
            fit = products @ np.linalg.lstsq(products, found, rcond=None)[0]
            yield close(fit, found, FOUND)

    def _pose(self, name: str, at: Values) -> Array:
        """T_b^a by the oracle."""
        import numpy as np

        of, seen_from = name.removeprefix("T_").split("^")
        found: Array = np.linalg.solve(self._frame(seen_from, at), self._frame(of, at))
        return found

    def _frame(self, name: str, at: Values) -> Array:
        import numpy as np

        if name == "0":
            return np.eye(4)
        return self.target.oracle.tool(at) if name == TOOL else self.target.oracle.poses(at)[int(name)]

    def _why(self) -> Iterator[bool]:
        """Whether three neighbouring axes are seen to be parallel, or to meet, unless it is said that none
        do."""
        here = {**self._there, **{name: 0.7 - 0.4 * k for k, name in enumerate(self.target.joints)}}
        axes = [axis_seen(self.problem, self.chain, i, here) for i, _ in self.chain.moving]
        special = [three_are_special(axes[k : k + 3], self._numbers.size) for k in range(len(axes) - 2)]
        yield any(special) == (self.told.why.key == "no-formula-found")


def _carried(fixed: Sequence[tuple[Array, Array]], angles: Sequence[float]) -> tuple[Array, Array]:
    """The direction of a line and a point on it (3 by 1 each), moved by the last of these displacements and
    then, from the last, by each angle about an axis and the displacement before."""
    import numpy as np

    (R, p), *before = reversed(fixed)
    l = R[:, 2:]
    for (R, o), q in zip(before, reversed(angles), strict=True):
        c, s = math.cos(q), math.sin(q)
        turn = R @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        l, p = turn @ l, turn @ p + o
    return l, p
