"""Trees and normal forms as floating-point numbers: for `evaluate`, and for the second route of checks."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any, TypeAlias

from flint import fmpq, fmpq_mpoly

from derive.algebra.fold import Domain, fold
from derive.algebra.generators import ITSELF, Opaque
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.errors import DivisionByZero, NotReal, TooLarge
from derive.expression import Expr, Matrix

Point: TypeAlias = Mapping[str, float]


def _real(name: str, function: Callable[..., float]) -> Callable[..., float]:
    """The function, with words for where it has no value or none that fits into a float."""

    def value(*at: float) -> float:
        said = f"{name} of {', '.join(f'{each:g}' for each in at)}"
        try:
            found = function(*at)
        except ValueError as error:
            raise NotReal(f"{said} is not real") from error
        except OverflowError as error:
            raise TooLarge(f"{said} is too large a number") from error
        except ZeroDivisionError as error:
            raise DivisionByZero(f"{said} is infinite") from error
        if isinstance(found, complex):
            raise NotReal(f"{said} is not real")
        return float(found)

    return value


def quotient(top: float, bottom: float) -> float:
    """top / bottom. Raises DivisionByZero."""
    if bottom == 0:
        raise DivisionByZero("a division by zero")
    return top / bottom


FUNCTIONS: dict[str, Callable[..., float]] = {
    "pow": _real("a power", pow),
    "cos": math.cos,
    "sin": math.sin,
    "tan": math.tan,
    "sqrt": _real("sqrt", math.sqrt),
    "atan2": math.atan2,
    "acos": _real("acos", math.acos),
    "asin": _real("asin", math.asin),
    "atan": math.atan,
    "exp": _real("exp", math.exp),
    "log": _real("log", math.log),
    "abs": abs,
    "max": max,
    "sign": lambda x: float((x > 0) - (x < 0)),
}


class _Floats(Domain[float]):
    """Floating-point numbers, where each symbol has a value."""

    __slots__ = ("point",)

    def __init__(self, point: Point) -> None:
        self.point = point

    def number(self, value: Fraction) -> float:
        return float(value)

    def approximate(self, value: float) -> float:
        return value

    def degrees(self, value: Fraction) -> float:
        return math.radians(float(value))

    def symbol(self, name: str) -> float:
        return math.pi if name == "pi" else self.point[name]

    def sum(self, terms: list[float]) -> float:
        return math.fsum(terms)

    def product(self, factors: list[float]) -> float:
        return math.prod(factors)

    def quotient(self, top: float, bottom: float) -> float:
        return quotient(top, bottom)

    def power(self, base: float, exponent: float) -> float:
        return FUNCTIONS["pow"](base, exponent)

    def call(self, function: str, arguments: list[float]) -> float:
        return float(FUNCTIONS[function](*arguments)) if function in FUNCTIONS else self.refuse(function)


def number(expr: Expr, point: Point) -> float:
    """The value of a scalar expression where each symbol has a value.

    Raises KeyError for a symbol without one, ValueError or ZeroDivisionError where it is not real,
    NotDerivable for what is no scalar.
    """
    return fold(expr, _Floats(point))


def numbers(value: Expr | Scalar | ScalarMatrix, point: Point) -> Any:
    """Of a tree or a normal form: a float; of a matrix a list of rows, of a column of trees a flat list."""
    match value:
        case ScalarMatrix():
            return matrix_numbers(value, point)
        case Scalar():
            return scalar_number(value, point)
        case Matrix() if value.shape[1] == 1:
            return [number(entry, point) for (entry,) in value.rows]
        case Matrix():
            return number_rows(value, point)
    return number(value, point)


def number_rows(expr: Matrix, point: Point) -> list[list[float]]:
    """A list of rows, of one entry each in a matrix of one column."""
    return [[number(entry, point) for entry in row] for row in expr.rows]


def scalar_number(value: Scalar, point: Point) -> float:
    """The value of a normal form where each symbol has a value. Raises KeyError for one without."""
    gens = generator_numbers(value, point)
    top = _polynomial(value.numerator, gens)
    return top if value.denominator is None else top / _polynomial(value.denominator, gens)


def matrix_numbers(value: ScalarMatrix, point: Point) -> list[list[float]]:
    """Rows of floats."""
    return [[scalar_number(entry, point) for entry in row] for row in value.rows]


def generator_numbers(value: Scalar, point: Point) -> list[float]:
    """The value of each generator of a scalar's ring that occurs in it (0 for the others)."""
    home, used = value.ring, set(value.generators())
    table: dict[str, float] = {}
    for name in home.symbols:
        if name in used:
            table[name] = math.pi if name == "pi" else symbol_number(name, point)
    for form in home.angles:
        c, s = f"cos({form})", f"sin({form})"
        if c in used or s in used:
            angle = sum(float(n) * atom_number(atom, point) for atom, n in form.parts)
            table[c], table[s] = math.cos(angle), math.sin(angle)
    for root in reversed(home.roots):
        if root.name in used:
            square = Scalar(home, home.polynomial(root.radicand))
            table[root.name] = FUNCTIONS["pow"](scalar_number(square, point), 1 / root.degree)
    return [table.get(name, 0.0) for name in home.names]


def symbol_number(name: str, point: Point) -> float:
    """A letter; or a function that the normal form keeps as it is, `exp(x)`. Raises KeyError."""
    if not isinstance(name, Opaque) or name in point:
        return point[name]
    values = [scalar_number(argument, point) for argument in name.arguments]
    return values[0] if name.function == ITSELF else float(FUNCTIONS[name.function](*values))


def atom_number(atom: str, point: Point) -> float:
    """pi, one radian, an angle, or a product of powers of symbols."""
    if isinstance(atom, Opaque):
        return symbol_number(atom, point)
    value = {"pi": math.pi, "1": 1.0}.get(atom)
    if value is not None:
        return value
    factors = (factor.partition("^") for factor in atom.split("*"))
    values = ((math.pi if name == "pi" else point[name], power) for name, _, power in factors)
    return math.prod(value ** int(power or 1) for value, power in values)


def _polynomial(polynomial: fmpq_mpoly, gens: list[float]) -> float:
    """The exact value where the generators are exactly these floats, rounded once; FLINT is several times
    faster at that than Python at the terms."""
    value = polynomial(*(fmpq(*gen.as_integer_ratio()) for gen in gens))
    return int(value.p) / int(value.q)
