"""The figure of a problem on its page: the picture, its number, what stands under it, what is seen."""

from __future__ import annotations

from derive.derivation import Phrase
from derive.render.document import FIGURE, Document, ProblemPage
from derive.render.latex import Printer
from derive.render.phrases import on_page, spoken
from derive.render.printed import Printed
from derive.render.skin import Skin
from derive.render.so_far import SoFar

AGAIN = "again"  # what is said where an earlier figure shows the subject


def subject_figure(
    document: Document, problem: ProblemPage, skin: Skin, so_far: SoFar, printed: list[Printed]
) -> str:
    """The picture that stands with the text of a problem, which earlier figure shows the same, or nothing.
    Its mathematics is added to `printed`."""
    if problem.shown_in is not None:
        number = so_far.figure(_stem(document.problems[problem.shown_in - 1].figure or ""))
        return skin.plain(spoken(problem.drawn_as, FIGURE).say(Phrase(AGAIN, {"number": number})))
    if not problem.figure:
        return ""
    number = so_far.figure(_stem(problem.figure))
    caption, alt = "", skin.caption(number, "")
    if problem.drawing and problem.drawing.caption:
        speech = on_page(
            problem.drawn_as, FIGURE, Printer(problem.notation), skin.plain, printed,
            strong=skin.strong, em=skin.em,
        )  # fmt: skip
        caption = speech.say(problem.drawing.caption)
        alt = spoken(problem.drawn_as, FIGURE).seen_in(problem.drawing)
    return skin.figure(problem.figure, skin.caption(number, caption), alt)


def _stem(path: str) -> str:
    """The path without its suffix."""
    return path.rpartition(".")[0]
