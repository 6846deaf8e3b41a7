"""The page of an inverse: its steps in order, what its names stand for, and what the words need to know."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from derive.derivation import Claim, Step, Table
from derive.expression import Expr, Matrix, Symbol, atan2, free_symbols
from derive.kinds.checks import links
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.branches import Solutions
from derive.kinds.robot._inverse.moves import Definition, Item, Move
from derive.kinds.robot._inverse.opening import Opened
from derive.kinds.robot._inverse.singular import Case, cases
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.equation import Equation
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.plan import Plan

CHECKED = ("equation", "squares", "solved")  # steps that hold for every configuration of the arm
FIRST_AND_SECOND = {1: "first", -1: "second"}


@dataclass(frozen=True)
class Page:
    """What was written, read in several ways."""

    problem: Problem
    chain: Chain
    goal: Goal
    plan: Plan
    opened: Opened

    @cached_property
    def items(self) -> tuple[Item, ...]:
        """The moves, and the definitions that are used."""
        used = {name for case in self.singular for name in free_symbols(case.value)}
        kept: list[Item] = []
        for item in reversed(self.opened.items):
            if isinstance(item, Move):
                used |= _names(item)
                kept.append(item)
            elif item.name.name in used:
                used |= free_symbols(item.value)
                kept.append(item)
        return tuple(reversed(kept))

    @cached_property
    def moves(self) -> tuple[Move, ...]:
        return tuple(item for item in self.opened.items if isinstance(item, Move))

    def stage(self, name: str) -> list[Move]:
        """The moves of the "arm", or of the "wrist"."""
        return [move for move in self.moves if move.facts["stage"] == name]

    @cached_property
    def singular(self) -> tuple[Case, ...]:
        """What the wrist determines where its outer axes coincide."""
        first = next(iter(self.stage("wrist")), None)
        joints = self.chain.variables[-3:]
        if (
            first is None
            or first.facts["method"] not in ("cosine", "sine")
            or first.head != Symbol(joints[1])
        ):
            return ()
        made = self.opened.turn[-1].result
        if not isinstance(made, Matrix):
            return ()
        outer = (joints[0], joints[1], joints[2])
        return tuple(cases(made, self._wanted(), outer, first.facts["method"] == "cosine"))

    def _wanted(self) -> Matrix:
        """What the wrist's rotation has to be, entry by entry."""
        decoupling = self.plan.decoupling
        names = list(decoupling.turn) if decoupling else []
        names = names or [f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
        return Matrix(tuple(tuple(map(Symbol, names[3 * i : 3 * i + 3])) for i in range(3)))

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """In the order of the page."""
        arm, wrist = ([step for move in self.stage(s) for step in move.steps] for s in ("arm", "wrist"))
        return (*self.opened.given, *arm, *self.opened.turn, *self.turn_entries, *wrist, *self.singular_steps)

    @cached_property
    def turn_entries(self) -> tuple[Step, ...]:
        """The entries of the wrist's orientation that are used."""
        names = self.plan.decoupling.turn if self.plan.decoupling else {}
        return tuple(
            Step(item.name.name, (item.name, item.value), "name")
            for item in self.items
            if isinstance(item, Definition) and item.name.name in names
        )

    @cached_property
    def singular_steps(self) -> tuple[Step, ...]:
        return tuple(
            Step(f"singular_{k}", (case.determined, case.value), "singular", {"middle": case.middle})
            for k, case in enumerate(self.singular, 1)
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
        return found | {item.name: item.value for item in self.items if isinstance(item, Definition)}

    def claims(self) -> tuple[Claim, ...]:
        """Every equation holds with the forward kinematics put in for what is given."""
        checked = [step for step in self.steps if step.rule in CHECKED]
        return links(checked, {**self.problem.names, **self.definitions})

    # -- for the words ----------------------------------------------------------------------------

    def facts(self, solutions: Solutions) -> dict[str, Any]:
        """What the words choose their sentences by."""
        goal = self.goal
        return {
            "triangle": False,
            "pose": goal.R is not None and goal.whole_position,
            "orientation": goal.R is not None and not goal.whole_position,
            "angle": Symbol(goal.angle) if goal.angle else None,
            "plane": ["xyz"[k] for k in goal.plane[:2]],
            "plane_axis": "xyz"[goal.plane[2]],
            "conditions": [self._condition(equation) for equation in self.plan.conditions],
            "arm": [move.facts for move in self.stage("arm")],
            "wrist": [self._wrist_facts(move) for move in self.stage("wrist")],
            "tree": self._tree(solutions),
            "count": len(solutions.chosen),
            "chosen": [move.head for move in self._two_valued()],
            **self._decoupled(),
        }

    def _decoupled(self) -> dict[str, Any]:
        decoupling = self.plan.decoupling
        if decoupling is None:
            return {"decoupled": False, "singular": []}
        rows = decoupling.wrist.rows
        middle = Symbol(self.chain.variables[-2])
        return {
            "decoupled": True,
            "centre": bool(decoupling.centre),
            "turned": bool(decoupling.turn),
            "at_end": not decoupling.wrist.centre,
            "wrist_joints": list(rows),
            "rotation_before": Symbol(f"R_{rows[0] - 1}^0"),
            "turn_entries": [step.name for step in self.turn_entries],
            "singular": [
                {"step": step.name, "middle": (middle, step.facts["middle"])} for step in self.singular_steps
            ],
        }

    def _two_valued(self) -> list[Move]:
        return [move for move in self.moves if move.chosen]

    def _wrist_facts(self, move: Move) -> Mapping[str, Any]:
        """What happens where the outer axes coincide is said once."""
        return {**move.facts, "unless": []} if self.singular and move.facts.get("factor") else move.facts

    def _tree(self, solutions: Solutions) -> Table | None:
        """Which of the two values each solution takes, where there are several choices."""
        two = self._two_valued()
        if len(two) < 2:
            return None
        rows = tuple(
            (str(k), *(FIRST_AND_SECOND[taken[move.number].sign] for move in two))
            for k, taken in enumerate(solutions.chosen, 1)
        )
        return Table(("solution", *(move.head for move in two)), rows)

    def _condition(self, equation: Equation) -> tuple[Expr, ...]:
        return tuple(self.problem.readable(side) for side in (equation.left, equation.right))


def _names(move: Move) -> set[str]:
    """Every name in a move."""
    trees = [option.value for option in move.options]
    trees += [value for trig in move.trig.values() for value in trig.values()]
    trees += [expr for step in move.steps for expr in step.chain]
    return {name for tree in trees for name in free_symbols(tree)}
