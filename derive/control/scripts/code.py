"""Formulas as lines of a program: numbers as they were typed, names a language does not reserve."""

from __future__ import annotations

import keyword
from dataclasses import dataclass

from derive.algebra.infix import ATOM, PRODUCT, SUM, Infix, text
from derive.expression import Expr, Number, Sum, is_negative


@dataclass(frozen=True, slots=True)
class Language(Infix):
    """A language of programs, and the names that it or the script has for itself."""

    reserved: frozenset[str] = frozenset()

    def name(self, name: str) -> str:
        """A name of the sheet as a variable of the program."""
        return Infix.name(self, f"{name}_" if name in self.reserved else name)

    def number(self, number: Number) -> tuple[str, int]:
        """A decimal as one."""
        if not number.decimal:
            return Infix.number(self, number)
        return repr(float(number.value)), ATOM if number.value >= 0 else SUM

    def sum(self, terms: tuple[Expr, ...]) -> str:
        """Blanks around its signs."""
        first, *rest = terms
        parts = [self.held(first, PRODUCT if isinstance(first, Sum) else SUM)]
        for term in rest:
            size = -term if is_negative(term) else term
            parts += ["-" if is_negative(term) else "+", self.held(size, PRODUCT)]
        return " ".join(parts)

    def product(self, factors: tuple[Expr, ...]) -> tuple[str, int]:
        """Numbers stay where they stand; -1 is a sign."""
        written = "*".join(self.held(factor, PRODUCT) for factor in factors)
        signed = f"-{written.removeprefix('(-1)*')}" if written.startswith("(-1)*") else written
        return signed, SUM if is_negative(factors[0]) else PRODUCT

    def rarer(self, expr: Expr) -> str:
        """Raises ValueError: what has no place in a program."""
        raise ValueError(f"{text(expr)} in a program")


_SCRIPT = frozenset({"G", "C", "T", "t", "y", "model", "response", "stop"})
_MATLAB = frozenset(
    {
        "break", "case", "catch", "classdef", "continue", "else", "elseif", "end", "for", "function",
        "global", "if", "otherwise", "parfor", "persistent", "return", "spmd", "switch", "try", "while",
        "ans", "eps", "i", "j", "inf", "tf", "step", "feedback", "minreal", "sim", "plot", "grid", "legend",
        "out",
    }
)  # fmt: skip
MATLAB = Language("^", reserved=_SCRIPT | _MATLAB)
PYTHON = Language(
    "**",
    {"acos": "arccos", "asin": "arcsin", "atan": "arctan", "atan2": "arctan2"},
    "numpy.",
    _SCRIPT
    | frozenset({"control", "numpy", "blocks", "loop", "other", "sys", "print", "matplotlib"})
    | frozenset(keyword.kwlist),
)
