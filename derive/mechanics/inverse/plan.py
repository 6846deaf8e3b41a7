"""The order in which the joint variables of an arm are found: a plan of named sub-problems.

An arm with a spherical wrist is decoupled: its first joints bring the centre of the wrist to its place, the
last three turn the end-effector (Pieper 1968). An arm with a spherical shoulder is taken from the other end:
its last joints bring the centre of the shoulder to its place, seen from the end-effector, the first three
turn it. Any other arm is taken as a whole.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import Point, scalar_number
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import TooLong
from derive.expression import Symbol
from derive.mechanics.budget import Budget
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.arm_angle import ArmAngle
from derive.mechanics.inverse.doubled import doubled
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.known import Knowledge, singles
from derive.mechanics.inverse.paul import (
    Equation,
    Frames,
    centre_equations,
    pose_equations,
    position_equations,
    reversed_equations,
)
from derive.mechanics.inverse.pieper import quartic
from derive.mechanics.inverse.search import Stage
from derive.mechanics.inverse.subproblems import Elbow, Quartic, SubProblem, equations_of
from derive.mechanics.inverse.two_slides import two_slides
from derive.mechanics.inverse.wrist import Spherical, spherical_shoulder, spherical_wrist
from derive.mechanics.poses import inverse_pose, rotation_part


@dataclass(frozen=True, slots=True)
class Decoupling:
    """A spherical wrist or shoulder with its `joints`: what stands for the place of its centre and for the
    orientation it has to make.

    `centre` are three names and what they stand for; `turn` likewise nine, of the orientation without that of
    the other joints. Empty where nothing needs a name.
    """

    joint: Spherical
    joints: tuple[str, ...]
    centre: dict[str, Scalar]
    turn: dict[str, Scalar]

    @property
    def name(self) -> Symbol:
        """Of the centre."""
        return Symbol("p_s" if self.joint.shoulder else "p_w")


@dataclass(frozen=True, slots=True)
class Planned:
    """A sub-problem, the equations it was found in, and what is known before it is solved."""

    stage: Stage
    known: Knowledge
    subproblem: SubProblem


@dataclass(frozen=True, slots=True)
class Plan:
    """The sub-problems in order; `left` are equations nobody could solve, empty where all joints are known.

    `conditions` hold no joint variable: only poses that fulfil them can be reached at all. `stopped` says
    that the budget of the search was spent. The shoulder of an arm with seven joints is solved by its arm
    `angle`.
    """

    steps: tuple[Planned, ...]
    knowledge: Knowledge
    decoupling: Decoupling | None = None
    left: tuple[Equation, ...] = ()
    conditions: tuple[Equation, ...] = ()
    stopped: bool = False
    angle: ArmAngle | None = None

    @property
    def quartic(self) -> tuple[int, Quartic] | None:
        """The sub-problem that a polynomial solves, where there is one, and its place."""
        found = ((k, each.subproblem) for k, each in enumerate(self.steps))
        return next(((k, each) for k, each in found if isinstance(each, Quartic)), None)

    @property
    def complete(self) -> bool:
        """Whether every joint variable is found."""
        return self.knowledge.complete and not self.stopped


@dataclass(frozen=True, slots=True)
class Search:
    """A search for one arm and one goal. `points` are poses it reaches: values of every name."""

    chain: Chain
    goal: Goal
    points: tuple[Point, ...]
    free_name: Callable[[str], str]
    budget: Budget

    def plan(self) -> Plan:
        """Decoupled where there is a spherical wrist or shoulder, as a whole otherwise."""
        plans: list[Plan] = []
        for joint in self._meeting():
            plans.append(self._decoupled(joint))
            if plans[-1].complete and not plans[-1].quartic:
                return plans[-1]
        return next((each for each in plans if each.complete), plans[0]) if plans else self._whole()

    def by_arm_angle(self, arm: ArmAngle) -> Plan:
        """The elbow, the shoulder by the arm angle, then the wrist."""
        decoupling = self._decoupling(arm.wrist)
        stage = self._arm(decoupling)
        before = Knowledge.of(self.chain, stage.joints)
        bent = stage.next(before, self.budget)
        if not isinstance(bent, Elbow) or not before.after(bent.unknown).knows_joint(arm.elbow):
            return Plan((), before, decoupling, tuple(stage.left(before)), angle=arm)
        shoulder, hand = self._follow(self._shoulder(arm)), self._follow(self._hand(decoupling))
        steps = (Planned(stage, before, bent), *shoulder.steps, *hand.steps)
        known = Knowledge.of(self.chain, self.chain.variables)
        for planned in steps:
            known = known.after(planned.subproblem.unknown)
        left, stopped = (*shoulder.left, *hand.left), shoulder.stopped or hand.stopped
        return Plan(steps, known, decoupling, left, stopped=stopped, angle=arm)

    def _shoulder(self, arm: ArmAngle) -> Stage:
        """The joints of the shoulder, by the rotation that the arm angle asks of it."""
        frames = Frames.of(self.chain, singles(self.chain), 0, arm.shoulder.frame)
        names = list(map(Scalar.symbol, arm.turn))
        R = ScalarMatrix.of([names[k : k + 3] for k in (0, 3, 6)])
        points = [{**point, **arm.at(self.chain, point)} for point in self.points]
        named = arm.named()
        at = tuple({**p, **{name: scalar_number(v, p) for name, v in named.items()}} for p in points)
        return Stage.of(pose_equations(frames, R, None), arm.joints, at)

    def _meeting(self) -> Iterator[Spherical]:
        """Three joints that make the orientation whatever the others do."""
        if self.goal.R is None or self.goal.angle:
            return
        if wrist := spherical_wrist(self.chain):
            yield wrist
        if self.goal.whole_position and (shoulder := spherical_shoulder(self.chain)):
            yield shoulder

    def _whole(self) -> Plan:
        frames, goal = Frames.of(self.chain, singles(self.chain)), self.goal
        equations: list[Equation] = []
        if goal.R is not None and None not in goal.p:
            equations += pose_equations(frames, goal.R, [part for part in goal.p if part is not None])
        else:
            origin = ScalarMatrix.column((0, 0, 0))
            equations += position_equations(frames, goal.p, origin)
            if goal.R is not None:
                equations += pose_equations(frames, goal.R, None)
        plan = self._follow(Stage.of(equations, self.chain.variables, self.points))
        if not plan.complete and goal.R is not None and None not in goal.p and not goal.angle:
            p = [part for part in goal.p if part is not None]
            both = [*equations, *reversed_equations(frames, goal.R, p)]
            other = self._follow(Stage.of(both, self.chain.variables, self.points))
            plan = other if other.complete else plan
        return replace(plan, conditions=tuple(self._conditions(equations)))

    def _conditions(self, equations: Sequence[Equation]) -> Iterator[Equation]:
        for equation in equations:
            value = equation.right - equation.left
            plain = equation.between.first == 0 and equation.between.last is None
            if plain and value and not any(value.diff(name) for name in self.chain.variables):
                yield equation

    def _follow(self, stage: Stage) -> Plan:
        """One sub-problem after the other, each in what is known then."""
        known = Knowledge.of(self.chain, stage.joints)
        steps: list[Planned] = []
        try:
            while not known.complete:
                used = {equation.place for each in steps for equation in equations_of(each.subproblem)}
                found = stage.next(known, self.budget, used)
                solved: Sequence[SubProblem] | None = (found,) if found else None
                solved = solved or two_slides(stage, known)
                solved = solved or doubled(stage, known, self.free_name("phi"))
                solved = solved or quartic(stage, known, self.free_name("u"))
                if solved is None:
                    return Plan(tuple(steps), known, left=tuple(stage.left(known)))
                for each in solved:
                    steps.append(Planned(stage, known, each))
                    known = known.after(each.unknown)
        except TooLong:
            return Plan(tuple(steps), known, left=tuple(stage.left(known)), stopped=True)
        return Plan(tuple(steps), known)

    # -- three axes that meet ---------------------------------------------------------------------

    def _decoupled(self, joint: Spherical) -> Plan:
        """The joints on the other side of the centre, then the three that meet in it."""
        decoupling = self._decoupling(joint)
        first = self._follow(self._arm(decoupling))
        if not first.complete:
            return replace(first, decoupling=decoupling)
        second = self._follow(self._hand(decoupling))
        known = Knowledge.of(self.chain, self.chain.variables)
        for planned in (*first.steps, *second.steps):
            known = known.after(planned.subproblem.unknown)
        steps = (*first.steps, *second.steps)
        return Plan(steps, known, decoupling, second.left, stopped=second.stopped)

    def _decoupling(self, joint: Spherical) -> Decoupling:
        joints = tuple(self.chain.joint(row).variable for row in joint.rows)
        centre: dict[str, Scalar] = {}
        turn: dict[str, Scalar] = {}
        R, p = self.goal.R, self.goal.p
        if R is None:
            return Decoupling(joint, joints, centre, turn)
        alone = len(self.chain.variables) == len(joints)  # a wrist by itself: its centre stays where it is
        if None not in p and not alone and (joint.shoulder or joint.centre):
            place = ScalarMatrix.column([part for part in p if part is not None])
            seen = R.T @ (joint.centre - place) if joint.shoulder else place + R @ joint.centre
            names = [self.free_name(f"{axis}_{'s' if joint.shoulder else 'w'}") for axis in "xyz"]
            centre = dict(zip(names, seen.entries, strict=True))
        rest = self._rest(joint)
        if rest != ScalarMatrix.identity(3):
            left = R @ rest.T if joint.shoulder else rest.T @ R
            turn = {self.free_name(f"w_{i + 1}{j + 1}"): left[i, j] for i in range(3) for j in range(3)}
        return Decoupling(joint, joints, centre, turn)

    def _rest(self, joint: Spherical) -> ScalarMatrix:
        """The rotation of the arm before a wrist, or after a shoulder."""
        T = self.chain.T[joint.frame]
        return rotation_part(inverse_pose(T) @ self.chain.T_tool if joint.shoulder else T)

    def _arm(self, decoupling: Decoupling) -> Stage:
        """The joints before a wrist, or after a shoulder, by the position of its centre."""
        joint, home = decoupling.joint, singles(self.chain)
        variables = [name for name in self.chain.variables if name not in decoupling.joints]
        names = tuple(map(Scalar.symbol, decoupling.centre))
        if joint.shoulder:
            seen = centre_equations(Frames.of(self.chain, home, joint.frame), names, joint.inside)
            return Stage.of(seen, variables, self._points(decoupling), None)
        frames = Frames.of(self.chain, home, 0, joint.frame)
        equations = position_equations(frames, names or self.goal.p, joint.inside)
        return Stage.of(equations, variables, self._points(decoupling))

    def _hand(self, decoupling: Decoupling) -> Stage:
        """The three joints, by the orientation that is left to make."""
        joint, home = decoupling.joint, singles(self.chain)
        frames = Frames.of(self.chain, home, *((0, joint.frame) if joint.shoulder else (joint.frame,)))
        R = self.goal.R
        if decoupling.turn:
            names = list(map(Scalar.symbol, decoupling.turn))
            R = ScalarMatrix.of([names[3 * i : 3 * i + 3] for i in range(3)])
        equations = pose_equations(frames, R, None) if R is not None else ()
        return Stage.of(equations, decoupling.joints, self._points(decoupling), frames.base)

    def _points(self, decoupling: Decoupling) -> tuple[Point, ...]:
        named = {**decoupling.centre, **decoupling.turn}
        return tuple(
            {**point, **{name: scalar_number(value, point) for name, value in named.items()}}
            for point in self.points
        )
