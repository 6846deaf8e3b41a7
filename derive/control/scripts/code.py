"""Formulas as lines of a program: numbers as they were typed, names a language does not reserve."""

from __future__ import annotations

import keyword
from collections.abc import Mapping
from dataclasses import dataclass, field

from derive.algebra.infix import text
from derive.expression import (
    Approximate,
    Call,
    Degrees,
    Expr,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    is_negative,
    negate,
    number,
)

SUM, PRODUCT, POWER, ATOM = 1, 2, 3, 4  # how tightly a piece of text holds together


@dataclass(frozen=True, slots=True)
class Language:
    """What differs between languages; `module` stands before the names of functions and pi, some of which
    are called otherwise there (`functions`)."""

    power: str
    module: str
    reserved: frozenset[str]
    functions: Mapping[str, str] = field(default_factory=dict)

    def name(self, name: str) -> str:
        """A name of the sheet as a variable."""
        return f"{name}_" if name in self.reserved else name

    def write(self, expr: Expr) -> str:
        """A formula."""
        return self._written(expr)[0]

    def _written(self, expr: Expr) -> tuple[str, int]:
        match expr:
            case Symbol("pi"):
                return f"{self.module}pi", ATOM
            case Symbol(name):
                return self.name(name), ATOM
            case Number():
                return _number(expr)
            case Approximate(value):
                return repr(value), ATOM if value >= 0 else SUM
            case Degrees(value):
                return self._written(Product((number(value / 180), Symbol("pi"))))
            case Sum(terms):
                return self._sum(terms), SUM
            case Product(factors):
                parts = [self._held(factor, PRODUCT) for factor in factors]
                return _signed("*".join(parts)), SUM if is_negative(expr) else PRODUCT
            case Quotient(top, bottom):
                return f"{self._held(top, PRODUCT)}/{self._held(bottom, POWER)}", PRODUCT
            case Power(base, exponent):
                return f"{self._held(base, ATOM)}{self.power}{self._held(exponent, ATOM)}", POWER
            case Call(function, arguments):
                called = self.functions.get(function, function)
                return f"{self.module}{called}({', '.join(map(self.write, arguments))})", ATOM
        raise ValueError(f"{text(expr)} in a program")

    def _sum(self, terms: tuple[Expr, ...]) -> str:
        first, *rest = terms
        parts = [self._held(first, SUM if not isinstance(first, Sum) else PRODUCT)]
        for term in rest:
            size = negate(term) if is_negative(term) else term
            parts += ["-" if is_negative(term) else "+", self._held(size, PRODUCT)]
        return " ".join(parts)

    def _held(self, expr: Expr, least: int) -> str:
        written, tightness = self._written(expr)
        return written if tightness >= least else f"({written})"


def _number(value: Number) -> tuple[str, int]:
    fraction = value.value
    written = repr(float(fraction)) if value.decimal else str(fraction)
    if fraction < 0:
        return written, SUM
    return written, ATOM if value.decimal or fraction.denominator == 1 else PRODUCT


def _signed(product: str) -> str:
    """A minus sign instead of the factor -1."""
    return f"-{product.removeprefix('(-1)*')}" if product.startswith("(-1)*") else product


_SCRIPT = frozenset({"G", "C", "T", "t", "y", "model", "response", "stop"})
_MATLAB = frozenset(
    {
        "break", "case", "catch", "classdef", "continue", "else", "elseif", "end", "for", "function",
        "global", "if", "otherwise", "parfor", "persistent", "return", "spmd", "switch", "try", "while",
        "ans", "eps", "i", "j", "inf", "tf", "step", "feedback", "minreal", "sim", "plot", "grid", "legend",
        "out",
    }
)  # fmt: skip
MATLAB = Language("^", "", _SCRIPT | _MATLAB)
PYTHON = Language(
    "**",
    "numpy.",
    _SCRIPT
    | frozenset({"control", "numpy", "blocks", "loop", "other", "sys", "print", "matplotlib"})
    | frozenset(keyword.kwlist),
    {"acos": "arccos", "asin": "arcsin", "atan": "arctan", "atan2": "arctan2"},
)
