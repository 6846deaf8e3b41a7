"""The response to a unit step, of the system alone or in its loop, and what is read off it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from derive.algebra.formulas.with_units import measured
from derive.algebra.readable.form import readable
from derive.control.rational import Rational
from derive.control.response import StepResponse, step_response
from derive.control.roots import roots
from derive.control.system import System
from derive.derivation import Derivation, Phrase, Plot, Result, Said, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Measured, Number, Relation, Symbol, number
from derive.figures.responses import stepped
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.system._in_time import response_in_time
from derive.kinds.system._options import ControllerField
from derive.kinds.system._oracle import Held
from derive.kinds.system._pairs import roots_told, rounded
from derive.kinds.system._plant import Plant, point_chains, verdict
from derive.kinds.system._step_checks import as_marked, proofs, seen_of, written
from derive.kinds.system._step_facts import FIGURES, NONE
from derive.kinds.system._step_facts import Facts as Facts
from derive.kinds.system.closed_loop import plant_or_loop
from derive.kinds.work import Work

SUBJECTS = ("system", "motor")
CLAIMS = (
    "proper", "in-complex-numbers", "as-large-as-poles", "modes", "inverse-transform", "long-enough",
    "verdict", "poles-as-printed", "as-said", "figures|no-figures", "as-marked",
)  # fmt: skip
CLAIMED = dict.fromkeys(("overshoot", "rise_time", "settling_time"), "figures")
UNITS = {"angle": "rad", "speed": "rad/s"}  # of what a motor turns
S = Symbol("s")
MOST_UNSTABLE = 12  # poles of a response that grows: its inverted transform keeps too few digits of more


class Options(OptionsModel):
    """With a controller the reference steps, without one the input does."""

    controller: ControllerField | None = None
    """The controller; a gain without a value stays a letter."""
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
    in_time: Expr | None


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
    if (count := len(numeric.den) - 1) > MOST_UNSTABLE and verdict(numeric.den) == "unstable":
        raise NotDerivable(
            f"the system is unstable and has {count} poles: its response cannot be checked in floating point "
            f"(at most {MOST_UNSTABLE} poles can)"
        )
    in_time = None if "t" in system.names else response_in_time(response.curve, numeric, solved.style)
    final = _steady(solved, numeric, response)
    answer = Answer(solved, numeric, verdict(complete.den), response, final, in_time)
    name = solved.named("T" if options.controller else "G")
    work = Work(problem, _definitions(answer, name), uses=(base,), steps=tuple(_steps(answer, name)))
    results, told = _results(response, answer.final), _facts(answer, options)
    evaluated = {each: getattr(response, each) for each in FIGURES}
    held = Held(problem, system.input, options.controller, dict(options.evaluate or ()))
    num, den = numeric.numbers()
    polynomials = num, den, complete.numbers()[1]
    work = work.law("proper", numeric.proper)
    work = work.claim(*proofs(held, work.steps[0].result, polynomials, response, results, evaluated, told))
    work = work.claim(*written(work.steps, seen_of(work.steps[0].result, polynomials), response))
    plot = _plot(answer, options)
    work = work.claim(as_marked(plot, results, response))
    return work.answer("step-response", results, told, evaluated=evaluated, plots=(plot,))


def _steady(solved: Plant, numeric: Rational, response: StepResponse) -> Expr | None:
    """By the final value theorem: the function at s = 0, exactly."""
    if response.steady_state is None:
        return None
    return readable(numeric.num[-1] / numeric.den[-1], solved.style) if numeric.num else number(0)


def _steps(answer: Answer, name: Symbol) -> Iterator[Step]:
    yield Step("transfer", (name, answer.numeric.expr(answer.plant.style)), "substitute")
    output = answer.plant.system.output
    yield Step("transform", (output, name / S), "unit-step")
    if answer.in_time is not None:
        yield Step("response", (output, answer.in_time), "in-numbers")
    if answer.final is not None:
        middle = _at_zero(answer)
        worked = () if _same(middle, answer.final) else (middle,)
        final = measured(answer.final, answer.plant.system.unit(output))
        yield Step("steady_state", (_last(answer), *worked, final), "final-value")


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


def _plot(answer: Answer, options: Options) -> Plot:
    output, source = answer.plant.system.output, answer.plant.system.input
    motor = (UNITS[word] for word in answer.plant.system.motor if word in UNITS)
    unit = answer.plant.system.unit(output) or next(motor, "")
    caption = Phrase("drawn-loop" if options.controller else "drawn", {"output": output, "input": source})
    return stepped(answer.response, output, unit, caption)


def _facts(answer: Answer, options: Options) -> Facts:
    response, start = answer.response, Relation(Symbol("t"), "=", number(0))
    system = answer.plant.system
    jumping = system.output if options.controller else system.input
    about: dict[str, Said] = {"start": start, "height": _one(system.unit(jumping))}
    found = verdict(answer.numeric.den)
    returns = found == "stable" and response.steady_state == 0
    return Facts(
        jump=Phrase("reference-jumps", about)
        if options.controller
        else Phrase("input-jumps", about | {"input": system.input}),
        step=1 / S,
        point=point_chains(options.evaluate, answer.plant.problem.where),
        poles=roots_told(roots(answer.numeric.den)),
        course=_course(answer, found),
        figures=() if returns else tuple(_figures(response)),
        none=Phrase("returns") if returns else None,
        hidden=Phrase("hidden-growth") if answer.verdict == "unstable" != found else None,
        numbers=(),
    )


def _one(unit: str) -> Said:
    """The height of a unit step."""
    return Measured(number(1), unit) if unit else 1


def _course(answer: Answer, found: str) -> Phrase:
    """What the response does in the end."""
    origin, slope = Relation(S, "=", number(0)), _slope(answer)
    match found:
        case "stable":
            return Phrase("settles", {"origin": origin})
        case "unstable":
            return Phrase("grows")
    return Phrase("swings") if slope is None else Phrase("drifts", {"origin": origin, "slope": slope})


def _figures(response: StepResponse) -> Iterator[Phrase]:
    """What is read off it, the overshoot with the time of the peak."""
    peak = response.peak_time
    for name in FIGURES[:-1]:
        if (value := getattr(response, name)) is not None:
            if name == "overshoot" and peak is not None:
                yield Phrase("overshoot-at", {"value": rounded(value), "time": rounded(peak)})
            else:
                yield Phrase(name, {"value": rounded(value)})


def _slope(answer: Answer) -> Expr | None:
    """Where one integrator makes the response a ramp in the end: its slope, s G(s) at s = 0."""
    num, den = answer.numeric.num, answer.numeric.den
    if verdict(den) != "integrator" or not num or den[-1]:
        return None
    return readable(num[-1] / den[-2], answer.plant.style) if num[-1] else None
