"""The workspace of a point that no joint moves, as the center of a wrist: that point alone, and to where the
axis of the end-effector can point."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import derive.algebra.numbers.floats as numeric
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, Phrase, Result
from derive.errors import NotDerivable
from derive.expression import ZERO, Call, Expr, Symbol, between
from derive.kinds.checks import close, random_points, route
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.facts import Facts, Pointing
from derive.kinds.robot._reach.sections import orientations_held, orientations_in_space
from derive.kinds.robot._reach.swept import GRID
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.lines import dot
from derive.mechanics.poses import rotation_part
from derive.mechanics.reach import size
from derive.names import free

POINTS, NEAR, STILL = 2, 1e-3, 1e-9
P = Symbol("p")


@dataclass(frozen=True)
class Still:
    """A point of an arm that stays where it is."""

    problem: Problem
    chain: Chain
    point: Tracked

    def derivation(self) -> Derivation:
        """Its place, and the directions of the last axis. Raises NotDerivable where more than two joints turn
        that axis, or within ranges."""
        rows = self._rows()
        if any(self.problem.subject.links[i - 1].range for i in rows):
            raise NotDerivable("to where a wrist points within ranges of its joints is not derived yet")
        work = Work(self.problem, uses=(self.problem.ask("forward-kinematics"),))
        name = Symbol(free(self.problem.taken, "p", "p_e"))
        work = work.line(name, value=self.point.position, rule="still", label="p")
        description = Phrase("one-point")
        axis = Symbol(f"z_{len(self.problem.subject.links)}")
        low, high = self.cosines(*rows) if len(rows) == 2 else (None, None)
        facts = Facts(
            kinds=Phrase("kinds"),
            orientations=orientations_in_space(self.problem, self.chain, self.point, ()),
            description=description,
            pointing=Pointing(said=self._said(axis, low, high)),
        )
        work = work.claim(route("still", self._stays()))
        if low is not None and high is not None:
            work = work.claim(route("pointing", self._points_so(low, high, rows, facts)))
        else:
            held = orientations_held(self.problem, self.chain, self.point, facts.orientations)
            work = work.claim(held)
        results: dict[str, Result] = {"r_min": ZERO, "r_max": ZERO, "description": description}
        return work.answer("workspace", results, facts)

    @property
    def _axis(self) -> ScalarMatrix:
        """That of the end-effector (3 by 1)."""
        return rotation_part(self.chain.T_tool).columns(2)

    def _rows(self) -> list[int]:
        """Of the joints that turn it."""
        return [i for i, joint in self.chain.moving if any(self._axis.diff(joint.variable).entries)]

    def cosines(self, first: int, second: int) -> tuple[Expr | None, Expr | None]:
        """The least and the largest one of the angle between the first axis and that of the end-effector."""
        w, u, k = self.chain.axis(first), self.chain.axis(second), self._axis
        lever, across = dot(k, u), dot(w, u)
        if any(lever.diff(name) or across.diff(name) for name in self.chain.variables) or across.letters():
            return None, None
        one = Scalar.of(1)
        swing = size((one - lever * lever) * (one - across * across))
        low, high = lever * across - swing, lever * across + swing
        return self.problem.readable(low), self.problem.readable(high)

    def _said(self, axis: Symbol, low: Expr | None, high: Expr | None) -> Phrase:
        if low is None or high is None:
            return Phrase("pointing-open", {"axis": axis})
        if numeric.number(low, {}) <= STILL - 1 and numeric.number(high, {}) >= 1 - STILL:
            return Phrase("all-approaches", {"axis": axis})
        beta = Symbol(free(self.problem.taken, "beta", "gamma", "delta"))
        cosines = between(low, Call("cos", (beta,)), high)
        return Phrase("cone-of-approaches", {"axis": axis, "beta": beta, "cosines": cosines})

    def _stays(self) -> Iterator[bool]:
        oracle = oracle_of(self.problem)
        for at in random_points(self.problem.symbols, POINTS):
            here = dict(oracle.at(at))
            J = oracle.jacobian(here, self.point.frame, self.point.offset)
            yield float(abs(J[:3]).max()) < NEAR**2

    def _points_so(self, low: Expr, high: Expr, rows: list[int], facts: Facts) -> Iterator[bool]:
        """Whether the cosine comes to both ends while the second joint turns, and what is said of that."""
        import numpy as np

        oracle = oracle_of(self.problem)
        first, second = (self.chain.joint(i).variable for i in rows)
        for at in random_points(self.problem.symbols, POINTS):
            here, cosines = dict(oracle.at(at)), []
            before, after = oracle.tool({**here, first: 0.0}), oracle.tool({**here, first: np.pi})
            w = before[:3, :3] @ after[:3, :3].T  # half a turn about the first axis: 2 w w^T - 1
            axis = np.linalg.eigh(w + w.T)[1][:, -1]
            axis = axis if axis[int(np.abs(axis).argmax())] > 0 else -axis
            for q in np.linspace(-np.pi, np.pi, GRID + 1):
                cosines.append(float(oracle.tool({**here, second: q})[:3, 2] @ axis))
            told = [numeric.number(each, here) for each in (low, high)]
            ends = [min(cosines), max(cosines)]
            yield any(close(told, e, NEAR) for e in (ends, [-ends[1], -ends[0]]))
        whole = numeric.number(low, {}) <= STILL - 1 and numeric.number(high, {}) >= 1 - STILL
        yield (facts.pointing is not None and facts.pointing.said.key == "all-approaches") == whole
        # a wrist that points everywhere and turns about where it points takes every orientation
        rolls = len([*self.chain.moving]) > len(rows)
        yield (facts.orientations.key in ("both-the-same", "both-the-same-by-one")) == (whole and rolls)
