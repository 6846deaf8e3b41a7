"""Every answer of some sheets as it leaves the house, audited by SymPy; see `derive.audit`."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from derive.audit.asked import Asked
from derive.audit.budget import SECONDS, Endless
from derive.audit.engine import Audited, Contradicted, NotAudited, Outcome, audit
from derive.audit.text import Json
from derive.errors import Place, SheetError, SheetErrors
from derive.render.document import Document
from derive.sheet.model import Problem, Question, Sheet
from derive.writing import Progress, render

REPORT = "please report this with the sheet"


@dataclass(frozen=True, slots=True)
class Found:
    """What came of one answer, and where it is asked for."""

    place: Place
    find: str
    outcome: Outcome


def audited(sheets: Sequence[Sheet], documents: Sequence[Document], progress: Progress) -> tuple[Found, ...]:
    """What came of every answer. Raises SheetErrors with those that SymPy contradicts, or
    for one that it does not come to an end with."""
    found = []
    for sheet, document in zip(sheets, documents, strict=True):
        for question, asked in answers(sheet, render(document, "json")):
            progress(f"auditing {sheet.path.stem}, {question.find}")
            try:
                found.append(Found(question.place, question.find, audit(asked)))
            except Endless:
                message = f"SymPy does not come to an end with this answer in {SECONDS:.0f} s"
                raise SheetErrors([SheetError(message, question.place, REPORT)]) from None
    if wrong := [_fault(one.outcome, one.place) for one in found if isinstance(one.outcome, Contradicted)]:
        raise SheetErrors(wrong)
    return tuple(found)


def answers(sheet: Sheet, text: str) -> Iterator[tuple[Question, Asked]]:
    """The questions of a sheet with the answers in its JSON."""
    for problem, told in zip(sheet.problems, json.loads(text)["problems"], strict=True):
        for question, answer in zip(problem.questions, told["questions"], strict=True):
            yield question, _asked(problem, question, answer)


def _asked(problem: Problem, question: Question, answer: Mapping[str, Mapping[str, Json]]) -> Asked:
    return Asked(
        problem.subject_name,
        question.find,
        problem.subject,
        question.options,
        answer["results"],
        answer.get("evaluated", {}),
        question.evaluate,
        problem.where,
        problem.assumptions,
    )


def _fault(wrong: Contradicted, place: Place) -> SheetError:
    message = f"SymPy contradicts this answer: {wrong.name} is {wrong.ours} here, and {wrong.theirs} by SymPy"
    return SheetError(message, place, REPORT)


def report(found: Sequence[Found]) -> Iterator[str]:
    """How many answers were audited, and which were not."""
    import sympy

    counted = sum(isinstance(one.outcome, Audited) for one in found)
    yield f"Audited by SymPy {sympy.__version__.removesuffix('.0')}: {counted} answer{'s' * (counted != 1)}"
    for one in found:
        if isinstance(one.outcome, NotAudited):
            yield f"not audited: {one.place}: {one.find}: {one.outcome.reason}"
