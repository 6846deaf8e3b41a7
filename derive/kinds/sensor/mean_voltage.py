"""The mean of a voltage that is switched on and off, or the duty that gives a wanted mean."""

from __future__ import annotations

from derive.algebra.numbers.floats import number as at
from derive.derivation import Claim, Derivation, PageFacts
from derive.expression import ONE, ZERO, Expr, Product, Quotient, Symbol, add, subtract, symbols
from derive.kinds.checks import SECOND_ROUTE, close, links, random_points
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import PulseWidth
from derive.names import named

NEEDS = ("voltage",)
RESULTS = {
    "mean": "the mean voltage [V]",
    "duty": "the share of each period for which it is on",
    "t_on": "how long it is on in each period, where the frequency is given [s]",
}
EXAMPLE = """\
title: Pulse-width modulation
problems:
- sensor: {pwm: 12 V, duty: 40%}
  find: mean-voltage
- sensor: {pwm: 24 V, low: -24 V, mean: 6 V, frequency: 1000 Hz}
  find: mean-voltage
"""
MEAN, DUTY, PERIOD = symbols("U_m D T")
SAMPLES = 1000


class Options(OptionsModel):
    """None."""


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
    high, low = named("U", voltage.high, problem.taken), named("U_0", voltage.low, problem.taken)
    values: dict[Expr, Expr] = {high: voltage.high}
    bipolar = problem.final(voltage.low) != ZERO
    values |= {low: voltage.low} if bipolar else {}
    mean, duty = _names(voltage, problem)
    if voltage.duty is not None:
        values[duty] = voltage.duty
    if voltage.mean is not None:
        values[mean] = voltage.mean
    working = _solved(Work(problem, values), voltage, (high, low, mean, duty), bipolar)
    results = {"mean": problem.final(working.known[mean]), "duty": problem.final(working.known[duty])}
    if voltage.frequency is not None:
        f = named("f", voltage.frequency, problem.taken)
        working = working.knowing({f: voltage.frequency}).worked("t_on", Quotient(duty, f))
        results["t_on"] = working.final("t_on")
    claims = (
        *links(working.steps, {**problem.names, **working.definitions}),
        Claim(
            "the mean of the voltage, sampled over a period",
            SECOND_ROUTE,
            _sampled(voltage, problem, results),
        ),
    )
    facts = Facts(
        given=working.typed, bipolar=bipolar, inverse=voltage.duty is None, high=high, low=low, duty=duty,
        timed=voltage.frequency is not None, law=(mean, _mean(high, low, duty, bipolar)),
    )  # fmt: skip
    return Derivation("mean-voltage", working.steps, results, claims, working.definitions, facts=facts)


def _names(voltage: PulseWidth, problem: Problem) -> tuple[Symbol, Symbol]:
    return (
        MEAN if voltage.mean is None else named("U_m", voltage.mean, problem.taken),
        DUTY if voltage.duty is None else named("D", voltage.duty, problem.taken),
    )


def _mean(high: Expr, low: Expr, duty: Expr, bipolar: bool) -> Expr:
    on = Product((duty, high))
    return add(on, Product((subtract(ONE, duty), low))) if bipolar else on


def _solved(
    working: Work, voltage: PulseWidth, names: tuple[Symbol, Symbol, Symbol, Symbol], bipolar: bool
) -> Work:
    high, low, mean, duty = names
    if voltage.duty is not None:
        return working.worked(mean.name, _mean(high, low, duty, bipolar))
    above = subtract(mean, low) if bipolar else mean
    return working.worked(duty.name, Quotient(above, subtract(high, low) if bipolar else high))


def _sampled(voltage: PulseWidth, problem: Problem, results: dict[str, Expr]) -> bool:
    """In floats: switched sample by sample, with a part of a sample at the edge."""
    for point in random_points(sorted(problem.symbols), 2) if problem.symbols else iter([{}]):
        high, low = (at(problem.final(level), point) for level in (voltage.high, voltage.low))
        duty, mean = at(results["duty"], point), at(results["mean"], point)
        shares = [min(1.0, max(0.0, duty * SAMPLES - k)) for k in range(SAMPLES)]
        total = sum(share * high + (1 - share) * low for share in shares) / SAMPLES
        if 0 <= duty <= 1 and not close(total, mean):
            return False
    return True
