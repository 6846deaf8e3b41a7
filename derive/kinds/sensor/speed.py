"""The speed that the counts of an encoder within a period tell, and how finely they tell it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import tau

from pydantic import field_validator

from derive.algebra.formulas.quantities import rational
from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.derivation import Claim, Derivation, PageFacts
from derive.expression import ONE, Call, Expr, Symbol, free_symbols
from derive.expression import replace as put_in
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import Formula, OptionsModel, Time
from derive.kinds.problem import Problem
from derive.kinds.sensor._encoder import DELTA, counted
from derive.kinds.sensor._oracle import turned
from derive.kinds.work import Work
from derive.mechanics.sensing import Encoder

NEEDS = ("encoder",)
CLAIMS = ("edge-by-edge|turned-so-far", "as-given")
OMEGA = Symbol("omega")


class Options(OptionsModel):
    """`counts` were counted within `period`; they are negative where the disc turns backwards."""

    counts: Formula
    period: Time

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


class Facts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    n: Expr
    T: Expr
    gear: Symbol | None


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
    work = work.claim(*_claims(encoder, options, problem, results, base))
    facts = Facts(
        given=tuple((name, value) for name, value in work.typed if name in (n, T)),
        n=n, T=T, gear=gear, numbers=("omega", "omega_motor", "quantum", "relative"),
    )  # fmt: skip
    work = work.claim(route("as-given", _as_given(work, options, facts)))
    return work.answer("speed", results, facts)


def _claims(
    encoder: Encoder, options: Options, problem: Problem, results: dict[str, Expr], base: Derivation
) -> Iterator[Claim]:
    """The encoder driven as fast as that for so long; by the counts of a turn where it cannot be built."""
    counts, period, gear = (problem.final(e) for e in (options.counts, options.period, encoder.gear or ONE))
    symbols = sorted(problem.symbols | free_symbols(counts) | free_symbols(period))
    turn = base.scalar("counts")
    built = [*turned(encoder, symbols, problem.final)]
    driven = built or [(at_, at(turn, at_), at(gear, at_)) for at_ in random_points(symbols, 3)]
    found = [
        each
        for point, edges, ratio in driven
        for each in _driven(results, point, at(counts, point), at(period, point), edges, ratio)
    ]
    yield route("edge-by-edge" if built else "turned-so-far", found)


def _driven(
    results: dict[str, Expr], point: Point, n: float, T: float, edges: float, gear: float
) -> Iterator[bool]:
    """What is counted within T at the speed found and at a quantum more; what the motor does meanwhile."""
    omega, quantum, relative = (at(results[name], point) for name in ("omega", "quantum", "relative"))
    per_turn = edges * gear
    yield close(omega * T * per_turn / tau, n)
    yield close((omega + quantum) * T * per_turn / tau, n + 1)
    yield close(relative * abs(n), 1.0)
    if "omega_motor" in results:
        yield close(at(results["omega_motor"], point) * T * edges / tau, n)


def _as_given(work: Work, options: Options, told: Facts) -> Iterator[bool]:
    """The names of what was counted, and in which time, stand for what is given."""
    for name, typed in ((told.n, options.counts), (told.T, options.period)):
        yield work.value(put_in(name, work.definitions)) == work.value(typed)
    yield told.given == tuple(pair for pair in work.typed if pair[0] in (told.n, told.T))
    if told.gear is not None:
        yield work.value(told.gear * OMEGA) == work.value(Symbol("omega_m"))
