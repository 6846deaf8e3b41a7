"""How the shortest time of a motion of one shape is told, and drawn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from math import isclose

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Cell, Claim, Label, Phrase, Said, Step, Table, as_matrix
from derive.expression import ZERO, Expr, Relation, Symbol, free_symbols, number, sqrt
from derive.kinds.checks import law, route
from derive.kinds.fields import TREES
from derive.kinds.meanings import Chain
from derive.kinds.profile._fixed_shape import Case, Shaped, as_told, names_of, reached, right_case
from derive.kinds.profile._limited import as_typed, given_of
from derive.kinds.profile._minimum_told import NUMBERS, CaseTold, Facts, begins
from derive.kinds.profile._shapes import PEAKS, TAU, TIME, WAY
from derive.mechanics import shapes
from derive.mechanics.course import Course
from derive.mechanics.profile import Profile

NOW = Symbol("t")
HALF = number("1/2")
ROOT = sqrt(number(3)) / number(6)
LAWS = {"cubic": "cubic-law", "quintic": "quintic-law", "cycloidal": "cycloidal-law"}
GREATEST: Mapping[str, Phrase] = {  # where velocity and acceleration are greatest
    "cubic": Phrase("cubic-greatest", {"half": HALF}),
    "quintic": Phrase("quintic-greatest", {"half": HALF, "early": HALF - ROOT, "late": HALF + ROOT}),
    "cycloidal": Phrase("cycloidal-greatest", {"half": HALF, "early": number("1/4"), "late": number("3/4")}),
}
LOOSE = 1e-5
HEADINGS: tuple[Cell, ...] = (Phrase("axis"), *map(Symbol, PEAKS))


def steps_of(each: Shaped) -> Iterator[Step]:
    """Those that all cases share, then those of each."""
    yield from each.base.steps
    for case in each.cases:
        yield from (replace(step, name=name) for name, step in own(each, case))


def own(each: Shaped, case: Case) -> list[tuple[str, Step]]:
    """The lines of a case by their names."""
    mark = f"{case.outcome.active[0][1]}_" if case.outcome.when else ""
    return [(f"{mark}{step.name}", step) for step in case.work.steps[len(each.base.steps) :]]


def facts_of(each: Shaped, profile: Profile, at_point: Phrase | None, drawn: bool) -> Facts:
    """What the words read."""
    names = tuple(step.name for step in each.base.steps)
    how = _how(each)
    return Facts(
        given=given_of(each.base, each.axes),
        units=profile.units,
        direction=direction(each),
        opening=opening(each, TIME),
        laws=names[:3],
        greatest=GREATEST[each.law],
        peaks=names[3:5],
        bounds=Phrase("bound" if len(each.bounds) == 1 else "bounds"),
        needed=names[5:],
        cases=tuple(
            CaseTold(begins=begins(case.outcome, how), lines=tuple(name for name, _ in own(each, case)))
            for case in each.cases
        ),
        reached=Phrase("reached", {"T": TIME}) if each.several else None,
        table=_table(each),
        numbers=NUMBERS,
        page_names={"time": TIME},
        drawn=drawn,
        at_point=at_point,
    )


def opening(each: Shaped, T: Symbol) -> Phrase:
    """What the law is, over which distance in which time."""
    d = WAY if each.several else each.axes[0].d
    about: dict[str, Said] = {"d": d, "T": T, "tau": TAU, "share": Relation(TAU, "=", NOW / T)}
    return Phrase(LAWS[each.law], about)


def direction(each: Shaped) -> Phrase | None:
    """What is said where sizes are told of a motion backwards, or symbols leave open that it is none."""
    if any(axis.backwards for axis in each.axes):
        return Phrase("backwards-axes" if each.several else "backwards")
    ahead = tuple(Relation(axis.d, ">", ZERO) for axis in each.axes if axis.open)
    return Phrase("forwards", {"ahead": ahead}) if ahead else None


def _how(each: Shaped) -> str:
    """Which of the times is needed."""
    if len(each.bounds) == 1:
        return "only"
    return "longest" if each.several else "longer"


def _table(each: Shaped) -> Table | None:
    """What each of several axes reaches."""
    if not each.several:
        return None
    columns = [each.cases[0].peaks[name] for name in PEAKS]
    rows = enumerate(zip(*columns, strict=True), 1)
    return Table(HEADINGS, tuple((number(k), *values) for k, values in rows))


def courses_of(each: Shaped, case: Case, point: Point, start: Expr) -> dict[Label, Course]:
    """The motion of every axis from where it starts; none where symbols are left."""
    found: dict[Label, Course] = {}
    try:
        time, first = (value_of(tree, point) for tree in (case.outcome.values["time"], start))
        for k, axis in enumerate(each.axes, 1):
            d = value_of(each.base.problem.final(each.base[axis.d]), point)
            label: Label = Phrase("axis-number", {"k": k}) if each.several else ""
            found[label] = shapes.course(each.law, -d if axis.backwards else d, time, first)
    except KeyError:
        return {}
    return found


def drawn(said: bool, courses: Mapping[Label, Course], profile: Profile, point: Point) -> Claim:
    """Whether a motion is drawn just where that is said, and one that was typed by its ends between these."""
    journey = profile.journey
    held = [said == bool(courses)]
    for each in courses.values():
        if journey is None:
            continue
        first, last = each[0].at(each[0].start), each[-1].at(each[-1].end)
        start, end = (value_of(tree, point) for tree in (journey.start, journey.end))
        held.append(max(abs(first - start), abs(last - end)) <= LOOSE * abs(end - start))
    return law("drawn", held)


def claims_of(each: Shaped, facts: Facts, steps: Sequence[Step], profile: Profile) -> Iterator[Claim]:
    """The chains, every line as it is printed against the search, and what is said beside them."""
    chains = {step.name: step.chain for step in steps}
    shared = [chains[step.name] for step in each.base.steps]
    for case in each.cases:
        yield from case.work.linked().claims
    given: list[Chain] = [(name, value) for name, value, _ in facts.given]
    told_of = (
        (case, [*shared, *(chains[name] for name, _ in own(each, case)), *given, *_results(each, case)])
        for case in each.cases
    )
    names = partial(names_of, each)
    yield route("as-told", (right for case, lines in told_of for right in as_told(each, case, lines, names)))
    yield route("right-case", right_case(each))
    yield law("said", (*as_typed(profile, each.base, each.axes), *_said(each, facts)))
    if facts.table is not None:
        cells = [[value_of(cell, {}) for cell in row if isinstance(cell, TREES)] for row in facts.table.rows]
        reached_told = {name: [row[k] for row in cells] for k, name in enumerate(PEAKS, 1)}
        values = {
            name: [value_of(row[0], {}) for row in as_matrix(each.cases[0].outcome.values[name], name).rows]
            for name in PEAKS
        }
        yield route("on-axes", (*reached(each, reached_told), *reached(each, values)))


def _results(each: Shaped, case: Case) -> Iterator[Chain]:
    """What the results say of a case."""
    yield TIME, case.outcome.values["time"]
    if not each.several:
        yield from ((Symbol(name), case.outcome.values[name]) for name in PEAKS)


def _said(each: Shaped, facts: Facts) -> Iterator[bool]:
    """The sentences are those of so many limits and cases."""
    yield from said_of(each, facts.given, facts.opening, facts.greatest, facts.direction)
    yield facts.bounds == Phrase("bounds" if len(each.bounds) > 1 else "bound")
    yield from (said_of_case(case, told.begins) for case, told in zip(each.cases, facts.cases, strict=True))
    if facts.table is not None:
        yield [row[0] for row in facts.table.rows] == [number(k) for k, _ in enumerate(each.axes, 1)]


def said_of_case(case: Case, begins: Phrase) -> bool:
    """Whether a case is begun with its limits and its condition."""
    when = case.outcome.when or (None,)
    return begins.about.get("limits") == case.outcome.limits and (begins.about.get("when"),) == when


def said_of(
    each: Shaped,
    given: Sequence[tuple[Expr, Expr, int | None]],
    opening: Phrase | None,
    greatest: Phrase | None,
    way: Phrase | None,
) -> Iterator[bool]:
    """The sentences are those of this law; the peaks are where they are said to be."""
    rates: dict[Expr, int] = {axis.d: 0 for axis in each.axes}
    rates |= {name: rate for axis in each.axes for rate, name in axis.limits.items()}
    yield all(rates.get(name) == rate for name, _, rate in given)
    yield greatest is not None and _greatest_there(each.law, greatest)
    yield opening is not None and opening.key == LAWS[each.law] and _is_share(opening.about["share"])
    back = any(axis.backwards for axis in each.axes)
    yield (way is not None and way.key.startswith("backwards")) == back
    yield (way is not None) == (back or any(axis.open for axis in each.axes))


def _is_share(said: Said) -> bool:
    """Whether it is said to be the time that has passed, as a share of the whole."""
    if not isinstance(said, Relation) or said.sign != "=" or not isinstance(said.left, TREES):
        return False
    names = free_symbols(said.left) | free_symbols(said.right)
    at = dict.fromkeys(names, 2.0) | {NOW.name: 0.6, TAU.name: 0.3}
    return all(isclose(value_of(side, at), 0.3) for side in (said.left, said.right))


def _greatest_there(kind: shapes.Law, said: Phrase) -> bool:
    """Velocity at the half, acceleration early and late, at both ends of a cubic."""
    fast, strong = (abs(values) for values in shapes.rates(kind, 1.0, 1.0))
    shares = {name: value_of(share, {}) for name, share in said.about.items() if isinstance(share, TREES)}
    places = {name: round(share * (shapes.FINE - 1)) for name, share in shares.items()}
    own = [places[name] for name in ("early", "late") if name in places] or [0, -1]
    return (
        said.key == GREATEST[kind].key
        and isclose(fast[places["half"]], fast.max(), rel_tol=LOOSE)
        and all(isclose(strong[place], strong.max(), rel_tol=LOOSE) for place in own)
    )
