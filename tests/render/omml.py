"""The equations of a docx as Word shows them, written as LaTeX so that they can be read back."""

from __future__ import annotations

from xml.etree.ElementTree import Element, fromstring

from tests.render.greek import GREEK
from tests.render.mathml import ACCENTS, FUNCTIONS, SIGNS
from tests.render.typst import fraction

MATH = "http://schemas.openxmlformats.org/officeDocument/2006/math"
OPENING = {"|": r"\lvert", "(": "(", "[": "[", "{": r"\lbrace"}
CLOSING = {"|": r"\rvert", ")": ")", "]": "]", "}": r"\rbrace"}
LONE = tuple("+-=<>−⋅×≈≤≥∘∗")  # which LibreOffice takes for signs that want something on either side


def element(written: str) -> Element:
    return fromstring(f'<m:oMath xmlns:m="{MATH}">{written}</m:oMath>')


def latex_of(node: Element) -> str:
    """What an element shows."""
    name = tag(node)
    if name in ("r", "t"):
        return run(node)
    if name.endswith("Pr"):
        return ""
    parts = {tag(part): part for part in node}
    match name:
        case "f":
            return fraction(latex_of(parts["num"]), latex_of(parts["den"]))
        case "rad":
            return rf"\sqrt{{{latex_of(parts['e'])}}}"
        case "sSub" | "sSup" | "sSubSup":
            marks = (("_", "sub"), ("^", "sup"))
            scripts = (f"{mark}{{{latex_of(parts[key])}}}" for mark, key in marks if key in parts)
            return latex_of(parts["e"]) + "".join(scripts)
        case "acc":
            return f"{ACCENTS[value(parts['accPr'], 'chr')]}{{{latex_of(parts['e'])}}}"
        case "d":
            return fenced(value(parts["dPr"], "begChr"), parts["e"], value(parts["dPr"], "endChr"))
        case _:
            return " ".join(filter(None, map(latex_of, node)))


def fenced(opening: str, inside: Element, closing: str) -> str:
    tables = [part for part in inside if tag(part) == "m"]
    if opening == "[" and tables:
        rows = ([latex_of(cell) for cell in row] for row in tables[0] if tag(row) == "mr")
        return r"\begin{bmatrix} " + r" \\ ".join(map(" & ".join, rows)) + r" \end{bmatrix}"
    return f"{OPENING[opening]} {latex_of(inside)} {CLOSING[closing]}"


def run(node: Element) -> str:
    text = "".join(part.text or "" for part in node.iter(f"{{{MATH}}}t")).strip()
    if text in FUNCTIONS:
        return f"\\{text}"
    if len(text) > 1 and text[0].isalpha():
        return rf"\mathrm{{{text}}}"
    return SIGNS.get(text, GREEK.get(text, text))


def torn(node: Element) -> list[str]:
    """Signs that begin or end what stands together, and parentheses by themselves, in a run that LibreOffice
    takes for a formula of its own language: it shows a question mark for what is missing there."""
    found = []
    for group in node.iter():
        runs = [part for part in group if not tag(part).endswith("Pr")]
        for k, part in enumerate(runs):
            text = "" if tag(part) != "r" or plain(part) else "".join(part.itertext())
            if text in tuple("()[]{}|") or (text in LONE[2:] and text != "−" and k in (0, len(runs) - 1)):
                found.append(text)
    return found


def plain(node: Element) -> bool:
    return any(tag(part) == "nor" for part in node.iter())


def value(node: Element, name: str) -> str:
    return next(part.get(f"{{{MATH}}}val") or "" for part in node if tag(part) == name)


def tag(node: Element) -> str:
    return node.tag.rpartition("}")[2]
