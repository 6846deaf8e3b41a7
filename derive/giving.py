"""What a problem gives and its author's texts do not say, put on its page."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

from derive.errors import Place, SheetError, SheetErrors
from derive.given.collected import of_problem, of_question, says_in_questions
from derive.given.datum import Datum
from derive.given.screws_held import Misgiven
from derive.kinds.problem import Problem as Working
from derive.quoted import misgiven
from derive.render.document import ProblemPage, QuestionPage
from derive.render.mentioned import Mentioned
from derive.render.twists import swapped
from derive.sheet.model import Problem, Question


def with_given(page: ProblemPage, problem: Problem, working: Working) -> ProblemPage:
    """The page with what is given: of the subject as `given:` says, or where that is left out what no text
    says; of each question always what no text says. Raises SheetErrors where what is given in place of what
    was typed is not the same."""
    asked: Sequence[Question | QuestionPage] = problem.questions
    if says_in_questions(problem.subject_name):
        asked = page.questions
    texts = [page.title, page.text, *(each.text for each in asked)]
    questions = tuple(
        _asked(*pair, page, working) for pair in zip(page.questions, problem.questions, strict=True)
    )
    if problem.given is False:
        return replace(page, questions=questions)
    try:
        data = tuple(of_problem(working))
    except Misgiven as error:
        message = f"what is given of problem {problem.number} failed its own check: {error}"
        raise SheetErrors([SheetError(message, problem.place)]) from error
    _require_typed(data, (), working, problem.place)
    return replace(page, questions=questions, given=data if problem.given else _unsaid(data, texts))


def _require_typed(data: Sequence[Datum], options: Any, working: Working, place: Place | None) -> None:
    """Raises SheetErrors where the page would give what was not typed."""
    if wrong := [*misgiven(data, options, working)]:
        said = f"what the page gives failed its own check: {', '.join(wrong)} is not what was typed"
        raise SheetErrors([SheetError(said, place)])


def _asked(page: QuestionPage, question: Question, whole: ProblemPage, working: Working) -> QuestionPage:
    texts = [whole.title, whole.text, page.text, page.hint]
    options = question.options
    if whole.notation.angular_first and (twist := getattr(options, "twist", None)):
        options = options.model_copy(update={"twist": swapped(twist)})
    data = tuple(of_question(options, question.evaluate or {}))
    _require_typed(data, (options, question.evaluate), working, question.place)
    return replace(page, given=_unsaid(data, texts))


def _unsaid(data: Iterable[Datum], texts: Iterable[str]) -> tuple[Datum, ...]:
    mentioned = Mentioned.of(texts)
    return tuple(datum for datum in data if not mentioned.says(datum))
