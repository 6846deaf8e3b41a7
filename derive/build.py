"""The pipeline at a glance: load -> derive -> verify -> render -> write."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from derive.derivation import Claim, Derivation, Drawing
from derive.errors import NotDerivable, SheetError, SheetErrors, met_at
from derive.evaluate import strange_names, with_numbers
from derive.expression import ZERO, every
from derive.figures.held import Misdrawn
from derive.figures.wish import Wish
from derive.giving import with_given
from derive.kinds.bare_units import bare_in_lines, bare_units
from derive.kinds.figures import explains, figure_of
from derive.kinds.problem import Problem as Working
from derive.kinds.registry import words_folder
from derive.kinds.remembered import remembered
from derive.lettered import letters_of, unused_letters
from derive.placing import folder_name, namesakes
from derive.render.document import Document, ProblemPage, QuestionPage, Worked, figure_path
from derive.render.lettering import STYLES, Style
from derive.render.notation import Notation
from derive.render.printed import Printed
from derive.render.titles import without_solutions
from derive.render.trig import alike_letters, meant_indices
from derive.sheet.load import load_sheet
from derive.sheet.model import Angles, Problem, Question, Sheet, Steps
from derive.verify import answered, in_decimals
from derive.writing import Progress, render, write

CHRISTOFFEL = re.compile(r"c_\d{3}$")
Warn = Callable[[SheetError], None]
Audit = Callable[[Sequence[Sheet], Sequence[Document]], object]


def build(
    paths: Sequence[Path],
    formats: Sequence[str],
    output: Path | None,
    problems: bool = False,
    pdf_engine: str = "typst",
    progress: Progress = lambda _: None,
    warn: Warn = lambda _: None,
    audit: Audit = lambda sheets, documents: None,
    space: bool = False,
    figures: bool = True,
    steps: Steps | None = None,
) -> tuple[Path | str, ...]:
    """Builds every sheet and says what was written; without `output` it gives the pages as texts.

    `warn` is told what is strange about a sheet, though it can be built; `audit` sees the documents before
    anything is written, and may raise; `space` leaves room for answers. Without `figures` only those subjects
    are drawn whose sheets ask for it; `steps` says how much of every answer is told. Raises SheetErrors,
    before anything is written, with the faults of all sheets; NotAllWritten where a page could not be made.
    """
    if faults := namesakes(paths):
        raise SheetErrors(faults)
    sheets = [as_asked(sheet, figures, steps) for sheet in load_all(paths, progress)]
    for warning in (found for sheet in sheets for found in sheet.warnings):
        warn(warning)
    derived = derive_all(sheets, not problems, progress, warn)
    documents = [replace(document, space=space) for document in derived]
    audit(sheets, documents)
    if output is None:
        return tuple(render(document, kind) for document in documents for kind in formats)
    return write(sheets, documents, formats, output, pdf_engine, progress)


def load_all(paths: Sequence[Path], progress: Progress) -> list[Sheet]:
    """Every sheet. Raises SheetErrors with the faults of all of them."""
    return each(paths, load_sheet, lambda path: progress(f"reading {path.name}"))


def derive_all(
    sheets: Sequence[Sheet], solutions: bool, progress: Progress, warn: Warn = lambda _: None
) -> list[Document]:
    """A document for every sheet, each answer derived and verified. Raises SheetErrors."""
    return each(
        sheets,
        lambda sheet: assemble(sheet, solutions, warn),
        lambda sheet: progress(f"deriving {sheet.path.stem}"),
    )


def each(
    items: Sequence[Any], work: Callable[[Any], Any], say: Callable[[Any], None] = lambda _: None
) -> list[Any]:
    """Work done on every item. Raises SheetErrors with the faults of all of them."""
    done: list[Any] = []
    faults: list[SheetError] = []
    for item in items:
        say(item)
        try:
            done.append(work(item))
        except SheetErrors as errors:
            faults.extend(errors.errors)
    if faults:
        raise SheetErrors(faults)
    return done


def assemble(sheet: Sheet, solutions: bool = True, warn: Warn = lambda _: None) -> Document:
    """The sheet with its answers, ready to be printed. Raises SheetErrors where there is no answer."""
    folder = folder_name(_name(sheet, solutions))

    def page(problem: Problem) -> ProblemPage:
        with met_at(problem.place):
            return _page(sheet, problem, folder, solutions, warn)

    pages = each(sheet.problems, page)
    pages = [*_told_apart(pages)]
    answers = [page.derivation for each_page in pages for page in each_page.questions if page.derivation]
    for needless in unused_letters(sheet.notation, answers):
        warn(needless)
    return Document(
        title=sheet.title if solutions else sheet.problems_title or without_solutions(sheet.title),
        problems=tuple(_shown_once(pages)),
        course=sheet.course,
        author=sheet.author,
        date=sheet.date,
        language=sheet.language,
        name=_name(sheet, solutions),
        figures=folder,
        solutions=solutions,
        paper=sheet.paper,
    )


def as_asked(sheet: Sheet, figures: bool, steps: Steps | None) -> Sheet:
    """The sheet with only those figures that it asks for, told in so many steps, where that is wanted."""
    if not figures:
        sheet = _undrawn(sheet)
    return _told_in(sheet, steps) if steps else sheet


def _told_in(sheet: Sheet, steps: Steps) -> Sheet:
    """The sheet with all its answers told in so many steps."""
    problems = (
        replace(each, questions=tuple(replace(question, steps=steps) for question in each.questions))
        for each in sheet.problems
    )
    return replace(sheet, problems=tuple(problems))


def _undrawn(sheet: Sheet) -> Sheet:
    """The sheet without figures that its author did not ask for."""
    problems = (replace(problem, figure=problem.figure or False) for problem in sheet.problems)
    return replace(sheet, problems=tuple(problems))


def _told_apart(pages: Sequence[ProblemPage]) -> Iterator[ProblemPage]:
    """The pages, where no cosine is called as a Christoffel symbol of the sheet is that does not vanish:
    c_123."""
    answers = (question.derivation for page in pages for question in page.questions if question.derivation)
    symbols = meant_indices(
        name for answer in answers for name in _results(answer) if CHRISTOFFEL.match(name)
    )
    for page in pages:
        yield replace(page, notation=replace(page.notation, meant=page.notation.meant | symbols))


def _results(answer: Derivation) -> Iterator[str]:
    """The names of what was found and is not zero, and of what it rests on."""
    yield from (name for name, value in answer.results.items() if value != ZERO)
    for used in answer.uses:
        yield from _results(used)


def _shown_once(pages: Sequence[ProblemPage]) -> Iterator[ProblemPage]:
    """The pages, each drawing on the first only that has it; the others say which that is."""
    first: list[tuple[Drawing, int]] = []
    for page in pages:
        same = (number for drawn, number in first if page.drawing and drawn.same(page.drawing))
        if (shown_in := next(same, None)) is not None:
            yield replace(page, figure=None, shown_in=shown_in)
            continue
        if page.drawing:
            first.append((page.drawing, page.number))
        yield page


def working_on(problem: Problem, angles: Angles = None) -> Working:
    """The problem as its kinds see it, with all that is asked about it."""
    here = tuple((question.find, question.options) for question in problem.questions)
    points = (value for question in problem.questions for value in (question.evaluate or {}).values())
    known = problem.subject_name, problem.subject, problem.where, problem.assumptions
    return Working(*known, questions=here, angles=angles, points=tuple(points))


def _page(sheet: Sheet, problem: Problem, folder: str, solutions: bool, warn: Warn) -> ProblemPage:
    working = remembered(working_on(problem, sheet.notation.angles))
    answers = each(problem.questions, lambda question: answered(question, working))
    strange = list(strange_names(problem, working, answers))
    if misspelt := [found for found in strange if found.hint]:
        raise SheetErrors(misspelt)
    for needless in strange:
        warn(needless)
    places = max(getattr(part, "rounded", 0) for part in every(problem.subject))
    if places:
        answers = in_decimals(answers, problem.place)
    asked = [answer for answer in answers if solutions]
    printed: list[Derivation] = []
    notation = _notation(sheet, working, answers)
    questions: list[QuestionPage] = []
    for question, answer in zip(problem.questions, answers, strict=True):
        brief = (question.steps or sheet.steps) != "full"  # what it rests on is told where it is needed
        order = tuple(_order(answer, asked, [*printed] if brief else printed, working.name))
        printed.extend([answer] if brief else ())
        page = _question(sheet, question, answer if solutions else None, order if solutions else (), working)
        if not page.text:
            page = _asked_by_default(page, problem, question, answer, notation)
        questions.append(replace(page, rounded=0 if questions else places))
    figure, drawing = _figure(problem, working, folder, solutions)
    is_arm = problem.subject_name == "robot"
    whole = ProblemPage(
        problem.number, tuple(questions), problem.title, problem.text, figure, drawing,
        notation=notation, subject=problem.subject_name, place=problem.place,
        variables=problem.subject.variables if is_arm else (),
        bare=bare_units(working) | (bare_in_lines(answers) if is_arm else frozenset()),
    )  # fmt: skip
    return with_given(whole, problem, working)


def _figure(
    problem: Problem, working: Working, folder: str, solutions: bool
) -> tuple[str | None, Drawing | None]:
    """Where the picture of a problem stands, and what is drawn there if its author left that to us."""
    if isinstance(problem.figure, Path):
        return _picture(problem, problem.figure, folder), None
    if problem.figure is False:
        return None, None
    if problem.figure is None and not explains(working, solutions):
        return None, None
    wish = problem.figure if isinstance(problem.figure, Wish) else Wish()
    try:
        return figure_path(folder, problem.number), figure_of(working, wish)
    except Misdrawn as error:
        message = f"the figure of problem {problem.number} failed its own check: {error}"
        raise SheetErrors([SheetError(message, problem.place)]) from error
    except NotDerivable as error:
        if problem.figure is None:
            return None, None
        hint = "give the path of a picture beside the sheet, or leave figure: out"
        raise SheetErrors([SheetError(f"no figure can be drawn: {error}", problem.place, hint)]) from error


def _picture(problem: Problem, given: Path, folder: str) -> str:
    """Where the picture that an author gave stands. Raises SheetErrors where no page could show it."""
    from derive.render.author_pictures import NoPicture, drawn

    try:
        drawn(given)
    except NoPicture as error:
        hint = "give it as PNG, JPEG or SVG"
        raise SheetErrors(
            [SheetError(f"{given.name} is no picture that can be printed: {error}", problem.figure_at, hint)]
        ) from error
    return figure_path(folder, problem.number, given.suffix.lower())


def _asked_by_default(
    page: QuestionPage, problem: Problem, question: Question, answer: Derivation, notation: Notation
) -> QuestionPage:
    """The page of a question that has no text with ours, unless the text of its problem asks it."""
    from derive.render.asking import asks
    from derive.render.latex import Printer
    from derive.render.questions import question_text

    if len(problem.questions) == 1 and asks(problem.text):
        return page
    name, folder = problem.subject_name, words_folder(problem.subject_name, answer.kind)
    printer, printed = Printer(notation, flat=True), list[Printed]()
    text = question_text(folder, question.find, name, problem.subject, question.options, printer, printed)
    return replace(page, text=text, printed=tuple(printed))


def _notation(sheet: Sheet, working: Working, answers: Sequence[Derivation]) -> Notation:
    """That of the sheet, where c_1 is no cosine if the author means something else by it.
    Raises SheetErrors."""
    given = sheet.notation
    style = STYLES.get(given.style or "", Style())
    return Notation(
        given.atan2, given.trig, given.digits, meant=meant_indices(working.taken),
        alike=alike_letters(working.taken),
        letters=letters_of(given, working, answers), angles=given.angles,
        columns=style.columns, angular_first=style.angular_first,
    )  # fmt: skip


def _order(
    answer: Derivation, asked: Sequence[Derivation], printed: list[Derivation], subject: str
) -> Iterator[Worked]:
    """What to print for a question: what it rests on first, nothing that stands on the page already."""
    for used in answer.uses:
        yield from _order(used, asked, printed, subject)
    if not any(answer is done for done in printed):
        printed.append(answer)
        is_asked = any(answer is one for one in asked)
        read = is_asked or any(_reads(one, answer) for one in asked)
        yield Worked(answer, words_folder(subject, answer.kind), is_asked, read)


def _reads(user: Derivation, used: Derivation) -> bool:
    """Whether a derivation, or one that it rests on, needs the results of another."""
    own = any(each is used for each in user.uses) and used.kind not in user.unread
    return own or any(_reads(each, used) for each in user.uses)


def _question(
    sheet: Sheet,
    question: Question,
    answer: Derivation | None,
    order: tuple[Worked, ...],
    working: Working,
) -> QuestionPage:
    claims: tuple[Claim, ...] = ()
    left: tuple[str, ...] = ()
    if answer:
        answer, claims, left = with_numbers(answer, question, working)
    marks = question.marks if sheet.marks else None
    at = question.evaluate or {}
    folder = words_folder(working.name, answer.kind) if answer else ""
    return QuestionPage(
        question.number, question.find, question.text, marks, question.hint, answer, order, at,
        folder=folder, place=question.place, claims=claims, once=left, steps=question.steps or sheet.steps,
    )  # fmt: skip


def _name(sheet: Sheet, solutions: bool) -> str:
    return sheet.path.stem if solutions else f"{sheet.path.stem}-problems"
