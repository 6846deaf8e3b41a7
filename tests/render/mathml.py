"""Presentation MathML as a browser shows it, written as LaTeX so that it can be read back."""

from __future__ import annotations

from xml.etree.ElementTree import Element

from tests.render.greek import GREEK
from tests.render.typst import fraction

SIGNS = {
    "\N{MINUS SIGN}": "-", "\N{DOT OPERATOR}": r"\cdot", "\N{MULTIPLICATION SIGN}": r"\times",
    "\N{RING OPERATOR}": r"\circ", "\N{PARTIAL DIFFERENTIAL}": r"\partial", "\N{NABLA}": r"\nabla",
    "\N{ASTERISK OPERATOR}": r"\ast", "*": r"\ast", "\N{FUNCTION APPLICATION}": "", "\N{INVISIBLE TIMES}": "",
    "\N{DEGREE SIGN}": r"^\circ", "\N{ALMOST EQUAL TO}": r"\approx", "\N{INFINITY}": r"\infty",
}  # fmt: skip
BARS = ("|", "\N{VERTICAL LINE}")
ACCENTS = {
    "\N{DOT ABOVE}": r"\dot", "\N{DIAERESIS}": r"\ddot", "\N{COMBINING DOT ABOVE}": r"\dot",
    "\N{COMBINING DIAERESIS}": r"\ddot",
}  # fmt: skip
FUNCTIONS = ("sin", "cos", "tan", "arcsin", "arccos", "arctan", "ln", "det")


def latex_of(element: Element) -> str:
    """What an element shows."""
    inside = [*element]
    match element.tag.rpartition("}")[2]:
        case "math" | "semantics":
            return latex_of(inside[0])
        case "mrow" | "mstyle":
            return row(inside)
        case "mi":
            return name(element)
        case "mn":
            return element.text or ""
        case "mo":
            return sign(element)
        case "mspace" | "annotation":
            return ""
        case "mfrac":
            return fraction(*map(latex_of, inside))
        case "msqrt":
            return rf"\sqrt{{{row(inside)}}}"
        case "msub" | "munder":
            return f"{latex_of(inside[0])}_{{{latex_of(inside[1])}}}"
        case "msup":
            return f"{latex_of(inside[0])}^{{{latex_of(inside[1])}}}"
        case "msubsup":
            base, below, above = map(latex_of, inside)
            return f"{base}_{{{below}}}^{{{above}}}"
        case "mover":
            return f"{ACCENTS[inside[1].text or '']}{{{latex_of(inside[0])}}}"
        case "mtable":
            rows = (" & ".join(map(row, (list(cell) for cell in line))) for line in inside)
            return r"\begin{bmatrix} " + r" \\ ".join(rows) + r" \end{bmatrix}"
        case other:
            raise ValueError(other)


def row(parts: list[Element]) -> str:
    """Parts side by side; the brackets of a matrix are its own."""
    written = [*map(latex_of, parts)]
    for k, part in enumerate(parts):
        if part.tag.endswith("mtable"):
            assert (written[k - 1], written[k + 1]) == ("[", "]")
            written[k - 1], written[k + 1] = "", ""
    return " ".join(filter(None, written))


def name(element: Element) -> str:
    """A letter, a Greek one, the name of a function, or an upright word."""
    text = element.text or ""
    if text in SIGNS:
        return SIGNS[text]
    if text in FUNCTIONS:
        return f"\\{text}"
    if len(text) > 1 or (element.get("mathvariant") == "normal" and text.isascii()):
        return rf"\mathrm{{{text}}}"
    return GREEK.get(text, text)


def sign(element: Element) -> str:
    """A sign; a bar says on which side it stands."""
    text = element.text or ""
    if text in BARS:
        return r"\lvert" if element.get("form") == "prefix" else r"\rvert"
    return SIGNS.get(text, GREEK.get(text, text))
