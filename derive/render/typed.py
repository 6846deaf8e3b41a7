r"""Mathematics that the words of a kind have as it was typed: what is no result, but a law or a definition.

`templates/laws.txt` lists the formulas among it, and the tests try them in an instance. In a line of the list
`@L` stands for a name that a sheet may change, as the L of a Lagrangian, everywhere for the same.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from functools import cache

from derive.render.formulas import INLINE
from derive.render.lettering import Lettering
from derive.render.notation import Notation
from derive.render.printed import Printed
from derive.render.skin import templates

DISPLAY = re.compile(
    r"\$\$\n(?P<md>.*?)\n\$\$|\\\[\n(?P<tex>.*?)\n\\\]|\\begin\{align\*\}\n(?P<lined>.*?)\n\\end\{align\*\}",
    re.DOTALL,
)
ALIGNED = r"\\begin\{aligned\}\n(.*)\n\\end\{aligned\}"
FRAME = re.compile(rf"\\fitted\{{{ALIGNED}\}}|{ALIGNED}|\\fitted\{{(.*)\}}", re.DOTALL)
BOXED = re.compile(r"\\boxed\{\n?(.*?)\n?\}(?=\}?\Z)", re.DOTALL)
LETTER = re.compile(r"@([A-Za-z])")
NAME = r"\\?[A-Za-z]+(?:\{[A-Za-z]\})?(?:_(?:\w|\{[^{}]*\}))?"


def typed_in(written: str, printed: Collection[Printed], notation: Notation) -> Iterator[Printed]:
    """The formulas in a text, in Markdown or LaTeX, that are not as they were printed from trees or typed."""
    ours = {tuple(map(_aligned, formula.lines)) for formula in printed}
    inline = ((found[1],) for found in INLINE.finditer(DISPLAY.sub("", written)))
    for lines in (*map(_lines, DISPLAY.finditer(written)), *inline):
        if lines not in ours:
            yield Printed(lines, (), notation)


def relettered(written: str, printed: Collection[Printed], letters: Lettering) -> str:
    """The text with the letters of the sheet in the formulas that were typed; the others have them."""
    if not letters:
        return written
    ours = {line for formula in printed if formula.chains for line in map(_aligned, formula.lines)}

    def changed(formula: re.Match[str]) -> str:
        return formula[0] if formula[1] in ours else f"${letters.latex(formula[1])}$"

    found = INLINE.sub(changed, written)
    if found.count("$") != written.count("$"):
        raise ValueError("a text has lost a formula: a dollar is left over")
    return found


def _lines(display: re.Match[str]) -> tuple[str, ...]:
    """The lines of a display, out of what the format sets them in."""
    body = BOXED.sub(r"\1", display[display.lastgroup or 0])
    framed = FRAME.fullmatch(body)
    whole: str = body if framed is None else framed[framed.lastindex or 0]
    return tuple(map(_aligned, whole.split(" \\\\\n")))


def _aligned(line: str) -> str:
    """A line with one gap between equations side by side, which LaTeX has by itself."""
    return line.replace(r"&\qquad ", "& ")


def is_law(latex: str) -> bool:
    """Whether a typed formula is listed."""
    return latex in laws() or any(pattern.fullmatch(latex) for pattern in _patterns())


@cache
def laws() -> frozenset[str]:
    """The lines of the list."""
    lines = (templates() / "laws.txt").read_text(encoding="utf-8").splitlines()
    return frozenset(line for line in lines if line and not line.startswith("#"))


@cache
def _patterns() -> tuple[re.Pattern[str], ...]:
    return tuple(map(_pattern, sorted(law for law in laws() if "@" in law)))


def _pattern(law: str) -> re.Pattern[str]:
    """A law with names in the place of its letters; a letter that comes again is the same name."""
    met: set[str] = set()

    def name(letter: re.Match[str]) -> str:
        again = letter[1] in met
        met.add(letter[1])
        return f"(?P={letter[1]})" if again else f"(?P<{letter[1]}>{NAME})"

    return re.compile(LETTER.sub(name, re.escape(law).replace(r"\@", "@")))
