"""Trees as text, operators between their operands: in SymPy's own syntax, and in that of other languages.

`text(expr)` reads back in SymPy as an expression equal to the tree, with the names of the sheet:
`cos(theta1)`, `sqrt(3)/2`, `7/20`, `theta1_dot**2`. Decimals come out as exact rationals and degrees as
multiples of `pi`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from derive.expression import (
    PI,
    Approximate,
    Call,
    Degrees,
    Derivative,
    Expr,
    Indexed,
    Matrix,
    Measured,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    number,
)

# How tightly a piece of text holds together; a part weaker than its place asks for parentheses.
SUM, PRODUCT, POWER, ATOM = 1, 2, 3, 4


@dataclass(frozen=True, slots=True)
class Infix:
    """One language: its sign of a power, its names of functions, and what stands before these and pi."""

    power: str
    functions: Mapping[str, str] = field(default_factory=dict)
    module: str = ""

    def write(self, expr: Expr) -> str:
        """The tree in this language."""
        return self.measured(expr)[0]

    def measured(self, expr: Expr) -> tuple[str, int]:
        """The text of a tree, and how tightly it holds together."""
        match expr:
            case Symbol(name):
                return self.name(name), ATOM
            case Number():
                return self.number(expr)
            case Call(function, arguments):
                called = self.functions.get(function, function)
                return f"{self.module}{called}({self.listed(arguments)})", ATOM
            case Sum(terms):
                return self.sum(terms), SUM
            case Product(factors):
                return self.product(factors)
            case Quotient(top, bottom):
                return f"{self.held(top, PRODUCT)}/{self.held(bottom, POWER)}", PRODUCT
            case Power(base, exponent):
                return f"{self.held(base, ATOM)}{self.power}{self.held(exponent, ATOM)}", POWER
            case Degrees(value):
                return self.product((number(value / 180), PI)) if value else ("0", ATOM)
            case Approximate(value):
                return repr(value), ATOM if value >= 0 else SUM
            case Measured(value):
                return self.measured(value)
            case _:
                return self.rarer(expr), ATOM

    def rarer(self, expr: Expr) -> str:
        """What stands in no formula that is evaluated."""
        match expr:
            case Matrix(rows):
                return "Matrix([" + ", ".join(f"[{self.listed(row)}]" for row in rows) + "])"
            case Derivative(of, by):
                return f"Derivative({self.write(of)}, {by.name})"
            case Indexed(base, lower, upper):
                return f"{base}({self.listed(lower + upper)})"
            case _:
                raise TypeError(f"not an expression: {expr!r}")

    def listed(self, parts: tuple[Expr, ...]) -> str:
        """Parts with commas between them."""
        return ", ".join(map(self.write, parts))

    def held(self, expr: Expr, least: int) -> str:
        """The text of a part, in parentheses unless it holds together at least this tightly."""
        written, tightness = self.measured(expr)
        return written if tightness >= least else f"({written})"

    def name(self, name: str) -> str:
        """A name of the sheet as a variable."""
        return f"{self.module}{name}" if name == PI.name else name

    def number(self, number: Number) -> tuple[str, int]:
        """An exact number, p/q."""
        value = number.value
        return str(value), SUM if value < 0 else ATOM if value.denominator == 1 else PRODUCT

    def sum(self, terms: tuple[Expr, ...]) -> str:
        """Terms with their signs between them."""
        written = self.write(terms[0])
        for term in terms[1:]:
            part = self.held(term, PRODUCT) if isinstance(term, Sum) else self.write(term)
            written += f" - {part[1:]}" if part.startswith("-") else f" + {part}"
        return written

    def product(self, factors: tuple[Expr, ...]) -> tuple[str, int]:
        """A number p/q before factors as p*a*b/q; a minus sign stands before the whole."""
        first, *rest = factors
        if isinstance(first, Number) and rest:
            top, bottom = first.value.numerator, first.value.denominator
            size = [] if abs(top) == 1 else [str(abs(top))]
            written = "*".join(size + [self.held(factor, PRODUCT) for factor in rest])
            written = ("-" if top < 0 else "") + written + (f"/{bottom}" if bottom != 1 else "")
        else:
            written = "*".join([self._leading(first), *(self.held(factor, PRODUCT) for factor in rest)])
        return written, SUM if written.startswith("-") else PRODUCT

    def _leading(self, factor: Expr) -> str:
        """A first factor; its own minus sign may stand before the whole product."""
        written, tightness = self.measured(factor)
        bare = tightness >= PRODUCT or (written.startswith("-") and not isinstance(factor, Sum))
        return written if bare else f"({written})"


SYMPY_NAMES = {"abs": "Abs", "max": "Max", "inverse": "Inverse", "det": "Determinant", "cross": "Cross"}
SYMPY = Infix("**", SYMPY_NAMES)


def text(expr: Expr) -> str:
    """The tree in SymPy's syntax."""
    return SYMPY.write(expr)
