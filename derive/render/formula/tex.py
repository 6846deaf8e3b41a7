r"""Reads LaTeX into boxes: what our printer writes, and all that an author's text may hold.

The commands are those of `derive/sheet/tex.py`; anything else is `Unreadable`, so that no format prints
something else than it was given.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from derive.render.formula.boxes import (
    Accent,
    Box,
    Digits,
    Fenced,
    Fraction,
    Gap,
    Grid,
    Kind,
    Letter,
    Root,
    Row,
    Scripts,
    Sign,
    Stacked,
    Styled,
    Word,
)
from derive.render.formula.signs import CHARACTERS, COMMANDS, GAPS, GREEK
from derive.render.formula.vocabulary import (
    ACCENTS,
    ALIGNED,
    FENCES,
    OPERATORS,
    SIZES,
    STYLES,
    SWITCHES,
    TEXTS,
)

TOKEN = re.compile(
    r"\\(?:text|textrm|textbf|textit)\s*\{[^{}\\$]*\}|\\(?:mathrm|operatorname)\s*\{[A-Za-z0-9\s/]*\}"
    r"|\\(?:begin|end)\s*\{[A-Za-z*]+\}"
    r"|\\\\(?:\[[^\]]*\])?|\\[A-Za-z]+|\\.|\S",
    re.DOTALL,
)
OPEN_BEFORE: frozenset[Kind] = frozenset(("binary", "prefix", "relation", "opening", "punctuation"))


class Unreadable(ValueError):
    """TeX that is none of ours and of none that an author may write."""


@lru_cache(4096)
def boxes(latex: str) -> Box:
    """The boxes of a formula. Raises Unreadable."""
    reader = _Reader(TOKEN.findall(latex))
    read = reader.row(())
    if reader.peek():
        raise Unreadable(f"{reader.peek()} is out of its place in {latex}")
    return read


def boxes_of_lines(lines: Sequence[str]) -> Box:
    """The boxes of a display: its lines, which meet where they have a mark. Raises Unreadable."""
    if len(lines) == 1 and "&" not in lines[0].split(r"\begin")[0]:
        return boxes(lines[0])
    whole = " \\\\ ".join(lines)
    return boxes(rf"\begin{{aligned}} {whole} \end{{aligned}}")


@dataclass(slots=True)
class _Reader:
    """Reads tokens from the left."""

    tokens: list[str]
    at: int = 0

    def peek(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self) -> str:
        if self.at == len(self.tokens):
            raise Unreadable("something is missing at the end")
        self.at += 1
        return self.tokens[self.at - 1]

    def expect(self, token: str) -> None:
        if self.take() != token:
            raise Unreadable(f"{token} is missing")

    def row(self, ends: tuple[str, ...], continued: bool = False) -> Box:
        """Everything up to one of `ends`, which is left to be read. A row that is `continued` goes on from
        what stands in the line above."""
        found: list[Box] = []
        while (token := self.peek()) and not token.startswith(ends or "\n") and token != "&":
            if token in SWITCHES:
                self.take()
                found.append(Styled(SWITCHES[token], self.row(ends)))
                break
            found.append(self.scripted(self.signed(found, continued)))
        return found[0] if len(found) == 1 else Row(tuple(found))

    def signed(self, before: list[Box], continued: bool) -> Box:
        """The next box; a plus or a minus stands between terms, or in front of one."""
        if self.peek() in ("_", "^", "'"):
            return Row(())  # a script of what stands before the formula
        if self.peek() not in ("+", "-"):
            return self.atom()
        last = next((box for box in reversed(before) if not isinstance(box, Gap)), None)
        if isinstance(last, Sign):
            between = last.kind not in OPEN_BEFORE
        else:
            between = continued if last is None else not (isinstance(last, Word) and last.operator)
        return Sign("+" if self.take() == "+" else "−", "binary" if between else "prefix")

    def scripted(self, base: Box) -> Box:
        """A box with its scripts and primes."""
        below: Box | None = None
        above: list[Box] = []
        while (mark := self.peek()) in ("_", "^", "'", r"\limits") and mark:
            self.take()
            if mark == "_" and below is None:
                below = self.argument()
            elif mark == "^":
                above.append(self.argument())
            elif mark == "'":
                above.append(Sign("′"))
            elif mark == "_":
                raise Unreadable("two subscripts")
        if below is None and not above:
            return base
        return Scripts(base, below, None if not above else above[0] if len(above) == 1 else Row(tuple(above)))

    def argument(self) -> Box:
        """What a command or a script takes: a braced group or one character."""
        token = self.peek()
        return Digits(self.take()) if token.isdecimal() else self.atom()

    def atom(self) -> Box:
        token = self.take()
        name = token[1:]
        if token == "{":
            inside = self.row(("}",))
            self.expect("}")
            return inside
        if token in CHARACTERS and token != ".":
            return CHARACTERS[token]
        if token.isdecimal() or token == ".":
            return self.number(token)
        if token in ("+", "-"):
            return Sign("+" if token == "+" else "−", "prefix")
        if len(token) == 1 and token.isalpha():
            return Letter(token)
        if name in GREEK:
            return Letter(GREEK[name])
        if token in GAPS:
            return Gap(GAPS[token])
        if token in COMMANDS:
            return COMMANDS[token]
        if not name.isalpha() and not token.startswith((r"\begin", r"\end")) and len(token) <= 2:
            return Sign(token[-1])
        return self.command(token)

    def number(self, digit: str) -> Box:
        text = digit
        while self.peek().isdecimal() or (self.peek() == "." and self._goes_on()):
            text += self.take()
        return CHARACTERS["."] if text == "." else Digits(text)

    def _goes_on(self) -> bool:
        after = self.tokens[self.at + 1 : self.at + 2]
        return bool(after) and after[0].isdecimal()

    def command(self, token: str) -> Box:
        name = re.split(r"[\s{]", token[1:], maxsplit=1)[0]
        if token.endswith("}") and name in TEXTS:
            return self.text(name, token[token.index("{") + 1 : -1])
        if name in OPERATORS:
            return Word(name, operator=True)
        if name == "limits" or token in SWITCHES:  # with nothing that it could be said of
            return Row(())
        if name in TEXTS:
            return Styled(TEXTS[name] or "upright", self.argument())
        if name in ACCENTS:
            return Accent(name, self.argument())
        if name in STYLES:
            return Styled(STYLES[name], self.argument())
        if name in SIZES:
            return self.atom()
        match name:
            case "frac" | "dfrac" | "tfrac" | "binom":
                return self.fraction(name)
            case "sqrt":
                return self.root()
            case "left":
                return self.fenced()
            case "begin":
                return self.grid(token[token.index("{") + 1 : -1])
            case "overset" | "stackrel":
                over = self.argument()
                return Stacked(self.argument(), over=over)
            case "underset":
                under = self.argument()
                return Stacked(self.argument(), under=under)
        raise Unreadable(f"{token} is no command that is known here")

    def text(self, name: str, inside: str) -> Box:
        shown = inside if name.startswith("text") else "".join(inside.split())
        word = Word(" ".join(re.split(r"[\s~]+", shown)), operator=name == "operatorname")
        return Styled(TEXTS[name], word) if TEXTS[name] else word

    def fraction(self, name: str) -> Box:
        above, below = self.argument(), self.argument()
        if name == "binom":
            return Fenced("(", Fraction(above, below, bar=False), ")")
        return Fraction(above, below, "display" if name == "dfrac" else "text" if name == "tfrac" else "")

    def root(self) -> Box:
        degree: Box | None = None
        if self.peek() == "[":
            self.take()
            degree = self.row(("]",))
            self.expect("]")
        return Root(self.argument(), degree)

    def fenced(self) -> Box:
        opening = self.fence()
        inside = self.row((r"\right",))
        self.expect(r"\right")
        return Fenced(opening, inside, self.fence())

    def fence(self) -> str:
        token = self.take()
        if token == ".":
            return ""
        sign = COMMANDS.get(token) or CHARACTERS.get(token)
        if sign is None:
            raise Unreadable(f"{token} is no fence")
        return {"<": "⟨", ">": "⟩"}.get(sign.char, sign.char)

    def grid(self, name: str) -> Box:
        name = name.rstrip("*")
        if name not in FENCES and name not in ALIGNED:
            raise Unreadable(f"{name} is no environment that is known here")
        if name == "array":
            self.expect("{")
            while self.take() != "}":
                pass
        aligned = name in ALIGNED
        rows: list[list[Box]] = [[]]
        loose = False
        while True:
            # TeX begins every second cell of an equation as if something stood before it.
            rows[-1].append(self.row(("\\\\", r"\end"), aligned and len(rows[-1]) % 2 == 1))
            mark = self.take()
            if mark.startswith(r"\end"):
                break
            if mark != "&":
                loose = loose or "[" in mark
                rows.append([])
        if len(rows) > 1 and rows[-1] == [Row(())]:
            rows.pop()
        opening, closing = FENCES.get(name, ("", ""))
        return Grid(tuple(map(tuple, rows)), opening, closing, aligned, loose)
