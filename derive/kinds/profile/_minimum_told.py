"""What is told of a shortest time: the limits that bind, in which case, and the results."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from derive.algebra.numbers.floats import Point, numbers
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Branch, PageFacts, Phrase, Record, Result, Said, Table
from derive.errors import NotDerivable
from derive.expression import Expr, Matrix, Relation
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.profile._along.told import PathTold
from derive.kinds.values_at import point_of
from derive.mechanics.profile import NO_UNITS, Units

# The number of an axis (0 of a single one), and how often what is limited is differentiated.
Bound = tuple[int, int]
LIMITS = {1: Phrase("velocity"), 2: Phrase("acceleration")}
NUMBERS = ("time", "v_peak", "a_peak")


class CaseTold(Record):
    begins: Phrase
    lines: tuple[str, ...]  # steps


class SwitchedTold(Record):
    """Between two velocities: the distance of a single ramp, then what is done first."""

    braking: Phrase | None
    braked: tuple[str, ...]  # steps, as those that follow
    first: Phrase
    peak: tuple[str, ...]
    border: Phrase
    lines: tuple[str, ...]
    time: str


class Facts(PageFacts):
    cases: tuple[CaseTold, ...]
    given: tuple[tuple[Expr, Expr, int | None], ...] = ()  # each with how often it is differentiated
    units: Units = NO_UNITS
    direction: Phrase | None = None
    opening: Phrase | None = None
    laws: tuple[str, ...] = ()  # steps, as those that follow
    greatest: Phrase | None = None
    peaks: tuple[str, ...] = ()
    bounds: Phrase | None = None
    needed: tuple[str, ...] = ()
    reached: Phrase | None = None  # by several axes
    table: Table | None = None
    switched: SwitchedTold | None = None
    path: PathTold | None = None
    drawn: bool = False
    at_point: Phrase | None = None


@dataclass(frozen=True, slots=True)
class Outcome:
    """Which limits are active, and the time and the peaks; `when`, where symbols leave that open."""

    active: tuple[Bound, ...]
    values: Mapping[str, Expr]
    when: tuple[Relation, ...] = ()

    @property
    def limits(self) -> Phrase:
        """The limits in words: "velocity and acceleration", "acceleration of axis 2"."""
        said = tuple(
            Phrase("of-axis", {"limit": LIMITS[rate], "axis": axis}) if axis else LIMITS[rate]
            for axis, rate in self.active
        )
        return said[0] if len(said) == 1 else Phrase("binding", {"limits": said})

    def is_met(self, at: Point) -> bool:
        """Whether it is the case at a point. Raises KeyError where symbols leave that open."""
        return all(holds(need, at) for need in self.when)


def holds(need: Relation, at: Point) -> bool:
    """Whether a comparison is true. Raises KeyError."""
    if isinstance(need.left, Relation):
        return False
    left, right = value_of(need.left, at), value_of(need.right, at)
    return {"<=": left <= right, ">": left > right}[need.sign]


def met_of(outcomes: Sequence[Outcome], evaluate: Place | None, problem: Problem) -> int:
    """The place of the case at the point asked for; the first where none is."""
    if len(outcomes) == 1 or evaluate is None:
        return 0
    point = point_of(dict(evaluate), problem.where)
    try:
        return next((k for k, each in enumerate(outcomes) if each.is_met(point)), 0)
    except KeyError:
        return 0


def results_of(outcomes: Sequence[Outcome], met: int) -> dict[str, Result]:
    """Those of the case that is met, and all cases where symbols leave it open."""
    if len(outcomes) == 1:
        return {"active": outcomes[0].limits, **outcomes[0].values}
    first, second = (Phrase("case-if", {"case": each.limits, "when": each.when}) for each in outcomes)
    branches = tuple(
        Branch(each.values, (Phrase("case-when", {"case": each.limits, "when": each.when}),))
        for each in outcomes
    )
    either = Phrase("either", {"first": first, "other": second})
    return {"active": either, **outcomes[met].values, "solutions": branches}


def evaluated_of(outcome: Outcome, evaluate: Place | None, problem: Problem) -> dict[str, Any]:
    """The numbers at the point asked for. Raises NotDerivable where a name has no value there."""
    if evaluate is None:
        return {}
    point = point_of(dict(evaluate), problem.where)
    try:
        return {name: _flat(tree, point) for name, tree in outcome.values.items()}
    except KeyError as error:
        raise NotDerivable(f"no value is known for {error.args[0]}", "evaluate") from None


def _flat(tree: Expr, point: Point) -> Any:
    if isinstance(tree, Matrix):
        return [value_of(entry, point) for (entry,) in tree.rows]
    return numbers(tree, point)


# By how it is seen that limits bind: where one of them does, and where several do.
BEGINS = {
    "only": ("only", "only"),
    "longer": ("longer", "longer-all"),
    "longest": ("longest", "longest-all"),
    "profile": ("profile", "profile-all"),
}
BEGINS_IF = {"longer": ("longer-if", "longer-if"), "profile": ("profile-if", "profile-if-all")}


def begins(outcome: Outcome, how: str) -> Phrase:
    """Which limits bind, and `how` that is seen; under a condition where symbols leave it open."""
    about: dict[str, Said] = {"limits": outcome.limits}
    if outcome.when:
        about["when"] = outcome.when[0]
    keys = (BEGINS_IF if outcome.when else BEGINS)[how]
    return Phrase(keys[len(outcome.active) > 1], about)


def at_point(outcome: Outcome) -> Phrase:
    """Which case it is at the point asked for."""
    return Phrase("at-point-all" if len(outcome.active) > 1 else "at-point", {"limits": outcome.limits})
