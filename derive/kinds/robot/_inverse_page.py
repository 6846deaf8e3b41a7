"""The page of an inverse: what is given, the moves in order, and what they rest on."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Step, Table
from derive.expression import (
    Expr,
    Matrix,
    Product,
    Symbol,
    add,
    atan2,
    column,
    free_symbols,
    multiply,
    transpose,
)
from derive.kinds.checks import links
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse_branches import Solutions
from derive.kinds.robot._inverse_moves import Definition, Item, Move
from derive.kinds.robot._inverse_views import Reading, last_frame
from derive.kinds.robot._inverse_writing import Writer
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.equation import Equation
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.plan import Decoupling, Plan
from derive.mechanics.inverse.search import equations_of
from derive.mechanics.poses import homogeneous, inverse_pose, rotation_part

CHECKED = ("equation", "squares", "solved")  # steps that hold for every configuration of the arm


class Page:
    """Built once from a plan; read by the kind."""

    def __init__(
        self, problem: Problem, chain: Chain, goal: Goal, plan: Plan, free_name: Callable[[str], str]
    ) -> None:
        self.problem, self.chain, self.goal, self.plan = problem, chain, goal, plan
        self.last = last_frame(len(chain.joints), problem.subject.ends_in_tool)
        turning = [joint.variable for _, joint in chain.moving if joint.type == "revolute"]
        self.writer = Writer(problem, goal, turning, free_name)
        self.opening: list[Step] = [*self._given()]
        self.turning: list[Step] = []
        self._write()

    # -- what the kind reads ----------------------------------------------------------------------

    @cached_property
    def items(self) -> tuple[Item, ...]:
        """The definitions that are used, and the moves."""
        used: set[str] = set()
        kept: list[Item] = []
        for item in reversed(self.writer.items):
            if isinstance(item, Definition):
                if item.name.name in used:
                    used |= free_symbols(item.value)
                    kept.append(item)
                continue
            for option in item.options:
                used |= free_symbols(option.value)
            for trig in item.trig.values():
                used |= {name for value in trig.values() for name in free_symbols(value)}
            for step in item.steps:
                used |= {name for expr in step.chain for name in free_symbols(expr)}
            kept.append(item)
        return tuple(reversed(kept))

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        moves = [item for item in self.items if isinstance(item, Move)]
        turned = [*self.turning, *self._turn_entries()]
        found: list[Step] = list(self.opening)
        for move in moves:
            if move.facts["stage"] == "wrist" and turned:
                found += turned
                turned = []
            found += move.steps
        return tuple(found)

    @cached_property
    def definitions(self) -> dict[Expr, Expr]:
        """Every name in the equations, in the joint variables or in other names."""
        found: dict[Expr, Expr] = {}
        T = self.chain.T_tool
        for name, (i, j) in self.goal.places.items():
            found[Symbol(name)] = self.problem.readable(T[i, j])
        if self.goal.angle:
            first, second, place = self.goal.plane
            cosine, sine = (self.problem.readable(T[k, place]) for k in (first, second))
            found[Symbol(self.goal.angle)] = atan2(sine, cosine)
        found |= {item.name: item.value for item in self.items if isinstance(item, Definition)}
        return found

    def claims(self) -> tuple[Claim, ...]:
        """Every equation holds with the forward kinematics put in for what is given."""
        checked = [step for step in self.steps if step.rule in CHECKED]
        return links(checked, {**self.problem.names, **self.definitions})

    def facts(self, solutions: Solutions, values: Mapping[str, Any]) -> dict[str, Any]:
        moves = [item for item in self.items if isinstance(item, Move)]
        wrist = self.plan.decoupling
        return {
            "triangle": False,
            "pose": any(step.name == "T" for step in self.opening),
            "given": [Symbol(name) for name in self.goal.names],
            "whole": len(self.goal.names) > 9,
            "orientation": len(self.goal.names) == 9,
            "angle": Symbol(self.goal.angle) if self.goal.angle else None,
            "plane": ["xyz"[k] for k in self.goal.plane[:2]],
            "plane_axis": "xyz"[self.goal.plane[2]],
            "moves": [move.facts for move in moves],
            "arm": [m.facts for m in moves if m.facts["stage"] == "arm"],
            "wrist": [m.facts for m in moves if m.facts["stage"] == "wrist"],
            "decoupled": wrist is not None,
            "centre": any(step.name == "p_w" for step in self.opening),
            "at_end": wrist is not None and not wrist.wrist.centre,
            "wrist_joints": list(wrist.wrist.rows) if wrist else [],
            "turn": [step.name for step in self.turning],
            "turn_entries": [step.name for step in self._turn_entries()],
            "conditions": [self._condition(equation) for equation in self.plan.conditions],
            "rotation_before": Symbol(f"R_{wrist.wrist.rows[0] - 1}^0") if wrist else None,
            "tree": self._tree(moves, solutions),
            "count": len(solutions.chosen),
            "chosen": [move.head for move in moves if any(option.sign for option in move.options)],
            "order": [Symbol(name) for name in solutions.order],
            "nested": solutions.nested,
            "out_of_reach": bool(values) and all(s.get("real") is False for s in values["solutions"]),
        }

    def _tree(self, moves: list[Move], solutions: Solutions) -> Table | None:
        """Which of the two values each solution takes, where there are several choices."""
        two = [move for move in moves if any(option.sign for option in move.options)]
        if len(two) < 2:
            return None
        names = {1: "first", -1: "second"}
        rows = [
            (str(k), *(names[taken[move.number].sign] for move in two))
            for k, taken in enumerate(solutions.chosen, 1)
        ]
        return Table(("solution", *(move.head for move in two)), tuple(rows))

    def _condition(self, equation: Equation) -> tuple[Expr, ...]:
        return tuple(self.problem.readable(side) for side in (equation.left, equation.right))

    # -- how it is built --------------------------------------------------------------------------

    def _given(self) -> list[Step]:
        """The known pose by its entries."""
        if self.goal.angle and self.goal.R is not None and self.goal.whole_position:
            p = [part for part in self.goal.p if part is not None]
            return [Step("T", (Symbol("T"), self.problem.readable_matrix(homogeneous(self.goal.R, p))), "given")]
        if len(self.goal.names) < 9:
            return []
        R = tuple(tuple(Symbol(f"r{i}{j}") for j in (1, 2, 3)) for i in (1, 2, 3))
        if len(self.goal.names) == 9:
            return [Step("R", (Symbol("R"), Matrix(R)), "given")]
        rows = tuple((*row, Symbol(axis)) for row, axis in zip(R, "xyz", strict=True))
        zero, one = (self.problem.readable(Scalar.of(n)) for n in (0, 1))
        return [Step("T", (Symbol("T"), Matrix((*rows, (zero, zero, zero, one)))), "given")]

    def _write(self) -> None:
        decoupling = self.plan.decoupling
        if decoupling and decoupling.centre:
            self.opening.append(self._centre(decoupling))
        turned = False
        for stage, found in self.plan.found:
            wrist = decoupling is not None and stage.base == decoupling.wrist.rows[0] - 1 and self._turns(found)
            if wrist and decoupling and not turned:
                self._turn(decoupling)
                turned = True
            reading = self._reading(wrist)
            facts = {"stage": "wrist" if wrist else "arm", "views": reading.of(equations_of(found))}
            self.writer.write(stage, found, facts)

    def _turns(self, found: Any) -> bool:
        names = self.chain.variables[-3:]
        angle = getattr(found, "angle", None)
        return angle is not None and all(atom in names for atom, _ in angle.parts)

    def _reading(self, wrist: bool) -> Reading:
        decoupling = self.plan.decoupling
        if wrist and decoupling:
            base = decoupling.wrist.rows[0] - 1
            wanted = Symbol(f"R_{self.last}^{base}") if decoupling.turn else Symbol("R")
            return Reading("orientation", base, self.last, wanted)
        if decoupling:
            return Reading("position", 0, self.last, Symbol("p_w"), "center of the wrist")
        if self.goal.R is None:
            return Reading("position", 0, self.last, Symbol("p"))
        part = "pose" if self.goal.whole_position else "orientation"
        return Reading(part, 0, self.last, Symbol("T" if part == "pose" else "R"))

    def _centre(self, decoupling: Decoupling) -> Step:
        """p_w = p + R (centre in the end-effector's frame)."""
        names = [self.writer.define(name, value) for name, value in decoupling.centre.items()]
        p = column(Symbol(axis) for axis in "xyz")
        inside = self.problem.readable_matrix(decoupling.wrist.centre)
        entries = column(self.writer.value_of(name) for name in names)
        whole = add(p, multiply(Symbol("R"), inside))
        return Step("p_w", (Symbol("p_w"), column(names), whole, entries), "centre")

    def _turn(self, decoupling: Decoupling) -> None:
        """The orientation left for the wrist: what it has to be, and what it is in the wrist's angles."""
        base = decoupling.wrist.rows[0] - 1
        name = Symbol(f"R_{self.last}^{base}")
        made = self.problem.readable_matrix(rotation_part(inverse_pose(self.chain.T[base]) @ self.chain.T_tool))
        if not decoupling.turn:
            self.turning.append(Step("turn_made", (Symbol("R"), made), "turn"))
            return
        symbols = [self.writer.define(each, value) for each, value in decoupling.turn.items()]
        rows = tuple(tuple(symbols[3 * i : 3 * i + 3]) for i in range(3))
        product = Product((transpose(Symbol(f"R_{base}^0")), Symbol("R")))
        self.turning.append(Step("turn", (name, product, Matrix(rows)), "turn"))
        self.turning.append(Step("turn_made", (name, made), "turn"))

    def _turn_entries(self) -> list[Step]:
        """The entries of that orientation that are used."""
        decoupling = self.plan.decoupling
        if decoupling is None:
            return []
        return [
            Step(item.name.name, (item.name, item.value), "name")
            for item in self.items
            if isinstance(item, Definition) and item.name.name in decoupling.turn
        ]
