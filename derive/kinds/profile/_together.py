"""Several axes that leave and arrive together: the slowest sets the time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Cell, Claim, Phrase, Record, Result, Step, Table
from derive.errors import NotDerivable
from derive.expression import Expr, Matrix, Symbol, column, number
from derive.kinds.checks import close, route
from derive.kinds.fields import TREES
from derive.kinds.problem import Problem
from derive.kinds.profile._axis import AxisTold, Equation, Solved, solved, steps_of, told
from derive.kinds.profile._axis_checks import LOOSE, claims_about, fastest_time
from derive.kinds.profile._trapezoid import NAMES
from derive.mechanics.profile import Profile

HEADINGS: tuple[Cell, ...] = (Phrase("axis"), Phrase("case"), *(Symbol(name) for name in NAMES))


class TogetherTold(Record):
    alone: tuple[AxisTold, ...]
    axes: tuple[AxisTold, ...]
    slowest: int | None  # from 1; None where a time was given
    time: Equation
    least: Equation
    table: Table | None  # None where the time is too short


@dataclass(frozen=True)
class Together:
    """Each axis alone, each in the common time, and which is the slowest (None where a time was given)."""

    alone: tuple[Solved, ...]
    axes: tuple[Solved, ...]
    time: Expr
    slowest: int | None

    @property
    def infeasible(self) -> tuple[int, ...]:
        """The axes, from 1, that cannot be there in time."""
        return tuple(k for k, axis in enumerate(self.axes, 1) if axis.infeasible)

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """Those of the page, in its order."""
        steps: list[Step] = []
        for k, axis in enumerate(self.alone if self.slowest is not None else (), 1):
            steps += steps_of(axis, f"alone_{k}_")
        for k, axis in enumerate(self.axes):
            if k != self.slowest:
                steps += steps_of(axis, f"axis_{k + 1}_")
        return tuple(steps)

    def claims(self, said: TogetherTold) -> list[Claim]:
        """Those of each axis, and of what is said of all."""
        found = [
            claim.within(key, axis=k)
            for key, axes, prefix in (("axis-alone", self.alone, "alone"), ("on-axis", self.axes, "axis"))
            for k, axis in enumerate(axes, 1)
            for claim in self._about(axis, f"{prefix}_{k}_", k if prefix == "axis" else 0, said)
        ]
        return [*found, self._slowest_again(said)]

    def _about(self, axis: Solved, prefix: str, k: int, together: TogetherTold) -> Iterator[Claim]:
        """The claims of an axis, also for what the results and the table say of axis k."""
        steps = {step.name: step for step in (*steps_of(axis, prefix), *self.steps)}
        results = self.results() if k else {}
        said = {
            name: [result.rows[k - 1][0]] for name, result in results.items() if isinstance(result, Matrix)
        }
        if k and (table := together.table):
            for name, cell in zip(NAMES, table.rows[k - 1][2:], strict=True):
                said.setdefault(name, []).extend([cell] if isinstance(cell, TREES) else [])
        told_of = together.axes[k - 1] if k else together.alone[self.alone.index(axis)]
        return claims_about(axis, steps, told_of, said)

    def _slowest_again(self, said: TogetherTold) -> Claim:
        """The time of all is the longest that any axis needs by search, and is told to be that axis's; the
        least possible one is the longest too."""
        times = [fastest_time(axis) for axis in self.alone]
        holds = [close(value_of(said.least[1], {}), max(times), LOOSE)]
        holds.append((said.table is None) == any(axis.infeasible for axis in said.axes))
        if said.slowest is not None:
            pair = [times[said.slowest - 1], value_of(said.time[1], {})]
            holds.append(close(pair, [max(times)] * 2, LOOSE))
        return route("slowest", holds)

    def results(self) -> dict[str, Result]:
        """Vectors over the axes, but for the time they share."""
        outcomes = [axis.outcomes[0] for axis in self.axes]
        cases = tuple(outcome.case for outcome in outcomes)
        if self.infeasible:
            return {"case": cases, "t_min": self.alone[slowest(self.alone)].least}
        values = [outcome.values for outcome in outcomes]
        found: dict[str, Result] = {"case": cases}
        for name in NAMES:
            found[name] = self.time if name == "t_3" else column(each[name] for each in values)
        return found

    def told(self) -> TogetherTold:
        return TogetherTold(
            alone=tuple(told(axis, f"alone_{k}_") for k, axis in enumerate(self.alone, 1)),
            axes=tuple(told(axis, f"axis_{k}_") for k, axis in enumerate(self.axes, 1)),
            slowest=None if self.slowest is None else self.slowest + 1,
            time=(Symbol("t_3"), self.time),
            least=(Symbol("t_min"), self.alone[slowest(self.alone)].least),
            table=self._table(),
        )

    def _table(self) -> Table | None:
        if self.infeasible:
            return None
        rows = []
        for k, axis in enumerate(self.axes, 1):
            outcome = axis.outcomes[0]
            values = [outcome.working.known[Symbol(name)] for name in NAMES]
            rows.append((number(k), Phrase(outcome.case), *values))
        return Table(HEADINGS, tuple(rows))


def together(profile: Profile, problem: Problem) -> Together:
    """The axes in the time given, or in that of the slowest. Raises NotDerivable where symbols leave open
    which that is, or which case an axis has."""
    alone = tuple(solved(axis, None, profile, problem) for axis in profile.axes)
    if any(each.open for each in alone):
        raise NotDerivable("the slowest axis cannot be told without numbers; give values under where:")
    last = None if profile.time is not None else slowest(alone)
    time = profile.time if last is None else alone[last].outcomes[0].working.known[Symbol("t_3")]
    if time is None:
        raise NotDerivable("no time is known")
    axes = tuple(solved(axis, time, profile, problem) for axis in profile.axes)
    if any(each.open for each in axes):
        raise NotDerivable("the case of each axis cannot be told without numbers; give values under where:")
    return Together(alone, axes, time, last)


def slowest(alone: Sequence[Solved]) -> int:
    """The index of the axis that needs longest; the first of equals."""
    times = [value_of(each.least, {}) for each in alone]
    return max(range(len(times)), key=lambda index: times[index] * (1 - 1e-12 * index))
