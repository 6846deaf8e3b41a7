"""The results of a sheet as JSON, in the shapes the sheet language promises."""

from __future__ import annotations

import json
from typing import Any

from derive.algebra.text import text
from derive.derivation import Branch, Derivation, Result
from derive.expression import Expr, Matrix
from derive.render.document import Document, ProblemPage, QuestionPage

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
    return found


def _derivation(derivation: Derivation) -> dict[str, Any]:
    found: dict[str, Any] = {"results": {name: plain(result) for name, result in derivation.results.items()}}
    if derivation.evaluated:
        found["evaluated"] = dict(derivation.evaluated)
    found["checks"] = [
        {"claim": claim.claim, "by": claim.by, "holds": claim.holds} for claim in derivation.claims
    ]
    return found


def plain(result: Result | Branch | tuple[Expr, ...] | dict[str, Any]) -> Plain:
    """A result as JSON: a scalar is a text, a matrix a list of rows, a column vector a flat list, branches a
    list of objects with `when`."""
    match result:
        case str() | float() | int():
            return result
        case Matrix(rows):
            return _rows(rows)
        case Branch(values, when):
            return {**{name: plain(value) for name, value in values.items()}, "when": when}
        case dict():
            return result
        case tuple():
            return [plain(part) for part in result]
        case _:
            return text(result)


def _rows(rows: tuple[tuple[Any, ...], ...]) -> list[Any]:
    if all(len(row) == 1 for row in rows):
        return [plain(row[0]) for row in rows]
    return [[plain(entry) for entry in row] for row in rows]
