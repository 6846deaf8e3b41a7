r"""Mathematics that the words of a kind have as it was typed: what is no result, but a law or a definition.

`templates/laws.txt` lists the formulas among it, and the tests try them in an instance. In a line of the list
`@L` stands for a name that a sheet may change, as the L of a Lagrangian, everywhere for the same.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from functools import cache

from derive.render.notation import Notation
from derive.render.printed import Printed
from derive.render.skin import templates

INLINE = re.compile(r"(?<![\\$])\$([^$\n]+)\$(?!\$)")
DISPLAY = re.compile(r"\$\$.*?\$\$", re.DOTALL)
LETTER = re.compile(r"@([A-Za-z])")
NAME = r"\\?[A-Za-z]+(?:\{[A-Za-z]\})?(?:_(?:\w|\{[^{}]*\}))?"


def typed_in(written: str, printed: Collection[Printed], notation: Notation) -> Iterator[Printed]:
    """The formulas in a text that were not printed from trees."""
    ours = {line for formula in printed for line in formula.lines}
    for found in INLINE.finditer(DISPLAY.sub("", written)):
        if found[1] not in ours:
            yield Printed((found[1],), (), notation)


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
