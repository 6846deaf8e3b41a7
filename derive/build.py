"""The pipeline at a glance: load -> derive -> verify -> render -> write."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Any

from derive.derivation import Claim, Derivation, Figure, Phrase
from derive.errors import NotDerivable, Place, SheetError, SheetErrors
from derive.kinds.checks import SECOND_ROUTE, far_apart
from derive.kinds.measured import InDecimals
from derive.kinds.problem import Problem as Working
from derive.kinds.problem import parts
from derive.kinds.registry import module_name
from derive.render.document import Document, ProblemPage, QuestionPage, Worked, figure_path
from derive.render.notation import Notation
from derive.sheet.faults import did_you_mean
from derive.sheet.load import load_sheet
from derive.sheet.model import Problem, Question, Sheet
from derive.sheet.source import At
from derive.writing import Progress, render, write

if TYPE_CHECKING:
    from derive.kinds.values_at import Here
    from derive.render.phrases import Speech

BASE = re.compile(r"_d?dot$")  # what a rate has more than its variable
MISSPELT = 0.85  # how like a name another is that was meant: theta2 of thetha2, but not of theta3
ODD = re.compile(r"[^\w.-]+")
NAMESAKES = "rename one, or build them into different folders with --output"
UNPROVED = "nothing proves the answer of '{}': links from line to line hold of a wrong formula too"
PROVE = "its author must claim a law or an independent route: see 'What proves an answer' in CONTRIBUTING.md"
Warn = Callable[[SheetError], None]


def build(
    paths: Sequence[Path],
    formats: Sequence[str],
    output: Path | None,
    problems: bool = False,
    pdf_engine: str = "typst",
    progress: Progress = lambda _: None,
    warn: Warn = lambda _: None,
) -> tuple[Path | str, ...]:
    """Builds every sheet and says what was written; without `output` it gives the pages as texts.

    `warn` is told what is strange about a sheet, though it can be built. Raises SheetErrors, before
    anything is written, with the faults of all the sheets; PagesFailed where some pages were written.
    """
    if faults := _namesakes(paths):
        raise SheetErrors(faults)
    sheets = load_all(paths, progress)
    for warning in (found for sheet in sheets for found in sheet.warnings):
        warn(warning)
    documents = derive_all(sheets, not problems, progress, warn)
    if output is None:
        return tuple(render(document, kind) for document in documents for kind in formats)
    return write(sheets, documents, formats, output, pdf_engine, progress)


def _namesakes(paths: Sequence[Path]) -> list[SheetError]:
    """Sheets whose pages would take each other's place."""
    first: dict[str, Path] = {}
    return [
        SheetError(f"{path}: its pages would have the names of those of {other}", None, NAMESAKES)
        for path in paths
        if (other := first.setdefault(_folder_name(path.stem), path)) != path
    ]


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


def each(items: Sequence[Any], work: Callable[[Any], Any], say: Callable[[Any], None]) -> list[Any]:
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
    folder = _folder_name(_name(sheet, solutions))
    pages = each(
        sheet.problems, lambda problem: _page(sheet, problem, folder, solutions, warn), lambda _: None
    )
    return Document(
        title=sheet.title,
        problems=tuple(pages),
        course=sheet.course,
        author=sheet.author,
        date=sheet.date,
        language=sheet.language,
        notation=_notation(sheet),
        name=_name(sheet, solutions),
        figures=folder,
        solutions=solutions,
    )


def working_on(problem: Problem) -> Working:
    """The problem as its kinds see it, with all that is asked about it."""
    here = tuple((question.find, question.options) for question in problem.questions)
    return Working(problem.subject_name, problem.subject, problem.where, problem.assumptions, questions=here)


def _page(sheet: Sheet, problem: Problem, folder: str, solutions: bool, warn: Warn) -> ProblemPage:
    working = working_on(problem)
    answers = each(problem.questions, lambda question: answered(question, working), lambda _: None)
    strange = list(_strange_names(problem, working, answers))
    if misspelt := [found for found in strange if found.hint]:
        raise SheetErrors(misspelt)
    for needless in strange:
        warn(needless)
    places = max(getattr(part, "rounded", 0) for part in parts(problem.subject))
    if places:
        answers = list(map(InDecimals(), answers))
    asked = [answer for answer in answers if solutions]
    printed: list[Derivation] = []
    questions: list[QuestionPage] = []
    for question, answer in zip(problem.questions, answers, strict=True):
        order = tuple(_order(answer, asked, printed, working.name)) if solutions else ()
        page = _question(sheet, question, answer if solutions else None, order, working)
        text = page.text or _default_text(sheet, problem, question, answer)
        questions.append(replace(page, text=text, rounded=0 if questions else places))
    figure, drawing = _figure(problem, working, folder)
    return ProblemPage(problem.number, tuple(questions), problem.title, problem.text, figure, drawing)


def _strange_names(problem: Problem, working: Working, answers: list[Derivation]) -> Iterator[SheetError]:
    """Values under `evaluate` for what stands nowhere in the problem; with a hint where one of
    the sheet's own names is misspelt."""
    from derive.kinds.point_names import point_names

    if not any(question.evaluate for question in problem.questions):
        return
    names = point_names(working, answers)
    own = sorted(name for name in names if BASE.sub("", name) in working.symbols | working.where.keys())
    for question in problem.questions:
        for name in sorted((question.evaluate or {}).keys() - names):
            place = question.place
            if question.answer_at:
                place = At(question.answer_at.source, question.answer_at.route[:-1]).key(("evaluate", name))
            hint = did_you_mean(name, own) if _misspelt(name, own) else ""
            yield SheetError(f"'{name}' stands nowhere in this problem", place, hint)


def _misspelt(name: str, names: Collection[str]) -> bool:
    """Whether one of the names was meant: q1 of q_1, theta2 of thetha2."""
    plain = name.replace("_", "")
    return any(each.replace("_", "") == plain for each in names) or bool(
        get_close_matches(name, names, n=1, cutoff=MISSPELT)
    )


def _figure(problem: Problem, working: Working, folder: str) -> tuple[str | None, Figure | None]:
    """Where the picture of a problem stands, and what is drawn there if its author left that to us."""
    if isinstance(problem.figure, Path):
        return _picture(problem, problem.figure, folder), None
    if not problem.figure:
        return None, None
    from derive.kinds.figures import figure_of

    try:
        return figure_path(folder, problem.number), figure_of(working)
    except NotDerivable as error:
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


def _default_text(sheet: Sheet, problem: Problem, question: Question, answer: Derivation) -> str:
    """The text of a question that has none, unless the text of its problem asks it."""
    from derive.render.questions import question_text

    if problem.text and len(problem.questions) == 1:
        return ""
    name, folder = problem.subject_name, _folder(answer, problem.subject_name)
    return question_text(folder, question.find, name, problem.subject, question.options, _notation(sheet))


def _notation(sheet: Sheet) -> Notation:
    return Notation(sheet.notation.atan2, sheet.notation.trig, sheet.notation.digits)


def answered(question: Question, working: Working) -> Derivation:
    """The answer to a question, verified. Raises SheetErrors where there is none, or a claim fails."""
    try:
        derivation = working.answer(question.find, question.options)
    except NotDerivable as error:
        place = _place_of(error.about, question, working)
        raise SheetErrors([SheetError(str(error), place)]) from error
    except (OverflowError, ZeroDivisionError) as error:
        message = f"a number of this answer is too large, or divided by zero ({error})"
        raise SheetErrors([SheetError(message, question.place, "check the values of the sheet")]) from error
    except Exception as error:  # an accident of ours: where it was is told with it
        error.add_note(f"{question.place}: ")
        raise
    for rested_on, claim in _claims(derivation):
        if not claim.holds:
            raise SheetErrors([_failure(rested_on, claim, question, working)])
    if not derivation.proved:
        raise SheetErrors([SheetError(UNPROVED.format(derivation.kind), question.place, PROVE)])
    return derivation


def _failure(derivation: Derivation, failed: Claim, question: Question, working: Working) -> SheetError:
    """What is told of a claim that does not hold: an accident of ours, or numbers that floats cannot hold."""
    apart = far_apart((working.subject, *working.where.values())) if failed.by == SECOND_ROUTE else None
    if apart:
        small, large = apart
        message = f"numbers as far apart as {small:.3g} and {large:.3g} cannot be checked in floating point"
        return SheetError(message, question.place, "give them in other units")
    speech = speech_of(derivation, working)
    claim, means = speech.claim(failed), speech.say(Phrase(failed.by))
    message = f"the answer failed its own check: {claim} (by {means})"
    return SheetError(message, question.place, "please report this with the sheet")


def speech_of(derivation: Derivation, working: Working) -> Speech:
    """How a derivation says in plain text what it says in words."""
    from derive.render.phrases import spoken

    return spoken(_folder(derivation, working.name), derivation.kind)


def _place_of(about: str, question: Question, working: Working) -> Place:
    """Where an option of a question stands, or a key of its subject; else the question itself."""
    answer = question.answer_at
    if about and answer is not None:
        asked, problem = At(answer.source, answer.route[:-1]), At(answer.source, answer.route[:2])
        for at in (asked, problem / working.name):
            if at.value((about,)) is not None:
                return at.key((about,))
    return question.place


def _claims(derivation: Derivation) -> Iterator[tuple[Derivation, Claim]]:
    """Those of the answer and of all it rests on, with the derivation that makes each."""
    yield from ((derivation, claim) for claim in derivation.claims)
    for used in derivation.uses:
        yield from _claims(used)


def _order(
    answer: Derivation, asked: Sequence[Derivation], printed: list[Derivation], subject: str
) -> Iterator[Worked]:
    """What to print for a question: what it rests on first, nothing that stands on the page already."""
    for used in answer.uses:
        yield from _order(used, asked, printed, subject)
    if not any(answer is done for done in printed):
        printed.append(answer)
        yield Worked(answer, _folder(answer, subject), any(answer is one for one in asked))


def _folder(answer: Derivation, subject: str) -> str:
    """Where the words of a kind are: the folder of ours, the package of another's."""
    package = module_name(subject, answer.kind).rpartition(".")[0]
    return package.removeprefix("derive.kinds.")


def _question(
    sheet: Sheet,
    question: Question,
    answer: Derivation | None,
    order: tuple[Worked, ...],
    working: Working,
) -> QuestionPage:
    if answer and question.evaluate is not None and not (answer.evaluated or answer.files):
        answer = _evaluated(answer, question, working)
    marks = question.marks if sheet.marks else None
    at = question.evaluate or {}
    folder = _folder(answer, working.name) if answer else ""
    return QuestionPage(
        question.number, question.find, question.text, marks, question.hint, answer, order, at, folder=folder
    )


def _evaluated(answer: Derivation, question: Question, working: Working) -> Derivation:
    """The answer with its results in numbers at the point its author gave. Raises SheetErrors."""
    from derive.kinds.values_at import NOT_REAL, Here, values_at

    given = question.evaluate or {}
    here = Here.of(given, working.where, working.style)
    try:
        return replace(answer, evaluated=values_at(answer, here))
    except KeyError:
        missing = _missing(answer, here)
        message = f"no value is known for {', '.join(missing)}"
        wanted = f"{missing[0]} a value" if len(missing) == 1 else "them values"
        fault = SheetError(message, question.place, f"give {wanted} under evaluate: or where:")
    except NOT_REAL as error:
        fault = SheetError(
            f"the answer has no real value at this point ({error})", question.place, "choose another point"
        )
    raise SheetErrors([fault])


def _missing(answer: Derivation, here: Here) -> list[str]:
    """The names without a value that the results ask for, found by giving each the value 1 in turn."""
    from derive.kinds.values_at import NOT_REAL, values_at

    missing: list[str] = []
    while True:
        try:
            values_at(answer, replace(here, point={**here.point, **dict.fromkeys(missing, 1.0)}))
        except KeyError as error:
            if error.args[0] in missing:
                break
            missing.append(error.args[0])
        except NOT_REAL:
            break
        else:
            break
    return sorted(missing)


def _folder_name(name: str) -> str:
    """The folder of pictures beside a page: a name that links and LaTeX take as it is."""
    return ODD.sub("-", name)


def _name(sheet: Sheet, solutions: bool) -> str:
    return sheet.path.stem if solutions else f"{sheet.path.stem}-problems"
