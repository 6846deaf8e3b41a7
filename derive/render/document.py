"""A sheet ready to be printed: plain frozen values, the same for every format."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import PurePosixPath
from typing import Literal

from derive.derivation import Claim, Derivation, Drawing, Figure
from derive.errors import Place
from derive.expression import Expr
from derive.given.asked import AT_A_POSE
from derive.given.datum import Datum
from derive.render.notation import Notation
from derive.render.printed import Printed

LINES, FEWEST_LINES, LINES_A_MARK, MOST_LINES = 10, 4, 3, 30  # of room for an answer
FIGURE = "_figure"  # the words about what is drawn of a subject, among those of its folder


def _sum(marks: Iterable[int | None]) -> int | None:
    each = [count for count in marks if count is not None]
    return sum(each) if each else None


@dataclass(frozen=True, slots=True)
class Worked:
    """A derivation to print and the folder of its words under `templates/words/`.

    `asked` is false for one that only another rests on; its words may then be brief. It is not `read` where
    nothing needs its results written out.
    """

    derivation: Derivation
    folder: str
    asked: bool = True
    read: bool = True


@dataclass(frozen=True, slots=True)
class QuestionPage:
    """A question and its answer.

    `text` and `hint` are the author's Markdown; a `text` of "" prints none. `folder` is that of the words of
    its answer. `order` holds what to print for it, prerequisites first and only those no earlier question
    printed; it is empty on a problem sheet. `at` is the point its results are evaluated at. `rounded` are the
    places of rotations that were given rounded, where that is to be said here. `printed` is the mathematics
    of a text that is ours, `place` where the question stands in its sheet. `claims` are those about
    what was done with the answer after it was derived: its numbers at the point; `once` are the results of
    which some numbers could not be found again. `given` is what its options and its point give and its text
    does not say.
    """

    number: int
    find: str
    text: str = ""
    marks: int | None = None
    hint: str = ""
    derivation: Derivation | None = None
    order: tuple[Worked, ...] = ()
    at: Mapping[str, Expr] = field(default_factory=dict)
    rounded: int = 0
    folder: str = ""
    printed: tuple[Printed, ...] = ()
    place: Place | None = None
    claims: tuple[Claim, ...] = ()
    once: tuple[str, ...] = ()
    steps: Literal["full", "key", "answers"] = "full"
    given: tuple[Datum, ...] = ()

    @property
    def lines(self) -> int:
        """How many lines of room an answer is given: more for more marks."""
        return LINES if self.marks is None else min(MOST_LINES, FEWEST_LINES + LINES_A_MARK * self.marks)

    @property
    def gives_pose(self) -> bool:
        """Whether it tells the pose at which numbers are wanted, and all that goes with it."""
        return any(datum.said.key in AT_A_POSE for datum in self.given)

    def verified(self) -> Iterator[Claim]:
        """What was verified of the answer and of what it rests on and is printed with it."""
        for worked in self.order:
            yield from worked.derivation.claims
        yield from self.claims

    def alone(self) -> Iterator[str]:
        """The results that could be compared with no line, or with no number."""
        for worked in self.order:
            yield from worked.derivation.alone
        yield from self.once


@dataclass(frozen=True, slots=True)
class ProblemPage:
    """A problem. `figure` is the path of a picture relative to the page, `/` between its parts; `drawing` is
    what is drawn there, None where the author gave the picture. What an earlier problem shows already has a
    drawing and no path; `shown_in` is the number of that problem. `notation` is that of its mathematics,
    `subject` the name of its subject; `given` is what the problem gives and its text does not say."""

    number: int
    questions: tuple[QuestionPage, ...]
    title: str = ""
    text: str = ""
    figure: str | None = None
    drawing: Drawing | None = None
    shown_in: int | None = None
    notation: Notation = field(default_factory=Notation)
    subject: str = ""
    given: tuple[Datum, ...] = ()
    place: Place | None = None
    variables: tuple[str, ...] = ()  # of the joints of an arm
    bare: frozenset[str] = frozenset()  # units of data that stand in formulas as numbers

    @property
    def marks(self) -> int | None:
        """The sum of its marks, None where none are printed."""
        return _sum(question.marks for question in self.questions)

    @property
    def drawn_as(self) -> str:
        """The folder of the words about its figure: a motor is drawn as the system that it is."""
        return "system" if self.subject == "motor" else self.subject


@dataclass(frozen=True, slots=True)
class Document:
    """A sheet, with or without its solutions. `name` is that of its pages, without suffix; `figures` the
    folder of its pictures, seen from the page. With `space` there is room after each question."""

    title: str
    problems: tuple[ProblemPage, ...]
    course: str = ""
    author: str = ""
    date: str = ""
    language: str = "en"
    name: str = ""
    figures: str = ""
    solutions: bool = True
    space: bool = False
    paper: Literal["a4", "letter"] = "a4"

    @property
    def marks(self) -> int | None:
        """The sum of all marks, None where none are printed."""
        return _sum(problem.marks for problem in self.problems)

    def questions(self) -> Iterator[tuple[ProblemPage, QuestionPage]]:
        for problem in self.problems:
            for question in problem.questions:
                yield problem, question

    def verified(self) -> Iterator[Claim]:
        """What was verified, over all that is printed."""
        for _, question in self.questions():
            yield from question.verified()

    def alone(self) -> Iterator[str]:
        """The results that could be compared with nothing, over all that is printed."""
        for _, question in self.questions():
            yield from question.alone()

    def files(self) -> dict[str, str]:
        """Every file of the page by its path, relative to the page."""
        return {
            file_path(self.figures, problem.number, question.number, name): text
            for problem, question in self.questions()
            for worked in question.order
            for name, text in worked.derivation.files.items()
        }

    def pictures(self) -> tuple[str, ...]:
        """The pictures that authors gave, by their paths relative to the page."""
        return tuple(page.figure for page in self.problems if page.figure and not page.drawing)

    def plots(self) -> dict[str, Figure]:
        """Every plot of the page by the path of its picture, relative to the page and without suffix."""
        from derive.render.phrases import in_figure

        subjects = {
            problem.figure.removesuffix(".svg"): in_figure(problem.drawn_as, FIGURE, problem.notation).figure(
                problem.drawing
            )
            for problem in self.problems
            if problem.figure and problem.drawing
        }
        return subjects | {
            plot_path(self.figures, problem.number, question.number, plot.name): speech.figure(plot)
            for problem, question in self.questions()
            for worked in question.order
            if worked.derivation.plots
            for speech in [in_figure(worked.folder, worked.derivation.kind, problem.notation)]
            for plot in worked.derivation.plots
        }


def file_path(folder: str, problem: int, question: int, name: str) -> str:
    """Where a file is kept: `week6/problem_1_2_model.m`, a name that MATLAB and Python can run."""
    return str(PurePosixPath(folder, f"problem_{problem}_{question}_{name}"))


def figure_path(folder: str, problem: int, suffix: str = ".svg") -> str:
    """Where the picture of a problem is kept: `week4/problem-2-figure.svg`."""
    return str(PurePosixPath(folder, f"problem-{problem}-figure{suffix}"))


def plot_path(folder: str, problem: int, question: int, name: str) -> str:
    """Where a plot is kept: `week6/problem-1-2-step`."""
    return str(PurePosixPath(folder, f"problem-{problem}-{question}-{name}"))
