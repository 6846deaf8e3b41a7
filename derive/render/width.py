"""How wide a piece of LaTeX will print, in em of the text, by the advance widths of Computer Modern.

An estimate within some per cent, made from the LaTeX itself so that it follows the printer.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache

TOKEN = re.compile(r"\\[A-Za-z]+|\\.|[^\s]")
SCRIPT_SCALE = 0.76
INNER_FRACTION_SCALE = 0.72
RELATION = 1.34
BRACKETS = 1.25
COLUMN_GAP = 1.0
ROOT = 0.85

COMMANDS = {
    r"\cos": 1.66, r"\sin": 1.56, r"\tan": 1.7, r"\arccos": 2.7, r"\arcsin": 2.6, r"\arctan": 2.75,
    r"\ln": 1.0, r"\det": 1.5, r"\times": 1.22, r"\cdot": 0.72, r"\approx": RELATION, r"\quad": 1.0,
    r"\qquad": 2.0, r"\left": 0.2, r"\right": 0.2, r"\lvert": 0.28, r"\rvert": 0.28, r"\circ": 0.5,
    r"\Rightarrow": 1.6, r"\infty": 1.0, r"\omega": 0.62, r"\pm": 1.22, r"\,": 0.17,
}  # fmt: skip
CHARACTERS = {
    **dict.fromkeys("()[]", 0.39), **dict.fromkeys("+-", 1.22), **dict.fromkeys("=<>", RELATION),
    **dict.fromkeys(",.;:", 0.38), "m": 0.88, "w": 0.72, "i": 0.35, "j": 0.41, "l": 0.3, "t": 0.36, "r": 0.45,
    "f": 0.49, "I": 0.44, "J": 0.55, "M": 0.97, "W": 0.94, "/": 0.5,
}  # fmt: skip
SIMPLE_GROUPS = {r"\mathrm": 0.53, r"\operatorname": 0.55, r"\text": 0.5}


@lru_cache(maxsize=4096)  # what stands on a page is measured for its room, its entries and its line
def width(latex: str) -> float:
    """The printed width in em."""
    return _Reader(TOKEN.findall(latex)).sequence()


def _single(token: str) -> float:
    if token.startswith("\\"):
        return COMMANDS.get(token, 0.57)
    return CHARACTERS.get(token, 0.72 if token.isupper() else 0.5)


@dataclass(slots=True)
class _Reader:
    """Reads tokens from the left; `depth` counts the matrices and fractions around."""

    tokens: list[str]
    at: int = 0
    depth: int = 0

    def take(self) -> str:
        self.at += 1
        return self.tokens[self.at - 1]

    def sequence(self, ends: tuple[str, ...] = ()) -> float:
        """The width up to one of `ends`, which is left to be read, or to the end."""
        total, start = 0.0, True
        while self.at < len(self.tokens) and self.tokens[self.at] not in ends:
            token = self.take()
            if token in "^_":
                total += self.scripts(token)
            elif token in "+-" and start:
                total += 0.78
            else:
                total += self.atom(token)
            start = token in "(=,&" or token == r"\approx"
        return total

    def atom(self, token: str) -> float:
        if token == "{":
            return self._rest_of_group()
        if token == r"\frac":
            return self._fraction()
        if token == r"\sqrt":
            return self.group() + ROOT
        if token == r"\begin":
            return self._matrix()
        if token in SIMPLE_GROUPS:
            return self._letters() * SIMPLE_GROUPS[token]
        return self.group() if token in (r"\dot", r"\ddot") else _single(token)

    def group(self) -> float:
        """The width of what a command or a script takes: a braced group or one token."""
        return self.atom(self.take())

    def _rest_of_group(self) -> float:
        total = self.sequence(("}",))
        self.take()
        return total

    def scripts(self, mark: str) -> float:
        """A subscript and a superscript of the same base stand above each other."""
        first = self.group()
        if self.at < len(self.tokens) and self.tokens[self.at] in "^_" and self.tokens[self.at] != mark:
            self.take()
            first = max(first, self.group())
        return first * SCRIPT_SCALE + 0.05

    def _fraction(self) -> float:
        scale = INNER_FRACTION_SCALE if self.depth else 1.0
        self.depth += 1
        wider = max(self.group(), self.group())
        self.depth -= 1
        return wider * scale + 0.24

    def _letters(self) -> int:
        start = self.at
        if self.tokens[start] != "{":
            self.take()
            return 1
        self._rest_of_group_tokens()
        return sum(len(token) for token in self.tokens[start + 1 : self.at - 1])

    def _rest_of_group_tokens(self) -> None:
        while self.take() != "}":
            pass

    def _matrix(self) -> float:
        """A matrix: its columns as wide as their widest entries."""
        self._rest_of_group_tokens()
        columns: list[float] = []
        column = 0
        self.depth += 1
        while True:
            entry = self.sequence(("&", r"\\", r"\end"))
            columns += [0.0] * (column + 1 - len(columns))
            columns[column] = max(columns[column], entry)
            separator = self.take()
            if separator == r"\end":
                break
            column = column + 1 if separator == "&" else 0
        self.depth -= 1
        self._rest_of_group_tokens()
        return sum(columns) + COLUMN_GAP * (len(columns) - 1) + BRACKETS
