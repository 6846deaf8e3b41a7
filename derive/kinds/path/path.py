"""A path by its parameter: tangent, normal, binormal, curvature and length."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.derivation import Derivation, PageFacts, Phrase, Record, Result
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Relation, Symbol
from derive.kinds.bare_units import bare_units, meters_and_seconds
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.meanings import as_told
from derive.kinds.path._drawn import drawn
from derive.kinds.path._frenet import E_B, E_N, E_T, KAPPA, Bent, bent
from derive.kinds.path._length import SIGMA, measured
from derive.kinds.path._meanings import meant
from derive.kinds.path._motion import Motion, in_motion
from derive.kinds.path._shapes import along
from derive.kinds.path._spline import C, SplineTold, splined
from derive.kinds.path._timing import T
from derive.kinds.path._told import given_names, shape_told
from derive.kinds.path._turning.course import Part
from derive.kinds.path._turning.told import turning
from derive.kinds.problem import Problem
from derive.kinds.values_at import Here, point_of, values_at
from derive.kinds.work import Work
from derive.mechanics.paths import Curve, Path, Via

TIMED = ("p", "v", "a", "curvature", "t", "n", "b", "s", "time")
CLAIMED = dict.fromkeys(TIMED, "timed|all-conditions") | {"length": "all-conditions"}
CLAIMED |= dict.fromkeys(("R", "angle", "axis", "q", "angles", "omega", "alpha"), "turns")
UNITS: dict[Expr | Phrase, str] = dict(zip(C, ("m", "m/s", "m/s^2", "m/s^3"), strict=True))
BENT = ("n", "b")  # what a path has only where it bends
DIFFERENCES, STRAIGHT = 1e-6, 1e-9
TANGENTS = {  # by whether s is the arc length, and whether the path is straight
    (True, True): "tangent-of-length-same", (True, False): "tangent-of-length-along",
    (False, True): "tangent-same", (False, False): "tangent-along",
}  # fmt: skip
LENGTHS = {"steady": "length-steady", "integral": "length-integral", "quadrature": "length-quadrature"}


def measures(path: Path) -> dict[str, str]:
    """Of a body that turns, where times were typed in seconds."""
    seconds = "s" in meters_and_seconds(path.timing)
    return {"omega": "rad/s", "alpha": "rad/s^2"} if path.turned is not None and seconds else {}


class Options(OptionsModel):
    """`evaluate`: values of symbols, of the parameter, or with a timing of the time t."""

    evaluate: Evaluation = None


class CurveTold(Record):
    """A path that is one formula of its parameter."""

    shape: Phrase
    typed: bool  # whether p is given as such
    given: tuple[tuple[Expr, Expr], ...]  # names of what is given
    advance: Symbol | None  # of a helix in a turn
    before: tuple[str, ...]  # steps: what p is made of
    s: Symbol
    first: Symbol
    second: Symbol
    speed: Symbol
    sigma: Symbol = SIGMA
    tangent: Phrase
    bend: Phrase
    across: tuple[str, ...]  # the step of dp/ds x d2p/ds2, where it is needed
    beside: Phrase | None  # of it
    binormal: Phrase | None  # where that comes last
    frame: tuple[str, ...]  # steps of e_n and e_b
    length: Phrase | None
    lengths: tuple[str, ...]  # steps


class Facts(PageFacts):
    curve: CurveTold | None = None
    spline: SplineTold | None = None
    motion: Motion | None = None
    turning: tuple[Part, ...] = ()
    pictures: tuple[str, ...] = ()


def claims_of(path: Path, options: Options) -> tuple[str, ...]:
    """The keys of what is claimed; of a motion that too."""
    if isinstance(path.shape, Via):
        return ("passes-every-point", "is-smooth", "all-conditions")
    more = ("timed",) * (path.timing is not None) + ("turns",) * (path.turned is not None)
    return ("differences", "unit", "frenet", *more)


def derive(path: Path, options: Options, problem: Problem) -> Derivation:
    """p(s), dp/ds, the unit vectors t, n, b (columns of 2 or 3), the curvature and the length.

    Siciliano et al., section 4.3.1.
    """
    if isinstance(path.shape, Via):
        return _through_points(path, options, problem)
    found = bent(along(path, problem))
    long = measured(found)
    work, way = _obeys(long.work, found), found.along
    curve = _curve(path, found, work, long.way)
    symbols = problem.symbols | {way.s.name}
    work = as_told(work, partial(meant, problem, found), curve.given, "differences", DIFFERENCES, symbols)
    work = work.law("said", _said(curve, found, work))
    facts = Facts(curve=curve, page_names=_page_names(found))
    results = _results(work, found, (way.p, found.first, found.second), long.way)
    named = _to_its_length(found, work)
    if path.timing is not None:
        moved = in_motion(work, named, path.timing, facts.page_names)
        by_parameter = _results(moved.work, found, (way.p, *moved.rates), long.way)
        work, results, motion = moved.finished(by_parameter)
        facts = replace(facts, motion=motion, page_names=moved.on_page)
    if path.turned is not None:
        body = turning(work, path.turned, named, None if path.timing is None else moved.time)
        work, results = body.work, {**results, **body.results}
        work = work.law("said", ("omega" in results) == (path.timing is not None))
        on_page = {**facts.page_names, **body.way.page_names}
        facts = replace(facts, turning=body.way.parts, page_names=on_page)
        facts = replace(facts, angle_results=("angle", "angles"), style=problem.style)
    pictures = tuple(drawn(work, found, results))
    facts = replace(facts, pictures=tuple(each.name for each in pictures))
    return _evaluated(work.answer("path", results, facts, plots=pictures), options, problem)


def _to_its_length(found: Bent, work: Work) -> Bent:
    """With the name of the length at the end, where the parameter is the arc length from the start."""
    along = found.along
    if along.between is None or along.between[0] != ZERO or along.L not in work.known or not found.unit:
        return found
    return replace(found, work=work, along=replace(along, between=(ZERO, along.L)))


def _through_points(path: Path, options: Options, problem: Problem) -> Derivation:
    """The cubic spline of each coordinate."""
    spline = splined(problem, bent=True)
    results = spline.results()
    work = spline.proved(results)
    pictures = tuple(spline.drawn(results))
    facts = Facts(
        spline=spline.told, pictures=tuple(each.name for each in pictures), page_names=spline.on_page,
        numbers=tuple(name for name in results if name not in BENT),
    )  # fmt: skip
    typed = {"m", "s"} <= bare_units(problem)
    answer = work.answer("path", results, facts, plots=pictures, units=UNITS if typed else {})
    if options.evaluate is not None:
        _require_between(spline.shape, dict(options.evaluate), problem)
    return _where_bent(_evaluated(answer, options, problem), spline.shape, problem)


def _where_bent(answer: Derivation, shape: Via, problem: Problem) -> Derivation:
    """Without a normal at a point where the path does not bend."""
    found = answer.evaluated or {}
    kappa, v = found.get("curvature"), found.get("v", ())
    if not isinstance(kappa, float) or not all(isinstance(each, float) for each in v):
        return answer
    point = point_of({"begin": shape.times[0], "end": shape.times[-1]}, problem.where)
    if kappa * math.hypot(*v) * (point["end"] - point["begin"]) > STRAIGHT:
        return answer
    return replace(answer, evaluated={name: each for name, each in found.items() if name not in BENT})


def _require_between(shape: Via, at: Mapping[str, Expr], problem: Problem) -> None:
    """Raises NotDerivable for a time before the first point or after the last."""
    point = point_of({**at, "begin": shape.times[0], "end": shape.times[-1]}, problem.where)
    if T.name in point and not point["begin"] <= point[T.name] <= point["end"]:
        raise NotDerivable(
            f"the motion lasts from t = {point['begin']:.3g} to {point['end']:.3g}", "evaluate"
        )


def _evaluated(answer: Derivation, options: Options, problem: Problem) -> Derivation:
    """With the numbers at the author's point."""
    if options.evaluate is None:
        return answer
    here = Here.of(dict(options.evaluate), problem.where, problem.style)
    numbers = values_at(answer, here)
    if problem.subject.timing:
        _require_within(here, numbers)
    return replace(answer, evaluated=numbers)


def _require_within(here: Here, numbers: Mapping[str, Any]) -> None:
    """Raises NotDerivable for a time before the motion begins or after its end."""
    time, whole = here.point.get(T.name), numbers.get("time")
    if time is not None and isinstance(whole, float) and not 0 <= time <= whole:
        raise NotDerivable(f"the motion is over at t = {whole:.3g}, and begins at 0", "evaluate")


def _results(work: Work, found: Bent, place: tuple[Symbol, Symbol, Symbol], way: str) -> dict[str, Result]:
    """By their names in the JSON."""
    names = dict(zip("pva", place, strict=True))
    if way:
        names["length"] = found.along.L
    names |= {"curvature": KAPPA, **dict(zip("tnb", found.frame, strict=False))}
    return {key: work.final(name) for key, name in names.items()}


def _obeys(work: Work, found: Bent) -> Work:
    """Unit vectors, perpendicular to each other, that turn with the curvature (Frenet)."""
    frame = ScalarMatrix.beside([work.value_matrix(each) for each in found.frame])
    work = work.law("unit", frame.T @ frame == ScalarMatrix.identity(len(found.frame)))
    s, kappa, speed = found.along.s.name, work.value_matrix(KAPPA)[0, 0], work.value_matrix(found.speed)[0, 0]
    turning = work.value_matrix(E_T).diff(s)
    along_normal = work.value_matrix(E_N).scaled(kappa * speed) if not found.straight else turning.scaled(0)
    work = work.law("frenet", turning == along_normal)
    if SIGMA in work.known:
        work = work.law("arc-length", work.value_matrix(SIGMA).diff(s)[0, 0] == speed)
    return work


def _curve(path: Path, found: Bent, work: Work, way: str) -> CurveTold:
    names = {step.name for step in work.steps}

    def those(*steps: Expr) -> tuple[str, ...]:
        return tuple(
            str(each)
            for step in steps
            for each in [step.name if isinstance(step, Symbol) else ""]
            if each in names
        )

    along = found.along
    lengths = tuple(name for name in those(SIGMA, along.L) if name not in along.lines)
    low, high = along.between or (ZERO, ZERO)
    ends: dict[str, Any] = {"s": along.s, "low": low, "high": high}
    ends |= {"start": Relation(along.s, "=", low), "end": Relation(along.s, "=", high)}
    bend = _bend(found.straight, found.steady, found.flat)
    about = {**ends, "speed": found.speed, "sigma": SIGMA}
    return CurveTold(
        shape=shape_told(path, along.s),
        typed=isinstance(path.shape, Curve),
        given=given_names(work, found.along),
        advance=found.along.given.get("pitch"),
        before=along.lines,
        s=along.s,
        first=found.first,
        second=found.second,
        speed=found.speed,
        tangent=Phrase(TANGENTS[found.unit, found.straight], {"s": along.s}),
        bend=Phrase(bend),
        beside=Phrase("beside-across") if bend == "bend-across" else None,
        binormal=Phrase("then-binormal") if bend == "bend-steady" and not found.flat else None,
        across=those(found.across) if not found.steady and not found.flat else (),
        frame=those(E_N, E_B) if found.steady or found.flat else those(E_B, E_N),
        length=Phrase(LENGTHS[way], about) if way and lengths else None,
        lengths=lengths,
    )


def _bend(straight: bool, steady: bool, flat: bool) -> str:
    """How the curvature is seen."""
    if straight:
        return "bend-none"
    return "bend-steady" if steady else "bend-flat" if flat else "bend-across"


def _page_names(found: Bent) -> dict[str, str]:
    """What the results are called on the page."""
    names = {
        "p": found.along.p,
        "v": found.first,
        "a": found.second,
        "length": found.along.L,
        "curvature": KAPPA,
    }
    return {key: name.name for key, name in {**names, "t": E_T, "n": E_N, "b": E_B}.items()}


def _said(facts: CurveTold, found: Bent, work: Work) -> tuple[bool, ...]:
    """What is said of the parameter and of the curvature."""
    s = found.along.s.name
    squared = (work.value_matrix(found.first).T @ work.value_matrix(found.first))[0, 0]
    turned = work.value_matrix(E_T).diff(s)
    flat = work.value_matrix(found.first).shape[0] == 2
    bend = _bend(not turned, not squared.diff(s), flat)
    return (
        facts.tangent.key == TANGENTS[squared == 1, not turned],
        facts.tangent.about == {"s": found.along.s},
        facts.bend.key == bend,
        (facts.beside is not None) == (bend == "bend-across") == bool(facts.across),
        (facts.binormal is not None) == (bend == "bend-steady" and not flat),
    )
