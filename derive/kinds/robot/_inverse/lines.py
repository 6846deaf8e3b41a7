"""Every line of the working at poses that the arm reaches: with the joint values of a branch its expressions
have to be equal, and the poses in it have to be those of the oracle."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from derive.algebra.angles import Form
from derive.algebra.numbers.arrays import arrays
from derive.derivation import Claim, Step
from derive.expression import Expr, Matrix, Relation, Symbol, free_symbols
from derive.kinds.checks import close, route
from derive.kinds.robot._inverse import breaks
from derive.kinds.robot._inverse.checks import Tried
from derive.kinds.robot._inverse.readings import Reading
from derive.kinds.robot._inverse.subproblem import Solved, Taken, course, defined
from derive.kinds.robot._inverse.target import Target, Values
from derive.kinds.robot._inverse.turned import Turned
from derive.kinds.robot._inverse.worked import Worked
from derive.kinds.robot._seen import axis_seen

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

READ = 2  # poses at which is looked where equations are read, and at a singular wrist
UP_TO_TURNS = ("difference", "twice")  # rules of lines about angles
SAME = 1e-7  # of the sides of a line, relative to their size
CHOICES = ("choice", "squared")  # one of which holds
TURNS = 0.3  # by which joints are moved to find what stays


@dataclass(frozen=True, slots=True)
class Lines:
    """The lines of an inverse, and the arm in numbers."""

    tried: Tried
    worked: Worked
    chosen: Sequence[Taken]

    @property
    def target(self) -> Target:
        return self.tried.target

    def claims(self) -> Iterator[Claim]:
        """Of every line, of where a rule breaks, and of a wrist that is singular."""
        solved = [(self.chosen[k], values) for k, _, values in self.tried.once]
        yield route("lines", (each for taken, known in solved for each in self.hold(known, taken)))
        yield route("read-there", (each for _, known in solved[:READ] for each in self.read(known)))
        if bounds := [*self._bounds(solved)]:
            yield route("where-it-breaks", bounds)
        if self.worked.singular:
            points = self.tried.points[:READ]
            free = (each for point in points for each in self.leave_free(dict(point)))
            yield route("singular-wrist", free)

    def _bounds(self, tried: Sequence[tuple[Taken, Values]]) -> Iterator[bool]:
        """Of each sub-problem where it is real, where it is determined, and which factor decides a sign."""
        turning = [name for name in self.target.joints if name not in self.target.slides]
        for k, solved in enumerate(self.worked.solved):
            yield from breaks.real(solved, self.worked.solved[: solved.number])
            rates = course(solved, self.worked.solved[:k], turning)
            for _, known in tried[:READ]:
                yield from breaks.decided(solved, self.worked.all_items, known, self.target.joints)
            for taken, known in tried:
                yield from breaks.determined(solved, known, rates)
                yield from breaks.turned(solved, known)
                yield from self._arbitrary(solved, known)
                choice = solved.choices.index(taken[solved.number])
                yield from breaks.sided(solved, known, choice)
                yield from breaks.signed(solved, known, choice)

    def _arbitrary(self, solved: Solved, known: Values) -> Iterator[bool]:
        """Whether an angle that is said to be arbitrary where a slide is zero moves nothing there that is
        known: the center of the wrist where the hand follows, else all that is given."""
        said = solved.facts.open
        if said is None or said.key != "singular-and-arbitrary-if":
            return
        slides = [each.left for each in solved.facts.method.unless]
        assert all(isinstance(each, Symbol) for each in slides) and isinstance(solved.unknown, Form)
        here = {**known, **{each.name: 0.0 for each in slides if isinstance(each, Symbol)}}
        there = here | {name: here[name] + TURNS for name, _ in solved.unknown.parts}
        if solved.stage == "arm":
            yield close(self._centre(there), self._centre(here), SAME)
        else:
            yield close(self.target.there(there), self.target.there(here), SAME)

    def hold(self, known: Values, taken: Taken) -> Iterator[bool]:
        """Whether each holds: `known` are the values of all names in the branch with these choices."""
        known = defined(self.worked.all_items, known)
        meaning = {**known, **self._poses(known)}
        for solved in self.worked.solved:
            turns = solved.unknown not in self.target.slides
            lines = [step for step in solved.steps if step.rule not in CHOICES]
            yield from (equal(step.chain, known, step.rule in UP_TO_TURNS) for step in lines)
            yield equal(line_of(solved, taken).chain, known, turns)
            if quartic := solved.facts.method.quartic:
                yield quartic.first.name not in free_symbols(quartic.height)
        given = {name: value for name, value in meaning.items() if name not in self.target.joints}
        yield from (equal(step.chain, given, False) for step in self.worked.pose)
        yield from (equal(step.chain, meaning, False) for step in (*self.worked.centre, *self.worked.turn))
        yield from (_by_place(step.chain[-1]) for step in self.worked.turn)
        yield from (equal(step.chain, known, False) for step in self.worked.elements)
        for pair in self.worked.conditions:
            yield pair[0] != pair[1] and equal(pair, known, False)
        if turned := self.worked.by_angle:
            yield from (equal(step.chain, meaning, False) for step in (*turned.steps, turned.made))
            yield from (equal(step.chain, known, False) for step in self.worked.swung_elements)
            still = {**known, turned.angle.psi: 0.0}
            yield close(arrays(turned.before.chain[1], still)[2, 1], 0.0, SAME)  # the axis of the elbow
        if self.worked.at_end:
            end = self.target.oracle.tool(known)[:3, 3:]
            yield close(self._centre(known), 0 * end if self.worked.shoulder else end, SAME)

    def leave_free(self, point: Values) -> Iterator[bool]:
        """Whether what is said of a singular wrist holds at a configuration: its sum or difference of angles
        is determined so, and the outer joints can turn against each other without moving anything else."""
        tool, (first, _, last) = self.target.oracle.tool, self.worked.spherical
        for k, case in enumerate(self.worked.singular):
            middle = case.said.about["middle"]
            yield case.said.key == ("outer-axes-too" if k else "outer-axes")
            yield (case.said.about["a"], case.said.about["b"]) == (Symbol(first), Symbol(last))
            assert isinstance(middle, Relation) and isinstance(middle.left, Symbol) and middle.sign == "="
            at = {**point, middle.left.name: arrays(middle.right, {})}
            at |= self.target.goal.numbers(tool(at))
            known = defined(self.worked.all_items, at)
            yield equal(case.step.chain, known, True)
            with_last = arrays(case.step.chain[0], {first: 0.0, last: 1.0})
            moved = {first: at[first] + TURNS, last: at[last] - with_last * TURNS}
            yield close(tool({**at, **moved}), tool(at), SAME)

    def _poses(self, at: Values) -> dict[str, Array]:
        """What the names of poses stand for, by the oracle: T_6^0 and R_6^0 of the end-effector in the base,
        R_3^0, R_6^3, and the centre of the wrist, or that of the shoulder seen from the end-effector (3 by
        1)."""
        T, last = self.target.oracle.tool(at), self.worked.last
        found: dict[str, Array] = {f"T_{last}^0": T, f"R_{last}^0": T[:3, :3]}
        if turn := self.worked.orientation:
            R, point = self.target.oracle.poses(at)[self._inside][:3, :3], self._centre(at)
            if self.worked.shoulder:
                seen = T[:3, :3].T @ (point - T[:3, 3:])
                found |= {"p_s": seen, turn.before.name: R.T @ T[:3, :3], turn.name.name: R}
            else:
                found |= {"p_w": point, turn.before.name: R, turn.name.name: R.T @ T[:3, :3]}
        return found | (self._swung(at, self.worked.by_angle) if self.worked.by_angle else {})

    def _swung(self, at: Values, turned: Turned) -> dict[str, Array]:
        """The line between the centres, and the frame on it in the base and after the shoulder."""
        import numpy as np

        angle, problem, chain = turned.angle, self.worked.problem, self.worked.chain
        line = self._centre(at) - self._centre(at, angle.joints)
        row = next(i for i, joint in chain.moving if joint.variable == angle.elbow)
        z, y = line[:, 0] / np.linalg.norm(line), axis_seen(problem, chain, row, at)[0]
        U = np.column_stack([np.cross(y, z), y, z])
        R = self.target.oracle.poses(at)[angle.shoulder.frame][:3, :3]
        return dict(zip(turned.names, (line, U, R.T @ U, R), strict=True))

    @property
    def _inside(self) -> int:
        """The frame before the wrist, or after the shoulder, by the name of its rotation."""
        turn = self.worked.orientation
        if turn is None:
            return 0
        of, seen_from = turn.before.name.removeprefix("R_").split("^")
        return int(seen_from if self.worked.shoulder else of)

    def _centre(self, at: Values, joints: Sequence[str] = ()) -> Array:
        """The point (3 by 1, in the base) that none of the three joints of a wrist or shoulder moves."""
        import numpy as np

        tool, rows, shifts = self.target.oracle.tool, [], []
        for name in joints or self.worked.spherical:
            D = tool({**at, name: at[name] + TURNS}) @ np.linalg.inv(tool(at))
            rows.append(D[:3, :3] - np.eye(3))
            shifts.append(-D[:3, 3])
        found: Array = np.linalg.lstsq(np.vstack(rows), np.concatenate(shifts), rcond=None)[0]
        return found[:, None]

    def read(self, known: Values) -> Iterator[bool]:
        """Whether the equations stand where they are said to be read."""
        import numpy as np

        known = defined(self.worked.all_items, known)
        poses = self._poses(known)
        centre: Array = np.ones((4, 1))
        if self.worked.orientation:
            centre[:3] = self._centre(known)
            centre = np.linalg.solve(self.target.oracle.poses(known)[self._inside], centre)
        reading = Reading(self.target, known, poses, self._inside, centre[:, 0], self.worked.shoulder)
        for k, solved in enumerate(self.worked.solved):
            yield from reading.right(solved, self.worked.solved[:k])


def line_of(solved: Solved, taken: Taken) -> Step:
    """The line that tells the unknown in a branch, of two the first where its sign is positive."""
    choice, told = taken[solved.number], solved.facts.choices
    if choice.sign:
        return told[0 if choice.sign > 0 else 1]
    return told[solved.choices.index(choice)]


def equal(chain: Sequence[Expr], known: Mapping[str, Any], turns: bool) -> bool:
    """Whether all expressions of a chain have one value; angles up to whole turns. A chain of one, or with a
    name that means nothing there, says nothing and is not right."""
    try:
        first, *others = (arrays(each, known) for each in chain)
    except KeyError:
        return False
    if turns:
        same = (abs(math.remainder(each - first, 2 * math.pi)) < SAME for each in others)
    else:
        same = (close(each, first, SAME) for each in others)
    return bool(others) and all(same)


def _by_place(matrix: Expr) -> bool:
    """Whether the names in a matrix of names end in their row and column."""
    rows = matrix.rows if isinstance(matrix, Matrix) else ()
    entries = [(f"{i}{j}", entry) for i, row in enumerate(rows, 1) for j, entry in enumerate(row, 1)]
    named = all(isinstance(entry, Symbol) for _, entry in entries)
    return not named or all(isinstance(each, Symbol) and each.name.endswith(at) for at, each in entries)
