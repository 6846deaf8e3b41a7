"""SymPy in and out: our trees as SymPy expressions and back. SymPy is imported only where it is asked for."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable
from derive.expression import (
    Approximate,
    Call,
    Degrees,
    Expr,
    Matrix,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    add,
    multiply,
    sqrt,
)

# Our functions by SymPy's names; the rest are called the same.
RENAMED = {"Abs": "abs"}
FUNCTIONS = ("cos", "sin", "tan", "acos", "asin", "atan", "atan2", "exp", "log", "sign", "Abs")


def to_sympy(value: Expr | Scalar) -> Any:
    """A tree or a normal form as a SymPy expression (a matrix as an ImmutableMatrix); names are real symbols.

    Raises NotDerivable for what has no value of its own, such as an indexed name.
    """
    import sympy

    if isinstance(value, Scalar):
        from derive.algebra.readable.form import readable

        return to_sympy(readable(value, Style()))
    match value:
        case Number(exact):
            return sympy.Rational(exact.numerator, exact.denominator)
        case Approximate(approximate):
            return sympy.Float(approximate)
        case Degrees(exact):
            return sympy.Rational(exact.numerator, exact.denominator) * sympy.pi / 180
        case Symbol("pi"):
            return sympy.pi
        case Symbol(name):
            return sympy.Symbol(name, real=True)
        case Sum(terms):
            return sympy.Add(*map(to_sympy, terms))
        case Product(factors):
            return sympy.Mul(*map(to_sympy, factors))
        case Quotient(top, bottom):
            return to_sympy(top) / to_sympy(bottom)
        case Power(base, exponent):
            return to_sympy(base) ** to_sympy(exponent)
        case Call(function, arguments):
            return _function(function)(*map(to_sympy, arguments))
        case Matrix(rows):
            return sympy.ImmutableMatrix([[to_sympy(entry) for entry in row] for row in rows])
    raise NotDerivable(f"{type(value).__name__} has no counterpart in SymPy")


def from_sympy(value: Any) -> Expr:
    """The tree of a SymPy expression or matrix; `normal` brings it to the normal form.

    A floating-point number becomes the fraction its shortest decimal stands for. Raises NotDerivable for
    what the trees cannot hold.
    """
    import sympy

    if isinstance(value, sympy.MatrixBase):
        rows = value.tolist()
        return Matrix(tuple(tuple(from_sympy(entry) for entry in row) for row in rows))
    if isinstance(value, sympy.Rational):
        return Number(Fraction(int(value.p), int(value.q)))
    if isinstance(value, sympy.Float):
        return Number(Fraction(str(value)), decimal=True)
    if isinstance(value, sympy.Symbol) or value is sympy.pi:
        return Symbol(str(value))
    if isinstance(value, sympy.Add):
        return add(*map(from_sympy, value.args))
    if isinstance(value, sympy.Mul):
        return multiply(*map(from_sympy, value.args))
    if isinstance(value, sympy.Pow):
        base, exponent = value.args
        return sqrt(from_sympy(base)) if exponent == sympy.S.Half else _power(base, exponent)
    name = type(value).__name__
    if name in FUNCTIONS:
        return Call(RENAMED.get(name, name), tuple(map(from_sympy, value.args)))
    raise NotDerivable(f"SymPy's {name} has no counterpart here")


def _power(base: Any, exponent: Any) -> Expr:
    """An odd half is a power of a root."""
    if exponent.is_Rational and exponent.q == 2:
        return Power(sqrt(from_sympy(base)), Number(Fraction(int(exponent.p))))
    return Power(from_sympy(base), from_sympy(exponent))


def _function(name: str) -> Callable[..., Any]:
    """SymPy's function of our name. Raises NotDerivable."""
    import sympy

    called = {ours: theirs for theirs, ours in RENAMED.items()}.get(name, name)
    if name == "sqrt" or called in FUNCTIONS:
        found: Callable[..., Any] = getattr(sympy, called)
        return found
    raise NotDerivable(f"{name} has no counterpart in SymPy")
