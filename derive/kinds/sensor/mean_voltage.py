"""The mean of a voltage that is switched on and off, or the duty that gives a wanted mean."""

from __future__ import annotations

from collections.abc import Mapping

from derive.derivation import Derivation, Label, Phrase, Plot, Step
from derive.expression import ONE, ZERO, Expr, Symbol, symbols
from derive.figures.waves import switched
from derive.kinds.checks import route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.sensor._facts import VoltageFacts as Facts
from derive.kinds.sensor._voltage_checks import as_drawn, drawn_values, said, sampled
from derive.kinds.work import Work
from derive.mechanics.sensing import PulseWidth

NEEDS = ("voltage",)
CLAIMED = {"duty": "sampled-mean", "mean": "sampled-mean"}
CLAIMS = ("sampled-mean", "as-said", "drawn")
MEAN, DUTY, PERIOD = symbols("U_m D T")
UNITS: Mapping[Expr | Phrase, str] = {
    **dict.fromkeys(symbols("U U_0 U_m"), "V"),
    DUTY: "",
    PERIOD: "s",
    Symbol("f"): "Hz",
    Symbol("t_on"): "s",
}


def derive(voltage: PulseWidth, options: Options, problem: Problem) -> Derivation:
    """The area under one period over its length."""
    work, (high,) = Work(problem, units=UNITS).naming(U=voltage.high)
    low: Expr = ZERO
    mean, duty = MEAN, DUTY
    bipolar = problem.final(voltage.low) != ZERO
    if bipolar:
        work, (low,) = work.naming(U_0=voltage.low)
    if voltage.duty is not None:
        work, (duty,) = work.naming(D=voltage.duty)
    if voltage.mean is not None:
        work, (mean,) = work.naming(U_m=voltage.mean)
    work = work.showing(Step("mean_law", (mean, _mean(high, low, duty, bipolar)), "area"))
    work = _solved(work, voltage, (high, low, mean, duty), bipolar)
    results = {"mean": work.final(mean), "duty": work.final(duty)}
    f: Expr | None = None
    if voltage.frequency is not None:
        work, (f,) = work.naming(f=voltage.frequency)
        period = Step("period", (PERIOD, ONE / f), "law", instance={PERIOD: ONE / work[f], f: work[f]})
        work = work.showing(period).worked("t_on", duty / f)
        results["t_on"] = work.final("t_on")
    facts = Facts(
        given=work.typed, inverse=voltage.duty is None, high=high, low=low if bipolar else None, duty=duty,
        timed=voltage.frequency is not None,
    )  # fmt: skip
    work = work.claim(route("sampled-mean", sampled(voltage, problem, results)))
    work = work.claim(route("as-said", said(voltage, work, facts)))
    plot = _wave(voltage, problem, results, (high, low, mean, duty), f)
    work = work.claim(route("drawn", as_drawn(plot, voltage, problem, results)))
    return work.answer("mean-voltage", results, facts, units=UNITS, plots=(plot,))


def _wave(
    voltage: PulseWidth,
    problem: Problem,
    results: Mapping[str, Expr],
    names: tuple[Symbol, Expr, Symbol, Symbol],
    frequency: Expr | None,
) -> Plot:
    """With the values that are known, or some that show what is meant."""
    high, low, mean, duty = names
    U, U_0, D = drawn_values(voltage, problem, results)
    levels: dict[Label, float] = {high: U, low: U_0}
    return switched(levels, (mean, D * U + (1 - D) * U_0), (duty * PERIOD, D), PERIOD, frequency)


def _mean(high: Expr, low: Expr, duty: Expr, bipolar: bool) -> Expr:
    on = duty * high
    return on + (ONE - duty) * low if bipolar else on


def _solved(
    work: Work, voltage: PulseWidth, names: tuple[Symbol, Expr, Symbol, Symbol], bipolar: bool
) -> Work:
    high, low, mean, duty = names
    if voltage.duty is not None:
        return work.worked(mean.name, _mean(high, low, duty, bipolar), rule="solved")
    above = mean - low if bipolar else mean
    return work.worked(duty.name, above / (high - low if bipolar else high), rule="solved")
