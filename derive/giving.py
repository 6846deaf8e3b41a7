"""What a problem gives and its author's texts do not say, put on its page."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from derive.errors import SheetError, SheetErrors
from derive.given.collected import of_problem, of_question, says_in_questions
from derive.given.datum import Datum
from derive.given.screws_held import Misgiven
from derive.kinds.problem import Problem as Working
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
    questions = tuple(map(_asked, page.questions, problem.questions, [page] * len(page.questions)))
    if problem.given is False:
        return replace(page, questions=questions)
    try:
        data = tuple(of_problem(working))
    except Misgiven as error:
        message = f"what is given of problem {problem.number} failed its own check: {error}"
        raise SheetErrors([SheetError(message, problem.place)]) from error
    return replace(page, questions=questions, given=data if problem.given else _unsaid(data, texts))


def _asked(page: QuestionPage, question: Question, whole: ProblemPage) -> QuestionPage:
    texts = [whole.title, whole.text, page.text, page.hint]
    options = question.options
    if whole.notation.angular_first and (twist := getattr(options, "twist", None)):
        options = options.model_copy(update={"twist": swapped(twist)})
    return replace(page, given=_unsaid(of_question(options, question.evaluate or {}), texts))


def _unsaid(data: Iterable[Datum], texts: Iterable[str]) -> tuple[Datum, ...]:
    mentioned = Mentioned.of(texts)
    return tuple(datum for datum in data if not mentioned.says(datum))
