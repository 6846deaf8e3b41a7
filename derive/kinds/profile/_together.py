"""Several axes that leave and arrive together: the slowest sets the time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import isclose

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Cell, Claim, Phrase, Record, Result, Said, Step, Table, as_matrix
from derive.errors import NotDerivable
from derive.expression import Expr, Relation, Symbol, column, negate, number
from derive.kinds.checks import close, route
from derive.kinds.fields import TREES
from derive.kinds.problem import Problem
from derive.kinds.profile._axis import AxisTold, Solved, solved, steps_of, told
from derive.kinds.profile._axis_checks import LOOSE, claims_about, fastest_time
from derive.kinds.profile._trapezoid import NAMES
from derive.mechanics.profile import Profile

SAME = 1e-9  # of times that are one
HEADINGS: tuple[Cell, ...] = (Phrase("axis"), Phrase("case"), *(Symbol(name) for name in NAMES))


class TogetherTold(Record):
    alone: tuple[AxisTold, ...]
    axes: tuple[AxisTold | None, ...]  # in the common time; None of the slowest, which are told already
    common: Phrase  # the time that all take, and whose it is
    rest: Phrase | None  # how the others take it
    least: Phrase | None  # where the time is too short
    table: Table | None


@dataclass(frozen=True)
class Together:
    """Each axis alone, each in the common time, and which are the slowest (none where a time was given)."""

    alone: tuple[Solved, ...]
    axes: tuple[Solved, ...]
    time: Expr
    slowest: tuple[int, ...]

    @property
    def infeasible(self) -> tuple[int, ...]:
        """The axes, from 1, that cannot be there in time."""
        return tuple(k for k, axis in enumerate(self.axes, 1) if axis.infeasible)

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """Those of the page, in its order."""
        steps: list[Step] = []
        for k, axis in enumerate(self.alone if self.slowest else (), 1):
            steps += steps_of(axis, f"alone_{k}_")
        for k, axis in enumerate(self.axes):
            if k not in self.slowest:
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
                said.setdefault(name, []).extend(
                    [_signed(axis, name, cell)] if isinstance(cell, TREES) else []
                )
        shown = (together.axes[k - 1],) if k else together.alone[self.alone.index(axis) :]
        told_of = next(iter(shown), None) or told(axis, prefix, among=True, again=k in self.places)
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
        short = not self.slowest and value_of(self.time, {}) < max(times) * (1 - LOOSE)
        holds = [(said.table is None) == (said.least is not None) == short]
        numbers = [row[0] for row in said.table.rows] if said.table else []
        holds.append(numbers == [number(k) for k, _ in enumerate(numbers, 1)])
        holds.append(not said.least or _is(said.least.about["least"], max(times)))
        slowest = common.get("slowest", ())
        holds.append((not slowest) == (not said.alone))
        holds.append(
            (said.common.key == "time-of-several") == (isinstance(slowest, tuple) and len(slowest) > 1)
        )
        if isinstance(slowest, tuple) and slowest:
            longest = tuple(k for k, time in enumerate(times, 1) if close(time, max(times), LOOSE))
            holds.append(slowest == longest)
            holds.append(slowest == tuple(k for k, each in enumerate(said.axes, 1) if each is None))
            holds.append(_is(common["time"], max(times)))
        holds.append(
            (said.rest is None)
            == (len(slowest) in (0, len(said.axes)) if isinstance(slowest, tuple) else False)
        )
        d = abs(value_of(self.axes[0].axis.distance, {}))
        t_3 = value_of(self.time, {})
        peaks = [each.about["peak"] for each in (said.common, said.rest) if each and "peak" in each.about]
        holds += [_is(each, 2 * d / t_3, {self.axes[0].given.d.name: d, "t_3": t_3}) for each in peaks]
        holds += [bool(each.given) == (not slowest) for each in said.axes if each]
        return route("slowest", holds)

    def results(self) -> dict[str, Result]:
        """Vectors over the axes, but for the time they share."""
        outcomes = [axis.outcomes[0] for axis in self.axes]
        cases = tuple(outcome.case for outcome in outcomes)
        if self.infeasible:
            return {"case": cases, "t_min": self.alone[slowest(self.alone)[0]].least}
        values = [outcome.values for outcome in outcomes]
        found: dict[str, Result] = {"case": cases}
        for name in NAMES:
            found[name] = self.time if name == "t_3" else column(each[name] for each in values)
        return found

    @property
    def places(self) -> tuple[int, ...]:
        """Those of the slowest, from 1."""
        return tuple(k + 1 for k in self.slowest)

    def told(self) -> TogetherTold:
        again = bool(self.slowest)
        least = Relation(Symbol("t_min"), "=", self.alone[slowest(self.alone)[0]].least)
        return TogetherTold(
            alone=tuple(
                told(axis, f"alone_{k}_", among=True) for k, axis in enumerate(self.alone if again else (), 1)
            ),
            axes=tuple(
                None if k in self.places else told(axis, f"axis_{k}_", among=True, again=again)
                for k, axis in enumerate(self.axes, 1)
            ),
            common=self._common(),
            rest=Phrase("others-wait", self._peak()) if 0 < len(self.places) < len(self.axes) else None,
            least=Phrase("too-short-for-all", {"least": least}) if self.infeasible else None,
            table=self._table(),
        )

    def _common(self) -> Phrase:
        """The time that all take, and how."""
        if not self.places:
            return Phrase("time-given", self._peak())
        key = "time-of-the-slowest" if len(self.places) == 1 else "time-of-several"
        return Phrase(key, {"slowest": self.places, "time": Relation(Symbol("t_3"), "=", self.time)})

    def _peak(self) -> dict[str, Said]:
        """Of a triangle."""
        given = self.axes[0].given
        return {"peak": Relation(given.working.symbol("v"), "=", 2 * given.d / given.t_3)}

    def _table(self) -> Table | None:
        if self.infeasible:
            return None
        rows = []
        for k, axis in enumerate(self.axes, 1):
            outcome = axis.outcomes[0]
            values = [_signed(axis, name, outcome.working.known[Symbol(name)]) for name in NAMES]
            rows.append((number(k), Phrase(outcome.case), *values))
        return Table(HEADINGS, tuple(rows))


def _signed(axis: Solved, name: str, size: Expr) -> Expr:
    """A velocity or an acceleration of a motion backwards, of which the sizes were found; or back again."""
    return negate(size) if axis.given.backwards and name in ("v", "a") else size


def together(profile: Profile, problem: Problem) -> Together:
    """The axes in the time given, or in that of the slowest. Raises NotDerivable where symbols leave open
    which that is, or which case an axis has."""
    alone = tuple(solved(axis, None, profile, problem) for axis in profile.axes)
    if any(each.open for each in alone):
        raise NotDerivable("the slowest axis cannot be told without numbers; give values under where:")
    last = () if profile.time is not None else slowest(alone)
    time = alone[last[0]].outcomes[0].working.known[Symbol("t_3")] if last else profile.time
    if time is None:
        raise NotDerivable("no time is known")
    axes = tuple(solved(axis, time, profile, problem) for axis in profile.axes)
    if any(each.open for each in axes):
        raise NotDerivable("the case of each axis cannot be told without numbers; give values under where:")
    return Together(alone, axes, time, last)


def slowest(alone: Sequence[Solved]) -> tuple[int, ...]:
    """The indices of the axes that need longest."""
    times = [value_of(each.least, {}) for each in alone]
    return tuple(k for k, time in enumerate(times) if isclose(time, max(times), rel_tol=SAME))


def _is(said: Said, value: float, at: Point | None = None) -> bool:
    """Whether an equation says that value."""
    if not isinstance(said, Relation) or said.sign != "=":
        return False
    return close(value_of(said.right, at or {}), value, LOOSE)
