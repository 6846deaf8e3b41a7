"""Mathematics as text in SymPy's own syntax, with the names of the sheet.

`text(expr)` reads back in SymPy as an expression equal to the tree: `cos(theta1)`, `sqrt(3)/2`,
`7/20`, `theta1_dot**2`. Decimals come out as exact rationals and degrees as multiples of `pi`.
"""

from __future__ import annotations

from fractions import Fraction

from derive.expression import (
    Approximate,
    Call,
    Degrees,
    Derivative,
    Expr,
    Indexed,
    Matrix,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)

# How tightly a piece of text holds together; a part weaker than its place asks for parentheses.
SUM, PRODUCT, POWER, ATOM = 1, 2, 3, 4

SYMPY_NAMES = {"abs": "Abs", "max": "Max", "inverse": "Inverse", "det": "Determinant", "cross": "Cross"}


def text(expr: Expr) -> str:
    """The tree in SymPy's syntax."""
    return _write(expr)[0]


def _write(expr: Expr) -> tuple[str, int]:
    match expr:
        case Symbol(name):
            return name, ATOM
        case Number(value):
            return _rational(value)
        case Call(function, arguments):
            return f"{SYMPY_NAMES.get(function, function)}({_listed(arguments)})", ATOM
        case Sum(terms):
            return _sum(terms), SUM
        case Product(factors):
            return _product(factors)
        case Quotient(top, bottom):
            return f"{_held(top, PRODUCT)}/{_held(bottom, POWER)}", PRODUCT
        case Power(base, exponent):
            return f"{_held(base, ATOM)}**{_held(exponent, ATOM)}", POWER
        case Degrees(value):
            return _degrees(value)
        case _:
            return _rarer(expr)


def _rarer(expr: Expr) -> tuple[str, int]:
    match expr:
        case Approximate(value):
            return repr(value), ATOM if value >= 0 else SUM
        case Matrix(rows):
            return "Matrix([" + ", ".join(f"[{_listed(row)}]" for row in rows) + "])", ATOM
        case Derivative(of, by):
            return f"Derivative({text(of)}, {by.name})", ATOM
        case Indexed(base, lower, upper):
            return f"{base}({_listed(lower + upper)})", ATOM
        case _:
            raise TypeError(f"not an expression: {expr!r}")


def _listed(parts: tuple[Expr, ...]) -> str:
    return ", ".join(map(text, parts))


def _held(expr: Expr, least: int) -> str:
    """The text of a part, in parentheses unless it holds together at least this tightly."""
    written, tightness = _write(expr)
    return written if tightness >= least else f"({written})"


def _rational(value: Fraction) -> tuple[str, int]:
    if value < 0:
        return str(value), SUM
    return str(value), ATOM if value.denominator == 1 else PRODUCT


def _degrees(value: Fraction) -> tuple[str, int]:
    turns = value / 180
    if turns == 0:
        return "0", ATOM
    top = {1: "pi", -1: "-pi"}.get(turns.numerator, f"{turns.numerator}*pi")
    whole = turns.denominator == 1
    tightness = SUM if turns < 0 else ATOM if top == "pi" and whole else PRODUCT
    return (top if whole else f"{top}/{turns.denominator}"), tightness


def _sum(terms: tuple[Expr, ...]) -> str:
    written = text(terms[0])
    for term in terms[1:]:
        part = text(term)
        if isinstance(term, Sum):
            written += f" + ({part})"
        elif part.startswith("-"):
            written += f" - {part[1:]}"
        else:
            written += f" + {part}"
    return written


def _product(factors: tuple[Expr, ...]) -> tuple[str, int]:
    first = factors[0]
    if isinstance(first, Number) and len(factors) > 1:
        return _scaled(first.value, factors[1:])
    head, *rest = factors
    written = "*".join((_leading(head), *(_held(factor, PRODUCT) for factor in rest)))
    return written, SUM if written.startswith("-") else PRODUCT


def _leading(factor: Expr) -> str:
    """A first factor; its own minus sign may stand before the whole product."""
    written, tightness = _write(factor)
    bare = tightness >= PRODUCT or (written.startswith("-") and not isinstance(factor, Sum))
    return written if bare else f"({written})"


def _scaled(value: Fraction, factors: tuple[Expr, ...]) -> tuple[str, int]:
    """`p/q` times factors, as `p*a*b/q`; a factor that is a sign shows as one."""
    numbers = () if abs(value.numerator) == 1 else (str(abs(value.numerator)),)
    written = "*".join((*numbers, *(_held(factor, PRODUCT) for factor in factors)))
    if value.denominator != 1:
        written += f"/{value.denominator}"
    return (f"-{written}", SUM) if value < 0 else (written, PRODUCT)
