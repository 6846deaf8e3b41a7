"""SymPy in and out: our trees as SymPy expressions and back. SymPy is imported only where it is asked for."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NoReturn

from derive.algebra.fold import Domain, fold
from derive.algebra.readable.form import readable
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Matrix, Number, Power, Symbol, add, multiply, sqrt

# Our functions by SymPy's names; the rest are called the same.
RENAMED = {"Abs": "abs"}
FUNCTIONS = ("cos", "sin", "tan", "acos", "asin", "atan", "atan2", "exp", "log", "sign", "Abs")


def to_sympy(value: Expr | Scalar) -> Any:
    """A tree or a normal form as a SymPy expression (a matrix as an ImmutableMatrix of its shape), its names
    real symbols. Raises NotDerivable for what has no value of its own, such as an indexed name."""
    if isinstance(value, Scalar):
        value = readable(value, Style())
    return fold(value, _SymPy())


class _SymPy(Domain[Any]):
    """Expressions of SymPy, in the forms its own constructors give them."""

    def __init__(self) -> None:
        import sympy

        self.sympy = sympy

    def number(self, value: Fraction) -> Any:
        return self.sympy.Rational(value.numerator, value.denominator)

    def approximate(self, value: float) -> Any:
        return self.sympy.Float(value)

    def degrees(self, value: Fraction) -> Any:
        return self.number(value) * self.sympy.pi / 180

    def symbol(self, name: str) -> Any:
        return self.sympy.pi if name == "pi" else self.sympy.Symbol(name, real=True)

    def sum(self, terms: list[Any]) -> Any:
        return self.sympy.Add(*terms)

    def product(self, factors: list[Any]) -> Any:
        return self.sympy.Mul(*factors)

    def call(self, function: str, arguments: list[Any]) -> Any:
        called = {ours: theirs for theirs, ours in RENAMED.items()}.get(function, function)
        known = function == "sqrt" or called in FUNCTIONS
        return getattr(self.sympy, called)(*arguments) if known else self.refuse(function)

    def matrix(self, rows: list[list[Any]]) -> Any:
        return self.sympy.ImmutableMatrix(rows)

    def refuse(self, what: str) -> NoReturn:
        raise NotDerivable(f"{what} has no counterpart in SymPy")


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
    if isinstance(value, sympy.Add | sympy.Mul):
        return (add if isinstance(value, sympy.Add) else multiply)(*map(from_sympy, value.args))
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
