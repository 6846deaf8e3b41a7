"""Typst's mathematics as it is set, written as LaTeX so that it can be read back."""

from __future__ import annotations

import re
from dataclasses import dataclass

TOKEN = re.compile(r'\s+|\\.|"[^"]*"|[A-Za-z]{2,}(?:\.[a-z]+)*|[A-Za-z]|\d+(?:\.\d+)?|.')
NAMES = {
    "dot.op": r"\cdot", "times": r"\times", "compose": r"\circ", "partial": r"\partial", "thin": "",
    "quad": "",
    "phi.alt": r"\phi", "phi": r"\varphi", "ast.op": r"\ast", "ast": r"\ast", "gradient": r"\nabla",
    "epsilon": r"\varepsilon", "epsilon.alt": r"\epsilon", "theta.alt": r"\vartheta",
}  # fmt: skip
ACCENTS = {"dot": r"\dot", "dot.double": r"\ddot"}
CALLS = ("frac", "sqrt", "upright", "mat", *ACCENTS)


@dataclass
class Group:
    """What stands in parentheses, which are not set where it is a part of a fraction or a script."""

    inner: str


Piece = str | Group


class Typst:
    """One formula being read."""

    def __init__(self, text: str) -> None:
        self.tokens = TOKEN.findall(text)
        self.at = 0

    @property
    def next(self) -> str:
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self) -> str:
        self.at += 1
        return str(self.tokens[self.at - 1])

    def blank(self) -> None:
        while self.next.isspace():
            self.take()

    def sequence(self, *ends: str) -> str:
        """Fractions and what stands between them, up to a sign that ends it."""
        written: list[str] = []
        self.blank()
        while self.next and self.next not in ends:
            piece = self.attached()
            self.blank()
            while self.next == "/":
                self.take()
                self.blank()
                piece = fraction(bare(piece), bare(self.attached()))
                self.blank()
            written.append(shown(piece))
        return " ".join(filter(None, written))

    def attached(self) -> Piece:
        """An atom with its scripts."""
        piece = self.atom()
        while self.next in ("_", "^"):
            mark = self.take()
            piece = f"{shown(piece)}{mark}{{{bare(self.atom())}}}"
        return piece

    def atom(self) -> Piece:
        token = self.take()
        if token == "(":
            inner = self.sequence(")")
            self.take()
            return Group(inner)
        if token in CALLS and self.next == "(":
            return self.call(token)
        if token.startswith("\\"):
            return token[1:]
        if len(token) > 1 and token[0].isalpha():
            return NAMES.get(token, f"\\{token}")
        return token

    def call(self, name: str) -> str:
        self.take()
        if name == "mat":
            return self.matrix()
        arguments = [self.sequence(",", ")")]
        while self.take() == ",":
            arguments.append(self.sequence(",", ")"))
        if name == "frac":
            return fraction(*arguments)
        if name == "upright":
            return rf"\mathrm{{{arguments[0].replace(' ', '')}}}"
        return f"{ACCENTS.get(name, chr(92) + name)}{{{arguments[0]}}}"

    def matrix(self) -> str:
        """`mat(delim: "[", a, b; c, d)`."""
        head = "".join(self.take() for _ in range(5))
        if head != 'delim: "[",':
            raise ValueError(head)
        rows, end = [[self.sequence(",", ";", ")")]], self.take()
        while end != ")":
            if end == ";":
                rows.append([])
            rows[-1].append(self.sequence(",", ";", ")"))
            end = self.take()
        return r"\begin{bmatrix} " + r" \\ ".join(" & ".join(row) for row in rows) + r" \end{bmatrix}"


def fraction(top: str, bottom: str) -> str:
    """Of a differential the d stands close to what follows."""
    top, bottom = (re.sub(r"^d (?=.)", "d", part) for part in (top, bottom))
    return rf"\frac{{{top}}}{{{bottom}}}"


def shown(piece: Piece) -> str:
    return f"({piece.inner})" if isinstance(piece, Group) else piece


def bare(piece: Piece) -> str:
    return piece.inner if isinstance(piece, Group) else piece


def latex_of(text: str) -> str:
    """What a formula shows; a bar is of the kind that opens where none is open."""
    return Typst(text).sequence()
