"""Trees and normal forms as floating-point numbers: for `evaluate`, and for the second route of checks."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from typing import Any, TypeAlias

from flint import fmpq, fmpq_mpoly

from derive.algebra.evaluation import Evaluation
from derive.algebra.fold import Domain, fold
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar
from derive.errors import DivisionByZero, NotReal, TooLarge
from derive.expression import Expr, Matrix, Number, Symbol, free_symbols

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
    "atan2": lambda y, x: math.atan2(y + 0.0, x + 0.0),  # there is one zero, and the angle of -1 is pi
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

    def knows(self, name: str) -> bool:
        return name in self.point

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


def somewhere(name: str) -> float:
    """A number of its own for every name, the same on every machine."""
    return random.Random(name).uniform(0.2, 1.9)


def number(expr: Expr, point: Point) -> float:
    """The value of a scalar expression where each symbol has a value.

    Raises KeyError for a symbol without one, ValueError or ZeroDivisionError where it is not real,
    NotDerivable for what is no scalar.
    """
    if isinstance(expr, Symbol):  # most of what oracles ask for
        return math.pi if expr.name == "pi" else point[expr.name]
    if isinstance(expr, Number):
        return float(expr.value)
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


class _Exact(Evaluation[float]):
    """Floats of normal forms: the generators are rounded, and a polynomial in exactly these floats is rounded
    once; FLINT is several times faster at that than Python at the terms."""

    def polynomial(self, polynomial: fmpq_mpoly, home: Ring) -> float:
        at = self.generators(home, polynomial.degrees())
        value = polynomial(*(fmpq(*each.as_integer_ratio()) for each in at))
        return int(value.p) / int(value.q)

    def generators(self, home: Ring, degrees: Iterable[int]) -> list[float]:
        return [self.generator(home, place) if n > 0 else 0.0 for place, n in enumerate(degrees)]


def scalar_number(value: Scalar, point: Point) -> float:
    """The value of a normal form where each symbol has a value. Raises KeyError for one without."""
    return _Exact(_Floats(point)).quotient(value)


def matrix_numbers(value: ScalarMatrix, point: Point) -> list[list[float]]:
    """The rows of a matrix as floats. Raises KeyError for a symbol without a value."""
    return [[scalar_number(entry, point) for entry in row] for row in value.rows]


def generator_numbers(value: Scalar, point: Point) -> list[float]:
    """The value of each generator of a scalar's ring that occurs in it (0 for the others)."""
    used = set(value.generators())
    return _Exact(_Floats(point)).generators(value.ring, [name in used for name in value.ring.names])


def atom_number(atom: str, point: Point) -> float:
    """The value of a letter, of a function that the normal form keeps as it is, `exp(x)`, or of an atom of an
    angle. Raises KeyError."""
    return _Exact(_Floats(point)).atom(atom)


def completed(point: Point, where: Mapping[str, Expr]) -> Point:
    """The point with the values of `where` added, those that rest on others after them. Names whose
    value is not decided by the point are left out."""
    found = dict(point)
    pending = {name: free_symbols(value) for name, value in where.items()}
    while ready := [name for name, needed in pending.items() if needed <= found.keys()]:
        found.update({name: number(where[name], found) for name in ready})
        pending = {name: needed for name, needed in pending.items() if name not in ready}
    return found
