"""A factor that all entries of a matrix of numbers have, written before it: 1/sqrt(3) (1, -1, 1)."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm

from derive.expression import (
    ONE,
    PI,
    ZERO,
    Call,
    Expr,
    Matrix,
    Number,
    Product,
    Quotient,
    multiply,
    number,
    sqrt,
    walk,
)

FEWEST = 2  # fractions that are worth a factor


@dataclass(frozen=True, slots=True)
class _Entry:
    """A rational times roots and pi, in the order in which they stand."""

    rational: Fraction
    rest: tuple[Expr, ...] = ()

    def over(self, factor: Fraction, kept: bool) -> Expr:
        """Divided by a rational, and by its roots unless these are `kept`."""
        return multiply(number(self.rational / factor), *(self.rest if kept else ()))


def factored(matrix: Expr) -> Expr:
    """`factor * matrix` where that is shorter: fractions of one denominator or of one root, and no entry that
    would be longer; any other matrix as it is."""
    if not isinstance(matrix, Matrix) or not any(isinstance(node, Number) for node in walk(matrix)):
        return matrix
    rows = [[_entry(entry) for entry in row] for row in matrix.rows]
    entries = [entry for row in rows for entry in row if entry is None or entry.rational]
    told = [entry for entry in entries if entry is not None]
    if len(told) < len(entries) or sum(entry.rational.denominator > 1 for entry in told) < FEWEST:
        return matrix
    rests = {entry.rest for entry in told}
    if min(matrix.shape) > 1 and any(entry.rational.denominator == 1 and not entry.rest for entry in told):
        return matrix  # a one would become a number
    bottom = lcm(*(entry.rational.denominator for entry in told))
    top = gcd(*(int(entry.rational * bottom) for entry in told)) if len(rests) == 1 else 1
    factor, alone = Fraction(top, bottom), len(rests) == 1
    written = _written(factor, told[0].rest if alone else ())
    inside = tuple(tuple(ZERO if e is None else e.over(factor, not alone) for e in row) for row in rows)
    return Product((written, Matrix(inside)))


def is_factored(tree: Expr) -> bool:
    """Whether it is a matrix with a number before it."""
    match tree:
        case Product((Number() | Quotient(Number(), Number()), Matrix())):
            return True
    return False


def _written(factor: Fraction, rest: tuple[Expr, ...]) -> Expr:
    """1/sqrt(n) for sqrt(n)/n."""
    match rest:
        case (Call("sqrt", (Number(value),)),) if factor * value == 1:
            return Quotient(ONE, sqrt(number(value)))
    above = multiply(number(factor.numerator), *rest)
    return above if factor.denominator == 1 else Quotient(above, number(factor.denominator))


def _entry(tree: Expr) -> _Entry | None:
    """The entry as a rational times roots; None for any other, a decimal too."""
    match tree:
        case Number(value, False):
            return _Entry(value)
        case Call("sqrt", (Number(_, False),)):
            return _Entry(Fraction(1), (tree,))
        case Product(factors):
            return _product([_entry(factor) for factor in factors])
        case Quotient(top, Number(value, False)) if value:
            above = _entry(top)
            return above and _Entry(above.rational / value, above.rest)
    return _Entry(Fraction(1), (tree,)) if tree == PI else None


def _product(parts: list[_Entry | None]) -> _Entry | None:
    total = _Entry(Fraction(1))
    for part in parts:
        if part is None:
            return None
        total = _Entry(total.rational * part.rational, total.rest + part.rest)
    return total
