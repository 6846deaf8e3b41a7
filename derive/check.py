"""Published answers against derived ones: every question that has an `answer` is derived and compared."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path

from derive.answers.checking import Compared
from derive.answers.findings import Check
from derive.answers.points import Point
from derive.build import Warn, answered, each, load_all, working_on
from derive.derivation import Derivation
from derive.errors import NotDerivable, SheetError, SheetErrors
from derive.kinds.problem import Problem as Working
from derive.sheet.model import Problem, Question, Sheet
from derive.writing import Progress

POINTS = 4  # that the subject of an inverse problem reaches


def check(
    paths: Sequence[Path], progress: Progress = lambda _: None, warn: Warn = lambda _: None
) -> list[Check]:
    """What was found about each entry of each answer, in the order of the sheets.

    Raises SheetErrors with the faults of all the sheets, and where there is no answer to check.
    """
    sheets = load_all(paths, progress)
    for warning in (found for sheet in sheets for problem in sheet.problems for found in problem.warnings):
        warn(warning)
    found = each(sheets, _checks, lambda sheet: progress(f"checking {sheet.path.stem}"))
    checks = [found_here for of_sheet in found for found_here in of_sheet]
    if not checks:
        names = ", ".join(str(path) for path in paths)
        hint = "write answer: {J: ...} beside a find"
        raise SheetErrors([SheetError(f"{names}: there is no answer to check", None, hint)])
    return checks


def _checks(sheet: Sheet) -> list[Check]:
    found = each(sheet.problems, lambda problem: _of_problem(sheet, problem), lambda _: None)
    return [check for of_problem in found for check in of_problem]


def _of_problem(sheet: Sheet, problem: Problem) -> list[Check]:
    working = working_on(problem)
    asked = [question for question in problem.questions if question.answer]
    found = each(asked, lambda question: _of_question(sheet, problem, question, working), lambda _: None)
    return [check for of_question in found for check in of_question]


def _of_question(sheet: Sheet, problem: Problem, question: Question, working: Working) -> list[Check]:
    derivation = answered(question, working)
    at = question.answer_at
    if not question.answer or at is None:
        return []
    return Compared(
        problem.number,
        question.number,
        derivation,
        working,
        question.answer,
        at.place,
        at.key,
        sheet.notation.atan2 == "xy",
        _reached(question, working, derivation),
    ).checks()


def _reached(question: Question, working: Working, derivation: Derivation) -> tuple[Point, ...]:
    """Points at which what is known belongs together, where the kind can tell."""
    reached = getattr(question.kind, "reached", None)
    if reached is None or "solutions" not in derivation.results:
        return ()
    try:
        points: Sequence[Mapping[str, float]] = reached(question.options, working, POINTS)
    except NotDerivable:  # where: has names of its own for what is given; then any points will do
        return ()
    return tuple({name: Fraction(value) for name, value in point.items()} for point in points)
