"""The nodes of a tree, and the operators that put them together."""

from __future__ import annotations

from dataclasses import dataclass, field
from dataclasses import replace as replace_fields
from fractions import Fraction
from typing import TypeAlias, cast


class Tree:
    """What all nodes can do: they are put together as they are written, `(a + b)/2 - x**2`.

    A sum or a product that goes on, `a + b + c`, is one node; terms that are zero are left out of a sum, and
    nothing else is touched. Whole numbers may stand beside a tree as they are.
    """

    __slots__ = ()

    def __add__(self, other: Operand) -> Expr:
        return add(*terms_of(_tree(self)), _tree(other))

    def __radd__(self, other: int) -> Expr:
        return add(number(other), _tree(self))

    def __sub__(self, other: Operand) -> Expr:
        return add(*terms_of(_tree(self)), negate(_tree(other)))

    def __rsub__(self, other: int) -> Expr:
        return add(number(other), negate(_tree(self)))

    def __mul__(self, other: Operand) -> Expr:
        return Product((*factors_of(_tree(self)), _tree(other)))

    def __rmul__(self, other: int) -> Expr:
        return Product((number(other), _tree(self)))

    def __truediv__(self, other: Operand) -> Expr:
        return Quotient(_tree(self), _tree(other))

    def __rtruediv__(self, other: int) -> Expr:
        return Quotient(number(other), _tree(self))

    def __pow__(self, other: Operand) -> Expr:
        return Power(_tree(self), _tree(other))

    def __neg__(self) -> Expr:
        return negate(_tree(self))


@dataclass(frozen=True, slots=True)
class Number(Tree):
    """An exact rational. `decimal` prints it as a decimal fraction, as its author typed it.

    `unit` is the SI unit its author gave it; tables of data print it, and nothing else takes note of it.
    `places` are the digits after the point as typed, which say how far a published number is rounded.
    """

    value: Fraction
    decimal: bool = False
    unit: str = field(default="", compare=False)
    places: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True)
class Approximate(Tree):
    """A number known only to floating point; printed to the digits the sheet asks for."""

    value: float


@dataclass(frozen=True, slots=True)
class Degrees(Tree):
    """An angle given in degrees, `value * pi / 180`; `places` are the digits after its point as typed, `unit`
    what its author had it divided by, "/s"."""

    value: Fraction
    places: int = field(default=0, compare=False)
    unit: str = field(default="", compare=False)


@dataclass(frozen=True, slots=True)
class Symbol(Tree):
    """A name as typed or as in the results: `theta1`, `L_c`, `theta1_dot`, `T_1^0`, `c_111`; `pi`."""

    name: str


@dataclass(frozen=True, slots=True)
class Indexed(Tree):
    """A name with mathematics in its indices: `R_{z, 30 deg}`."""

    base: str
    lower: tuple[Expr, ...] = ()
    upper: tuple[Expr, ...] = ()


@dataclass(frozen=True, slots=True)
class Sum(Tree):
    """Terms added in this order; a term with a negative leading number prints as a difference."""

    terms: tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class Product(Tree):
    """Factors in this order, of numbers, matrices or both; a leading -1 prints as a sign."""

    factors: tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class Quotient(Tree):
    """A fraction."""

    numerator: Expr
    denominator: Expr


@dataclass(frozen=True, slots=True)
class Power(Tree):
    """A power; the base may be a square matrix where the exponent is an integer."""

    base: Expr
    exponent: Expr


@dataclass(frozen=True, slots=True)
class Call(Tree):
    """A function by name: `cos`, `sin`, `tan`, `sqrt`, `atan2`, `acos`, `asin`, `atan`, `abs`, `sign`,
    `exp`, `log`; of matrices `transpose`, `inverse`, `cross`, `det`."""

    function: str
    arguments: tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class Matrix(Tree):
    """Rows of entries; a column vector has rows of one. Entries may be blocks."""

    rows: tuple[tuple[Expr, ...], ...]

    @property
    def shape(self) -> tuple[int, int]:
        return len(self.rows), len(self.rows[0])

    @property
    def T(self) -> Matrix:
        """Transposed."""
        return Matrix(tuple(zip(*self.rows, strict=True)))


@dataclass(frozen=True, slots=True)
class Derivative(Tree):
    """A partial derivative, as yet to be taken."""

    of: Expr
    by: Symbol


@dataclass(frozen=True, slots=True)
class Measured(Tree):
    """A quantity as it is said on a page: a number, an angle in degrees or a vector, with its SI unit, "N m",
    or what degrees are divided by, "/s". A whole expression is one, or what was put in for a name; the value
    is that of `value`."""

    value: Expr
    unit: str


Expr: TypeAlias = (
    Number
    | Approximate
    | Degrees
    | Symbol
    | Indexed
    | Sum
    | Product
    | Quotient
    | Power
    | Call
    | Matrix
    | Derivative
    | Measured
)
Operand: TypeAlias = Tree | int


ZERO = Number(Fraction(0))
ONE = Number(Fraction(1))
MINUS_ONE = Number(Fraction(-1))
PI = Symbol("pi")


def number(value: int | str | Fraction, decimal: bool = False) -> Number:
    """`number("1/2")`, `number(3)`."""
    return Number(Fraction(value), decimal)


def add(*terms: Expr) -> Expr:
    """The sum of terms, with zeros left out."""
    kept = tuple(term for term in terms if term != ZERO)
    return Sum(kept) if len(kept) > 1 else kept[0] if kept else ZERO


def terms_of(expr: Expr) -> tuple[Expr, ...]:
    """The terms of a sum, or the one that anything else is."""
    return expr.terms if isinstance(expr, Sum) else (expr,)


def factors_of(expr: Expr) -> tuple[Expr, ...]:
    """The factors of a product, or the one that anything else is."""
    return expr.factors if isinstance(expr, Product) else (expr,)


def _tree(part: Operand) -> Expr:
    """A part of a tree that is being put together: every node is one of the twelve."""
    return number(part) if isinstance(part, int) else cast("Expr", part)


def multiply(*factors: Expr) -> Expr:
    """The product of factors, with ones left out; zero if a scalar factor is zero."""
    if ZERO in factors:
        return ZERO
    kept = tuple(factor for factor in factors if factor != ONE)
    return Product(kept) if len(kept) > 1 else kept[0] if kept else ONE


def negate(expr: Expr) -> Expr:
    """The opposite, written with a leading minus; a minus that is there already is dropped."""
    match expr:
        case Number(value):
            return with_value(expr, -value)
        case Approximate(value):
            return Approximate(-value)
        case Degrees(value):
            return with_value(expr, -value)
        case Quotient(top, bottom):
            return Quotient(negate(top), bottom)
        case Product((Number(value) as first, *rest)):
            return multiply(with_value(first, -value), *rest)
        case Product(factors):
            return Product((MINUS_ONE, *factors))
        case _:
            return Product((MINUS_ONE, expr))


def with_value(expr: Number | Degrees, value: Fraction) -> Number | Degrees:
    """Another value of the same kind: a decimal stays one, an angle in degrees too."""
    return replace_fields(expr, value=value)
