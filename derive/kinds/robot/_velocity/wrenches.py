"""A force and a moment in the axes of the base, and the same in those of the frame in which they act."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point
from derive.derivation import Record
from derive.expression import ZERO, Expr, Symbol, column, transpose
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import TOOL, chain_of, oracle_of
from derive.kinds.robot._point import Tracked
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.poses import rotation_part
from derive.mechanics.task import ROWS
from derive.names import free


class Seen(Record):
    """What the words read of it: steps, and the frame."""

    given: tuple[str, ...]
    turned: tuple[str, ...]
    rotation: Symbol
    in_tool: bool  # it is given there


def rotation_of(found: Chain, point: Tracked) -> ScalarMatrix:
    """R (3 by 3) of the frame that carries a point."""
    return rotation_part(found.T[point.frame] if point.frame <= len(found.T_local) else found.T_tool)


@dataclass(frozen=True)
class Wrench:
    """Components along some rows (forces, then moments) where a point is, in the axes of the base or of the
    frame that carries the point."""

    problem: Problem
    point: Tracked
    components: dict[str, Expr]  # by rows, vx ... wz
    in_tool: bool
    outside: bool = False  # it is what the surroundings exert

    @property
    def _frame(self) -> str:
        """e of the tool, else the number of the frame that carries the point."""
        carried = self.point.frame <= len(chain_of(self.problem).T_local)
        return str(self.point.frame) if carried else TOOL

    @property
    def rotation(self) -> Symbol:
        return Symbol(f"R_{self._frame}^0")

    @cached_property
    def R(self) -> ScalarMatrix:
        return rotation_of(chain_of(self.problem), self.point)

    @cached_property
    def _halves(self) -> tuple[tuple[Symbol, tuple[Expr, ...]], ...]:
        """The force and the moment (3 each) as they are given; nothing for one of which nothing is said."""
        taken = self.problem.taken
        if self.outside:
            letters = free(taken, "f_ext", "f_o"), free(taken, "m_ext", "m_o")
        else:
            letters = free(taken, "f", "f_o"), free(taken, "m", "mu", "m_o")
        halves = (
            tuple(self.components.get(row, ZERO) for row in rows) if {*rows} & self.components.keys() else ()
            for rows in (ROWS[:3], ROWS[3:])
        )
        return tuple(zip(map(Symbol, letters), halves, strict=True))

    def _names(self, half: Symbol) -> tuple[Symbol, Symbol]:
        """As it is given, and seen from the other frame."""
        seen = Symbol(f"{half.name}^{self._frame}")
        return (seen, half) if self.in_tool else (half, seen)

    def lines(self, work: Work) -> Work:
        """What is given, then the same in the other axes."""
        work = work.knowing({self.rotation: self.problem.readable_matrix(self.R)})
        turn = self.rotation if self.in_tool else transpose(self.rotation)
        halves = [(*self._names(half), parts) for half, parts in self._halves if parts]
        for given, _, parts in halves:
            work = work.given(given, column(parts))
        for given, other, _ in halves:
            work = work.line(other, turn * given, rule="turned")
        return work

    def turned(self, work: Work) -> tuple[Expr, ...]:
        """The six components in the other axes, as they are on the board."""
        both = (work.entries(self._names(half)[1]) if parts else (ZERO,) * 3 for half, parts in self._halves)
        return tuple(chain.from_iterable(both))

    def seen(self) -> Seen:
        """What the words read."""
        names = [self._names(half) for half, parts in self._halves if parts]
        return Seen(
            given=tuple(given.name for given, _ in names),
            turned=tuple(other.name for _, other in names),
            rotation=self.rotation,
            in_tool=self.in_tool,
        )

    def numbers(self, at: Point) -> Any:
        """The six components in the other axes, by the pose in numbers."""
        import numpy as np

        oracle = oracle_of(self.problem)
        here = oracle.at(at)
        frames = {str(i): T for i, T in enumerate(oracle.poses(here))}
        frames |= {TOOL: oracle.tool(here)} if self.problem.subject.ends_in_tool else {}
        T = frames[self._frame]
        turn = T[:3, :3] if self.in_tool else T[:3, :3].T
        given = [float(arrays(self.components.get(row, ZERO), at)) for row in ROWS]
        return np.concatenate([turn @ given[:3], turn @ given[3:]])
