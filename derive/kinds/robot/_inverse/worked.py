"""An inverse as it was worked: its steps in order, and what its names stand for."""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from derive.derivation import Step
from derive.expression import Expr, Matrix, Symbol, atan2, free_symbols, number
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.facts import SingularWrist
from derive.kinds.robot._inverse.subproblem import Definition, Item, Solved
from derive.kinds.robot._inverse.turned import Turned
from derive.kinds.robot._inverse.wrist import singular
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.plan import Plan
from derive.mechanics.poses import position_part

PROVED = ("equation", "form", "squares", "solved", "split", "joined")


@dataclass(frozen=True, slots=True)
class Orientation:
    """What a spherical wrist has to make, by its `entries` and, where those are named, what they are
    (`wanted`); what it makes in its angles (`made`, of this `rotation`), by its `name`; and the rotation
    `before` it."""

    name: Symbol
    entries: Matrix
    wanted: tuple[Step, ...]
    made: Step
    rotation: Matrix
    before: Symbol


@dataclass(frozen=True)
class Worked:
    """`all_items` are the definitions and solved sub-problems; `pose` and `centre` the steps about what is
    given and where the centre of the wrist is, before the arm is solved; `orientation` comes before the
    wrist. `last` is the index of the end-effector's frame. A `by_angle` comes before the shoulder of an arm
    with seven joints."""

    problem: Problem
    chain: Chain
    goal: Goal
    plan: Plan
    all_items: tuple[Item, ...]
    pose: tuple[Step, ...]
    centre: tuple[Step, ...]
    orientation: Orientation | None
    last: str
    by_angle: Turned | None = None

    @cached_property
    def items(self) -> tuple[Item, ...]:
        """The solved sub-problems, and the definitions that are used."""
        used = {name for case in self.singular for name in free_symbols(case.step.result)}
        kept: list[Item] = []
        for item in reversed(self.all_items):
            if isinstance(item, Solved):
                used |= _names(item)
                kept.append(item)
            elif item.name.name in used:
                used |= free_symbols(item.value)
                kept.append(item)
        return tuple(reversed(kept))

    @cached_property
    def solved(self) -> tuple[Solved, ...]:
        """Every sub-problem, in order."""
        return tuple(item for item in self.all_items if isinstance(item, Solved))

    @property
    def arm(self) -> list[Solved]:
        """The sub-problems of all joints but those of a spherical wrist, and of a shoulder that is turned."""
        return [each for each in self.solved if each.stage not in ("hand", "shoulder")]

    @property
    def swung(self) -> list[Solved]:
        """The sub-problems of a shoulder that is turned by the arm angle."""
        return [each for each in self.solved if each.stage == "shoulder"]

    @cached_property
    def hand(self) -> tuple[tuple[Solved, ...], ...]:
        """The sub-problems of a spherical wrist, two together where they are solved alike."""
        each = [each for each in self.solved if each.stage == "hand"]
        if self.singular and len(each) > 1 and each[-2].facts.is_like(each[-1].facts):
            return (*((one,) for one in each[:-2]), (each[-2], each[-1]))
        return tuple((one,) for one in each)

    @cached_property
    def singular(self) -> tuple[SingularWrist, ...]:
        """What the wrist determines where its outer axes coincide."""
        first = next((each for each in self.solved if each.stage == "hand"), None)
        decoupling, found = self.plan.decoupling, self.orientation
        if first is None or decoupling is None or found is None:
            return ()
        method, joints = first.facts.method.name, decoupling.joints
        if method not in ("cosine", "sine") or first.head != Symbol(joints[1]):
            return ()
        return tuple(singular(found.rotation, found.entries, joints, method == "cosine"))

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """In the order of the page."""
        arm, swung = ([step for each in solved for step in each.steps] for solved in (self.arm, self.swung))
        hand = [step for together in self.hand for step in _steps(together)]
        singular_steps = (case.step for case in self.singular)
        turned: tuple[Step, ...] = ()
        if found := self.by_angle:
            turned = (*found.steps, found.made, *self.swung_elements)
        return (*self.pose, *self.centre, *arm, *turned, *swung, *self.turn, *hand, *singular_steps)

    @property
    def turn(self) -> tuple[Step, ...]:
        """What a wrist has to make, and what it makes."""
        turned = self.orientation
        return (*turned.wanted, turned.made, *self.elements) if turned else ()

    @cached_property
    def varying(self) -> tuple[int, ...]:
        """The coordinates of the end-effector that change, from 0."""
        p = position_part(self.chain.T_tool).entries
        return tuple(k for k in range(3) if any(p[k].diff(name) for name in self.chain.variables))

    @property
    def two_valued(self) -> list[Solved]:
        """The sub-problems at which there is a choice."""
        return [each for each in self.solved if each.two_valued]

    @property
    def at_end(self) -> bool:
        """Whether the centre of a wrist is the origin of the end-effector's frame, that of a shoulder the
        origin of the base frame."""
        return self.plan.decoupling is not None and not self.plan.decoupling.joint.centre

    @property
    def shoulder(self) -> bool:
        """Whether it is a spherical shoulder that was decoupled."""
        return self.plan.decoupling is not None and self.plan.decoupling.joint.shoulder

    @property
    def spherical(self) -> tuple[str, ...]:
        """The three joints of a spherical wrist or shoulder."""
        return self.plan.decoupling.joints if self.plan.decoupling else ()

    @cached_property
    def conditions(self) -> tuple[tuple[Expr, Expr], ...]:
        """What any pose that the arm reaches fulfils."""
        readable = self.problem.readable
        return tuple((readable(each.left), readable(each.right)) for each in self.plan.conditions)

    @cached_property
    def elements(self) -> tuple[Step, ...]:
        """The elements of the wrist's orientation that are used."""
        return self._told_of(self.plan.decoupling.turn if self.plan.decoupling else {})

    @cached_property
    def swung_elements(self) -> tuple[Step, ...]:
        """Those of a shoulder that is turned by the arm angle."""
        return self._told_of(self.by_angle.angle.turn if self.by_angle else {})

    def _told_of(self, names: Container[str]) -> tuple[Step, ...]:
        """What those of these names stand for that are used."""
        return tuple(
            Step(item.name.name, (item.name, item.value), "name")
            for item in self.items
            if isinstance(item, Definition) and item.name.name in names
        )

    @cached_property
    def definitions(self) -> dict[Expr, Expr]:
        """Every name in the equations, in the joint variables or in other names."""
        T = self.chain.T_tool
        found: dict[Expr, Expr] = {
            Symbol(name): self.problem.readable(T[i, j]) for name, (i, j) in self.goal.places.items()
        }
        if self.goal.angle:
            first, second, place = self.goal.plane
            cosine, sine = (self.problem.readable(T[k, place]) for k in (first, second))
            found[Symbol(self.goal.angle)] = atan2(sine, cosine)
        found |= {item.name: item.value for item in self.items if isinstance(item, Definition)}
        found |= {
            each.head: number(2) * each.facts.method.half for each in self.solved if each.facts.method.half
        }
        if self.plan.angle:
            sides = self.plan.angle.swing(self.chain)
            found[Symbol(self.plan.angle.psi)] = atan2(*map(self.problem.readable, sides))
        return found | {each.named: each.head for each in self.solved if each.named}

    @property
    def conditional(self) -> list[str]:
        """The steps that hold in some configurations only, or are told beside the others; each of the rest
        holds with the forward kinematics put in for what is given."""
        return [step.name for step in self.steps if step.rule not in PROVED]


def _steps(together: Sequence[Solved]) -> Iterator[Step]:
    """In the order of the page: of two that are solved alike the equations first."""
    if len(together) == 1:
        yield from together[0].steps
        return
    yield from (step for each in together for step in each.facts.equations)
    yield from (step for each in together for step in each.facts.choices)


def _names(solved: Solved) -> set[str]:
    """Every name in a solved sub-problem."""
    trees = [choice.value for choice in solved.choices]
    trees += [value for trig in solved.trig.values() for value in trig.values()]
    trees += [expr for step in solved.steps for expr in step.chain]
    return {name for tree in trees for name in free_symbols(tree)}
