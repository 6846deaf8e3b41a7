"""Where the equations of a move are read: which entries of which product of poses."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from derive.expression import Call, Expr, Product, Symbol, transpose
from derive.kinds.robot._chain import TOOL
from derive.mechanics.inverse.equation import Equation, View


@dataclass(frozen=True, slots=True)
class Reading:
    """How the poses of a stage are called: `part` says what is compared (position, orientation or pose),
    `base` the frame in which it is known, `last` the last frame, `wanted` what is known, `point` whose
    position ("end-effector" or "wrist")."""

    part: str
    base: int
    last: str
    wanted: Symbol
    point: str = "end-effector"

    def of(self, equations: Iterable[Equation]) -> list[dict[str, Any]]:
        """For each view its entries and, where the pose was multiplied, the product and what it equals."""
        views: dict[View, list[Equation]] = {}
        for equation in equations:
            views.setdefault(equation.view, []).append(equation)
        return [self._one(view, sorted(each, key=lambda e: (e.row, e.col))) for view, each in views.items()]

    def _one(self, view: View, equations: list[Equation]) -> dict[str, Any]:
        return {
            "part": self.part,
            "point": self.point,
            "frame": view.first,
            "base": view.first == self.base and view.last is None,
            "entries": [f"({e.row + 1}, {e.col + 1})" for e in equations],
            "axes": ["xyz"[e.row] for e in equations],
            "position": all(e.is_position for e in equations) and view.last is None,
            "product": self._product(view),
            "equals": Symbol(f"{self._letter}_{self._end(view)}^{view.first}"),
        }

    @property
    def _letter(self) -> str:
        return "R" if self.part == "orientation" else "T"

    def _end(self, view: View) -> str:
        return self.last if view.last is None else str(view.last)

    def _product(self, view: View) -> Expr:
        factors: list[Expr] = [self.wanted]
        if view.first != self.base:
            factors.insert(0, self._inverse(Symbol(f"{self._letter}_{view.first}^{self.base}")))
        if view.last is not None:
            factors.append(self._inverse(Symbol(f"{self._letter}_{self.last}^{view.last}")))
        return Product(tuple(factors)) if len(factors) > 1 else factors[0]

    def _inverse(self, of: Symbol) -> Expr:
        return transpose(of) if self.part == "orientation" else Call("inverse", (of,))


def last_frame(rows: int, tool: bool) -> str:
    """The index of the end-effector's frame."""
    return TOOL if tool else str(rows)
