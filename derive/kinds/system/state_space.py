"""The equations of a system as dx/dt = A x + B u, y = C x + D u."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from derive.algebra.normal import normal_matrix
from derive.algebra.readable.form import readable, readable_matrix
from derive.control.elimination import hidden, without
from derive.control.rational import names_in
from derive.control.rational import written as collected
from derive.control.roots import as_json, roots
from derive.control.states import ORDERS, Law
from derive.control.states import written as written_form
from derive.control.system import System
from derive.derivation import Derivation, Phrase, Step, as_matrix
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, add, column, multiply
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.system._delay_checks import fraction_claims
from derive.kinds.system._matrix_checks import routes
from derive.kinds.system._oracle import Held, given_claims, motor_claims
from derive.kinds.system._pairs import roots_told
from derive.kinds.system._plant import (
    AtPoint,
    Plant,
    asked,
    delay_claims,
    delay_steps,
    inside_motor,
    mixed,
    point_chains,
    verdict,
)
from derive.kinds.system._state_checks import characteristic_of, claims_about
from derive.kinds.system._state_facts import Facts as Facts
from derive.kinds.system._states import MATRICES, Answer, answered, readable_form
from derive.kinds.work import Work

SUBJECTS = ("system", "motor")
S = Symbol("s")


class Options(OptionsModel):
    """Numbers where `evaluate` asks for them."""

    evaluate: Evaluation = None


def claims_of(system: System, options: Options) -> tuple[str, ...]:
    """With those of a motor, and of the values asked for."""
    always = ("state-in-s", "transfer-function", "poles-are-eigenvalues", "equations-again", "as-said")
    physical = ("impedances", "power") if system.motor else ()
    return (*always, *physical, *(("in-numbers",) if options.evaluate else ()))


def derive(system: System, options: Options, problem: Problem) -> Derivation:
    """Ogata, Modern Control Engineering, sections 2.5 and 9.2.

    Raises NotDerivable for a system that differentiates its input, and for one without states.
    """
    answer = answered(problem, options.evaluate)
    base = () if answer.is_physical else (asked(problem, "transfer-function", source=None),)
    results = {name: as_matrix(problem.final(readable_form(answer, name)), name) for name in MATRICES}
    evaluated, numbers = _evaluated(answer, options)
    work = Work(problem, _definitions(answer), uses=base, steps=tuple(_steps(answer)))
    held, told = Held(problem, system.input), _facts(answer, numbers)
    given = dict(options.evaluate or ())
    work = work.claim(
        *delay_claims(system),
        *claims_about(answer),
        *given_claims(held, work.steps),
        *fraction_claims(held, work.steps),
        *motor_claims(held),
        *routes(held, work.steps, results, evaluated, told, given),
    )
    return work.answer("state-space", results, told, evaluated=evaluated, matrices=frozenset(MATRICES))


# -- the page -----------------------------------------------------------------------------------------


def _steps(answer: Answer) -> Iterator[Step]:
    if answer.is_physical:
        if _begins(answer):
            yield from delay_steps(answer.plant.system)
            yield from _given(answer.plant)
        for rule, laws in (("algebraic", answer.space.algebraic), ("rate", answer.space.rates)):
            yield from (_law(answer, each, rule) for each in laws)
    else:
        yield from _canonical_steps(answer)
    yield Step("x", (answer.letter, column(answer.state)), "state")
    for name in MATRICES:
        yield Step(name, (answer.plant.named(name), readable_form(answer, name)), "matrix")


def _begins(answer: Answer) -> bool:
    """Whether no other question about the system writes its equations down."""
    return all(kind != "transfer-function" for kind, _ in answer.plant.problem.questions)


def _given(solved: Plant) -> Iterator[Step]:
    """The equations."""
    zero = solved.solution.zero
    for place, equation in enumerate(solved.system.equations, 1):
        yield Step(
            f"equation_{place}", (without(equation.left, zero), without(equation.right, zero)), "given"
        )


def _law(answer: Answer, each: Law, rule: str) -> Step:
    style = answer.plant.style
    own, final = written_form(each.own, style), written_form(each.final, style)
    chain = (Symbol(each.name), own) if own == final else (Symbol(each.name), own, final)
    return Step(f"{each.name}_law", chain, rule)


def _canonical_steps(answer: Answer) -> Iterator[Step]:
    """G with the leading coefficient of its denominator 1, and what passes straight through apart."""
    style, transfer = answer.plant.style, answer.transfer
    lead = transfer.den[0]
    through = answer.space.D[0, 0]
    den = tuple(k / lead for k in transfer.den)
    num = answer.space.C.rows[0][::-1]
    apart = collected(num, style)
    fraction = apart / collected(den, style) if any(num) else None
    parts = [readable(through, style)] if through else []
    yield Step("G", (answer.plant.named("G"), add(*parts, *([fraction] if fraction else []))), "canonical")


def _definitions(answer: Answer) -> dict[Expr, Expr]:
    """Every signal by the input, as the elimination gives it; its derivatives times s."""
    found: dict[Expr, Expr] = {answer.plant.named(name): readable_form(answer, name) for name in MATRICES}
    found[answer.letter] = column(answer.state)
    if not answer.is_physical:
        return found | {answer.plant.named("G"): answer.transfer.expr(answer.plant.style)}
    values = answer.plant.solution.values
    for name, order in answer.space.states:
        for k in (1, 2)[: order + 1]:
            found[Symbol(name + ORDERS[k])] = multiply(*[S] * k, values[Symbol(name)])
    return {**found, **values}


def _facts(answer: Answer, at: AtPoint | None) -> Facts:
    solved = answer.plant
    beyond = len(answer.state) - len(answer.transfer.den) + 1
    beside = hidden(solved.system, answer.transfer.den, solved.style)
    return Facts(
        physical=answer.is_physical,
        motor=solved.system.motor,
        disturbance=solved.system.disturbance if answer.is_physical else None,
        inside=inside_motor(solved.system) if answer.is_physical and _begins(answer) else None,
        law=_equation(answer, Symbol(f"{answer.letter.name}_dot"), "A", "B"),
        output_law=_equation(answer, solved.system.output, "C", "D"),
        matrices=tuple(solved.named(name) for name in MATRICES),
        form=None if answer.is_physical else Phrase("form-beside" if answer.space.D[0, 0] else "form"),
        hidden=Phrase("hidden-motions", {"count": beyond}) if beyond else None,
        cancelled=() if answer.is_physical or len(beside) == 1 else (collected(beside, solved.style),),
        final=_final(answer),
        at=at,
        numbers=(),
    )


def _equation(answer: Answer, left: Symbol, state: str, drive: str) -> tuple[Expr, ...]:
    """dx/dt = A x + B u."""
    named = answer.plant.named
    terms = (named(state) * answer.letter, named(drive) * answer.plant.system.input)
    return left, add(*terms)


def _final(answer: Answer) -> tuple[tuple[Expr, ...], ...]:
    """The matrices with `where` replaced, those that it changes."""
    pairs = [(answer.plant.named(name), readable_form(answer, name)) for name in MATRICES]
    done = [(name, tree, answer.plant.problem.final(tree)) for name, tree in pairs]
    return tuple((name, after) for name, before, after in done if after != before)


# -- in numbers ---------------------------------------------------------------------------------------


def _evaluated(answer: Answer, options: Options) -> tuple[dict[str, Any], AtPoint | None]:
    """What goes to the JSON, and what the words print."""
    if options.evaluate is None:
        return {}, None
    solved = answer.plant
    if len(solved.there(answer.transfer).den) < len(answer.transfer.den):
        raise NotDerivable(
            "the highest coefficient is zero at these values: there are fewer states", "evaluate"
        )
    names = {**solved.problem.names, **solved.point}
    numeric = {name: normal_matrix(readable_form(answer, name), names) for name in MATRICES}
    values: dict[str, Any] = {name: [mixed(row) for row in matrix.rows] for name, matrix in numeric.items()}
    shown = tuple((solved.named(name), readable_matrix(numeric[name], solved.style)) for name in MATRICES)
    told = AtPoint(shown=shown, point=point_chains(options.evaluate, solved.problem.where))
    characteristic = characteristic_of(numeric["A"])
    if names_in(characteristic):
        return values, told
    poles = roots(characteristic)
    return {**values, "poles": [as_json(pole) for pole in poles]}, replace(
        told, poles=roots_told(poles), verdict=Phrase(verdict(characteristic))
    )
