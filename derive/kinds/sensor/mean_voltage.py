"""The mean of a voltage that is switched on and off, or the duty that gives a wanted mean."""

from __future__ import annotations

from derive.algebra.numbers.floats import number as at
from derive.derivation import Claim, Derivation, PageFacts
from derive.expression import ONE, ZERO, Expr, Symbol, symbols
from derive.kinds.checks import SECOND_ROUTE, close, random_points
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import PulseWidth
from derive.names import named

NEEDS = ("voltage",)
MEAN, DUTY, PERIOD = symbols("U_m D T")
SAMPLES = 1000


class Facts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    bipolar: bool
    inverse: bool
    timed: bool
    high: Expr
    low: Expr
    duty: Expr
    law: tuple[Expr, Expr]


def derive(voltage: PulseWidth, options: Options, problem: Problem) -> Derivation:
    """The area under one period over its length."""
    work, (high,) = Work(problem).naming(U=voltage.high)
    low, mean, duty = named("U_0", voltage.low, problem.taken), MEAN, DUTY
    bipolar = problem.final(voltage.low) != ZERO
    if bipolar:
        work, (low,) = work.naming(U_0=voltage.low)
    if voltage.duty is not None:
        work, (duty,) = work.naming(D=voltage.duty)
    if voltage.mean is not None:
        work, (mean,) = work.naming(U_m=voltage.mean)
    work = _solved(work, voltage, (high, low, mean, duty), bipolar)
    results = {"mean": work.final(mean), "duty": work.final(duty)}
    if voltage.frequency is not None:
        work, (f,) = work.naming(f=voltage.frequency)
        work = work.worked("t_on", duty / f)
        results["t_on"] = work.final("t_on")
    sampled = _sampled(voltage, problem, results)
    work = work.claim(Claim("sampled-mean", SECOND_ROUTE, sampled))
    facts = Facts(
        given=work.typed, bipolar=bipolar, inverse=voltage.duty is None, high=high, low=low, duty=duty,
        timed=voltage.frequency is not None, law=(mean, _mean(high, low, duty, bipolar)),
    )  # fmt: skip
    return work.answer("mean-voltage", results, facts)


def _mean(high: Expr, low: Expr, duty: Expr, bipolar: bool) -> Expr:
    on = duty * high
    return on + (ONE - duty) * low if bipolar else on


def _solved(
    work: Work, voltage: PulseWidth, names: tuple[Symbol, Symbol, Symbol, Symbol], bipolar: bool
) -> Work:
    high, low, mean, duty = names
    if voltage.duty is not None:
        return work.worked(mean.name, _mean(high, low, duty, bipolar))
    above = mean - low if bipolar else mean
    return work.worked(duty.name, above / (high - low if bipolar else high))


def _sampled(voltage: PulseWidth, problem: Problem, results: dict[str, Expr]) -> bool:
    """In floats: switched sample by sample, with a part of a sample at the edge."""
    for point in random_points(problem.symbols, 2):
        high, low = (at(problem.final(level), point) for level in (voltage.high, voltage.low))
        duty, mean = at(results["duty"], point), at(results["mean"], point)
        shares = [min(1.0, max(0.0, duty * SAMPLES - k)) for k in range(SAMPLES)]
        total = sum(share * high + (1 - share) * low for share in shares) / SAMPLES
        if 0 <= duty <= 1 and not close(total, mean):
            return False
    return True
