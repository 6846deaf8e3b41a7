"""Typst's mathematics as Typst itself reads it, written as LaTeX so that it can be read back."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from typing import Any

from typst import Compiler

from tests.render.greek import GREEK

SIGNS = {
    "−": "-", "⋅": r"\cdot", "×": r"\times", "∘": r"\circ", "∂": r"\partial", "∇": r"\nabla", "∗": r"\ast",
    "°": r"^\circ", "≈": r"\approx", "≤": r"\leq", "≥": r"\geq", "≠": r"\neq", "∞": r"\infty",
}  # fmt: skip
ACCENTS = {"\N{COMBINING DOT ABOVE}": r"\dot", "\N{COMBINING DIAERESIS}": r"\ddot"}
FUNCTIONS = ("sin", "cos", "tan", "arcsin", "arccos", "arctan", "ln", "det")
BARS = {"opening": r"\lvert", "closing": r"\rvert"}


def read(formulas: Sequence[str]) -> Iterator[str]:
    """Formulas in Typst as LaTeX, by what Typst takes them for."""
    page = "\n\n".join(f"${formula}$" for formula in formulas)
    compiler = Compiler(page.encode(), ignore_system_fonts=True)
    for equation in json.loads(compiler.query("math.equation")):
        yield latex_of(equation["body"])


def latex_of(node: dict[str, Any]) -> str:
    """What a piece of content shows."""
    match node["func"]:
        case "space" | "h" | "align-point" | "linebreak":
            return ""
        case "sequence":
            return " ".join(filter(None, map(latex_of, node["children"])))
        case "symbol" | "text":
            return letters(node["text"])
        case "styled":
            return latex_of(node["child"])
        case "class":
            return BARS[node["class"]] if node["body"]["text"] == "|" else latex_of(node["body"])
        case "op":
            return letters(node["text"]["text"])
        case "frac":
            return fraction(latex_of(node["num"]), latex_of(node["denom"]))
        case "root":
            return rf"\sqrt{{{latex_of(node['radicand'])}}}"
        case "attach":
            return latex_of(node["base"]) + "".join(
                f"{mark}{{{latex_of(node[side])}}}" for mark, side in (("_", "b"), ("^", "t")) if side in node
            )
        case "accent":
            return f"{ACCENTS[node['accent']]}{{{latex_of(node['base'])}}}"
        case "lr":
            return latex_of(node["body"])
        case "mat":
            assert node["delim"] == ["[", "]"]
            rows = (" & ".join(map(latex_of, row)) for row in node["rows"])
            return r"\begin{bmatrix} " + r" \\ ".join(rows) + r" \end{bmatrix}"
        case other:
            raise ValueError(other)


def letters(text: str) -> str:
    if text in FUNCTIONS:
        return f"\\{text}"
    if len(text) > 1 and not text[0].isdigit():
        return rf"\mathrm{{{text}}}"
    return SIGNS.get(text) or GREEK.get(text, text)


def fraction(top: str, bottom: str) -> str:
    """Of a differential the d stands close to what follows."""
    top, bottom = (part[0] + part[2:] if part.startswith("d ") else part for part in (top, bottom))
    return rf"\frac{{{top}}}{{{bottom}}}"
