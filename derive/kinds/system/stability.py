"""For which values a system, or its loop, is stable: by the array of Routh."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from derive.algebra.readable.form import readable
from derive.algebra.readable.operation_count import operations
from derive.algebra.roots_and_functions import root
from derive.algebra.solving.polynomials import known_sign, odd_part
from derive.control.hurwitz import is_impossible
from derive.control.rational import Rational, at, names_in
from derive.control.rational import written as collected
from derive.control.roots import roots
from derive.control.system import System
from derive.derivation import Derivation, Phrase, Result, Step
from derive.expression import Expr, Quotient, Relation, Sum, Symbol, number, walk
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.system._checked_array import Printed
from derive.kinds.system._options import ControllerField
from derive.kinds.system._oracle import Held
from derive.kinds.system._pairs import roots_told
from derive.kinds.system._plant import mixed, point_chains, poles_json, verdict
from derive.kinds.system._routh_steps import entry_steps, law_step
from derive.kinds.system._stability_answer import Answer, answered, right_of_axis
from derive.kinds.system._stability_checks import claims_about, signs_at
from derive.kinds.system._stability_facts import Facts as Facts
from derive.kinds.system._stability_facts import StabilityAtPoint
from derive.kinds.system._stability_limit import (
    frequency_squared,
)
from derive.kinds.system._stability_proofs import routes
from derive.kinds.system._stability_told import facts_of, omega_of, small_of, written_of
from derive.kinds.system._values_checks import point_routes
from derive.kinds.work import Work

SUBJECTS = ("system", "motor")
S = Symbol("s")
CLAIMED = {"unstable_poles": "sign-changes"}


class Options(OptionsModel):
    """With a controller the loop is closed, without one the system itself is looked at."""

    controller: ControllerField | None = None
    """The controller; a gain without a value stays a letter."""
    evaluate: Evaluation = None


def claims_of(system: System, options: Options) -> tuple[str, ...]:
    """With those of the values asked for."""
    always = ("polynomial", "minors", "array-as-printed", "as-said")
    return (*always, "in-numbers") if options.evaluate else always


def derive(system: System, options: Options, problem: Problem) -> Derivation:
    """Routh and Hurwitz (Dorf and Bishop, Modern Control Systems, sections 6.2 and 6.3)."""
    answer = answered(problem, options.controller, options.evaluate)
    results: dict[str, Result] = {
        "routh": answer.array.matrix,
        "conditions": answer.written,
    }
    if not answer.symbols:
        results["unstable_poles"] = number(answer.changes)
    evaluated, numbers = _evaluated(answer, options)
    work = Work(problem, _definitions(answer), uses=(answer.base,), steps=tuple(_steps(answer)))
    told, held = (
        facts_of(answer, options.controller is not None, numbers),
        Held(problem, system.input, options.controller),
    )
    letter = answer.array.letter
    printed = Printed(
        answer.array.matrix, answer.written, work.steps, told, answer.positive, letter, small_of(answer)
    )
    there = replace(held, given=dict(options.evaluate or ()))
    work = work.claim(
        *claims_about(answer), *routes(held, printed, results), *point_routes(there, printed, evaluated)
    )
    return work.answer("stability", results, told, evaluated=evaluated, matrices=frozenset({"routh"}))


# -- the page -----------------------------------------------------------------------------------------


def _delta(answer: Answer) -> Symbol:
    return answer.plant.named("Delta")


def _steps(answer: Answer) -> Iterator[Step]:
    style = answer.plant.style
    whole = collected(answer.whole, style)
    found = tuple(each for each in answer.found if _terms(each) != _terms(whole))
    yield Step("characteristic", (_delta(answer), *found, whole), "denominator")
    if any(node in answer.plant.problem.names for node in walk(whole)):
        yield Step("values", (_delta(answer), collected(answer.final, style)), "substitute")
    if len(answer.array.rows) > 2:
        yield law_step(answer.array)
    yield from entry_steps(answer.array)
    yield from _limit_steps(answer)


def _terms(expr: Expr) -> int:
    """A sum with as many terms as the polynomial has says the same."""
    return len(expr.terms) if isinstance(expr, Sum) else 1


def _definitions(answer: Answer) -> dict[Expr, Expr]:
    found = {_delta(answer): collected(answer.final, answer.plant.style), **answer.array.definitions}
    if (square := frequency_squared(answer)) is not None:
        found[omega_of(answer)] = readable(root(square), answer.plant.style)
    return found


def _limit_steps(answer: Answer) -> Iterator[Step]:
    """The frequency of the motion that is left where the row of s vanishes."""
    square, array = frequency_squared(answer), answer.array
    if square is None:
        return
    row = len(array.rows) - 2
    below, value = array.value(row, 1), readable(square, answer.plant.style)
    filled = array.value(row, 2) / below
    value = value if isinstance(below, Quotient) or operations(value) < operations(filled) else filled
    chain: tuple[Expr, ...] = (omega_of(answer) ** 2, array.name(row, 2) / array.name(row, 1))
    yield Step("limit", (*chain, value), "limit", spare=(value,))


# -- in numbers ---------------------------------------------------------------------------------------


def _evaluated(answer: Answer, options: Options) -> tuple[dict[str, Any], StabilityAtPoint | None]:
    """What goes to the JSON, and what the words print."""
    if options.evaluate is None:
        return {}, None
    solved = answer.plant
    numeric = solved.there(Rational((), answer.final))
    place = {**solved.problem.names, **solved.point}
    rows = _rows_at(answer, place)
    array = {"routh": rows} if rows else {}
    shown = ((_delta(answer), collected(numeric.den, solved.style)),)
    told = StabilityAtPoint(shown=shown, point=point_chains(options.evaluate, {}))
    if numeric.symbols():
        return {**array, "conditions": _left(answer, place)}, told
    poles = roots(numeric.den)
    met = [each > 0 for each in signs_at(answer.conditions, place)]
    values: dict[str, Any] = {
        "conditions": met,
        "poles": poles_json(numeric),
        "stable": verdict(numeric.den) == "stable",
        "unstable_poles": right_of_axis(poles),
    }
    return {**array, **values}, replace(
        told,
        poles=roots_told(poles),
        verdict=Phrase(verdict(numeric.den)),
        met=_met(answer, tuple(each for each, holds in zip(answer.written, met, strict=True) if not holds)),
    )


def _met(answer: Answer, failing: tuple[Relation, ...]) -> Phrase | None:
    """Which of the conditions do not hold, where some are told."""
    if not answer.written or not answer.symbols or is_impossible(answer.conditions, answer.positive):
        return None
    return Phrase("not-met", {"failing": failing}) if failing else Phrase("all-met")


def _left(answer: Answer, place: Mapping[Expr, Expr]) -> list[bool | Relation]:
    """Each condition as far as it is decided there, else as an inequality in the symbols left."""
    signs = [known_sign(each, answer.positive) for each in at(answer.conditions, place)]
    left = written_of(answer, [odd_part(each, answer.positive) for each in at(answer.conditions, place)])
    return [c if known is None else known > 0 for c, known in zip(left, signs, strict=True)]


def _rows_at(answer: Answer, place: Mapping[Expr, Expr]) -> list[list[float | str]] | None:
    """The array in numbers; None where it needs its special cases there."""
    try:
        rows = [at(row.entries, place) for row in answer.array.rows]
    except ZeroDivisionError:
        return None
    if answer.array.epsilon in names_in(k for row in rows for k in row):
        return None
    return [mixed(row) for row in rows]
