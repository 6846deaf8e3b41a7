"""The cubic spline through via points: place, velocity and acceleration continuous."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.algebra.infix import text
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, PageFacts, Phrase, Step, Table
from derive.errors import NotDerivable
from derive.expression import (
    ZERO,
    Expr,
    Measured,
    Symbol,
    column,
    free_symbols,
    number,
    symbols,
)
from derive.kinds.checks import law, lists
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.profile._drawn import Drawn, LimitTold
from derive.kinds.profile._knots import Ends, Knots, plain, read, span_of, system
from derive.kinds.profile._pieces import Span, branch, joined, times_of
from derive.kinds.profile._spline_checks import asked, claims
from derive.kinds.profile._spline_laws import laws
from derive.kinds.profile._units import units_of
from derive.kinds.work import Work
from derive.mechanics.profile import Journey, Profile, Units

NEEDS = ("journey", "time")
USES = frozenset({"start_velocity", "end_velocity", "via"})
MOST_BY_SYMBOLS = 3  # via points at times that are symbols
CLAIMS = (
    "q-is-continuous", "velocity-is-continuous", "passes-every-point", "all-conditions",
    "velocity-at-the-start|acceleration-at-the-start", "velocity-at-the-end|acceleration-at-the-end",
)  # fmt: skip
CLAIMED = {"q": "passes-every-point"}


class Options(OptionsModel):
    """What is said of the ends."""

    ends: Ends = "clamped"
    """clamped: the velocities at the ends are given, zero if nothing is said; natural: no acceleration at the
    ends."""
    evaluate: Evaluation = None


class Facts(PageFacts):
    natural: bool
    given_velocity: bool
    points: Table
    pieces: Table
    units: Units
    drawn: bool
    limits: tuple[LimitTold, ...]


def derive(profile: Profile, options: Options, problem: Problem) -> Derivation:
    """The velocities from a tridiagonal system, then a cubic between each two points (Siciliano et al.,
    section 4.2.2; Craig, section 7.3). Raises NotDerivable without via points."""
    journey = profile.journey
    if journey is None or not journey.via:
        raise NotDerivable(
            "there are no via points: add via: [{time: 1 s, at: 10 deg}], or ask cubic-trajectory"
        )
    if options.ends == "natural" and (journey.start_velocity, journey.end_velocity) != (ZERO, ZERO):
        raise NotDerivable(
            "natural ends are given no velocity: leave start_velocity: and end_velocity: out", "ends"
        )
    knots = _knots(journey, profile, options.ends, problem)
    if len(journey.via) > MOST_BY_SYMBOLS and any(free_symbols(problem.final(time)) for time in knots.times):
        raise NotDerivable(f"with more than {MOST_BY_SYMBOLS} via points their times must be numbers", "via")
    A, b = system(knots)
    velocities = (A.inverse() @ b).entries
    working = knots.working
    written = tuple(working.readable(v) for v in velocities)
    spans = tuple(span_of(knots, velocities, k) for k in range(knots.spans))
    drawn = Drawn.of(spans, profile, problem, options.evaluate)
    names: dict[Expr, Expr] = {Symbol(f"v_{k}"): value for k, value in enumerate(written)}
    general = laws(options.ends == "natural", knots.spans)
    units = units_of(profile, {**dict.fromkeys(names, 1), **_coefficients()})
    rate = units.get(Symbol("v_0"), "").removeprefix("deg")
    work = working.knowing(names).showing(*general, *_steps(knots, A, b, written, rate)).linked()
    work = work.claim(*joined(spans, working, 3 if all(v is None for v in knots.velocities[1:-1]) else 2))
    work = work.claim(*_passes(knots, spans))
    results = {name: work.final(name) for name in map(text, names)}
    pieces = tuple(branch(span.law, span.start, span.end, problem) for span in spans)
    facts = _facts(knots, spans, profile, drawn, options)
    chains = [step.chain for step in work.steps if step.rule != "law"]
    chains += [(Symbol(name), tree) for name, tree in results.items()]
    given = asked(journey, profile.time, options.ends == "natural")
    work = work.claim(*claims(given, chains, pieces, facts.pieces, problem))
    work = work.law("all-conditions", lists(facts.points, zip(*given[:2], strict=True)))
    timed = [(piece.values["q"], times_of(piece)) for piece in pieces]
    moments: dict[Expr, Expr] = {Symbol(f"t_{k}"): t for k, t in enumerate(knots.times) if k}
    work = work.claim(*drawn.claims(timed, facts.limits, facts.drawn, moments=moments))
    return work.answer(
        "spline-trajectory",
        {**results, "q": pieces},
        facts,
        evaluated=drawn.evaluated(results),
        plots=drawn.plots("spline", moments, through=True),
        units=units,
    )


# -- the points ---------------------------------------------------------------------------------------


def _knots(journey: Journey, profile: Profile, ends: Ends, problem: Problem) -> Knots:
    times = (ZERO, *(via.time for via in journey.via), profile.time or ZERO)
    places = (journey.start, *(via.place for via in journey.via), journey.end)
    clamped = ends == "clamped"
    velocities = (
        journey.start_velocity if clamped else None,
        *(via.velocity for via in journey.via),
        journey.end_velocity if clamped else None,
    )
    working = Work(problem, {}, profile.sort == "angle" and problem.style.degrees)
    return Knots(times, places, velocities, ends, working)


# -- steps and facts ----------------------------------------------------------------------------------


def _steps(
    knots: Knots, A: ScalarMatrix, b: ScalarMatrix, written: Sequence[Expr], rate: str
) -> Iterator[Step]:
    """The system, its times bare numbers so that every row has the unit of a velocity; and what it gives."""
    unknown = column(Symbol(f"v_{k}") for k in range(knots.spans + 1))
    decimals = knots.working.problem.style.decimals
    right = column(read(knots.working.readable(entry), decimals) for entry in b.entries)
    yield Step("system", (plain(A, knots) * unknown, Measured(right, rate) if rate else right))
    shown = column(read(each, decimals) for each in written)
    yield Step("velocities", (unknown, shown))


def _facts(knots: Knots, spans: Sequence[Span], profile: Profile, drawn: Drawn, options: Options) -> Facts:
    c = symbols("a_0 a_1 a_2 a_3")
    rows = tuple(
        (number(k), s.start, s.end, *(read(each, drawn.problem.style.decimals) for each in s.coefficients))
        for k, s in enumerate(spans, 1)
    )
    points = tuple(
        (number(k), time, place)
        for k, (time, place) in enumerate(zip(knots.times, knots.places, strict=True))
    )
    return Facts(
        natural=options.ends == "natural",
        given_velocity=any(velocity is not None for velocity in knots.velocities[1:-1]),
        points=Table((Phrase("point"), Symbol("t"), Symbol("q")), points),
        pieces=Table((Phrase("piece"), Phrase("from"), Phrase("to"), *c), rows),
        units=profile.units,
        drawn=drawn.course is not None,
        limits=drawn.limits(),
    )


def _coefficients() -> dict[Expr, int | None]:
    """Those of a piece, each with the time that it is divided by."""
    return {Symbol(f"a_{k}"): k for k in range(4)}


# -- what it is held to -------------------------------------------------------------------------------


def _passes(knots: Knots, spans: Sequence[Span]) -> Iterator[Claim]:
    """Through every point; at the ends as it should."""
    working = knots.working
    lengths = [working.scalar(span.end - span.start) for span in spans]
    places = knots.scalars(knots.places)
    through = [span.derivative(working, Scalar.of(0), 0) == places[k] for k, span in enumerate(spans)]
    yield law("passes-every-point", (*through, spans[-1].derivative(working, lengths[-1], 0) == places[-1]))
    ends = ((0, Scalar.of(0), "velocity-at-the-start", "acceleration-at-the-start"),
            (-1, lengths[-1], "velocity-at-the-end", "acceleration-at-the-end"))  # fmt: skip
    for k, at, moving, free in ends:
        given = knots.velocities[k]
        if given is None:
            yield law(free, not spans[k].derivative(working, at, 2))
        else:
            yield law(moving, spans[k].derivative(working, at, 1) == working.scalar(given))
