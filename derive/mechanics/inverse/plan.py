"""The order in which the joint variables of an arm are found: a plan of named sub-problems.

An arm with a spherical wrist is decoupled: its first joints bring the centre of the wrist to its place, the
last three turn the end-effector (Pieper 1968). Any other arm is taken as a whole.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import Point, scalar_number
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import TooLong
from derive.mechanics.budget import Budget
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.known import Knowledge, singles
from derive.mechanics.inverse.paul import Equation, Frames, pose_equations, position_equations
from derive.mechanics.inverse.search import Stage
from derive.mechanics.inverse.subproblems import SubProblem, equations_of
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
class Planned:
    """A sub-problem, the equations it was found in, and what is known before it is solved."""

    stage: Stage
    known: Knowledge
    subproblem: SubProblem


@dataclass(frozen=True, slots=True)
class Plan:
    """The sub-problems in order; `left` are equations nobody could solve, empty where all joints are known.

    `conditions` hold no joint variable: only poses that fulfil them can be reached at all. `stopped` says
    that the budget of the search was spent.
    """

    steps: tuple[Planned, ...]
    knowledge: Knowledge
    decoupling: Decoupling | None = None
    left: tuple[Equation, ...] = ()
    conditions: tuple[Equation, ...] = ()
    stopped: bool = False

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
        """Decoupled where there is a spherical wrist, as a whole otherwise."""
        wrist = spherical_wrist(self.chain) if self.goal.R is not None and not self.goal.angle else None
        if wrist is None:
            return self._whole()
        decoupling = self._decoupling(wrist)
        first = self._follow(self._arm(decoupling))
        if not first.complete:
            return first
        second = self._follow(self._hand(decoupling))
        known = Knowledge.of(self.chain, self.chain.variables)
        for planned in (*first.steps, *second.steps):
            known = known.after(planned.subproblem.unknown)
        steps = (*first.steps, *second.steps)
        return Plan(steps, known, decoupling, second.left, stopped=second.stopped)

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
                if found is None:
                    return Plan(tuple(steps), known, left=tuple(stage.left(known)))
                steps.append(Planned(stage, known, found))
                known = known.after(found.unknown)
        except TooLong:
            return Plan(tuple(steps), known, left=tuple(stage.left(known)), stopped=True)
        return Plan(tuple(steps), known)

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

    def _arm(self, decoupling: Decoupling) -> Stage:
        """The joints before the wrist, by the position of its centre."""
        wrist = decoupling.wrist
        frames = Frames.of(self.chain, singles(self.chain), 0, wrist.rows[0] - 1)
        goal = tuple(map(Scalar.symbol, decoupling.centre)) or self.goal.p
        equations = position_equations(frames, goal, wrist.before)
        return Stage.of(equations, self.chain.variables[:-3], self._points(decoupling))

    def _hand(self, decoupling: Decoupling) -> Stage:
        """The joints of the wrist, by the orientation that is left to make."""
        frames = Frames.of(self.chain, singles(self.chain), decoupling.wrist.rows[0] - 1)
        R = self.goal.R
        if decoupling.turn:
            names = list(map(Scalar.symbol, decoupling.turn))
            R = ScalarMatrix.of([names[3 * i : 3 * i + 3] for i in range(3)])
        equations = pose_equations(frames, R, None) if R is not None else ()
        return Stage.of(equations, self.chain.variables[-3:], self._points(decoupling), frames.base)

    def _points(self, decoupling: Decoupling) -> tuple[Point, ...]:
        named = {**decoupling.centre, **decoupling.turn}
        return tuple(
            {**point, **{name: scalar_number(value, point) for name, value in named.items()}}
            for point in self.points
        )
