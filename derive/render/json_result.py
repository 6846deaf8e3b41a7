"""The results of a sheet as JSON, in the shapes the sheet language promises."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any, get_args

from derive.algebra.infix import text
from derive.derivation import Branch, Claim, Derivation, LinearSystem, Phrase
from derive.expression import Expr, Matrix, Relation
from derive.render.document import Document, ProblemPage, QuestionPage
from derive.render.phrases import Speech, spoken

TREES = get_args(Expr)


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
            {
                "claim": speech.claim(claim),
                "by": speech.say(Phrase(claim.by)),
                "holds": claim.holds,
                "tried": claim.tried,
                "truth": claim.truth,
            }
            for speech, claim in _claims(question, speech)
        ]
    return found


def _derivation(derivation: Derivation, speech: Speech) -> dict[str, Any]:
    results: dict[str, Any] = {}
    written: dict[tuple[int, bool], Any] = {}  # c_121 and c_211 are one tree
    for name, result in derivation.results.items():
        key = id(result), name in derivation.matrices
        if key not in written:
            written[key] = plain(result, speech, name in derivation.matrices)
        results[name] = written[key]
    evaluated = {"evaluated": plain(dict(derivation.evaluated), speech)} if derivation.evaluated else {}
    return {"results": results, **evaluated}


def _claims(question: QuestionPage, speech: Speech) -> Iterator[tuple[Speech, Claim]]:
    """What was verified of the answer, then of what it rests on and is printed with it; with how each is
    said."""
    own = question.derivation.claims if question.derivation else ()
    yield from ((speech, claim) for claim in own)
    for worked in question.order:
        if worked.derivation.claims is not own:
            theirs = spoken(worked.folder, worked.derivation.kind)
            yield from ((theirs, claim) for claim in worked.derivation.claims)
    yield from ((speech, claim) for claim in question.claims)


def plain(value: Any, speech: Speech, matrix: bool = False) -> Any:
    """A result, or a value in numbers, as JSON: a scalar is a text, a matrix a list of rows, a column vector
    a flat list (unless it is a `matrix` of one column), a branch an object with `when`, equations one with
    `unknowns` and `equations`."""
    match value:
        case Matrix(rows) if matrix or value.shape[1] > 1:
            return [[plain(entry, speech) for entry in row] for row in rows]
        case Matrix(rows):
            return [plain(entry, speech) for (entry,) in rows]
        case Branch(values, when, short, true_at, facts):
            found = {**(short or values), "when": when, **({} if true_at else {"true_at": False}), **facts}
            return plain(found, speech)
        case LinearSystem():
            return plain(_system(value), speech)
        case dict():
            return {
                name: speech.when(part) if name == "when" else plain(part, speech)
                for name, part in value.items()
            }
        case Phrase() | Relation():
            return speech.say(value)
        case tuple() | list():
            return [plain(part, speech) for part in value]
    return text(value) if isinstance(value, TREES) else value


def _system(system: LinearSystem) -> dict[str, Any]:
    """Names of the result, those found with them, the equations, and what is given with them, if any."""
    wanted, others = system.shaped(system.unknowns), system.unknowns[system.wanted :]
    told = {"unknowns": wanted, "auxiliary": others, "where": dict(system.names)}
    return {
        **{key: each for key, each in told.items() if each},
        "equations": [*map(_equation, system.equations)],
    }


def _equation(sides: tuple[Expr, Expr]) -> str:
    return " = ".join(map(text, sides))
