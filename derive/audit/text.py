"""The text of a result as a SymPy expression, read by a parser of its own: never by `eval` or `sympify`."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

import sympy

from derive.audit.budget import spend

Json: TypeAlias = "str | int | float | bool | Sequence[Json] | Mapping[str, Json] | None"
Names: TypeAlias = Mapping[str, sympy.Expr]

TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+)|([^\W\d]\w*)|(\*\*|[-+*/(),]))")
CONSTANTS = {"pi": sympy.pi}
FUNCTIONS = {
    function.__name__: function
    for function in (
        *(sympy.cos, sympy.sin, sympy.tan, sympy.acos, sympy.asin, sympy.atan, sympy.atan2, sympy.sqrt),
        *(
            sympy.cosh,
            sympy.sinh,
            sympy.tanh,
            sympy.exp,
            sympy.log,
            sympy.sign,
            sympy.Abs,
            sympy.Max,
            sympy.Min,
        ),
    )
}


class Unreadable(Exception):
    """A text that is no formula."""


def sympy_of_text(text: str, names: Names) -> sympy.Expr:
    """`cos(theta1)**2/2` as a SymPy expression; a name of `names` stands for its value, any other is a
    symbol without assumptions. Raises Unreadable."""
    return _Reader(_tokens(text), names).whole()


def made(function: Callable[..., sympy.Expr], *arguments: sympy.Expr) -> sympy.Expr:
    """The function of these. Of what is no fraction it is left as it stands: to simplify it SymPy would ask
    of the numbers in it whether they are zero, by their minimal polynomials, which may never end."""
    return function(*arguments, evaluate=all(each.is_Rational for each in arguments))


def _tokens(text: str) -> list[tuple[str, str]]:
    """(kind, token): "number", "name" or "sign"."""
    found, at = [], 0
    text = text.rstrip()
    spend(len(text))
    while at < len(text):
        match = TOKEN.match(text, at)
        if match is None:
            raise Unreadable(f"{text[at : at + 20]!r} is no part of a formula")
        kind = ("number", "name", "sign")[(match.lastindex or 1) - 1]
        found.append((kind, match[match.lastindex or 1]))
        at = match.end()
    return [*found, ("end", "")]


class _Reader:
    """A recursive descent through the tokens of one formula."""

    def __init__(self, tokens: list[tuple[str, str]], names: Names) -> None:
        self.tokens, self.names, self.at = tokens, names, 0

    def whole(self) -> sympy.Expr:
        found = self.sum()
        if self.next != "" or self.tokens[self.at][0] != "end":
            raise Unreadable(f"{self.next!r} should not follow")
        return found

    @property
    def next(self) -> str:
        return self.tokens[self.at][1]

    def taken(self, *signs: str) -> str:
        """The next token where it is one of these, which is then behind us; else nothing."""
        kind, token = self.tokens[self.at]
        if kind != "sign" or token not in signs:
            return ""
        self.at += 1
        return token

    def expect(self, sign: str) -> None:
        if not self.taken(sign):
            raise Unreadable(f"{sign!r} is missing before {self.next!r}")

    def sum(self) -> sympy.Expr:
        terms = [self.product()]
        while sign := self.taken("+", "-"):
            term = self.product()
            terms.append(term if sign == "+" else -term)
        return sympy.Add(*terms)

    def product(self) -> sympy.Expr:
        factors = [self.signed()]
        while sign := self.taken("*", "/"):
            factor = self.signed()
            factors.append(factor if sign == "*" else made(sympy.Pow, factor, sympy.Integer(-1)))
        return sympy.Mul(*factors)

    def signed(self) -> sympy.Expr:
        if self.taken("-"):
            return -self.signed()
        return self.power()

    def power(self) -> sympy.Expr:
        base = self.atom()
        return made(sympy.Pow, base, self.signed()) if self.taken("**") else base

    def atom(self) -> sympy.Expr:
        kind, token = self.tokens[self.at]
        if kind == "sign":
            self.expect("(")
            inside = self.sum()
            self.expect(")")
            return inside
        self.at += 1
        if kind == "number":
            return sympy.Integer(token) if token.isdigit() else sympy.Float(token)
        if kind == "end":
            raise Unreadable("the formula ends too early")
        if self.taken("("):
            return self.called(token)
        return CONSTANTS.get(token) or self.names.get(token, sympy.Symbol(token))

    def called(self, function: str) -> sympy.Expr:
        if function not in FUNCTIONS:
            raise Unreadable(f"{function} is no function known here")
        arguments = [self.sum()]
        while self.taken(","):
            arguments.append(self.sum())
        self.expect(")")
        return made(FUNCTIONS[function], *arguments)
