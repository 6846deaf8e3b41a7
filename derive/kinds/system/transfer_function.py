"""The transfer function of a system of linear equations, by eliminating one signal after the other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from pydantic import Field

from derive.algebra.readable.operation_count import operations
from derive.control.elimination import Elimination, without
from derive.control.roots import roots
from derive.control.system import System
from derive.derivation import Claim, Derivation, Phrase, Step
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Relation, Symbol, free_symbols, walk
from derive.figures.block_diagram import drawn
from derive.figures.loops import Pictured, pictured
from derive.kinds.checks import law
from derive.kinds.fields import Evaluation, Name, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.system._delay_checks import fraction_claims
from derive.kinds.system._drift import DriftAtPoint, drift, in_decimals, integrates_once, way_of
from derive.kinds.system._oracle import Held, as_drawn, as_printed, given_claims, motor_claims
from derive.kinds.system._pairs import roots_told
from derive.kinds.system._plant import (
    Plant,
    delay_claims,
    delay_steps,
    inside_motor,
    plant,
    point_chains,
    poles_json,
    transfer_json,
    verdict,
    zeros_json,
)
from derive.kinds.system._point_checks import AT_POINT, point_claims
from derive.kinds.system._transfer_checks import drift_claims, eliminations, said
from derive.kinds.system._transfer_facts import Facts as Facts
from derive.kinds.system._transfer_facts import Told
from derive.kinds.work import Work
from derive.names import free

SUBJECTS = ("system", "motor")
S = Symbol("s")
MOTORS = ("armature", "field")


class Options(OptionsModel):
    """Which signal drives."""

    source: Name | None = Field(None, alias="from")
    """The disturbance, for its transfer function instead of that of the input."""
    evaluate: Evaluation = None


def claims_of(system: System, options: Options) -> tuple[str, ...]:
    """With those of a motor, and of the values asked for."""
    always = ("fraction", "as-given", "in-complex-numbers", "eliminations", "as-said")
    physical = ("impedances", "power") if system.motor else ()
    return (*always, *physical, *(AT_POINT if options.evaluate else ()))


def derive(system: System, options: Options, problem: Problem) -> Derivation:
    """Output over input with all other inputs zero (Dorf and Bishop, Modern Control Systems, section 2.5)."""
    solved = plant(problem, options.source, options.evaluate)
    definitions = {**solved.solution.values, _name(solved): solved.solution.ratio.expr(solved.style)}
    evaluated, numbers = _evaluated(solved, options)
    picture = _picture(solved, options, problem)
    G, told = _result(solved), _facts(solved, numbers, picture is not None, _before(options, problem))
    work = Work(problem, definitions, steps=tuple(_steps(solved))).claim(*_claims(solved))
    held = Held(problem, solved.solution.source)
    work = work.claim(
        *given_claims(held, work.steps),
        *fraction_claims(held, work.steps),
        as_printed("in-complex-numbers", held, G),
        *motor_claims(held),
        eliminations(held, work.steps),
        said(held, told, work.steps, G, options),
        *drift_claims(replace(held, given=dict(options.evaluate or ())), told.at, work.steps),
        *point_claims(replace(held, given=dict(options.evaluate or ())), evaluated, "G", told.at),
    )
    if not picture:
        return work.answer("transfer-function", {"G": G}, told, evaluated=evaluated)
    work = work.claim(as_drawn(held, picture.diagram))
    return work.answer("transfer-function", {"G": G}, told, evaluated=evaluated, plots=(picture.drawing,))


def _before(options: Options, problem: Problem) -> int | None:
    """The number of the first question, where it is an earlier one, that has the equations already."""
    asked = [(k, each) for k, (kind, each) in enumerate(problem.questions, 1) if kind == "transfer-function"]
    first = asked[0] if asked else (0, options)
    return first[0] if first[1] != options and any(each == options for _, each in asked) else None


def _picture(solved: Plant, options: Options, problem: Problem) -> Pictured | None:
    """With the first function of the input that is asked for, where there are several blocks to draw."""
    asked = [each for kind, each in problem.questions if kind == "transfer-function"]
    if not asked or asked[0] != options or options.source is not None:
        return None
    try:
        diagram, wired = drawn(solved.system, solved.rational, None, solved.style)
        return pictured(solved.system, diagram, "diagram") if len(wired) > 1 else None
    except NotDerivable:
        return None


def _steps(solved: Plant) -> Iterator[Step]:
    system, solution = solved.system, solved.solution
    yield from delay_steps(system)
    for place, equation in enumerate(system.equations, 1):
        yield Step(f"equation_{place}", (equation.left, equation.right), "given")
    usual = solution.source == system.input
    for signal in solution.zero:
        zero = {"zero": Relation(signal, "=", ZERO)}
        said = (
            Phrase("disturbance-zero", zero)
            if usual
            else Phrase("others-zero", zero | {"input": solution.source})
        )
        yield Step("zero", (signal, ZERO), "superposition", Told(said=said))
    for step in solution.steps:
        yield Step(
            f"{step.signal.name}_eliminated", step.chain, "elimination", Told(said=_eliminated(step, solved))
        )
    last = Told(said=_left(solution.relation, solved))
    yield Step("relation", solution.relation.chain, "relation", last)
    yield from _transfer(solved)


def _equation(step: Elimination, solved: Plant) -> Relation:
    equation, zero = solved.system.equations[step.equation], solved.solution.zero
    return Relation(without(equation.left, zero), "=", without(equation.right, zero))


def _eliminated(step: Elimination, solved: Plant) -> Phrase:
    """How a signal is expressed."""
    equation = _equation(step, solved)
    match step.explicit, bool(step.put):
        case True, True:
            return Phrase("put-into", {"put": step.put, "equation": equation})
        case True, False:
            return Phrase("given-directly", {"signal": step.signal})
        case False, True:
            return Phrase("solve-and-put", {"equation": equation, "signal": step.signal, "put": step.put})
    return Phrase("solve", {"equation": equation, "signal": step.signal})


def _left(step: Elimination, solved: Plant) -> Phrase:
    """The equation between input and output that is left."""
    ends = {"input": solved.solution.source, "output": solved.system.output}
    if step.put:
        return Phrase("left-put", {"put": step.put, "equation": _equation(step, solved), **ends})
    return Phrase("left" if solved.solution.steps else "only-one", ends)


def _transfer(solved: Plant) -> Iterator[Step]:
    """G, as the elimination leaves it and as it is reported."""
    G, head = _name(solved), solved.system.output / solved.solution.source
    unexpanded, collected = _forms(solved)
    chain: tuple[Expr, ...] = (G, head, unexpanded)
    apart = operations(unexpanded) <= operations(collected)
    if not apart and collected != unexpanded:
        chain = (*chain, collected)
    yield Step("G", chain, "quotient")
    if apart and collected != unexpanded and "s" in free_symbols(collected):
        yield Step("collected", (G, collected), "collect")
    reduced = solved.rational.reduced()
    if reduced is not solved.rational:
        yield Step("reduced", (G, reduced.expr(solved.style)), "cancel")
    result = _result(solved)
    if any(node in solved.problem.names for node in walk(chain[-1])):
        yield Step("final", (G, result), "substitute")
    if integrates_once(solved.rational):
        yield Step("drift", drift(solved, solved.rational), "drift")


def _name(solved: Plant) -> Symbol:
    """G; with the index of the disturbance where it is that of a disturbance, G_d of T_d."""
    source = solved.solution.source
    if source == solved.system.input:
        return solved.named("G")
    index = source.name.rpartition("_")[2]
    return Symbol(free(solved.system.names, f"G_{index}", f"G_{source.name}"))


def _forms(solved: Plant) -> tuple[Expr, Expr]:
    """G with its products standing, and by powers of s."""
    return solved.solution.ratio.expr(solved.style), solved.rational.expr(solved.style)


def _result(solved: Plant) -> Expr:
    """The shorter form; without common factors, and the names of `where` replaced."""
    unexpanded, collected = _forms(solved)
    if any(node in solved.problem.names for node in walk(unexpanded)):
        return solved.final(solved.rational.reduced())
    reduced = solved.rational.reduced()
    if reduced is not solved.rational:
        return reduced.expr(solved.style)
    return unexpanded if operations(unexpanded) <= operations(collected) else collected


def _facts(solved: Plant, at: DriftAtPoint | None, drawn: bool, before: int | None) -> Facts:
    system, rational = solved.system, solved.rational
    ends = {"input": solved.solution.source, "output": system.output}
    return Facts(
        described=Phrase(next((word for word in system.motor if word in MOTORS), "a-system"))
        if before is None
        else Phrase("again", {"number": before}),
        inside=inside_motor(system) if before is None else None,
        start=Phrase("from-the-output", ends) if solved.solution.steps else None,
        found=Phrase("ratio") if rational.num else Phrase("vanishes", {"input": solved.solution.source}),
        input=solved.solution.source,
        output=system.output,
        cancelled=_cancelled(solved),
        nature=_nature(solved),
        at=at,
        drawn=drawn,
        numbers=(),
    )


def _cancelled(solved: Plant) -> Phrase | None:
    """What numerator and denominator have in common."""
    if solved.rational.reduced() is solved.rational:
        return None
    count = solved.rational.cancelled
    return Phrase("motion-cancels", {"count": count}) if count else Phrase("factor-cancels", {"s": S})


def _nature(solved: Plant) -> Phrase | None:
    """What it does to any input."""
    rational = solved.rational
    if not rational.proper:
        return Phrase("improper")
    if rational.num and not rational.den[-1] and rational.num[-1]:
        ends = {"input": solved.solution.source, "output": solved.system.output}
        key = "integrates" if integrates_once(rational) else "integrates-often"
        return Phrase(key, {"order": len(rational.den) - 1, "s": S, **ends})
    return None


def _claims(solved: Plant) -> Iterator[Claim]:
    rational = solved.rational
    yield from delay_claims(solved.system)
    if rational.proper:
        yield law("proper", rational.proper)
    yield law("fraction", _multiplies(solved))


def _multiplies(solved: Plant) -> bool:
    reduced = solved.rational.reduced()
    return reduced.value == solved.rational.value


def _evaluated(solved: Plant, options: Options) -> tuple[dict[str, Any], DriftAtPoint | None]:
    """What goes to the JSON, and what the words print."""
    if options.evaluate is None:
        return {}, None
    numeric = solved.there(solved.rational.reduced())
    shown = ((_name(solved), numeric.expr(solved.style)),)
    told = DriftAtPoint(shown=shown, point=point_chains(options.evaluate, solved.problem.where))
    if numeric.symbols():
        return {"G": transfer_json(numeric)}, told
    poles, zeros = roots(numeric.den), roots(numeric.num) if numeric.num else ()
    values = {"G": transfer_json(numeric), "poles": poles_json(numeric), "zeros": zeros_json(numeric)}
    if numeric.num and verdict(numeric.den) == "integrator" and integrates_once(numeric):
        chain = drift(solved, numeric)
        told = replace(told, drift=in_decimals(chain, solved), way=way_of(chain, solved))
    return values, replace(
        told,
        poles=roots_told(poles),
        zeros=roots_told(zeros),
        verdict=Phrase(verdict(numeric.den)) if poles else None,
    )
