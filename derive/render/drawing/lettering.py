"""What is written in a picture: captions as Typst content, and the room that their ink takes."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from dataclasses import dataclass

from derive.derivation import Caption, Phrase, Words
from derive.expression import Expr, Number
from derive.render.drawing.paper import FONTS
from derive.render.drawing.style import LETTERS
from derive.render.formula.tex import boxes
from derive.render.formula.typst import typst
from derive.render.latex import Printer
from derive.render.names import name_latex
from derive.render.notation import Notation

_measured: dict[tuple[str, float], tuple[float, float]] = {}  # what was measured before, of any picture


@dataclass(frozen=True, slots=True)
class Written:
    """Typst content of a size, and how wide and high its ink is, in points."""

    content: str
    size: float
    wide: float
    high: float


def written(captions: Iterable[tuple[Caption, float]]) -> list[Written]:
    """Captions with their sizes, measured by Typst: one question for all."""
    asked = [(content(caption), size) for caption, size in captions]
    _measure(one for one in dict.fromkeys(asked) if one not in _measured)
    return [Written(*one, *_measured[one]) for one in asked]


def content(caption: Caption) -> str:
    """A caption as Typst content: mathematics, or words with mathematics in them."""
    match caption.text:
        case Words(text):
            return f"[{_prose(text)}]"
        case str():
            return f"${_formula(name_latex(caption.text))}$"
        case Phrase():
            raise TypeError(f"'{caption.text.key}' is still to be said in words")
        case tuple():
            names = ", ".join(_formula(name_latex(name)) for name in caption.text)
            return f"$({names})$" if caption.role == "place" else f"${names}$"
        case _:
            return f"${_tree(caption.text, caption.role == 'block')}$"


def _tree(tree: Expr, displayed: bool) -> str:
    whole = _formula(Printer(Notation()).write(tree))
    unit = f' thin upright("{tree.unit}")' if isinstance(tree, Number) and tree.unit else ""
    return f"display({whole}{unit})" if displayed else whole + unit


def _prose(text: str) -> str:
    """Plain words, with mathematics between dollars."""
    pieces = text.split("$")
    return "".join(
        f"${_formula(p)}$" if k % 2 else re.sub(r"([#$*_@<>`\[\]\\])", r"\\\1", p)
        for k, p in enumerate(pieces)
    )


def _formula(latex: str) -> str:
    """Our LaTeX of names and formulas as Typst mathematics."""
    return typst(boxes(latex))


def _measure(asked: Iterable[tuple[str, float]]) -> None:
    """Asks Typst how large contents are, and keeps it."""
    new = list(asked)
    if not new:
        return
    from typst import Compiler

    items = "".join(f"text(size: {size}pt, {what}), " for what, size in new)
    sizes = "items.map(it => { let m = measure(it); (m.width.pt(), m.height.pt()) })"
    source = f"{FONTS}#let items = ({items})\n#context [#metadata({sizes}) <sizes>]\n"
    compiler = Compiler(source.encode(), ignore_system_fonts=True)
    found = json.loads(compiler.query("<sizes>", field="value", one=True))
    for one, (wide, high) in zip(new, found, strict=True):
        _measured[one] = (wide, high)


def size_of(caption: Caption) -> float:
    """The size of its letters (points)."""
    return LETTERS - {"note": 1.0, "tick": 1.0, "sign": 2.5}.get(caption.role, 0.0)
