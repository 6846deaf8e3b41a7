"""Several axes that leave and arrive together: the slowest sets the time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Cell, Claim, Phrase, Record, Result, Said, Step, Table, as_matrix
from derive.errors import NotDerivable
from derive.expression import Expr, Relation, Symbol, column, number
from derive.kinds.checks import close, route
from derive.kinds.fields import TREES
from derive.kinds.problem import Problem
from derive.kinds.profile._axis import AxisTold, Solved, solved, steps_of, told
from derive.kinds.profile._axis_checks import LOOSE, claims_about, fastest_time
from derive.kinds.profile._trapezoid import NAMES
from derive.mechanics.profile import Profile

HEADINGS: tuple[Cell, ...] = (Phrase("axis"), Phrase("case"), *(Symbol(name) for name in NAMES))


class TogetherTold(Record):
    alone: tuple[AxisTold, ...]
    axes: tuple[AxisTold | None, ...]  # in the common time; None of the slowest, which is told already
    common: Phrase  # the time that all take, and whose it is
    least: Phrase | None  # where the time is too short
    table: Table | None


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
        said = self._results_of(k) if k and not self.infeasible else {}
        if k and (table := together.table):
            for name, cell in zip(NAMES, table.rows[k - 1][2:], strict=True):
                said.setdefault(name, []).extend([cell] if isinstance(cell, TREES) else [])
        shown = (together.axes[k - 1],) if k else together.alone[self.alone.index(axis) :]
        told_of = next(iter(shown), None) or told(axis, prefix, among=True, again=k == self.place)
        return claims_about(axis, steps, told_of, said)

    def _results_of(self, k: int) -> dict[str, list[Expr]]:
        """What the results say of axis k: each is a column over the axes, but for the time they share."""
        found = self.results()
        columns = {name: as_matrix(found[name], name) for name in NAMES if name != "t_3"}
        shared = [found["t_3"]] if isinstance(found["t_3"], TREES) else []
        return {"t_3": shared} | {name: [each.rows[k - 1][0]] for name, each in columns.items()}

    def _slowest_again(self, said: TogetherTold) -> Claim:
        """The time of all is the longest that any axis needs by search, and is told to be that axis's; the
        least possible one is the longest too."""
        times, common = [fastest_time(axis) for axis in self.alone], said.common.about
        short = self.slowest is None and value_of(self.time, {}) < max(times) * (1 - LOOSE)
        holds = [(said.table is None) == (said.least is not None) == short]
        numbers = [row[0] for row in said.table.rows] if said.table else []
        holds.append(numbers == [number(k) for k, _ in enumerate(numbers, 1)])
        holds.append(not said.least or _is(said.least.about["least"], max(times)))
        slowest = common.get("slowest")
        holds += [(slowest is None) == (not said.alone), [each is None for each in said.axes].count(True) < 2]
        if isinstance(slowest, int):
            holds += [close(times[slowest - 1], max(times), LOOSE), said.axes[slowest - 1] is None]
            holds.append(_is(common["time"], max(times)))
        d = abs(value_of(self.axes[0].axis.distance, {}))
        t_3 = value_of(self.time, {})
        holds.append(_is(common["peak"], 2 * d / t_3, {self.axes[0].given.d.name: d, "t_3": t_3}))
        holds += [bool(each.given) == (slowest is None) for each in said.axes if each]
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

    @property
    def place(self) -> int | None:
        """That of the slowest, from 1."""
        return None if self.slowest is None else self.slowest + 1

    def told(self) -> TogetherTold:
        again = self.slowest is not None
        least = Relation(Symbol("t_min"), "=", self.alone[slowest(self.alone)].least)
        return TogetherTold(
            alone=tuple(
                told(axis, f"alone_{k}_", among=True) for k, axis in enumerate(self.alone if again else (), 1)
            ),
            axes=tuple(
                None if k == self.place else told(axis, f"axis_{k}_", among=True, again=again)
                for k, axis in enumerate(self.axes, 1)
            ),
            common=self._common(),
            least=Phrase("too-short-for-all", {"least": least}) if self.infeasible else None,
            table=self._table(),
        )

    def _common(self) -> Phrase:
        """The time that all take, and how."""
        given = self.axes[0].given
        peak = Relation(given.working.symbol("v"), "=", 2 * given.d / given.t_3)
        if self.place is None:
            return Phrase("time-given", {"peak": peak})
        time = Relation(Symbol("t_3"), "=", self.time)
        return Phrase("time-of-the-slowest", {"slowest": self.place, "time": time, "peak": peak})

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


def _is(said: Said, value: float, at: Point | None = None) -> bool:
    """Whether an equation says that value."""
    if not isinstance(said, Relation) or said.sign != "=":
        return False
    return close(value_of(said.right, at or {}), value, LOOSE)
