"""Published answers against derived ones: every question that has an `answer` is derived and compared."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path

from derive.answers.asked import Asked
from derive.answers.checking import checks
from derive.answers.findings import Check
from derive.answers.points import Point
from derive.build import Warn, load_all, working_on
from derive.derivation import Derivation, has_equations
from derive.errors import NotDerivable, SheetError, SheetErrors
from derive.evaluate import evaluated
from derive.kinds.problem import Problem as Working
from derive.sheet.model import Problem, Question, Sheet
from derive.verify import answered, speech_of
from derive.writing import Progress

POINTS = 12  # that the subject of an inverse problem reaches
NOT_COMPARED = "it was not compared: see the fault"


@dataclass(frozen=True, slots=True)
class Checked:
    """What was found about each entry of each answer, in the order of the sheets, and why some were not
    compared: those are undecided."""

    checks: tuple[Check, ...] = ()
    faults: tuple[SheetError, ...] = ()


def check(paths: Sequence[Path], progress: Progress = lambda _: None, warn: Warn = lambda _: None) -> Checked:
    """A verdict on every answer of the sheets.

    Raises SheetErrors with the faults of all the sheets, and where there is no answer to check.
    """
    sheets = load_all(paths, progress)
    for warning in (found for sheet in sheets for found in sheet.warnings):
        warn(warning)
    found = []
    for sheet in sheets:
        progress(f"checking {sheet.path.stem}")
        found += [_of_question(sheet, *asked) for asked in _asked(sheet)]
    if not found:
        names = ", ".join(str(path) for path in paths)
        hint = "write answer: {J: ...} beside a find"
        raise SheetErrors([SheetError(f"{names}: there is no answer to check", None, hint)])
    return Checked(
        tuple(entry for each in found for entry in each.checks),
        tuple(dict.fromkeys(fault for each in found for fault in each.faults)),
    )


def _asked(sheet: Sheet) -> Iterator[tuple[Problem, Question, Working]]:
    """Every question with an answer; those of one problem share what is derived."""
    for problem in sheet.problems:
        working = working_on(problem)
        for question in problem.questions:
            if question.answer is not None:
                yield problem, question, working


def _of_question(sheet: Sheet, problem: Problem, question: Question, working: Working) -> Checked:
    """A verdict on every entry; where one name cannot be read, the others are compared all the same."""
    try:
        derivation = answered(question, working)
    except SheetErrors as errors:
        return _undecided(problem, question, errors)
    try:
        return _compared(sheet, problem, question, working, derivation)
    except SheetErrors as errors:
        if len(question.answer or ()) < 2:
            return _undecided(problem, question, errors)
    found = [_of_question(sheet, problem, one, working) for one in _names_apart(question)]
    checks = tuple(entry for each in found for entry in each.checks)
    return Checked(checks, tuple(fault for each in found for fault in each.faults))


def _names_apart(question: Question) -> Iterator[Question]:
    """The question with one name of its answer at a time."""
    for name, typed in (question.answer or {}).items():
        yield replace(question, answer={name: typed})


def _undecided(problem: Problem, question: Question, errors: SheetErrors) -> Checked:
    """What was not compared, and why."""
    where = question.answer_at
    checks = tuple(
        Check(
            problem.number, question.number, name, (), "undecided",
            typed if isinstance(typed, str) else str(typed), "",
            where.key((name,)) if where else question.place, note=NOT_COMPARED,
        )
        for name, typed in (question.answer or {}).items()
    )  # fmt: skip
    return Checked(checks, errors.errors)


def _compared(
    sheet: Sheet, problem: Problem, question: Question, working: Working, derivation: Derivation
) -> Checked:
    at, speech = question.answer_at, speech_of(derivation, working)
    if not question.answer or at is None:
        raise SheetErrors([SheetError("this answer is empty", question.place, "write answer: {J: ...}")])
    if question.evaluate is not None and has_equations(derivation):  # only their solution can be compared
        derivation = evaluated(derivation, question, working)
    asked = Asked(
        problem=problem.number,
        question=question.number,
        derivation=replace(derivation, results=speech.results(derivation.results)),
        given=working,
        answer=question.answer,
        locate=at.place,
        key=at.key,
        xy=sheet.notation.atan2 == "xy",
        reached=reached(question, working, derivation),
        evaluate=question.evaluate,
    )
    return Checked(tuple(checks(asked)))


def reached(question: Question, working: Working, derivation: Derivation) -> tuple[Point, ...]:
    """Points at which what is known belongs together, where the kind can tell."""
    search = getattr(question.kind, "reached", None)
    if search is None or "solutions" not in derivation.results:
        return ()
    try:
        points: Sequence[Mapping[str, float]] = search(question.options, working, POINTS)
    except NotDerivable:  # where: has names of its own for what is given; then any points will do
        return ()
    return tuple({name: Fraction(value) for name, value in point.items()} for point in points)
