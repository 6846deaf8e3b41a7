"""The factor by which a motion has to be slowed down, or can be made faster, to just keep its limits."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Literal

from derive.algebra.numbers.floats import number as value_of
from derive.derivation import (
    Cell,
    Claim,
    Derivation,
    Figure,
    PageFacts,
    Phrase,
    Record,
    Step,
    Table,
    as_matrix,
)
from derive.expression import ONE, Expr, Symbol, free_symbols, number
from derive.figures.courses import panels
from derive.kinds.checks import law, route
from derive.kinds.fields import TREES, Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.profile._fixed_shape import Shaped, as_told, reached, right_case
from derive.kinds.profile._limited import as_typed, given_of
from derive.kinds.profile._minimum_told import Outcome, evaluated_of, met_of, results_of
from derive.kinds.profile._scaled import LETTERS, NEW, K, after_of, names_of, scaled, time_named
from derive.kinds.profile._shape_told import (
    GREATEST,
    courses_of,
    direction,
    drawn,
    opening,
    own,
    said_of,
    said_of_case,
    steps_of,
)
from derive.kinds.profile._units import sort_at
from derive.kinds.values_at import point_of
from derive.mechanics.profile import Profile, Units

NEEDS = ("time",)
CLAIMED = dict.fromkeys(("k", "time", "v_peak", "a_peak", "v_k", "a_k", "solutions"), "as-told")
NAMES = ("k", "time", "v_peak", "a_peak", "v_k", "a_k")
JUST = 1e-9  # of a factor that is 1


class Options(OptionsModel):
    """Where symbols stand for something, `evaluate` gives the numbers at a point and draws the motion."""

    law: Literal["cubic", "quintic", "cycloidal"] = "cubic"
    """How the distance is covered."""
    evaluate: Evaluation = None


class CaseTold(Record):
    begins: Phrase
    lines: tuple[str, ...]  # steps


class Facts(PageFacts):
    given: tuple[tuple[Expr, Expr, int | None], ...]  # each with how often it is differentiated
    units: Units
    direction: Phrase | None
    opening: Phrase
    laws: tuple[str, ...]  # steps, as those that follow
    greatest: Phrase
    peaks: tuple[str, ...]
    slower: Phrase  # what a factor does
    factors: tuple[str, ...]
    cases: tuple[CaseTold, ...]
    verdict: Phrase | None
    table: Table | None
    drawn: bool


def claims_of(profile: Profile, options: Options) -> tuple[str, ...]:
    """The keys of what is claimed."""
    return ("as-told", "right-case", *(("on-axes",) if len(profile.axes) > 1 else ()))


def derive(profile: Profile, options: Options, problem: Problem) -> Derivation:
    """k is the greatest of v_peak/v_M and sqrt(a_peak/a_M) (Siciliano et al., section 4.2; Biagiotti and
    Melchiorri, chapter 5).

    Raises NotDerivable where no time is given, and where symbols of several axes leave the greatest open.
    """
    each = scaled(options.law, profile, problem)
    outcomes = tuple(case.outcome for case in each.cases)
    met = met_of(outcomes, options.evaluate, problem)
    start = profile.journey.start if profile.journey else number(0)
    point = point_of(dict(options.evaluate or ()), problem.where)
    known = options.evaluate or len(outcomes) == 1
    courses = courses_of(each, each.cases[met], point, start) if known else {}
    steps = tuple(steps_of(each))
    facts = _facts(each, profile, problem, outcomes, bool(courses))
    plots: tuple[Figure, ...] = ()
    if courses:
        end = next(iter(courses.values()))[-1].end
        plots = (
            panels("motion", courses, sort_at(profile, options.evaluate), problem.style.degrees, {NEW: end}),
        )
    return Derivation(
        "time-scaling",
        steps,
        results_of(outcomes, met),
        (*_claims(each, facts, steps, profile, problem), drawn(facts.drawn, courses, profile, point)),
        each.base.definitions,
        evaluated_of(outcomes[met], options.evaluate, problem),
        plots=plots,
        facts=facts,
        units=dict(each.base.units),
    )


def _facts(
    each: Shaped, profile: Profile, problem: Problem, outcomes: Sequence[Outcome], drawn: bool
) -> Facts:
    """What the words read."""
    names = tuple(step.name for step in each.base.steps)
    T = time_named(profile, problem)
    typed = ((T, each.base[T], None),) if each.base[T] != T else ()
    return Facts(
        given=(*given_of(each.base, each.axes), *typed),
        units=profile.units,
        direction=direction(each),
        opening=opening(each, T),
        laws=names[:3],
        greatest=GREATEST[each.law],
        peaks=names[3 : 3 + len(each.bounds)],
        slower=_slower(each),
        factors=names[3 + len(each.bounds) :],
        cases=tuple(
            CaseTold(
                begins=_begins(case.outcome, each.several, len(each.bounds)),
                lines=tuple(name for name, _ in own(each, case)),
            )
            for case in each.cases
        ),
        verdict=_verdict(outcomes),
        table=_table(each),
        numbers=NAMES,
        page_names={"time": NEW},
        drawn=drawn,
    )


def _slower(each: Shaped) -> Phrase:
    """What a factor does to velocities and accelerations."""
    return Phrase("slower" if len(each.bounds) > 1 else "slower-for-one", {"k": K, "square": K**2})


def _begins(outcome: Outcome, several: bool, limits: int) -> Phrase:
    """Which factor is needed, and when."""
    if outcome.when:
        return Phrase("greater-if", {"when": outcome.when[0], "limits": outcome.limits})
    if limits == 1:
        return Phrase("the-one", {"limits": outcome.limits})
    if len(outcome.active) > 1:
        return Phrase("greatest-all", {"limits": outcome.limits})
    return Phrase("greatest" if several else "greater", {"limits": outcome.limits})


def _verdict(outcomes: Sequence[Outcome]) -> Phrase | None:
    """Whether the limits are kept in the given time; None where symbols leave it open."""
    try:
        k = value_of(outcomes[0].values["k"], {})
    except KeyError:
        return None
    if abs(k - 1) < JUST:
        return Phrase("just-kept", {"k": K})
    return Phrase("not-kept" if k > 1 else "kept", {"k": K})


def _table(each: Shaped) -> Table | None:
    """What each of several axes reaches in the new time."""
    if not each.several:
        return None
    columns = [each.cases[0].peaks[after_of(rate).name] for rate in LETTERS]
    rows = tuple((number(k), *row) for k, row in enumerate(zip(*columns, strict=True), 1))
    headings: tuple[Cell, ...] = (Phrase("axis"), *map(after_of, LETTERS))
    return Table(headings, rows)


def _claims(
    each: Shaped, facts: Facts, steps: Sequence[Step], profile: Profile, problem: Problem
) -> Iterator[Claim]:
    """The chains, every line as it is printed against the search, and what is said beside them."""
    chains = {step.name: step.chain for step in steps}
    for case in each.cases:
        yield from case.work.linked().claims
    T, time = time_named(profile, problem), profile.time or ONE
    names = partial(names_of, each, T, time)
    shared = [chains[step.name] for step in each.base.steps] + [
        (name, value) for name, value, _ in facts.given
    ]

    def right() -> Iterator[bool]:
        for case in each.cases:
            values = [
                (NEW if name == "time" else Symbol(name), value)
                for name, value in case.outcome.values.items()
                if isinstance(value, TREES) and not (each.several and name in ("v_k", "a_k"))
            ]
            lines = [chains[name] for name, _ in own(each, case)]
            yield from as_told(each, case, [*shared, *lines, *values], names)

    yield route("as-told", right())
    yield route("right-case", right_case(each))
    yield law("said", (*as_typed(profile, each.base, each.axes), *_said(each, facts, T)))
    if facts.table is not None:
        for columns in _of_axes(each, facts.table):
            yield route("on-axes", reached(each, columns))


def _of_axes(each: Shaped, table: Table) -> Iterator[dict[str, list[float]]]:
    """What the table and the results say of each axis."""
    peaks = dict(zip(("v_peak", "a_peak"), LETTERS, strict=True))
    cells = [[value_of(cell, {}) for cell in row if isinstance(cell, TREES)] for row in table.rows]
    yield {name: [row[rate] for row in cells] for name, rate in peaks.items()}
    values = each.cases[0].outcome.values
    yield {
        name: [value_of(row[0], {}) for row in as_matrix(values[after_of(rate).name], name).rows]
        for name, rate in peaks.items()
    }


def _said(each: Shaped, facts: Facts, T: Symbol) -> Iterator[bool]:
    """The sentences are those of the limits, and of a motion that keeps them or does not."""
    given = [item for item in facts.given if item[0] != T]
    yield all(rate is None for name, _, rate in facts.given if name == T)
    yield from said_of(each, given, facts.opening, facts.greatest, facts.direction)
    yield facts.opening.about.get("T") == T
    yield facts.slower == _slower(each)
    yield from (said_of_case(case, told.begins) for case, told in zip(each.cases, facts.cases, strict=True))
    values = [case.outcome.values["k"] for case in each.cases]
    if not free_symbols(values[0]):
        k = value_of(values[0], {})
        keys = {"just-kept": abs(k - 1) < JUST, "not-kept": k > 1 + JUST, "kept": k < 1 - JUST}
        yield facts.verdict is not None and keys[facts.verdict.key]
    if facts.table is not None:
        yield [row[0] for row in facts.table.rows] == [number(k) for k, _ in enumerate(each.axes, 1)]
