"""A linear segment with parabolic blends: constant velocity between two ends that are smoothed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from derive.algebra.rationals import significant_digits
from derive.derivation import Claim, Derivation, PageFacts, Phrase, Record, Step
from derive.errors import NotDerivable
from derive.expression import Degrees, Expr, Number, Relation, Symbol, measured
from derive.kinds.checks import law
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.profile._blends import (
    POSSIBLE,
    T_B,
    A,
    Blended,
    V,
    blended,
    filled_laws,
    filled_span,
    worked_out,
)
from derive.kinds.profile._blends_checks import Blends
from derive.kinds.profile._drawn import Drawn, LimitTold
from derive.kinds.profile._pieces import Span, branch, joined, times_of
from derive.kinds.profile._units import units_of
from derive.kinds.work import Work
from derive.mechanics.profile import Profile, Units

NEEDS = ("journey",)
USES = frozenset({"cruise", "acceleration", "blend"})
q = Symbol("q")
SHORT, LONG = 5, 99  # digits of a bound
CLAIMS = ("q-is-continuous", "velocity-is-continuous", "ends-there", "ends-at-rest", "as-told")
CLAIMED = dict.fromkeys(("q", "t_f", "t_b", "v", "a"), "as-told")


class Options(OptionsModel):
    """Where symbols stand for something, `evaluate` draws the trajectory at a point; with t also q there."""

    evaluate: Evaluation = None


class PieceTold(Record):
    step: str
    what: Phrase


class Facts(PageFacts):
    given: tuple[tuple[Expr, Expr, int | None], ...]  # each with how often it is differentiated
    units: Units
    how: Phrase  # it comes about
    lines: tuple[str, ...]  # steps
    back: Phrase | None  # the sign of what was given
    smaller: Phrase | None  # of two roots
    possible: Phrase | None  # which values, where symbols leave that open
    between: Phrase | None  # that the given number is between those bounds
    pieces: tuple[PieceTold, ...]
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
    shown = [k for k in (1, 2, 3) if k != 2 or work.sign(found.T - 2 * T_B) != 0]
    facts = _facts(found, lines, profile, drawn, shown)
    facts = replace(facts, numbers=tuple(n for n, tree in results.items() if not isinstance(tree, Symbol)))
    steps = _piece_steps(found.laws(), laws, found.open)
    work = replace(work.showing(*(steps[k - 1] for k in shown)), uses=found.uses).linked()
    work = work.claim(*joined(found.spans(), work, 2), *_ends_of(found, work))
    chains = [step.chain for step in work.steps]
    chains += [(Symbol(name), tree) for name, tree in results.items()]
    chains += [(name, value) for name, value, _ in facts.given]
    checked = Blends(journey, profile, problem, found)
    by_name = {step.name: step for step in work.steps}
    told = {int(each.step[-1]): (by_name[each.step].chain, each.what) for each in facts.pieces}
    work = work.claim(*checked.claims([each for each in chains if each[0] != q], pieces, told))
    work = work.claim(
        *checked.said(facts.how, facts.back, facts.smaller, facts.possible, facts.given, facts.between)
    )
    timed = [(piece.values["q"], times_of(piece)) for piece in pieces]
    t_b, t_f = results["t_b"], results["t_f"]
    moments = {T_B: t_b, found.T - T_B: t_f - t_b, found.T: t_f}
    work = work.claim(*drawn.claims(timed, facts.limits, facts.drawn, results, moments))
    return work.answer(
        "lspb-trajectory",
        {**results, "q": pieces},
        facts,
        evaluated=drawn.evaluated(results),
        plots=() if any(base.plots for base in found.uses) else drawn.plots("lspb", moments),
        units=units_of(profile, found.rates),
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


def _facts(
    found: Blended, lines: tuple[str, ...], profile: Profile, drawn: Drawn, shown: Iterable[int]
) -> Facts:
    working = found.working
    spans = {k: span for k, span in enumerate(found.spans(), 1) if k in shown}
    return Facts(
        given=tuple((n, value, found.rates[n]) for n, value in working.typed if n in found.rates),
        units=profile.units,
        lines=lines,
        back=_back(found),
        smaller=Phrase("smaller-root") if found.by == "a" else None,
        possible=(possible := _possible(found)),
        between=_met(possible, found),
        pieces=tuple(PieceTold(step=f"piece_{k}", what=_piece(k, span)) for k, span in spans.items()),
        how=_how(found),
        drawn=drawn.course is not None,
        limits=drawn.limits(),
    )


def _back(found: Blended) -> Phrase | None:
    """Why a velocity or an acceleration is negative."""
    if found.given is None or found.by == "t_b" or found.working.sign(found.given) != -1:
        return None
    return Phrase("goes-back", {"given": found.given})


def _how(found: Blended) -> Phrase:
    if found.by == "limits":
        return Phrase("as-the-profile")
    area = Relation(found.way, "=", V * (found.T - T_B))
    if found.by == "a":
        joined = Relation(found.way, "=", A * T_B * (found.T - T_B))
        return Phrase("blended-quadratic", {"v": V, "t_b": T_B, "area": area, "a": A, "joined": joined})
    return Phrase("blended", {"v": V, "t_b": T_B, "area": area})


def _possible(found: Blended) -> Phrase | None:
    """Which velocities, accelerations or durations of the blends make a motion."""
    way, T = found.way, found.T
    if found.given is None:
        return None
    borders: dict[str, dict[str, Expr]] = {
        "v": {"least": way / T, "most": 2 * way / T}, "a": {"least": 4 * way / T**2}, "t_b": {"most": T / 2},
    }  # fmt: skip
    bounds = {name: _with_value(bound, found) for name, bound in borders[found.by].items()}
    return Phrase(POSSIBLE[found.by], {"given": found.given, **bounds})


def _met(possible: Phrase | None, found: Blended) -> Phrase | None:
    """The bounds and the given value in numbers, where all of them are positive numbers."""
    if possible is None or found.given is None:
        return None
    bounds = [possible.about[key] for key in ("least", "most") if key in possible.about]
    value, unit = worked_out(found.given, found.working), found.working.units.get(found.given, "")
    if not isinstance(value, Number | Degrees) or value.value <= 0:
        return None
    ends = [each.right for each in bounds if isinstance(each, Relation)]
    if len(ends) < len(bounds):
        return None
    given, most = measured(value, unit), ends[-1] if "most" in possible.about else None
    least = "<" if found.by == "v" else "<="  # a velocity leaves time for blends
    chain: Expr | Relation = given if "least" not in possible.about else Relation(ends[0], least, given)
    return Phrase("bounds-met", {"chain": chain if most is None else Relation(chain, "<=", most)})


def _with_value(bound: Expr, found: Blended) -> Expr | Relation:
    """A bound, and what it comes to where that is short."""
    value, unit = worked_out(bound, found.working), found.working.units.get(found.given or V, "")
    if not isinstance(value, Number | Degrees) or (significant_digits(value.value) or LONG) > SHORT:
        return bound
    in_size = found.by == "a" and value.value < 0  # of which no sign is told
    return bound if in_size else Relation(bound, "=", measured(value, unit))


def _piece(k: int, span: Span) -> Phrase:
    if k == 1:
        return Phrase("begins", {"start": span.start, "end": span.end})
    return Phrase("goes-on" if k == 2 else "ends", {"end": span.end})
