"""A linear segment with parabolic blends: constant velocity between two ends that are smoothed."""

from __future__ import annotations

from dataclasses import replace

from derive.derivation import Claim, Derivation, PageFacts, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol
from derive.kinds.checks import law
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.profile._blends import T_B, Blended, V, blended, filled_laws, filled_span
from derive.kinds.profile._blends_checks import Blends
from derive.kinds.profile._drawn import Drawn, LimitTold
from derive.kinds.profile._pieces import branch, joined, times_of
from derive.kinds.work import Work
from derive.mechanics.profile import Profile, Units

NEEDS = ("journey",)
USES = frozenset({"cruise", "acceleration", "blend"})
q = Symbol("q")
CLAIMS = ("q-is-continuous", "velocity-is-continuous", "ends-there", "ends-at-rest", "as-told")
CLAIMED = ("q", "t_f", "t_b", "v", "a")


class Options(OptionsModel):
    """Where symbols stand for something, `evaluate` draws the trajectory at a point; with t also q there."""

    evaluate: Evaluation = None


class Facts(PageFacts):
    given: tuple[tuple[Expr, Expr, int | None], ...]  # each with how often it is differentiated
    backwards: bool = False
    units: Units
    by: str
    lines: tuple[str, ...]  # steps
    name: Symbol | None
    V: Symbol = V
    t_b: Symbol = T_B
    area: tuple[Expr, Expr]
    between: tuple[Expr, Expr]
    least: Expr
    half: Expr
    open: bool
    bounds: tuple[tuple[Expr, Expr], ...]
    plateau: bool
    drawn: bool
    limits: tuple[LimitTold, ...]


def derive(profile: Profile, options: Options, problem: Problem) -> Derivation:
    """Three pieces, symmetric in time (Craig, section 7.3; Spong et al., section 5.5.3).

    Raises NotDerivable where nothing says how fast it is, or it cannot be there in time.
    """
    journey = profile.journey
    if journey is None:
        raise NotDerivable("a start and an end are needed")
    found = blended(journey, profile, problem)
    work = found.working
    spans = tuple(filled_span(span, work) for span in found.spans())
    laws = filled_laws(found, work)
    drawn = Drawn.of(spans, profile, problem, options.evaluate)
    results = {name: work.final(name) for name in ("t_b", "v", "a")} | {"t_f": work.final(found.T)}
    bounds = found.spans() if found.open else spans
    pieces = tuple(branch(q_t, s.start, s.end, problem) for q_t, s in zip(laws, bounds, strict=True))
    lines = tuple(step.name for step in work.steps)
    facts = _facts(found, lines, profile, drawn)
    work = replace(work.showing(*_piece_steps(found.laws(), laws, found.open)), uses=found.uses).linked()
    work = work.claim(*joined(found.spans(), work, 2), *_ends_of(found, work))
    chains = [step.chain for step in work.steps]
    chains += [(Symbol(name), tree) for name, tree in results.items()]
    chains += [facts.area, *((name, value) for name, value, _ in facts.given)]
    checked = Blends(journey, profile, problem, found)
    work = work.claim(*checked.claims(chains, pieces, facts.bounds))
    timed = [(piece.values["q"], times_of(piece)) for piece in pieces]
    work = work.claim(*drawn.claims(timed, facts.limits, facts.drawn, results))
    return work.answer(
        "lspb-trajectory",
        {**results, "q": pieces},
        facts,
        evaluated=drawn.evaluated(results),
        plots=drawn.plots("lspb"),
    )


# -- the pieces -------------------------------------------------------------------------------------


def _piece_steps(named_laws: tuple[Expr, ...], laws: tuple[Expr, ...], open_: bool) -> tuple[Step, ...]:
    """Each law in names, and with numbers where there are."""
    steps = []
    for k, (tree, filled) in enumerate(zip(named_laws, laws, strict=True), 1):
        numbers = () if open_ else (filled,)
        steps.append(Step(f"piece_{k}", (q, tree, *numbers)))
    return tuple(steps)


def _ends_of(found: Blended, working: Work) -> tuple[Claim, Claim]:
    last = found.spans()[-1]
    length = working.scalar(T_B)
    there = last.derivative(working, length, 0) == working.scalar(found.end)
    return law("ends-there", there), law("ends-at-rest", last.derivative(working, length, 1) == 0)


# -- what the page needs ------------------------------------------------------------------------------


def _facts(found: Blended, lines: tuple[str, ...], profile: Profile, drawn: Drawn) -> Facts:
    working, way, T = found.working, found.way, found.T
    return Facts(
        given=tuple((n, value, found.rates[n]) for n, value in working.typed if n in found.rates),
        units=profile.units,
        by=found.by,
        lines=lines,
        name=found.given,
        area=(way, V * (T - T_B)),
        between=(way / T, 2 * way / T),
        least=4 * way / T**2,
        half=T / 2,
        open=found.open,
        bounds=tuple((each.start, each.end) for each in found.spans()),
        plateau=working.sign(T - 2 * T_B) != 0,
        drawn=drawn.course is not None,
        limits=drawn.limits(),
    )
