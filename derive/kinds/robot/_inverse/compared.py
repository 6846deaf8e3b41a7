"""Where the equations of a sub-problem are read: which entries of which product of poses."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from derive.expression import Call, Expr, Product, Symbol, transpose
from derive.kinds.robot._inverse.facts import Compared
from derive.mechanics.inverse.paul import Between, Equation


@dataclass(frozen=True, slots=True)
class Poses:
    """How the poses of a stage are called: T, or R where only orientations are compared; `base` is the frame
    in which `wanted` is known, None the end-effector's, `last` the index of the frame it leads to. The
    stage of the arm brings the centre of a spherical wrist or `shoulder` to its place, that of the hand
    turns the end-effector, that of the shoulder turns by the arm angle."""

    letter: str
    base: int | None
    last: str
    wanted: Symbol
    stage: Literal["whole", "arm", "shoulder", "hand"] = "whole"
    shoulder: bool = False

    def compared(self, equations: Iterable[Equation]) -> tuple[Compared, ...]:
        """For each product its entries and, where the pose was multiplied, what it equals."""
        found: dict[Between, list[Equation]] = {}
        for equation in equations:
            found.setdefault(equation.between, []).append(equation)
        return tuple(
            self._one(between, sorted(each, key=lambda e: (e.row, e.col))) for between, each in found.items()
        )

    def _one(self, between: Between, equations: list[Equation]) -> Compared:
        position = all(e.is_position for e in equations) and between.last is None
        base = between.first == self.base and between.last is None
        end = self._frame(between.last)
        return Compared(
            axes=tuple("xyz"[e.row] for e in equations) if position else (),
            entries=() if position else tuple(f"({e.row + 1}, {e.col + 1})" for e in equations),
            frame=None if base else between.first,
            centre=("shoulder" if self.shoulder else "wrist") if self.stage == "arm" else None,
            product=None if position else self._product(between),
            equals=None if base or position else Symbol(f"{self.letter}_{end}^{self._frame(between.first)}"),
        )

    def _product(self, between: Between) -> Expr:
        if between.reversed:
            return self._reversed(between)
        factors: list[Expr] = [self.wanted]
        if between.first != self.base:
            factors.insert(0, self._inverse(Symbol(f"{self.letter}_{between.first}^{self.base}")))
        if between.last is not None:
            factors.append(self._inverse(Symbol(f"{self.letter}_{self.last}^{between.last}")))
        return Product(tuple(factors)) if len(factors) > 1 else factors[0]

    def _reversed(self, between: Between) -> Expr:
        """(T_e^j) T^-1 T_i^0."""
        factors = [self._inverse(self.wanted)]
        if between.first is not None:
            factors.insert(0, Symbol(f"{self.letter}_{self.last}^{between.first}"))
        if between.last != self.base:
            factors.append(Symbol(f"{self.letter}_{between.last}^{self.base}"))
        return Product(tuple(factors)) if len(factors) > 1 else factors[0]

    def _frame(self, number: int | None) -> str:
        """The index of a frame, None that of the end-effector."""
        return self.last if number is None else str(number)

    def _inverse(self, of: Symbol) -> Expr:
        return transpose(of) if self.letter == "R" else Call("inverse", (of,))
