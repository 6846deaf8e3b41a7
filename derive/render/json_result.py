"""The results of a sheet as JSON, in the shapes the sheet language promises."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any, get_args

from derive.algebra.infix import text
from derive.derivation import Branch, Claim, Derivation, Result
from derive.expression import Expr, Matrix
from derive.render.document import Document, ProblemPage, QuestionPage

TREES = get_args(Expr)
Plain = str | float | list[Any] | dict[str, Any]


def render_json(document: Document) -> str:
    """The results of every question, as a JSON text."""
    problems = [_problem(problem) for problem in document.problems]
    return json.dumps({"title": document.title, "problems": problems}, indent=2, ensure_ascii=False) + "\n"


def _problem(problem: ProblemPage) -> dict[str, Any]:
    questions = [_question(question) for question in problem.questions]
    return {"number": problem.number, "title": problem.title, "questions": questions}


def _question(question: QuestionPage) -> dict[str, Any]:
    found: dict[str, Any] = {"number": question.number, "find": question.find}
    if question.derivation:
        found |= _derivation(question.derivation)
        found["checks"] = [
            {"claim": claim.claim, "by": claim.by, "holds": claim.holds} for claim in _claims(question)
        ]
    return found


def _derivation(derivation: Derivation) -> dict[str, Any]:
    results: dict[str, Plain] = {}
    written: dict[tuple[int, bool], Plain] = {}  # c_121 and c_211 are one tree
    for name, result in derivation.results.items():
        key = id(result), name in derivation.matrices
        if key not in written:
            written[key] = plain(result, name in derivation.matrices)
        results[name] = written[key]
    evaluated = {"evaluated": _numbers(dict(derivation.evaluated))} if derivation.evaluated else {}
    return {"results": results, **evaluated}


def _numbers(value: Any) -> Any:
    """Evaluated values as they are; what symbols are left in as a text."""
    match value:
        case dict():
            return {name: _numbers(part) for name, part in value.items()}
        case list():
            return [_numbers(part) for part in value]
    return text(value) if isinstance(value, TREES) else value


def _claims(question: QuestionPage) -> Iterator[Claim]:
    """What was verified of the answer, then of what it rests on and is printed with it."""
    own = question.derivation
    if own:
        yield from own.claims
    for worked in question.order:
        if own is None or worked.derivation.claims is not own.claims:
            yield from worked.derivation.claims


def plain(result: Result | Branch | tuple[Expr, ...] | dict[str, Any], matrix: bool = False) -> Plain:
    """A result as JSON: a scalar is a text, a matrix a list of rows, a column vector a flat list (unless it
    is a `matrix` of one column), branches a list of objects with `when`."""
    match result:
        case str() | float() | int():
            return result
        case Matrix(rows) if matrix or result.shape[1] > 1:
            return [[plain(entry) for entry in row] for row in rows]
        case Matrix(rows):
            return [plain(entry) for (entry,) in rows]
        case Branch(values, when, short, true_at, facts):
            shown = {name: plain(value) for name, value in (short or values).items()}
            return {**shown, "when": when, **({} if true_at else {"true_at": False}), **facts}
        case dict():
            return result
        case tuple():
            return [plain(part) for part in result]
        case _:
            return text(result)
