"""The response to a unit step, of the system alone or in its loop, and what is read off it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from derive.algebra.normal import normal
from derive.algebra.numeric import scalar_number
from derive.algebra.readable import readable
from derive.control.controllers import Controller
from derive.control.laplace import Numeric, inverted
from derive.control.rational import Rational
from derive.control.response import StepResponse, step_response
from derive.control.roots import roots
from derive.control.system import System
from derive.derivation import Claim, Derivation, Plot, Result, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Number, Quotient, Symbol, number
from derive.kinds.checks import SECOND_ROUTE, law, links
from derive.kinds.evaluation import Evaluation
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.system._options import ControllerField
from derive.kinds.system._plant import Plant, asked, plant, point_chains, root_tree, rounded, verdict
from derive.kinds.system.closed_loop import closed

RESULTS = {
    "rise_time": "from 10 to 90 % of the steady state [s]",
    "settling_time": "after which it stays within 2 % of the steady state [s]",
    "overshoot": "in percent of the steady state",
    "steady_state": "where it ends",
}
EXAMPLE = """\
title: DC motor with a controller
problems:
- motor: {control: armature, output: angle}
  find: step-response
  controller: {PD: {K_p: 1, K_d: 1}}
  evaluate: {J: 2, K_m: 10, R_a: 1, L_a: 1, b: 0.5, K_b: 0.1}
"""
NONE = "none"  # a number that this response does not have
TOLERANCE = 1e-5  # of the curve against the inverted transform, relative to its height
LABELS = {"angle": "angle [rad]", "speed": "speed [rad/s]"}
S = Symbol("s")


class Options(OptionsModel):
    """With a controller the reference steps, without one the input does."""

    controller: ControllerField | None = None
    evaluate: Evaluation = None


@dataclass(frozen=True, slots=True)
class Answer:
    """A response with what it is the response of; `poles` are those of the whole loop."""

    plant: Plant
    numeric: Rational
    poles: tuple[complex, ...]
    response: StepResponse
    final: Expr | None


def derive(system: System, options: Options, problem: Problem) -> Derivation:
    """y(t) for a unit step, by the exact solution of the state equations.

    Raises NotDerivable for a function that is improper, and where a name has no value.
    """
    base, whole, solved = _asked(options, problem)
    numeric, poles = solved.numeric(whole.reduced()), roots(solved.numeric(whole).den)
    if not numeric.proper:
        raise NotDerivable("the transfer function is improper: its step response begins with an impulse")
    response = step_response(*numeric.numbers(), roots(numeric.den))
    answer = Answer(solved, numeric, poles, response, _steady(solved, numeric, response))
    name = solved.named("T" if options.controller else "G")
    steps = tuple(_steps(answer, name))
    claims = (*links(steps, _definitions(answer, name)), *_claims(answer, options))
    return Derivation(
        "step-response",
        steps,
        _results(response, answer.final),
        claims,
        _definitions(answer, name),
        {each: getattr(response, each) for each in RESULTS},
        (base,),
        (_plot(solved.system, response),),
        _facts(answer, options, name),
    )


def _asked(options: Options, problem: Problem) -> tuple[Derivation, Rational, Plant]:
    """The derivation this rests on, the transfer function with everything in it, and the plant."""
    if options.controller is None:
        solved = plant(problem, None, options.evaluate)
        return asked(problem, "transfer-function", source=None), solved.rational, solved
    loop = closed(problem, options.controller, options.evaluate)
    return asked(problem, "closed-loop", controller=options.controller), loop.transfer, loop.plant


def _steady(solved: Plant, numeric: Rational, response: StepResponse) -> Expr | None:
    """By the final value theorem: the function at s = 0, exactly."""
    if response.steady_state is None:
        return None
    return readable(numeric.num[-1] / numeric.den[-1], solved.style) if numeric.num else number(0)


def _steps(answer: Answer, name: Symbol) -> Iterator[Step]:
    yield Step("transfer", (name, answer.numeric.expr(answer.plant.style)), "substitute")
    output = answer.plant.system.output
    yield Step("transform", (output, Quotient(name, S)), "unit-step")
    if answer.final is not None:
        chain = (_last(answer), _at_zero(answer), answer.final)
        yield Step("steady_state", chain[:2] if _same(chain) else chain, "final-value")


def _same(chain: tuple[Expr, Expr, Expr]) -> bool:
    """Whether the fraction is its own value, as 1/2 is."""
    return isinstance(chain[2], Number) and not chain[2].decimal and chain[1] == _fraction(chain[2])


def _fraction(value: Number) -> Expr:
    return Quotient(number(value.value.numerator), number(value.value.denominator))


def _last(answer: Answer) -> Symbol:
    """The steady state of the output."""
    return Symbol(f"{answer.plant.system.output.name}_ss")


def _at_zero(answer: Answer) -> Expr:
    """num(0) / den(0), before it is worked out."""
    num, den = answer.numeric.num, answer.numeric.den
    style = answer.plant.style
    return Quotient(readable(num[-1], style) if num else number(0), readable(den[-1], style))


def _definitions(answer: Answer, name: Symbol) -> dict[Expr, Expr]:
    transfer = answer.numeric.expr(answer.plant.style)
    definitions: dict[Expr, Expr] = {name: transfer, answer.plant.system.output: Quotient(transfer, S)}
    if answer.final is not None:
        definitions[_last(answer)] = answer.final
    return definitions


def _results(response: StepResponse, final: Expr | None) -> dict[str, Result]:
    def found(value: float | None) -> Result:
        return NONE if value is None else rounded(value)

    measured = {name: found(getattr(response, name)) for name in RESULTS}
    return {**measured, "steady_state": NONE if final is None else final}


def _plot(system: System, response: StepResponse) -> Plot:
    label = next((LABELS[word] for word in system.motor if word in LABELS), f"{system.output.name}(t)")
    marks = {"steady state": response.steady_state} if response.steady_state else {}
    return Plot("step", "time [s]", label, {"response": (response.times, response.values)}, marks)


def _facts(answer: Answer, options: Options, name: Symbol) -> dict[str, Any]:
    response = answer.response
    shown = roots(answer.numeric.den)
    return {
        "numbers": (),
        "start": (Symbol("t"), number(0)),
        "origin": (S, number(0)),
        "step": Quotient(number(1), S),
        "closed": options.controller is not None,
        "name": name,
        "input": answer.plant.system.input,
        "output": answer.plant.system.output,
        "motor": answer.plant.system.motor,
        "point": point_chains(options.evaluate, answer.plant.problem.where),
        "poles": tuple(map(root_tree, shown)),
        "verdict": verdict(shown),
        "hidden": verdict(answer.poles) == "unstable" and verdict(shown) != "unstable",
        "slope": _slope(answer),
        "steady_state": None if answer.final is None else answer.final,
        "zero": response.steady_state == 0,
        **{each: _shown(getattr(response, each)) for each in ("rise_time", "settling_time", "overshoot")},
        "peak_time": _shown(response.peak_time),
        "error": None if response.steady_state is None else rounded(1 - response.steady_state),
    }


def _shown(value: float | None) -> Expr | None:
    return None if value is None else rounded(value)


def _slope(answer: Answer) -> Expr | None:
    """Where one integrator makes the response a ramp in the end: its slope, s G(s) at s = 0."""
    num, den = answer.numeric.num, answer.numeric.den
    if verdict(roots(den)) != "integrator" or not num or den[-1]:
        return None
    return readable(num[-1] / den[-2], answer.plant.style) if num[-1] else None


# -- what it is held to -------------------------------------------------------------------------------


def _claims(answer: Answer, options: Options) -> Iterator[Claim]:
    numeric = answer.numeric
    yield law("the transfer function is proper", numeric.proper)
    if answer.final is not None and answer.response.steady_state is not None:
        last = answer.response.steady_state
        yield Claim("the curve ends at the steady state", SECOND_ROUTE, _ends(answer.response, last))
    claim = "the curve agrees with the inverted Laplace transform of the equations"
    yield Claim(claim, SECOND_ROUTE, _is_inverse(answer, options.controller))


def _ends(response: StepResponse, last: float) -> bool:
    height = max(map(abs, response.values))
    return abs(response.values[-1] - last) <= 0.021 * max(abs(last), height * 1e-3)


def _is_inverse(answer: Answer, controller: Controller | None) -> bool:
    """A few points of the curve against the numerically inverted transform."""
    times, values = answer.response.times, answer.response.values
    height = max(1e-12, *map(abs, values))
    fastest = max((abs(pole) for pole in answer.poles), default=1.0)
    transform = _transform(answer, controller)
    for share in (8, 3):
        place = len(times) // share
        time = times[place]
        terms = 60 + math.ceil(fastest * time)
        if abs(inverted(transform, time, min(terms, 600)) - values[place]) > TOLERANCE * height:
            return False
    return True


def _transform(answer: Answer, controller: Controller | None) -> Callable[[complex], complex]:
    """Y(s) of a unit step by solving the equations as typed, at the values given."""
    system = answer.plant.system
    names = {**answer.plant.problem.names, **answer.plant.point}
    point = {name.name: scalar_number(normal(name, names), {}) for name in names if isinstance(name, Symbol)}
    solved = Numeric.of(system, system.input, point)
    if controller is None:
        return lambda s: solved.gain(s) / s
    return lambda s: solved.closed(s, controller.sum) / s
