"""From a plan to the board: what is given, the decoupling, and every move in its stage."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from derive.algebra.angles import Form
from derive.algebra.scalar import Scalar
from derive.derivation import Step
from derive.expression import Matrix, Product, Symbol, add, column, multiply, transpose
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.board import Board
from derive.kinds.robot._inverse.moves import Item
from derive.kinds.robot._inverse.views import Reading, last_frame
from derive.kinds.robot._inverse.writing import write
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.plan import Decoupling, Plan
from derive.mechanics.inverse.search import Found, equations_of
from derive.mechanics.poses import homogeneous, inverse_pose, rotation_part


@dataclass(frozen=True, slots=True)
class Opened:
    """The board as it was written: `given` are the steps before the moves, `turn` those about the orientation
    the wrist has to make."""

    items: tuple[Item, ...]
    given: tuple[Step, ...]
    turn: tuple[Step, ...]


@dataclass(frozen=True, slots=True)
class Opening:
    """What the steps before and between the moves are made from."""

    problem: Problem
    chain: Chain
    goal: Goal
    plan: Plan
    free_name: Callable[[str], str]

    def written(self) -> Opened:
        """The whole board."""
        board = Board(self.problem, self.goal, self._turning(), self.free_name)
        decoupling = self.plan.decoupling
        given, turn = self._given(), tuple[Step, ...]()
        if decoupling and decoupling.centre:
            given = (*given, self._centre(board, decoupling))
        for stage, found in self.plan.found:
            wrist = decoupling is not None and self._turns_wrist(found)
            if wrist and decoupling and not turn:
                turn = self._turn(board, decoupling)
            facts = {
                "stage": "wrist" if wrist else "arm",
                "views": self._reading(wrist).of(equations_of(found)),
            }
            write(board, stage, found, facts)
        return Opened(tuple(board.items), given, turn)

    @property
    def last(self) -> str:
        """The index of the end-effector's frame."""
        return last_frame(len(self.chain.joints), self.problem.subject.ends_in_tool)

    def _turning(self) -> list[str]:
        return [joint.variable for _, joint in self.chain.moving if joint.type == "revolute"]

    def _turns_wrist(self, found: Found) -> bool:
        angle = getattr(found, "angle", None)
        return isinstance(angle, Form) and all(atom in self.chain.variables[-3:] for atom, _ in angle.parts)

    def _given(self) -> tuple[Step, ...]:
        """The known pose by its entries, where it is one."""
        R = self.goal.R
        if R is None:
            return ()
        if not self.goal.whole_position:
            return (Step("R", (Symbol("R"), self.problem.readable_matrix(R)), "given"),)
        T = homogeneous(R, [part for part in self.goal.p if part is not None])
        return (Step("T", (Symbol("T"), self.problem.readable_matrix(T)), "given"),)

    def _reading(self, wrist: bool) -> Reading:
        """How the poses are called in which the equations of a stage stand."""
        decoupling, goal = self.plan.decoupling, self.goal
        if wrist and decoupling:
            base = decoupling.wrist.rows[0] - 1
            wanted = Symbol(f"R_{self.last}^{base}") if decoupling.turn else Symbol("R")
            return Reading("orientation", base, self.last, wanted)
        if decoupling:
            return Reading("position", 0, self.last, Symbol("p_w"), "center of the wrist")
        if goal.R is None:
            return Reading("position", 0, self.last, Symbol("p"))
        part = "pose" if goal.whole_position else "orientation"
        return Reading(part, 0, self.last, Symbol("T" if part == "pose" else "R"))

    def _centre(self, board: Board, decoupling: Decoupling) -> Step:
        """p_w = p + R (centre in the end-effector's frame)."""
        names = [board.define(name, value) for name, value in decoupling.centre.items()]
        p = column(self.problem.readable(part or Scalar.of(0)) for part in self.goal.p)
        whole = add(p, multiply(Symbol("R"), self.problem.readable_matrix(decoupling.wrist.centre)))
        return Step(
            "p_w", (Symbol("p_w"), column(names), whole, column(map(board.value_of, names))), "centre"
        )

    def _turn(self, board: Board, decoupling: Decoupling) -> tuple[Step, ...]:
        """The orientation left for the wrist: what it has to be, and what it is in the wrist's angles."""
        base = decoupling.wrist.rows[0] - 1
        rest = rotation_part(inverse_pose(self.chain.T[base]) @ self.chain.T_tool)
        made = self.problem.readable_matrix(rest)
        if not decoupling.turn:
            return (Step("turn_made", (Symbol("R"), made), "turn"),)
        symbols = [board.define(each, value) for each, value in decoupling.turn.items()]
        rows = tuple(tuple(symbols[3 * i : 3 * i + 3]) for i in range(3))
        name, before = Symbol(f"R_{self.last}^{base}"), Symbol(f"R_{base}^0")
        wanted = (name, Product((transpose(before), Symbol("R"))), Matrix(rows))
        return (Step("turn", wanted, "turn"), Step("turn_made", (name, made), "turn"))
