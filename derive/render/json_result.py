"""The results of a sheet as JSON, in the shapes the sheet language promises."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any, get_args

from derive.algebra.infix import text
from derive.derivation import Branch, Claim, Condition, Derivation, Phrase, Result
from derive.expression import Expr, Matrix, Relation
from derive.render.document import Document, ProblemPage, QuestionPage
from derive.render.phrases import Speech, spoken

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
        speech = spoken(question.folder, question.derivation.kind)
        found |= _derivation(question.derivation, speech)
        found["checks"] = [
            {"claim": speech.claim(claim), "by": speech.say(Phrase(claim.by)), "holds": claim.holds}
            for speech, claim in _claims(question, speech)
        ]
    return found


def _derivation(derivation: Derivation, speech: Speech) -> dict[str, Any]:
    results: dict[str, Plain] = {}
    written: dict[tuple[int, bool], Plain] = {}  # c_121 and c_211 are one tree
    for name, result in derivation.results.items():
        key = id(result), name in derivation.matrices
        if key not in written:
            written[key] = plain(result, speech, name in derivation.matrices)
        results[name] = written[key]
    evaluated = {"evaluated": _numbers(dict(derivation.evaluated), speech)} if derivation.evaluated else {}
    return {"results": results, **evaluated}


def _numbers(value: Any, speech: Speech) -> Any:
    """Evaluated values as they are; what symbols are left in and what is said in words as a text."""
    match value:
        case dict():
            return {
                name: speech.when(part) if name == "when" else _numbers(part, speech)
                for name, part in value.items()
            }
        case list():
            return [_numbers(part, speech) for part in value]
        case Phrase() | Relation():
            return speech.say(value)
    return text(value) if isinstance(value, TREES) else value


def _claims(question: QuestionPage, speech: Speech) -> Iterator[tuple[Speech, Claim]]:
    """What was verified of the answer, then of what it rests on and is printed with it; with how each is
    said."""
    own = question.derivation.claims if question.derivation else ()
    yield from ((speech, claim) for claim in own)
    for worked in question.order:
        if worked.derivation.claims is not own:
            theirs = spoken(worked.folder, worked.derivation.kind)
            yield from ((theirs, claim) for claim in worked.derivation.claims)


def plain(
    result: Result | Branch | Condition | tuple[Expr, ...] | dict[str, Any],
    speech: Speech,
    matrix: bool = False,
) -> Plain:
    """A result as JSON: a scalar is a text, a matrix a list of rows, a column vector a flat list (unless it
    is a `matrix` of one column), branches a list of objects with `when`."""
    match result:
        case str() | float() | int():
            return result
        case Matrix(rows) if matrix or result.shape[1] > 1:
            return [[plain(entry, speech) for entry in row] for row in rows]
        case Matrix(rows):
            return [plain(entry, speech) for (entry,) in rows]
        case Branch(values, when, short, true_at, facts):
            shown = {name: plain(value, speech) for name, value in (short or values).items()}
            facts = {name: _numbers(fact, speech) for name, fact in facts.items()}
            return {**shown, "when": speech.when(when), **({} if true_at else {"true_at": False}), **facts}
        case dict():
            return result
        case Phrase() | Relation():
            return speech.say(result)
        case tuple():
            return [plain(part, speech) for part in result]
        case _:
            return text(result)
