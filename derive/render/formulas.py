"""Formulas in the notation of a format: until its page is put together they stand in texts as `$latex$`."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Protocol

from derive.render.layout import Display
from derive.render.printed import Printed

DISPLAYED = re.compile(r"\$\$([^$]+)\$\$")
INLINE = re.compile(r"(?<![\\$])\$([^$\n]+)\$(?!\$)")


class Formulas(Protocol):
    """How a format that is not written in TeX spells formulas: they were decided, laid out and read back in
    LaTeX. Each comes with the trees it was printed from, or with none where it was typed."""

    def inline(self, formula: Display) -> str:
        """One in a line of text."""
        ...

    def display(self, formula: Display) -> str:
        """One on lines of its own."""
        ...


def spelt(text: str, formulas: Formulas | None, printed: Iterable[Printed]) -> str:
    """A text whose formulas are in the notation of its format; what was `printed` in it knows its trees."""
    if formulas is None:
        return text
    known = {each.lines[0]: each for each in printed if len(each.lines) == 1}

    def inline(found: re.Match[str]) -> str:
        formula = known.get(found[1])
        if formula is None:
            return formulas.inline(Display((found[1],)))
        return formulas.inline(Display(formula.lines, False, formula.chains, formula.notation))

    displayed = DISPLAYED.sub(lambda found: formulas.display(Display((found[1].strip(),))), text)
    return INLINE.sub(inline, displayed)
