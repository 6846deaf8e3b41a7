"""The order in which the joint variables of an arm are found: a plan of named sub-problems.

An arm with a spherical wrist is decoupled: its first joints bring the centre of the wrist to its place, the
last three turn the end-effector (Pieper). Any other arm is taken as a whole.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from derive.algebra.angles import Form
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import Point, scalar_number
from derive.algebra.scalar import Scalar
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.budget import Budget, Spent
from derive.mechanics.inverse.equation import Equation, Frames, pose_equations, position_equations
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.knowledge import Knowledge, singles
from derive.mechanics.inverse.sample import Samples
from derive.mechanics.inverse.search import Found, Stage, equations_of
from derive.mechanics.inverse.slide import Slide
from derive.mechanics.inverse.squares import Reach
from derive.mechanics.inverse.wrist import Wrist, spherical_wrist
from derive.mechanics.poses import rotation_part


@dataclass(frozen=True, slots=True)
class Decoupling:
    """A spherical wrist: what stands for the place of its centre and for the orientation it has to make.

    `centre` are three names and what they stand for; `turn` likewise nine, of the orientation in the frame
    before the wrist. Empty where nothing needs a name.
    """

    wrist: Wrist
    centre: dict[str, Scalar]
    turn: dict[str, Scalar]


@dataclass(frozen=True, slots=True)
class Plan:
    """What was found in order; `left` are equations nobody could solve, empty where all joints are known.

    `conditions` hold no joint variable: only poses that fulfil them can be reached at all. `stopped` says
    that the budget of the search was spent.
    """

    found: tuple[tuple[Stage, Found], ...]
    knowledge: Knowledge
    decoupling: Decoupling | None = None
    left: tuple[Equation, ...] = ()
    conditions: tuple[Equation, ...] = ()
    stopped: bool = False

    @property
    def complete(self) -> bool:
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
        """Decoupled where there is a spherical wrist, as a whole otherwise."""
        wrist = spherical_wrist(self.chain) if self.goal.R is not None and not self.goal.angle else None
        if wrist is None:
            return self._whole()
        decoupling = self._decoupling(wrist)
        arm, turning = self._centre(decoupling), self._turning(decoupling)
        variables = self.chain.variables
        known = Knowledge.of(self.chain, variables[:-3])
        first = self._follow(arm, known) if known.unknown_joints() else Plan((), known)
        if not first.complete:
            return first
        second = self._follow(turning, Knowledge.of(self.chain, variables[-3:]))
        whole = Knowledge.of(self.chain, variables)
        left = second.left
        both = Knowledge(
            whole.runs,
            whole.slides,
            (*first.knowledge.forms, *second.knowledge.forms),
            first.knowledge.lengths | second.knowledge.lengths,
        )
        return Plan((*first.found, *second.found), both, decoupling, left, stopped=second.stopped)

    def _whole(self) -> Plan:
        home = singles(self.chain)
        frames = Frames.of(self.chain, home)
        goal = self.goal
        equations: list[Equation] = []
        if goal.R is not None and None not in goal.p:
            equations += pose_equations(frames, goal.R, [part for part in goal.p if part is not None])
        else:
            origin = ScalarMatrix.column((0, 0, 0))
            equations += position_equations(frames, goal.p, origin)
            if goal.R is not None:
                equations += pose_equations(frames, goal.R, None)
        stage = Stage.of(equations, self.chain.variables, Samples(self.points))
        plan = self._follow(stage, Knowledge.of(self.chain, self.chain.variables))
        conditions = tuple(self._conditions(equations))
        return Plan(plan.found, plan.knowledge, None, plan.left, conditions, plan.stopped)

    def _conditions(self, equations: Sequence[Equation]) -> Iterator[Equation]:
        for equation in equations:
            value = equation.right - equation.left
            plain = equation.view.first == 0 and equation.view.last is None
            if plain and value and not any(value.diff(name) for name in self.chain.variables):
                yield equation

    def _follow(self, stage: Stage, known: Knowledge) -> Plan:
        """One sub-problem after the other, each in what is known then."""
        found: list[tuple[Stage, Found]] = []
        try:
            while not known.complete:
                used = {equation.place for _, each in found for equation in equations_of(each)}
                here = stage.next(known, self.budget, used)
                if here is None:
                    return Plan(tuple(found), known, left=tuple(stage.left(known)))
                found.append((stage, here))
                known = learned(known, here)
        except Spent:
            return Plan(tuple(found), known, left=tuple(stage.left(known)), stopped=True)
        return Plan(tuple(found), known)

    # -- the spherical wrist ----------------------------------------------------------------------

    def _decoupling(self, wrist: Wrist) -> Decoupling:
        centre: dict[str, Scalar] = {}
        R = self.goal.R
        alone = len(self.chain.variables) == 3  # a wrist by itself: its centre stays where it is
        if R is not None and self.goal.whole_position and wrist.centre and not alone:
            arm = (R @ wrist.centre).entries
            parts = [part for part in self.goal.p if part is not None]
            names = [self.free_name(f"{axis}_w") for axis in "xyz"]
            centre = {name: p + c for name, p, c in zip(names, parts, arm, strict=True)}
        turn: dict[str, Scalar] = {}
        base = wrist.rows[0] - 1
        before = rotation_part(self.chain.T[base])
        if R is not None and before != ScalarMatrix.identity(3):
            seen = before.T @ R
            turn = {self.free_name(f"w_{i + 1}{j + 1}"): seen[i, j] for i in range(3) for j in range(3)}
        return Decoupling(wrist, centre, turn)

    def _centre(self, decoupling: Decoupling) -> Stage:
        """The joints before the wrist, by the position of its centre."""
        wrist, home = decoupling.wrist, singles(self.chain)
        frames = Frames.of(self.chain, home, 0, wrist.rows[0] - 1)
        goal = tuple(map(Scalar.symbol, decoupling.centre)) or self.goal.p
        equations = list(position_equations(frames, goal, wrist.before))
        return Stage.of(equations, self.chain.variables[:-3], self._samples(decoupling))

    def _turning(self, decoupling: Decoupling) -> Stage:
        """The joints of the wrist, by the orientation that is left to make."""
        home = singles(self.chain)
        frames = Frames.of(self.chain, home, decoupling.wrist.rows[0] - 1)
        R = self.goal.R
        if decoupling.turn:
            names = list(map(Scalar.symbol, decoupling.turn))
            R = ScalarMatrix.of([names[3 * i : 3 * i + 3] for i in range(3)])
        equations = list(pose_equations(frames, R, None)) if R is not None else []
        return Stage.of(equations, self.chain.variables[-3:], self._samples(decoupling), frames.base)

    def _samples(self, decoupling: Decoupling) -> Samples:
        named = {**decoupling.centre, **decoupling.turn}
        return Samples(
            tuple(
                {**point, **{name: scalar_number(value, point) for name, value in named.items()}}
                for point in self.points
            )
        )


def learned(known: Knowledge, found: Found) -> Knowledge:
    """What is known once a sub-problem is solved."""
    if isinstance(found, Slide | Reach):
        return known.with_length(found.slide)
    form: Form = found.angle
    return known.with_form(form)
