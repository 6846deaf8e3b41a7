r"""Derivatives by time in Leibniz's form: \frac{d\theta_1}{dt}, \frac{d^2 q}{dt^2}, \frac{d}{dt}\theta_1."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from derive.algebra.formulas.tokens import Token
from derive.answers.latex.letters import Letters
from derive.answers.latex.scripts import FONTS, Tokens, group, group_text, scripted
from derive.errors import FormulaError
from derive.expression import Derivative, Expr, Symbol

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


@dataclass(frozen=True, slots=True)
class Derived:
    """A derivative: what is derived (None where it follows), the names by which, outermost first, and the
    place after it."""

    of: Tokens | None
    by: tuple[Tokens, ...]
    end: int

    def applied(self, of: Expr, read: Callable[[Tokens], Expr]) -> Expr:
        """The derivative of a tree, the names read. Raises FormulaError where one is no name."""
        for tokens in reversed(self.by):
            by = read(tokens)
            if not isinstance(by, Symbol):
                raise FormulaError("a derivative is taken by a name", tokens[0].offset)
            of = Derivative(of, by)
        return of


def derivative_at(found: Sequence[Token], at: int, letters: Letters) -> Derived | None:
    r"""The partial derivative that begins at a \frac, or on our page one by time; None for anything else.
    Raises FormulaError."""
    above, middle = group(found, at + 1)
    below, end = group(found, middle)
    if letters.printed and _is(below, ("dt",)) and above and above[0].text.startswith("d"):
        order, rest = _without_d(above) or (1, above)
        by = (_ended((Token("name", "t", below[0].offset + 1, below[0].end),)),)
        return Derived(_ended(rest) if rest else None, by * order, end)
    if not _is(above, ("partial",)) or not _is(below, ("partial",)):
        return None
    rest = above[1:]
    order = 1
    if rest and rest[0].text == "^":
        inner, after = group(_ended(rest), 1)
        order, rest = int(_whole(inner)), rest[after:]
    names = _names_below(below)
    if len(names) != order:
        raise FormulaError("the orders of this derivative do not agree", found[at].offset)
    return Derived(_ended(rest) if rest else None, names, end)


def _is(tokens: Tokens, first: tuple[str, ...]) -> bool:
    return bool(tokens) and tokens[0].text in first


def _whole(tokens: Tokens) -> str:
    text = "".join(token.text for token in tokens)
    if not text.isdigit():
        raise FormulaError("the order of a derivative is a whole number", tokens[0].offset)
    return text


def _names_below(below: Tokens) -> tuple[Tokens, ...]:
    r"""The x, x, y of \partial x^2 \partial y."""
    pieces: list[list[Token]] = []
    for token in below:
        if token.text == "partial" and token.kind == "command":
            pieces.append([])
        else:
            pieces[-1].append(token)
    names: list[Tokens] = []
    for piece in pieces:
        times, kept = 1, tuple(piece)
        power = next((k for k, token in enumerate(kept) if token.text == "^"), None)
        if power and group(_ended(kept), power + 1)[1] == len(kept):
            order = group_text(_ended(kept), power + 1)
            times, kept = (int(order), kept[:power]) if order.isdigit() else (1, kept)
        if not kept:
            raise FormulaError("a derivative is taken by a name", below[0].offset)
        names += [_ended(kept)] * times
    return tuple(names)


def _ended(tokens: Tokens) -> Tokens:
    return (*tokens, Token("end", "", tokens[-1].end, tokens[-1].end))
