"""The speed that the counts of an encoder within a period tell, and how finely they tell it."""

from __future__ import annotations

from dataclasses import replace

from pydantic import field_validator

from derive.algebra.formulas.quantities import rational
from derive.derivation import Derivation
from derive.expression import ONE, Call, Expr, Symbol
from derive.kinds.checks import route
from derive.kinds.fields import Formula, OptionsModel, Time
from derive.kinds.problem import Problem
from derive.kinds.sensor._encoder import DELTA, OMEGA, UNITS, counted
from derive.kinds.sensor._facts import SpeedFacts as Facts
from derive.kinds.sensor._speed_checks import as_given, turning_claims
from derive.mechanics.sensing import Encoder

NEEDS = ("encoder", "size")
USES = frozenset({"lines", "bits", "turn_bits"})
CLAIMS = ("edge-by-edge|turned-so-far", "as-given")


class Options(OptionsModel):
    """What was counted."""

    counts: Formula
    """How many were counted within the period, negative where the disc turns backwards."""
    period: Time
    """How long was counted."""

    @field_validator("counts")
    @classmethod
    def _is_counted(cls, value: Expr) -> Expr:
        if rational(value) == 0:
            raise ValueError("nothing is counted: no speed can be told")
        return value

    @field_validator("period")
    @classmethod
    def _is_positive(cls, value: Expr) -> Expr:
        if (size := rational(value)) is not None and size <= 0:
            raise ValueError("a period must be positive")
        return value


def derive(encoder: Encoder, options: Options, problem: Problem) -> Derivation:
    """Counts times the angle of one, over the period; one count more or less is not seen in between."""
    base = problem.ask("resolution")
    work, gear = counted(problem, encoder)
    told = len(work.steps)
    work, (n, T) = work.naming(n=options.counts, T=options.period)
    work = work.worked("omega", n * DELTA / T)
    if gear:
        work = work.worked("omega_m", gear * OMEGA)
    backwards = (rational(problem.final(options.counts)) or 0) < 0
    size, speed = (Call("abs", (each,)) if backwards else each for each in (n, OMEGA))
    work = work.worked("delta_omega", DELTA / T).worked("relative", ONE / size)
    results: dict[str, Expr] = {"omega": work.final("omega")}
    if gear:
        results["omega_motor"] = work.final("omega_m")
    results |= {"quantum": work.final("delta_omega"), "relative": work.final("relative")}
    share = Symbol("delta_omega") / speed
    last = work.steps[-1]
    work = replace(
        work,
        uses=(base,),
        steps=(*work.steps[told:-1], replace(last, chain=(share, *last.chain[1:]))),
        claims=(),
    )
    work = work.claim(*turning_claims(encoder, (options.counts, options.period), problem, results, base))
    facts = Facts(
        given=tuple((name, value) for name, value in work.typed if name in (n, T)),
        n=n, T=T, gear=gear, numbers=("omega", "omega_motor", "quantum", "relative"),
    )  # fmt: skip
    work = work.claim(route("as-given", as_given(work, (options.counts, options.period), facts)))
    return work.answer("speed", results, facts, units=UNITS)
