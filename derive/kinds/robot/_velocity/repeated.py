"""A table of iterations done again in NumPy, from the table as it is printed: with poses and Jacobians of the
oracle each row has to follow from the one before."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import number
from derive.derivation import Claim, Phrase, Said, Table
from derive.expression import Expr, Relation, Symbol
from derive.kinds.checks import close, route
from derive.kinds.fields import TREES
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._velocity.task import Task
from derive.mechanics.iteration import Verdict
from derive.mechanics.task import ROWS

if TYPE_CHECKING:
    from numpy.typing import NDArray

NEAR = 1e-7  # of an error, a step, relative to their sizes
REACHED = 1e-10  # an error that is none
RANK, LEVEL = 1e-7, 1e-8  # a singular value, a slope that is none
ROUNDING = 1e-14  # of an error


@dataclass(frozen=True, slots=True)
class Row:
    """One line of the table: its number, every name with the joint variables under their headings, and the
    error."""

    k: float
    at: dict[str, float]
    error: float


@dataclass(frozen=True)
class Repeated:
    """`here` holds a value for every name of the arm, `turning` the joints whose sum the angle is, `step` the
    fixed one of the gradient method (None: the best), `most` the number of steps that were asked for."""

    task: Task
    here: Mapping[str, float]
    turning: Sequence[str]
    target: Sequence[float]
    method: str
    step: float | None
    most: int

    def claims(
        self,
        table: Table,
        listed: Sequence[Sequence[float]],
        start: Mapping[str, float],
        verdict: Verdict,
        told: Mapping[str, float],
    ) -> Iterator[Claim]:
        """About the table and the same rows as the JSON has them, how it is said to have ended, and the joint
        variables `told` beside it."""
        rows = [self._row(table, row) for row in table.rows]
        first, last, names = rows[0], rows[-1], self.task.found.variables
        yield route("begun", (close(first.at[name], start[name]) for name in names))
        yield route("numbered", (row.k == k for k, row in enumerate(rows)))
        yield route("errors", map(self._measured, rows))
        if len(rows) > 1:
            yield route("steps-repeated", (self._follows(*pair) for pair in pairwise(rows)))
        yield route("ended", self._ended(first, last, verdict) and self._went_on(rows, verdict))
        told_rows = ([row.k, *(row.at[name] for name in names), row.error, row.error**2 / 2] for row in rows)
        yield route("as-listed", map(partial(close, tolerance=NEAR), told_rows, listed))
        yield route("last-row", (told.get(name) == last.at[name] for name in names))

    def stops(self, last: Mapping[str, float], J: Expr, e: Expr | None = None) -> Claim:
        """That the Jacobian, and the error, that are shown are those of the last row."""
        shown = [close(arrays(J, {}), self.task.numbers(last), NEAR)]
        if e is not None:
            shown.append(close(arrays(e, {}), self._gap(last), NEAR))
        return route("there", shown)

    def tells(self, error: Said, at: Mapping[str, float]) -> bool:
        """Whether the error is what is said, e = r_d - f."""
        if not isinstance(error, Relation) or error.sign != "=" or isinstance(error.left, Relation):
            return False
        import numpy as np

        names = {"e": self._gap(at), "r_d": np.array(self.target), "f": np.array(self.place(at))}
        return close(arrays(error.left, names), arrays(error.right, names), NEAR)

    def _row(self, table: Table, row: Sequence[Any]) -> Row:
        """By the headings: k, the joint variables, the error."""
        *numbers, last = row
        k, *q = (number(cell, {}) for cell in numbers)
        error = self._none(last) if isinstance(last, Phrase) else number(last, {})
        names = [heading.name for heading in table.headings[1:-1] if isinstance(heading, Symbol)]
        return Row(k, {**self.here, **dict(zip(names, q, strict=True))}, error)

    @staticmethod
    def _none(below: Phrase) -> float:
        """Zero, for an error that is below what counts as none."""
        bound = below.about["bound"]
        return 0.0 if isinstance(bound, TREES) and number(bound, {}) == REACHED else math.nan

    def place(self, at: Mapping[str, float]) -> NDArray[Any]:
        """f(q)."""
        import numpy as np

        p = oracle_of(self.task.problem).tool(at)[:3, 3]
        return np.array([self._turn(at) if row == "wz" else p[ROWS.index(row)] for row in self.task.rows])

    def _gap(self, at: Mapping[str, float]) -> NDArray[Any]:
        """r - f(q)."""
        import numpy as np

        return np.array(self.target - self.place(at))

    def _turn(self, at: Mapping[str, float]) -> float:
        """How far the end-effector has turned from where the joints are at zero; whole turns are counted by
        the joints."""
        tool = oracle_of(self.task.problem).tool
        R = tool(at)[:3, :3] @ tool({**at, **dict.fromkeys(self.turning, 0.0)})[:3, :3].T
        angle, counted = math.atan2(R[1, 0], R[0, 0]), sum(at[name] for name in self.turning)
        return angle + 2 * math.pi * round((counted - angle) / (2 * math.pi))

    def _measured(self, row: Row) -> bool:
        """Whether the error is that of its joint variables."""
        return abs(math.hypot(*self._gap(row.at)) - row.error) < (NEAR if row.error else REACHED)

    def _follows(self, row: Row, after: Row) -> bool:
        """Newton: the least step with J dq = e, or nearest to it. Gradient: along J^T e, by the fixed step or
        as far as |e - J dq| falls."""
        import numpy as np

        J, e = self.task.numbers(row.at), self._gap(row.at)
        dq = np.array([after.at[name] - row.at[name] for name in self.task.found.variables])
        if self.method == "newton":
            return _nearest(J, e, dq)
        down = J.T @ e
        if self.step is not None:
            return close(dq, self.step * down, NEAR)
        length, slope, moved = np.linalg.norm(dq), np.linalg.norm(down), J @ dq
        near = NEAR + ROUNDING / float(np.linalg.norm(e) or ROUNDING)
        along = min(length, slope) > 0 and close(dq / length, down / slope, near)
        most = NEAR * float(moved @ moved) + ROUNDING * length
        return bool(along and abs((e - moved) @ moved) <= most)

    def _went_on(self, rows: Sequence[Row], verdict: Verdict) -> bool:
        """Whether all steps were made that were asked for, where nothing ended them before."""
        made = len(rows) - 1
        return made == self.most if verdict in ("unfinished", "diverging") else made <= self.most

    def _ended(self, first: Row, last: Row, verdict: Verdict) -> bool:
        """Whether that is how the table ends."""
        import numpy as np

        J, e = self.task.numbers(last.at), self._gap(last.at)
        error = np.linalg.norm(e)
        sizes = np.linalg.svd(J, compute_uv=False)
        match verdict:
            case "converged":
                return bool(error < REACHED)
            case "singular":
                return bool(error > REACHED and sizes[-1] <= RANK * sizes[0])
            case "stuck":
                return bool(error > REACHED and np.linalg.norm(J.T @ e) <= LEVEL * error)
        return last.error > REACHED and (verdict == "diverging") == (last.error > first.error)


def _nearest(J: NDArray[Any], e: NDArray[Any], dq: NDArray[Any]) -> bool:
    """Whether J dq = e, or as near to it as it comes, and dq has no part that moves nothing."""
    import numpy as np

    most = NEAR * float(np.linalg.norm(J) * np.linalg.norm(dq) + np.linalg.norm(e)) + ROUNDING
    left, (m, n) = J @ dq - e, J.shape
    if m > n:
        left, most = J.T @ left, most * float(np.linalg.norm(J))
    idle = np.linalg.svd(J)[2][m:] @ dq
    return bool(np.linalg.norm(left) <= most and np.linalg.norm(idle) <= NEAR * np.linalg.norm(dq))
