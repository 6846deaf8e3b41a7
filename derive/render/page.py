"""A document as one page of a format: words in the order of the questions, in the format's furniture."""

from __future__ import annotations

import re

from derive.errors import met_at
from derive.render import html_skin
from derive.render.author_text import latex_prose, markdown_prose
from derive.render.conventions import conventions
from derive.render.coordinates import Spoken, coordinates
from derive.render.document import Document, ProblemPage, QuestionPage, Worked, file_path, plot_path
from derive.render.evaluated import evaluated_words
from derive.render.foot import Proved
from derive.render.formulas import spelt
from derive.render.given import given_words
from derive.render.html_skin import HTML
from derive.render.markdown_math import left_alone, rows_apart
from derive.render.plain_text import latex_text, markdown_text
from derive.render.printed import Printed, Reader, Said, unread
from derive.render.skin import HELD_LINE, Skin, english, environment, require_texts, words_file
from derive.render.so_far import SoFar
from derive.render.subject_figure import subject_figure
from derive.render.typst_skin import TYPST, laid_out
from derive.render.untold import Untold
from derive.render.words import words

MARKDOWN = Skin("markdown", markdown_prose, markdown_text)
LATEX = Skin("latex", latex_prose, latex_text)
BLANK_LINES = re.compile(r"\n[ \t]*\n\s*\n")
HYPHEN = re.compile(r"\$-(?=(?:ax[ei]s|planes?|directions?|components?|coordinates?)\b)")  # of the $x$-axis
BEFORE_DISPLAY = re.compile(r"\n\n+(?=\\\[|\\begin\{align\*\})")

MATRIX = re.compile(r"\\begin\{bmatrix\} .*? \\end\{bmatrix\}")


def render_markdown(document: Document, read: Reader = unread) -> str:
    """The sheet as Markdown for GitHub and pandoc; its mathematics is given to `read`. Raises ForgottenStep,
    and what `read` raises."""
    return _tidy(left_alone(_page(document, MARKDOWN, True, read)))


def render_for_pandoc(document: Document, read: Reader = unread) -> str:
    """The same without its title block, the formulas as they were printed, hyphens behind them unbroken."""
    return _tidy(HYPHEN.sub("$\u2011", _page(document, MARKDOWN, False, read)))


def render_latex(document: Document, read: Reader = unread) -> str:
    """The sheet as a LaTeX document that pdflatex compiles; its mathematics is given to `read`. Raises
    ForgottenStep, and what `read` raises."""
    page = MATRIX.sub(lambda found: rows_apart(found[0]), _page(document, LATEX, True, read))
    page = HYPHEN.sub(r"$\\nobreakdash-", page)
    return _tidy(BEFORE_DISPLAY.sub("\n", BLANK_LINES.sub("\n\n", page)))


def render_typst(document: Document, read: Reader = unread) -> str:
    """The sheet as a Typst document, which reads its title and the like from `sys.inputs`; its mathematics is
    given to `read`. Raises ForgottenStep, and what `read` raises."""
    return laid_out(_tidy(_page(document, TYPST, True, read)))


def render_html(document: Document, read: Reader = unread) -> str:
    """The body of the sheet as HTML; its mathematics is given to `read`. Raises ForgottenStep, and what
    `read` raises."""
    return html_skin.laid_out(_tidy(_page(document, HTML, True, read)))


def _page(document: Document, skin: Skin, front: bool, read: Reader) -> str:
    environment().begin()
    answers: dict[tuple[int, int], str] = {}
    given: dict[tuple[int, int], str] = {}
    figures: dict[int, str] = {}
    said: list[Said] = []
    so_far = SoFar()
    spoken = Spoken()
    for problem in document.problems:
        told: list[Printed] = []
        given[problem.number, 0] = given_words(problem.given, problem.subject, skin, problem.notation, told)
        said.append(Said(f"{problem.number}", problem.place, tuple(told)))
    for problem, question in document.questions():
        printed = [*question.printed]
        asked = given_words(question.given, problem.subject, skin, problem.notation, printed)
        given[problem.number, question.number] = asked
        if problem.number not in figures:
            figures[problem.number] = subject_figure(document, problem, skin, so_far, printed)
        so_far.problem = problem.number
        with met_at(question.place):
            answer = _answer(document, problem, question, skin, printed, so_far)
        if answer:
            spoken = spoken.and_by(problem, printed)
        answers[problem.number, question.number] = answer
        said.append(Said(f"{problem.number}.{question.number}", question.place, tuple(printed)))
    taken: list[Printed] = []
    bare = frozenset(unit for problem in document.problems for unit in problem.bare)
    agreed = " ".join(filter(None, (conventions(said, taken, bare), coordinates(spoken, taken))))
    known = spelt(agreed, skin.formulas, taken) if document.solutions else ""
    said.append(Said("conventions", None, tuple(taken)))
    look = f"{skin.name}/page.j2"
    alone = sum(1 for _ in document.alone())
    verified = Proved.of(document.verified(), read(said), alone).said() if document.solutions else ""
    boxed = known and skin.boxed(english("conventions"), known)
    page = (
        environment()
        .get_template(look)
        .render(
            document=document,
            answers=answers,
            figures=figures,
            given=given,
            skin=skin,
            front=front,
            conventions=boxed,
            verified=verified,
        )
    )
    if look in environment().own:
        require_texts(page, [boxed, *given.values(), *answers.values()], look)
    whole = spelt(page, skin.formulas, [formula for part in said for formula in part.printed])
    return so_far.settled(whole, skin.numbered)


def _answer(
    document: Document, problem: ProblemPage, question: QuestionPage, skin: Skin, printed: list[Printed],
    so_far: SoFar,
) -> str:  # fmt: skip
    told: list[str] = []
    for worked in question.order:
        kept = question.steps == "full" or _is_asked(worked, question)
        its: list[Printed] = printed if kept else []  # what is left out is counted all the same
        with so_far.telling(worked.derivation):
            written = _told(document, problem, question, worked, skin, its, so_far)
        told += [written] if kept else []
    if not told and document.solutions:
        told.append(_above(problem, question, skin, so_far))
    if question.rounded and document.solutions:
        told.insert(0, environment().get_template("words/_rounded.j2").render(places=question.rounded))
    if question.derivation and document.solutions:
        told.append(
            evaluated_words(
                question.derivation,
                question.folder,
                question.at,
                skin,
                problem.notation,
                printed,
                question.gives_pose,
            )
        )
    return spelt("\n\n".join(filter(None, told)), skin.formulas, printed)


def _is_asked(worked: Worked, question: QuestionPage) -> bool:
    return question.derivation is not None and worked.derivation.results is question.derivation.results


def _above(problem: ProblemPage, question: QuestionPage, skin: Skin, so_far: SoFar) -> str:
    """Where the answer stands, if an earlier question needed it already."""
    if question.derivation is None:
        return ""
    results = question.derivation.results
    for earlier in problem.questions:
        if any(worked.derivation.results is results for worked in earlier.order):
            return skin.above(earlier.number, so_far.answer_of(question.derivation))
    return ""


def _told(
    document: Document, problem: ProblemPage, question: QuestionPage, worked: Worked, skin: Skin,
    printed: list[Printed], so_far: SoFar,
) -> str:  # fmt: skip
    plots = {
        plot.name: plot_path(document.figures, problem.number, question.number, plot.name)
        for plot in worked.derivation.plots
    }
    files = {
        name: file_path(document.figures, problem.number, question.number, name)
        for name in worked.derivation.files
    }
    try:
        return words(
            worked.derivation, worked.folder, skin, problem.notation, worked.asked, plots, files, printed,
            so_far, question.steps, worked.read,
        )  # fmt: skip
    except Untold as untold:
        untold.template = untold.template or words_file(worked.folder, worked.derivation.kind)
        raise


def _tidy(page: str) -> str:
    return BLANK_LINES.sub("\n\n", page).strip().replace(HELD_LINE, "\n") + "\n"
