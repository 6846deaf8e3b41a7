"""One axis held to a search that knows no formula: which case it is, every line of it, and every result."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from math import inf

from derive.algebra.numbers.floats import Point, completed
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Claim, Phrase, Said, Step
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Relation, Symbol
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import TREES
from derive.kinds.meanings import Chain, Names, farthest
from derive.kinds.profile._axis import AxisTold, CaseTold, Solved
from derive.kinds.profile._places import places
from derive.kinds.profile._trapezoid import T_1, T_2, T_M, Outcome
from derive.mechanics import trapezoid
from derive.mechanics.trapezoid import Switching

EACH = 2  # points for a case
TRIED = 20
OPENINGS = {
    True: ("ramps", "ramps-among"),
    False: ("triangle-first", "triangle-among"),
}  # alone, among others
WHAT = {True: ("room", "room-or-none", "no-room", "just-room"), False: ("plateau", "triangle")}
WITH_A_PLATEAU = ("room", "room-or-none", "plateau")
SURE = 1e-12  # of numbers that are compared as they stand
LOOSE = 1e-6  # a search for a flat minimum finds no more digits
PROBE, TO_THE_LIMIT = Symbol("probe"), Symbol("time to the limit")


def claims_about(
    each: Solved,
    steps: Mapping[str, Step],
    told: AxisTold,
    results: Mapping[str, Sequence[Expr]],
    met: int = 0,
) -> Iterator[Claim]:
    """The lines as they stand on the page, by normal form and against the search; `results` are what each
    name is told to be elsewhere, of the case that is `met`."""
    for outcome in each.outcomes:
        for claim in outcome.working.linked().claims:
            yield claim.within("in-case", case=Phrase(outcome.case))
    key = "no-time-is-shorter" if each.time is None else "no-acceleration-is-smaller"
    points = [at for at in random_points(each.problem.symbols, TRIED) if _limits(each, at)]
    yield route("time-too-short" if each.infeasible else key, (_agrees(each, at) for at in points))
    told_at = [(k, at) for k in range(len(each.outcomes)) for at in islice(_of_case(each, k), EACH)]
    own = [results if k == met else {} for k in range(len(each.outcomes))]
    chains = [_chains(each, k, steps, told, own[k]) for k in range(len(each.outcomes))]
    if told_at:
        yield route("as-told", (farthest(chains[k], _meant(each, at)) < LOOSE for k, at in told_at))
        yield route("said", (_verdicts(each, told, k, at) for k, at in told_at))
    if each.open:
        yield route("when", (_told_when(each, told, at) for at in points))


def _limits(each: Solved, at: Point) -> tuple[float, float, float, float | None] | None:
    """The size of the distance, both limits, and the time; None where they are not positive."""
    known, axis = completed(at, each.problem.where), each.axis
    way, v_max = value_of(axis.distance, known), value_of(axis.v_max, known)
    a_max = inf if axis.a_max is None else value_of(axis.a_max, known)
    t_3 = None if each.time is None else value_of(each.time, known)
    d = -way if each.given.backwards else way
    return (d, v_max, a_max, t_3) if min(d, v_max, a_max) > 0 else None


def _searched(each: Solved, at: Point) -> Switching | None:
    given = _limits(each, at)
    return given and trapezoid.searched(*given)


def fastest_time(each: Solved) -> float:
    """The least time of an axis in numbers, by search. Raises NotDerivable for limits below zero."""
    given = _limits(each, {})
    if given is None:
        raise NotDerivable("a distance that is not zero and positive limits are needed")
    return trapezoid.searched_time(*given[:3])


# -- which case --------------------------------------------------------------------------------------


def _of_case(each: Solved, k: int) -> Iterator[Point]:
    """Points where the search finds this case."""
    outcome = each.outcomes[k]
    for at in places(each.problem.symbols):
        given, found = _limits(each, at), _searched(each, at)
        if given and found and (_is_case(outcome, found, given[1]) or not each.open):
            yield at


def _is_case(outcome: Outcome, found: Switching, v_max: float) -> bool:
    """On the border between them both cases are the same motion, a triangle up to the greatest velocity."""
    border = found.t_2 - found.t_1 <= trapezoid.FLAT * found.t_3 and found.v >= v_max * (1 - LOOSE)
    return outcome.case == found.case or (border and "infeasible" not in (outcome.case, found.case))


def _verdicts(each: Solved, told: AxisTold, k: int, at: Point) -> bool:
    """What the words say of a case, at a point where it occurs."""
    given, found, case = _limits(each, at), _searched(each, at), told.cases[k]
    if given is None or found is None:
        return False
    d, v_max, a_max, t_3 = given
    names, ends = each.given, case.ends.key if case.ends else ""
    rates = {names.d: 0, names.fastest: 1, names.strongest: 2, names.t_3: None}
    plateau = found.t_2 - found.t_1 > trapezoid.FLAT * found.t_3
    border = not plateau and found.v >= v_max * (1 - LOOSE)
    stuck = found.case == "infeasible"
    slow = t_3 is not None and v_max * t_3 <= d
    probe, limit = (v_max**2 / a_max, d) if t_3 is None else (2 * d / t_3, v_max)
    equal = abs(probe - limit) <= SURE * limit
    decided = {
        "at-most": probe <= limit * (1 + SURE), "more-than": probe > limit * (1 + SURE), "equal": equal,
    }  # fmt: skip
    backwards = value_of(each.axis.distance, completed(at, each.problem.where)) < 0
    return (
        told.opening.key in OPENINGS[t_3 is None]
        and case.what.key in WHAT[t_3 is None]
        and case.begins.key in ("if", *decided)
        and (case.begins.key == "equal") == (case.what.key == "just-room")
        and (len(told.cases) > 1 or case.what.key != "room-or-none")
        and (len(told.cases) > 1) == (case.begins.key == "if")
        and told.backwards in (None, Phrase("backwards"))
        and len(told.given) in (0, len(names.working.typed))
        and (told.backwards is None or backwards)
        and all(rates[name] == rate for name, _, rate in told.given if isinstance(name, Symbol))
        and ((case.what.key in WITH_A_PLATEAU) == plateau or border or (slow and stuck))
        and decided.get(case.begins.key, len(told.cases) > 1)
        and (ends != "within" or (t_3 is not None and not stuck and found.a <= a_max * (1 + LOOSE)))
        and (ends == "too-fast") == slow
        and (ends == "too-strong") == (stuck and not slow)
    )


def _told_when(each: Solved, told: AxisTold, at: Point) -> bool:
    """Whether just the case that the search finds is said to be the one here."""
    given, found = _limits(each, at), _searched(each, at)
    known = completed(at, each.problem.where)
    pairs = zip(each.outcomes, told.cases, strict=True)
    said = [outcome for outcome, case in pairs if all(_holds(need, known) for need in _needs(case))]
    if given is None or found is None or found.case == "infeasible":
        return not said
    return len(said) == 1 and _is_case(said[0], found, given[1])


def _needs(case: CaseTold) -> Iterator[Relation]:
    """All that is said of when it is the case."""
    for phrase in (case.begins, *([case.ends] if case.ends else [])):
        for said in phrase.about.values():
            parts = said if isinstance(said, tuple) else (said,)
            yield from (part for part in parts if isinstance(part, Relation))


def _holds(need: Relation, at: Point) -> bool:
    if isinstance(need.left, Relation):
        return False
    left, right = value_of(need.left, at), value_of(need.right, at)
    return {"<=": left <= right, ">": left > right}[need.sign]


# -- every line --------------------------------------------------------------------------------------


def _meant(each: Solved, at: Point) -> Names:
    """What was given, and the motion that the search finds; where no velocity would do, what the greatest
    velocity would need."""
    given, found = _limits(each, at), _searched(each, at)
    if given is None or found is None:
        return {}
    (d, v_max, a_max, t_3), names = given, each.given
    values: dict[Expr, float] = {
        names.d: d, names.fastest: v_max, names.strongest: a_max, Symbol("t_3"): found.t_3,
        T_1: found.t_1, T_2: found.t_2, T_M: found.t_2 - found.t_1,
        Symbol("v"): found.v, Symbol("a"): found.a, Symbol("v_p"): found.v, Symbol("a_p"): found.a,
        PROBE: v_max**2 / a_max if t_3 is None else 2 * d / t_3, TO_THE_LIMIT: v_max / a_max,
        Symbol("t_min"): trapezoid.searched_time(d, v_max, a_max),
    }  # fmt: skip
    letters: dict[Expr, float] = {Symbol(name): x for name, x in completed(at, each.problem.where).items()}
    return {**values, **letters, names.t_3: found.t_3}


def _chains(
    each: Solved, k: int, steps: Mapping[str, Step], told: AxisTold, results: Mapping[str, Sequence[Expr]]
) -> list[Chain]:
    """The lines of a case as they stand on the page, and what the words say beside them."""
    case, outcome = told.cases[k], each.outcomes[k]
    chains: list[Chain] = [steps[name].chain for name in case.lines]
    chains += [(name, value) for name, value, _ in told.given]
    if outcome.probe:
        chains.append((PROBE, *steps[told.probe].chain))
    for phrase in (told.letters, told.opening, case.begins, case.what, case.ends, told.least):
        chains += _said(each, phrase.about) if phrase else ()
    if outcome.case == "infeasible":
        return [*chains, *((Symbol("t_min"), tree) for tree in results.get("t_min", ()))]
    own = {name: [*results.get(name, ()), tree] for name, tree in outcome.values.items()}
    symbol = outcome.working.symbol
    return [*chains, *((symbol(name), tree) for name, trees in own.items() for tree in trees)]


def _said(each: Solved, about: Mapping[str, Said]) -> Iterator[Chain]:
    """What the words call something, and the areas and times in them."""
    names = each.given
    called: dict[str, Expr] = {
        "fastest": names.fastest, "strongest": names.strongest, "until": T_1, "after": T_2, "between": T_M,
        "peak": names.working.symbol("v"), "slope": names.working.symbol("a"),
        "rest": Symbol("t_3"), "time": Symbol("t_3"), "ramp": TO_THE_LIMIT,
        "border": names.d if each.time is None else names.fastest,
    }  # fmt: skip
    for name, said in about.items():
        if isinstance(said, TREES):
            yield called[name], said
        elif isinstance(said, Relation) and said.sign != "=" and name not in ("when", "conditions"):
            yield Symbol("t_3"), ZERO  # no equation
        elif isinstance(said, Relation) and said.sign == "=" and isinstance(said.left, TREES):
            yield (called[name], said.left, said.right) if name in called else (said.left, said.right)


def _agrees(each: Solved, point: Point) -> bool:
    """Whether the results are the best that the search finds, and make the motion within the limits."""
    given, best = _limits(each, point), _searched(each, point)
    if given is None or best is None:
        return False
    d, v_max, a_max, _ = given
    if best.case == "infeasible":
        return each.infeasible or each.open
    outcome = next((one for one in each.outcomes if _is_case(one, best, v_max)), None)
    if outcome is None:
        return False
    values = {name: value_of(tree, point) for name, tree in outcome.values.items()}
    found = Switching(best.case, **values)
    pair = (found.t_3, best.t_3) if each.time is None else (found.a, best.a)
    return _moves(found, d, v_max, a_max) and close(*pair, tolerance=LOOSE)


def _moves(found: Switching, d: float, v_max: float, a_max: float) -> bool:
    """Over the distance, from rest to rest, within both limits."""
    course = trapezoid.course(found)
    ends = course[-1].at(course[-1].end), course[-1].at(course[-1].end, 1)
    within = found.v <= v_max * (1 + 1e-9) and found.a <= a_max * (1 + 1e-9)
    return within and close(list(ends), [d, 0.0]) and close(found.a * found.t_1, found.v)
