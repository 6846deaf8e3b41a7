"""The response to a unit step, of the system alone or in its loop, and what is read off it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.readable.form import readable
from derive.control.controllers import Controller
from derive.control.laplace import Numeric, inverted
from derive.control.rational import Rational
from derive.control.response import BAND, HIGH, StepResponse, step_response
from derive.control.roots import roots
from derive.control.system import System
from derive.derivation import Claim, Curve, Derivation, Label, PageFacts, Phrase, Plot, Result, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Number, Symbol, number
from derive.kinds.checks import SECOND_ROUTE, law
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.system._options import ControllerField
from derive.kinds.system._plant import Plant, point_chains, root_tree, rounded, verdict
from derive.kinds.system.closed_loop import plant_or_loop
from derive.kinds.work import Work

SUBJECTS = ("system", "motor")
FIGURES = ("rise_time", "settling_time", "overshoot", "steady_state")
NONE = "none"  # a number that this response does not have
TOLERANCE = 1e-5  # of the curve against the inverted transform, relative to its height
CLOSE = 1e-6  # of transforms against each other
NEARLY = 1e-9  # of shares of the steady state
MOST_TERMS = 540  # of an inverted transform
POINTS = 8
LABELS = ("angle", "speed")
S = Symbol("s")


class Options(OptionsModel):
    """With a controller the reference steps, without one the input does."""

    controller: ControllerField | None = None
    evaluate: Evaluation = None


@dataclass(frozen=True, slots=True)
class Answer:
    """A response with what it is the response of; `verdict` is that of everything in it, `numeric` what is
    left once common factors have cancelled."""

    plant: Plant
    numeric: Rational
    verdict: str
    response: StepResponse
    final: Expr | None


class Facts(PageFacts):
    start: tuple[Expr, Expr]
    origin: tuple[Expr, Expr]
    step: Expr  # its transform
    closed: bool
    input: Symbol
    point: tuple[tuple[Expr, ...], ...]
    poles: tuple[Expr, ...]
    verdict: str
    hidden: bool
    slope: Expr | None
    zero: bool  # the steady state
    rise_time: Expr | None
    settling_time: Expr | None
    overshoot: Expr | None
    peak_time: Expr | None


def derive(system: System, options: Options, problem: Problem) -> Derivation:
    """y(t) for a unit step, by the exact solution of the state equations.

    Raises NotDerivable for a function that is improper, and where a name has no value.
    """
    base, transfer, solved = plant_or_loop(problem, options.controller, options.evaluate)
    complete = solved.numeric(transfer)
    numeric = complete.reduced()
    if not numeric.proper:
        raise NotDerivable("the transfer function is improper: its step response begins with an impulse")
    response = step_response(numeric.num, numeric.den)
    answer = Answer(solved, numeric, verdict(complete.den), response, _steady(solved, numeric, response))
    name = solved.named("T" if options.controller else "G")
    work = Work(problem, _definitions(answer, name), uses=(base,), steps=tuple(_steps(answer, name)))
    return work.claim(*_claims(answer, options)).answer(
        "step-response",
        _results(response, answer.final),
        _facts(answer, options),
        evaluated={each: getattr(response, each) for each in FIGURES},
        plots=(_plot(solved.system, response),),
    )


def _steady(solved: Plant, numeric: Rational, response: StepResponse) -> Expr | None:
    """By the final value theorem: the function at s = 0, exactly."""
    if response.steady_state is None:
        return None
    return readable(numeric.num[-1] / numeric.den[-1], solved.style) if numeric.num else number(0)


def _steps(answer: Answer, name: Symbol) -> Iterator[Step]:
    yield Step("transfer", (name, answer.numeric.expr(answer.plant.style)), "substitute")
    output = answer.plant.system.output
    yield Step("transform", (output, name / S), "unit-step")
    if answer.final is not None:
        middle = _at_zero(answer)
        worked = () if _same(middle, answer.final) else (middle,)
        yield Step("steady_state", (_last(answer), *worked, answer.final), "final-value")


def _same(fraction: Expr, value: Expr) -> bool:
    """Whether the fraction is its own value, as 1/2 and 3/1 are."""
    return isinstance(value, Number) and not value.decimal and fraction == _fraction(value)


def _fraction(value: Number) -> Expr:
    return number(value.value.numerator) / number(value.value.denominator)


def _last(answer: Answer) -> Symbol:
    """The steady state of the output."""
    return Symbol(f"{answer.plant.system.output.name}_ss")


def _at_zero(answer: Answer) -> Expr:
    """num(0) / den(0), before it is worked out."""
    num, den = answer.numeric.num, answer.numeric.den
    style = answer.plant.style
    return (readable(num[-1], style) if num else number(0)) / readable(den[-1], style)


def _definitions(answer: Answer, name: Symbol) -> dict[Expr, Expr]:
    transfer = answer.numeric.expr(answer.plant.style)
    definitions: dict[Expr, Expr] = {name: transfer, answer.plant.system.output: transfer / S}
    if answer.final is not None:
        definitions[_last(answer)] = answer.final
    return definitions


def _results(response: StepResponse, final: Expr | None) -> dict[str, Result]:
    def found(value: float | None) -> Result:
        return NONE if value is None else rounded(value)

    measured = {name: found(getattr(response, name)) for name in FIGURES}
    return {**measured, "steady_state": NONE if final is None else final}


def _plot(system: System, response: StepResponse) -> Plot:
    label = next((Phrase(word) for word in system.motor if word in LABELS), f"{system.output.name}(t)")
    marks: dict[Label, float] = (
        {Phrase("steady-state"): response.steady_state} if response.steady_state else {}
    )
    curves: dict[Label, Curve] = {Phrase("response"): (response.times, response.values)}
    return Plot("step", Phrase("time"), label, curves, marks)


def _facts(answer: Answer, options: Options) -> Facts:
    response = answer.response
    return Facts(
        start=(Symbol("t"), number(0)),
        origin=(S, number(0)),
        step=1 / S,
        closed=options.controller is not None,
        input=answer.plant.system.input,
        point=point_chains(options.evaluate, answer.plant.problem.where),
        poles=tuple(map(root_tree, roots(answer.numeric.den))),
        verdict=verdict(answer.numeric.den),
        hidden=answer.verdict == "unstable" and verdict(answer.numeric.den) != "unstable",
        slope=_slope(answer),
        zero=response.steady_state == 0,
        rise_time=_shown(response.rise_time),
        settling_time=_shown(response.settling_time),
        overshoot=_shown(response.overshoot),
        peak_time=_shown(response.peak_time),
        numbers=(),
    )


def _shown(value: float | None) -> Expr | None:
    return None if value is None else rounded(value)


def _slope(answer: Answer) -> Expr | None:
    """Where one integrator makes the response a ramp in the end: its slope, s G(s) at s = 0."""
    num, den = answer.numeric.num, answer.numeric.den
    if verdict(den) != "integrator" or not num or den[-1]:
        return None
    return readable(num[-1] / den[-2], answer.plant.style) if num[-1] else None


# -- what it is held to -------------------------------------------------------------------------------


def _claims(answer: Answer, options: Options) -> Iterator[Claim]:
    numeric = answer.numeric
    yield law("proper", numeric.proper)
    if answer.final is not None and answer.response.steady_state is not None:
        last = answer.response.steady_state
        yield Claim("ends-at-the-steady-state", SECOND_ROUTE, _ends(answer.response, last))
    yield law("samples-agree", _samples_agree(answer.response))
    transform = _transform(answer, options.controller)
    yield Claim("modes", SECOND_ROUTE, _transforms_back(answer.response, transform))
    yield Claim("inverse-transform", SECOND_ROUTE, _is_inverse(answer.response, transform))


def _ends(response: StepResponse, last: float) -> bool:
    """The constant among the modes is the steady state."""
    constant = float(response.curve.modes[0].factor[0].real) if response.curve.modes else 0.0
    return math.isclose(constant, last, rel_tol=1e-12, abs_tol=1e-300)


def _samples_agree(response: StepResponse) -> bool:
    """Below 90 % until it has risen, within the band once it has settled, never above its peak."""
    final = response.steady_state
    if not final or response.rises is None or response.settling_time is None or response.overshoot is None:
        return True
    top = 1 + response.overshoot / 100 + NEARLY
    return all(
        share <= top
        and (time >= response.rises[1] or share <= HIGH + NEARLY)
        and (time <= response.settling_time or abs(share - 1) <= BAND + NEARLY)
        for time, share in zip(response.times, (value / final for value in response.values), strict=True)
    )


def _transforms_back(response: StepResponse, transform: Callable[[complex], complex]) -> bool:
    """At a complex s as large as each pole, by the elementary transforms of the modes."""
    sizes = {float(abs(mode.pole).mid()) for mode in response.curve.modes} - {0.0} or {1.0}
    points = (size * (0.7 + 0.6j) for size in sorted(sizes)[:POINTS])
    pairs = ((response.transform(s), transform(s)) for s in points)
    return all(abs(ours - other) <= CLOSE * abs(other) for ours, other in pairs)


def _is_inverse(response: StepResponse, transform: Callable[[complex], complex]) -> bool:
    """A few points of the curve, and where it rises, settles and is highest, against the numerically
    inverted transform: as late as that follows the fastest mode."""
    height = max(1e-300, *map(abs, response.values))
    fastest = max(float(abs(mode.pole).mid()) for mode in response.curve.modes)
    places = [response.times[len(response.times) // share] for share in (8, 3)]
    places += [*(response.rises or ()), response.settling_time or 0.0, response.peak_time or 0.0]
    return all(
        abs(inverted(transform, time, 60 + math.ceil(fastest * time)) - response.at(time))
        <= TOLERANCE * height
        for time in places
        if time > 0 and fastest * time < MOST_TERMS
    )


def _transform(answer: Answer, controller: Controller | None) -> Callable[[complex], complex]:
    """Y(s) of a unit step by solving the equations as typed, at the values given."""
    system = answer.plant.system
    names = {**answer.plant.problem.names, **answer.plant.point}
    point = {name.name: scalar_number(normal(name, names), {}) for name in names if isinstance(name, Symbol)}
    solved = Numeric.of(system, system.input, point)
    if controller is None:
        return lambda s: solved.gain(s) / s
    return lambda s: solved.closed(s, controller.sum) / s
