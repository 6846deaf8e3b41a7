"""From a plan to the page: what is given, the decoupling, and every sub-problem in its stage."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

from derive.algebra.scalar import Scalar
from derive.derivation import Step
from derive.expression import Matrix, Symbol, column, multiply, transpose
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import TOOL
from derive.kinds.robot._inverse import (
    doubled,
    lengths,
    one_equation,
    quartic,
    two_equations,
    two_slides,
)
from derive.kinds.robot._inverse.compared import Poses
from derive.kinds.robot._inverse.progress import Progress
from derive.kinds.robot._inverse.solving import Solving
from derive.kinds.robot._inverse.turned import Turned, turned
from derive.kinds.robot._inverse.worked import Orientation, Worked
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.arm_angle import ArmAngle
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.plan import Decoupling, Plan
from derive.mechanics.inverse.search import Stage
from derive.mechanics.inverse.subproblems import (
    DoubleAngle,
    Elbow,
    HalfAngle,
    OneEquation,
    Quadratic,
    Quartic,
    Reach,
    Slide,
    TwoEquations,
)
from derive.mechanics.poses import homogeneous, inverse_pose, rotation_part


@dataclass(frozen=True, slots=True)
class Stages:
    """What the steps before and between the sub-problems are made from."""

    problem: Problem
    chain: Chain
    goal: Goal
    plan: Plan
    free_name: Callable[[str], str]

    def worked(self) -> Worked:
        """The whole, every sub-problem solved."""
        turning = [joint.variable for _, joint in self.chain.moving if joint.type == "revolute"]
        progress = Progress(self.problem, self.goal, turning, self.free_name)
        decoupling = self.plan.decoupling
        centre = (self._centre(progress, decoupling),) if decoupling and decoupling.centre else ()
        orientation: Orientation | None = None
        shoulder: Turned | None = None
        angle = self.plan.angle
        for planned in self.plan.steps:
            by_angle = angle is not None and planned.stage.joints == angle.joints
            if by_angle and angle and decoupling and shoulder is None:
                shoulder = turned(progress, self.chain, decoupling, angle)
            hand = decoupling is not None and planned.stage.joints == decoupling.joints
            if hand and decoupling and orientation is None:
                orientation = self._orientation(progress, decoupling)
            poses = self._shoulder(angle) if by_angle and angle else self._poses(hand)
            wrist = decoupling.joint if decoupling else None
            write(Solving(progress, poses, planned.subproblem, wrist), planned.stage)
        return Worked(
            self.problem,
            self.chain,
            self.goal,
            self.plan,
            tuple(progress.items),
            self._pose(),
            centre,
            orientation,
            self._last,
            shoulder,
        )

    def _pose(self) -> tuple[Step, ...]:
        """The known pose or orientation by its elements, where it is one."""
        R = self.goal.R
        if R is None:
            return ()
        if not self.goal.whole_position:
            return (Step("R", (self._end("R"), self.problem.readable_matrix(R)), "given"),)
        T = homogeneous(R, [part for part in self.goal.p if part is not None])
        return (Step("T", (self._end("T"), self.problem.readable_matrix(T)), "given"),)

    def _end(self, letter: str, base: int = 0) -> Symbol:
        """The pose or orientation of the end-effector."""
        return Symbol(f"{letter}_{self._last}^{base}")

    @property
    def _last(self) -> str:
        return TOOL if self.problem.subject.ends_in_tool else str(len(self.chain.joints))

    def _poses(self, hand: bool) -> Poses:
        """How the poses of a stage are called."""
        decoupling, goal = self.plan.decoupling, self.goal
        if hand and decoupling:
            frame = decoupling.joint.frame
            if decoupling.joint.shoulder:
                return Poses("R", 0, str(frame), Symbol(f"R_{frame}^0"), "hand")
            return Poses("R", frame, self._last, self._end("R", frame if decoupling.turn else 0), "hand")
        if decoupling:
            shoulder = decoupling.joint.shoulder
            return Poses("T", None if shoulder else 0, self._last, decoupling.name, "arm", shoulder)
        if goal.R is None:
            return Poses("T", 0, self._last, Symbol("p"))
        letter = "T" if goal.whole_position else "R"
        return Poses(letter, 0, self._last, self._end(letter))

    def _shoulder(self, angle: ArmAngle) -> Poses:
        """Those of a shoulder that is turned by the arm angle."""
        frame = angle.shoulder.frame
        return Poses("R", 0, str(frame), Symbol(f"R_{frame}^0"), "shoulder")

    def _centre(self, progress: Progress, decoupling: Decoupling) -> Step:
        """p_w = p + R (centre in the end-effector's frame), p_s = R^T ((centre in the base) - p)."""
        names = [progress.define(name, value) for name, value in decoupling.centre.items()]
        p = column(self.problem.readable(part or Scalar.of(0)) for part in self.goal.p)
        joint, R = decoupling.joint, self._end("R")
        centre = self.problem.readable_matrix(joint.centre)
        if joint.shoulder:
            whole = multiply(transpose(R), centre - p) if joint.centre else -multiply(transpose(R), p)
        else:
            whole = p + multiply(R, centre)
        values = column(map(progress.value_of, names))
        return Step(decoupling.name.name, (decoupling.name, column(names), whole, values), "centre")

    def _orientation(self, progress: Progress, decoupling: Decoupling) -> Orientation:
        """What is left for the three joints to make, and what they make."""
        frame, shoulder = decoupling.joint.frame, decoupling.joint.shoulder
        T = self.chain.T[frame]
        made = self.problem.readable_matrix(
            rotation_part(T if shoulder else inverse_pose(T) @ self.chain.T_tool)
        )
        names = tuple(progress.define(each, value) for each, value in decoupling.turn.items())
        rows = names or tuple(Symbol(f"r{i}{j}") for i, j in product((1, 2, 3), repeat=2))
        entries = Matrix(tuple(rows[k : k + 3] for k in (0, 3, 6)))
        name = self._poses(hand=True).wanted
        rest = self._end("R", frame) if shoulder else Symbol(f"R_{frame}^0")
        left = self._end("R") * transpose(rest) if shoulder else transpose(rest) * self._end("R")
        wanted = Step("turn", (name, left, entries), "turn")
        return Orientation(
            name, entries, (wanted,) if names else (), Step("turn_made", (name, made), "turn"), made, rest
        )


def write(solving: Solving, stage: Stage) -> None:
    """The next sub-problem, the names it needs before it."""
    match solving.found:
        case TwoEquations() as found:
            two_equations.write(solving, found)
        case OneEquation() as found:
            one_equation.write(solving, found, stage)
        case Elbow() as found:
            lengths.elbow(solving, found)
        case Reach() as found:
            lengths.reach(solving, found)
        case Slide() as found:
            lengths.slide(solving, found)
        case Quadratic() as found:
            two_slides.write(solving, found)
        case DoubleAngle() as found:
            doubled.double(solving, found)
        case HalfAngle() as found:
            doubled.half(solving, found)
        case Quartic() as found:
            quartic.write(solving, found)
