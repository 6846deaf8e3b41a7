"""The loop closed by unity feedback through a P, PI, PD or PID controller."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from derive.control.controllers import Controller, Loop
from derive.control.rational import Rational
from derive.control.ratios import Ratio, total
from derive.control.roots import roots
from derive.control.signals import signals
from derive.control.system import System
from derive.derivation import Claim, Derivation, Phrase, Step
from derive.errors import NotDerivable
from derive.expression import ONE, ZERO, Expr, Relation, Symbol, free_symbols, walk
from derive.figures.loops import looped
from derive.kinds.chains import distinct
from derive.kinds.checks import law, route
from derive.kinds.fields import Evaluation, OptionsModel, Place
from derive.kinds.problem import Problem
from derive.kinds.system._loop_checks import loop_point_claims, said
from derive.kinds.system._loop_facts import Facts as Facts
from derive.kinds.system._loop_facts import LoopAtPoint
from derive.kinds.system._options import ControllerField
from derive.kinds.system._oracle import Held, as_drawn, as_printed, controller_as_printed
from derive.kinds.system._pairs import roots_told
from derive.kinds.system._plant import (
    Plant,
    asked,
    plant,
    point_chains,
    poles_json,
    transfer_json,
    verdict,
    zeros_json,
)
from derive.kinds.system._point_checks import AT_POINT
from derive.kinds.system._reach import reach
from derive.kinds.work import Work

SUBJECTS = ("system", "motor")


class Options(OptionsModel):
    """The loop that is closed."""

    controller: ControllerField
    """The controller; a gain without a value stays a letter."""
    evaluate: Evaluation = None


@dataclass(frozen=True, slots=True)
class Closed:
    """A plant in its loop. `transfer` is T with everything in it, `reduced` without what cancels."""

    plant: Plant
    controller: Controller
    loop: Loop
    transfer: Rational
    reduced: Rational


def closed(problem: Problem, controller: Controller, point: Place | None) -> Closed:
    """The loop. Raises NotDerivable where it has no response."""
    solved = plant(problem, None, point, controller.gains)
    ratio = controller.ratio(solved.style)
    if not ratio:
        raise NotDerivable("every gain of the controller is zero: nothing drives the system", "controller")
    names = {signal.name for signal in signals(solved.system)}
    if mistaken := sorted(frozenset().union(*map(free_symbols, controller.gains)) & names):
        raise NotDerivable(f"{mistaken[0]} is a signal of the system, and cannot be a gain", "controller")
    loop = Loop(Rational.of(ratio), solved.rational)
    transfer = loop.closed
    return Closed(solved, controller, loop, transfer, transfer.reduced())


def plant_or_loop(
    problem: Problem, controller: Controller | None, point: Place | None
) -> tuple[Derivation, Rational, Plant]:
    """The system alone, or in its loop where there is a controller: the derivation it rests on, its transfer
    function with everything in it, and the plant. Raises NotDerivable."""
    if controller is None:
        solved = plant(problem, None, point)
        return asked(problem, "transfer-function", source=None), solved.rational, solved
    loop = closed(problem, controller, point)
    return asked(problem, "closed-loop", controller=controller), loop.transfer, loop.plant


def claims_of(system: System, options: Options) -> tuple[str, ...]:
    """With those of the values asked for."""
    always = ("loop", "controller", "in-complex-numbers", "as-said")
    return (*always, *(AT_POINT if options.evaluate else ()))


def derive(system: System, options: Options, problem: Problem) -> Derivation:
    """T = C G / (1 + C G) (Dorf and Bishop, Modern Control Systems, section 4.1)."""
    base = asked(problem, "transfer-function", source=None)
    found = closed(problem, options.controller, options.evaluate)
    solved = found.plant
    C, G, T = (solved.named(name) for name in "CGT")
    definitions: dict[Expr, Expr] = {
        C: options.controller.sum,
        G: solved.solution.ratio.expr(solved.style),
        T: found.transfer.expr(solved.style),
    }
    results = {"C": _final(found, found.loop.controller), "T": _final(found, found.reduced)}
    evaluated, numbers = _evaluated(found, options)
    work = Work(problem, definitions, uses=(base,), steps=tuple(_steps(found))).claim(*_claims(found))
    told, held = (
        _facts(found, numbers, _first(options, problem)),
        Held(problem, system.input, options.controller),
    )
    work = work.claim(
        controller_as_printed("controller", held, results["C"]),
        as_printed("in-complex-numbers", held, results["T"]),
        route("as-said", said(held, told, work.steps, results)),
        *loop_point_claims(replace(held, given=dict(options.evaluate or ())), _whole(found), evaluated, told),
    )
    if not told.drawn:
        return work.answer("closed-loop", results, told, evaluated=evaluated)
    loop = looped(solved.system, solved.rational, solved.style)
    work = work.claim(as_drawn(held, loop.diagram))
    return work.answer("closed-loop", results, told, evaluated=evaluated, plots=(loop.drawing,))


def _steps(found: Closed) -> Iterator[Step]:
    solved = found.plant
    C, G, T = (solved.named(name) for name in "CGT")
    over_one = found.controller.ratio(solved.style).expr(solved.style)
    chain = (C, found.controller.sum, over_one) if found.controller.integrates else (C, found.controller.sum)
    yield Step("C", chain, "controller")
    product = C * G
    collected = found.transfer.expr(solved.style)
    formula = product / (ONE + product)
    yield Step("T", distinct((T, formula, _unexpanded(found), collected)), "feedback")
    if found.reduced is not found.transfer:
        yield Step("reduced", (T, found.reduced.expr(solved.style)), "cancel")
    if any(node in solved.problem.names for node in walk(collected)):
        yield Step("final", (T, _final(found, found.reduced)), "substitute")


def _unexpanded(found: Closed) -> Expr:
    """With the products standing, where that can be read at a glance."""
    style = found.plant.style
    through = found.controller.ratio(style) * found.plant.solution.ratio
    return (through / total((Ratio(), through), style)).expr(style)


def _final(found: Closed, rational: Rational) -> Expr:
    return found.plant.final(rational)


def _first(options: Options, problem: Problem) -> bool:
    """Whether it is the first loop that is asked for: the others look like it."""
    asked = [each for kind, each in problem.questions if kind == "closed-loop"]
    return bool(asked) and asked[0] == options


def _facts(found: Closed, at: LoopAtPoint | None, drawn: bool) -> Facts:
    solved = found.plant
    return Facts(
        family=Phrase(found.controller.family),
        through=solved.named("C") * solved.named("G"),
        input=solved.system.input,
        output=solved.system.output,
        motor=solved.system.motor,
        order=len(found.transfer.den) - 1,
        reach=_reach(found),
        derivative=_derivative(found),
        tracks=Phrase("tracks", {"origin": Relation(Symbol("s"), "=", ZERO)}) if _tracks(found) else None,
        cancelled=_cancelled(found),
        at=at,
        drawn=drawn,
        numbers=(),
    )


def _reach(found: Closed) -> Phrase | None:
    order, taken = len(found.transfer.den) - 1, found.plant.system.names
    return reach(found.controller, found.plant.rational.num, order, taken)


def _derivative(found: Closed) -> Phrase | None:
    """What stands against building the loop."""
    if not found.loop.open.proper:
        return Phrase("improper-loop")
    return Phrase("ideal-derivative") if found.controller.differentiates else None


def _cancelled(found: Closed) -> Phrase | None:
    """What numerator and denominator have in common."""
    if found.reduced is found.transfer:
        return None
    count = found.transfer.cancelled
    return (
        Phrase("motion-cancels", {"count": count}) if count else Phrase("factor-cancels", {"s": Symbol("s")})
    )


def _tracks(found: Closed) -> bool:
    """Whether an integrator in the loop makes the steady state exact."""
    through = found.loop.open
    return bool(through.num) and bool(through.num[-1]) and not through.den[-1]


def _claims(found: Closed) -> Iterator[Claim]:
    through, transfer = found.loop.open.value, found.reduced.value
    yield law("loop", transfer * (1 + through) == through)
    if _tracks(found):
        yield law("no-error", _value_at_zero(found.reduced))


def _whole(found: Closed) -> Rational | None:
    """T in numbers with nothing cancelled; None where symbols are left."""
    value = found.plant.there(found.transfer)
    return None if value.symbols() else value


def _value_at_zero(rational: Rational) -> bool:
    return rational.num[-1] == rational.den[-1]


def _evaluated(found: Closed, options: Options) -> tuple[dict[str, Any], LoopAtPoint | None]:
    if options.evaluate is None:
        return {}, None
    solved = found.plant
    numeric, controller = solved.there(found.reduced), solved.there(found.loop.controller)
    functions = {"C": transfer_json(controller), "T": transfer_json(numeric)}
    shown = ((solved.named("T"), numeric.expr(solved.style)),)
    told = LoopAtPoint(shown=shown, point=point_chains(options.evaluate, solved.problem.where))
    if numeric.symbols():
        return functions, told
    whole = solved.numeric(found.transfer)
    poles, zeros = roots(numeric.den), roots(numeric.num) if numeric.num else ()
    gains = Phrase("this-gain" if len(found.controller.family) == 1 else "these-gains")
    return {**functions, "poles": poles_json(numeric), "zeros": zeros_json(numeric)}, replace(
        told,
        poles=roots_told(poles),
        zeros=roots_told(zeros),
        verdict=Phrase(verdict(whole.den), {"gains": gains}),
        hidden=Phrase("growth-cancels") if verdict(numeric.den) == "stable" != verdict(whole.den) else None,
    )
