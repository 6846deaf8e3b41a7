"""How the fastest motion between two velocities is told, and drawn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Claim, Derivation, Figure, Label, Phrase, Said
from derive.errors import NotAsWritten
from derive.expression import ZERO, Expr, Relation, squared, subtract
from derive.figures.courses import panels
from derive.kinds.checks import close, law, random_points, route
from derive.kinds.fields import TREES, Place
from derive.kinds.meanings import Chain, Names, farthest
from derive.kinds.problem import Problem
from derive.kinds.profile._minimum_told import Facts, Outcome, SwitchedTold, evaluated_of, results_of
from derive.kinds.profile._shapes import TIME
from derive.kinds.profile._switched import D_B, T_1, T_2, V_P, Motion, V, names_of, switched
from derive.kinds.values_at import point_of
from derive.mechanics.course import Course
from derive.mechanics.course import at as value_at
from derive.mechanics.profile import Profile
from derive.mechanics.switching import Switched, Ways, course, searched

LOOSE = 1e-5
EACH, TRIED = 3, 20  # points, and how many are looked at
NUMBERS = ("time", "t_1", "t_2", "v")


def fastest_between(profile: Profile, evaluate: Place | None, problem: Problem) -> Derivation:
    """The times at which the acceleration switches, and the shortest time."""
    motion = switched(profile, problem)
    outcome = _outcome(motion)
    point = point_of(dict(evaluate or ()), problem.where)
    plots = _plots(motion, outcome, profile, problem, point)
    facts = Facts(
        cases=(),
        given=_given(motion),
        units=profile.units,
        numbers=NUMBERS,
        page_names={"time": TIME},
        switched=_told(motion, outcome),
        drawn=bool(plots),
        direction=_direction(motion),
    )
    work = motion.work.claim(*_claims(motion, facts, outcome), law("drawn", facts.drawn == bool(plots)))
    evaluated = evaluated_of(outcome, evaluate, problem)
    return work.answer(
        "minimum-time",
        results_of((outcome,), 0),
        facts,
        evaluated=evaluated,
        plots=plots,
        units=dict(work.units),
    )


def _outcome(motion: Motion) -> Outcome:
    """The results: without a stretch at the greatest velocity it begins and ends at the same time."""
    work = motion.work
    names = (TIME, T_1, T_2, V) if motion.coasts else (TIME, T_1, T_1, V_P)
    values = dict(zip(NUMBERS, (work.final(name) for name in names), strict=True))
    return Outcome(((0, 1), (0, 2)) if motion.coasts else ((0, 2),), values)


def _given(motion: Motion) -> tuple[tuple[Expr, Expr, int | None], ...]:
    return tuple(
        (name, value, motion.rates[name]) for name, value in motion.work.typed if name in motion.rates
    )


def _direction(motion: Motion) -> Phrase | None:
    """A distance in symbols is taken to be positive."""
    d = motion.work.known.get(motion.d, motion.d)
    open_ = d != motion.d and motion.work.sign(d) is None
    return Phrase("forwards", {"ahead": (Relation(motion.d, ">", ZERO),)}) if open_ else None


def _told(motion: Motion, outcome: Outcome) -> SwitchedTold:
    """The sentences and the lines between them."""
    names = [step.name for step in motion.work.steps]
    at = names.index(V_P.name)
    a, d = motion.a, motion.d
    about: dict[str, Said] = {"a": a, "d": d, "v_p": V_P, "area": _area(motion)}
    if motion.rests:
        first = Phrase("from-rest" if motion.ahead > 0 else "from-rest-back", about)
    else:
        first = Phrase("ahead" if motion.ahead > 0 else "back", about)
    return SwitchedTold(
        braking=None if motion.rests else Phrase("at-once", {"v_0": motion.v_0, "v_f": motion.v_f, "a": a}),
        braked=tuple(names[:at]),
        first=first,
        peak=(V_P.name,),
        border=_border(motion, outcome),
        lines=tuple(names[at + 1 : -1]),
        time=names[-1],
    )


def _area(motion: Motion) -> Relation:
    """The distance by both ramps."""
    parts = [
        subtract(squared(V_P), squared(speed)) if speed != ZERO else squared(V_P)
        for speed in (motion.v_0, motion.v_f)
    ]
    first, last = (part / (2 * motion.a) for part in parts)
    return Relation(motion.d, "=", first + last if motion.ahead > 0 else -first - last)


def _border(motion: Motion, outcome: Outcome) -> Phrase:
    """Whether the greatest velocity is reached, and which limits determine the time."""
    about: dict[str, Said] = {"limits": outcome.limits, "t_1": T_1}
    if motion.fastest is None:
        return Phrase("no-border", about)
    about["fastest"] = motion.fastest
    if motion.coasts:
        return Phrase("reached-and-held", {**about, "t_2": T_2, "v": V})
    return Phrase("not-reached", about)


# -- by search ----------------------------------------------------------------------------------------


def _claims(motion: Motion, facts: Facts, outcome: Outcome) -> Iterator[Claim]:
    """Every line and all that is said against a search over all velocities in between."""
    names = (TIME, T_1, T_2, V) if motion.coasts else (TIME, T_1, T_1, V_P)
    lines: list[Chain] = [step.chain for step in motion.work.steps]
    lines += [(name, value) for name, value, _ in facts.given]
    lines += [(name, outcome.values[key]) for key, name in zip(NUMBERS, names, strict=True)]
    points = [*islice(_points(motion), EACH)]
    meant = [names_of(motion, at) for at in points]
    yield route("no-time-is-shorter", (farthest(lines, each) < LOOSE for each in meant))
    yield route("said", (right for each in meant for right in _said(motion, facts, outcome, each)))
    yield route("binding-limits", (right for at in points for right in _binding(motion.at(at), outcome)))


def _points(motion: Motion) -> Iterator[Point]:
    """Where every size is positive, and the distance as it is taken."""
    for at in random_points(motion.work.problem.symbols, TRIED):
        ways = motion.at(at)
        if min(ways.a_max, ways.v_max) > 0 and (not motion.rests or ways.d * motion.ahead > 0):
            yield at


def _said(motion: Motion, facts: Facts, outcome: Outcome, names: Names) -> Iterator[bool]:
    """The sentences of the first acceleration, of the limit of velocity, and the area."""
    told = facts.switched
    yield told is not None
    if told is None:
        return
    area = told.first.about["area"]
    yield isinstance(area, Relation) and farthest([_sides(area)], names) < LOOSE
    v_0 = 0.0 if motion.v_0 == ZERO else names[motion.v_0]
    forward = names[motion.d] >= names[D_B] - LOOSE if not motion.rests else names[motion.d] > 0
    keys = {True: ("ahead", "from-rest"), False: ("back", "from-rest-back")}
    yield told.first.key == keys[forward][motion.rests]
    yield (told.braking is None) == motion.rests and v_0 == v_0
    held = motion.fastest is not None and abs(names[V_P]) > names[motion.fastest] * (1 + 1e-12)
    expected = "no-border" if motion.fastest is None else "reached-and-held" if held else "not-reached"
    yield told.border.key == expected and told.border.about["limits"] == outcome.limits
    yield facts.direction == _direction(motion)
    yield all(motion.rates[name] == rate for name, _, rate in facts.given)


def _sides(relation: Relation) -> Chain:
    return tuple(each for each in (relation.left, relation.right) if isinstance(each, TREES))


def _binding(ways: Ways, outcome: Outcome) -> Iterator[bool]:
    """Just the limits that are told would allow a shorter time if they were wider."""
    least = searched(ways).time
    wider = {
        1: Ways(ways.d, ways.v_0, ways.v_f, ways.a_max, 1.01 * ways.v_max),
        2: Ways(ways.d, ways.v_0, ways.v_f, 1.01 * ways.a_max, ways.v_max),
    }
    for rate, each in wider.items():
        shorter = searched(each).time < least * (1 - LOOSE)
        yield shorter == ((0, rate) in outcome.active)


def _plots(
    motion: Motion, outcome: Outcome, profile: Profile, problem: Problem, point: Mapping[str, float]
) -> tuple[Figure, ...]:
    """The motion from where it starts, as its results say; none where symbols are left."""
    try:
        ways = motion.at(point)
        time, t_1, t_2, v = (value_of(outcome.values[name], point) for name in NUMBERS)
        start = value_of(profile.journey.start if profile.journey else ZERO, point)
    except KeyError:
        return ()
    moments: dict[Expr, float] = {T_1: t_1, **({T_2: t_2} if motion.coasts else {}), TIME: time}
    courses: dict[Label, Course] = {"": course(ways, Switched(v, t_1, t_2, time), start)}
    (drawn,) = courses.values()
    end = arrays(profile.journey.end, point) if profile.journey else start + ways.d
    if not drawn or not close(value_at(drawn, time), end):
        raise NotAsWritten("a motion is not drawn to its end")
    return (panels("motion", courses, profile.sort, problem.style.degrees, moments),)
