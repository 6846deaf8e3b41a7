r"""Derivatives by time in Leibniz's form: \frac{d\theta_1}{dt}, \frac{d^2 q}{dt^2}, \frac{d}{dt}\theta_1."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from derive.algebra.formulas.tokens import Token
from derive.answers.latex.letters import Letters
from derive.answers.latex.scripts import FONTS, Tokens, group, group_text, scripted
from derive.errors import FormulaError

_BY_TIME = re.compile(r"dt(?:\^([12]))?")
_DOTS = {1: "_dot", 2: "_ddot"}


@dataclass(frozen=True, slots=True)
class Rate:
    """The name of the rate, and the place after it."""

    name: str
    end: int


def rate_at(found: Sequence[Token], at: int, letters: Letters) -> Rate | None:
    r"""The derivative that begins at a \frac; None for any other fraction. Raises FormulaError for one that
    could be either, or whose object is no name."""
    above, middle = group(found, at + 1)
    below = _BY_TIME.fullmatch(group_text(found, middle))
    moving = _without_d(above)
    if below is None or moving is None:
        return None
    if letters.find("d") and letters.find("t"):
        hint = r"write \dot{} for a derivative"
        raise FormulaError("this could be a derivative or a quotient", found[at].offset, hint)
    order, rest = moving
    if order != int(below[1] or 1):
        raise FormulaError("the orders of this derivative do not agree", found[at].offset)
    _, end = group(found, middle)
    if not rest:
        name, end = _name(found, end)
    else:
        name, stop = _name((*rest, Token("end", "", rest[-1].end, rest[-1].end)), 0)
        if stop != len(rest):
            raise FormulaError("only a name can be derived by time here", rest[0].offset)
    rate = letters.find(name + _DOTS[order]) if name else ""
    if not rate:
        raise FormulaError("only a name of the problem can be derived by time here", found[at].offset)
    return Rate(rate, end)


def _name(found: Sequence[Token], at: int) -> tuple[str, int]:
    if found[at].kind not in ("name", "command"):
        return "", at
    name = scripted(found, at)
    return name.plain, name.power


def _without_d(above: Tokens) -> tuple[int, Tokens] | None:
    """The order of a numerator d^2 q and its q; None where it does not begin with a d."""
    if not above:
        return None
    first, at = above[0], 1
    ended = (*above, Token("end", "", above[-1].end, above[-1].end))
    if first.kind == "command" and first.text in FONTS:
        if group_text(ended, 1) != "d":
            return None
        at = group(ended, 1)[1]
    elif first.kind != "name" or not first.text.startswith("d"):
        return None
    elif len(first.text) > 1:
        return 1, (Token("name", first.text[1:], first.offset + 1, first.end), *above[1:])
    order = 1
    if at < len(above) and above[at].text == "^":
        power = group_text(ended, at + 1)
        if power not in ("1", "2"):
            return None
        order, at = int(power), group(ended, at + 1)[1]
    return order, above[at:]
