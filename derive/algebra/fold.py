"""One walk of a tree for everything that scalar trees can be worth; a domain says what each node becomes.

The domains stand where their values are used: floats and balls in `numbers`, fractions in `formulas`, SymPy's
expressions in `interop`, complex numbers and arrays where a second route needs them. A new node is one more
branch of `fold` and one more method of `Domain`. (This is the mapper of pymbolic, or a fold over an algebraic
data type. The normal form keeps a walk of its own, `normal.Walk`, which knows names and delays reduction, and
so does `numbers.compiled`, which computes parts that are the same object once.)
"""

from __future__ import annotations

from fractions import Fraction
from functools import reduce
from operator import add, mul, pow, truediv
from typing import Generic, NoReturn, TypeVar

from derive.errors import NotDerivable
from derive.expression import (
    Approximate,
    Call,
    Degrees,
    Expr,
    Matrix,
    Measured,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)

T = TypeVar("T")


class Domain(Generic[T]):
    """What the nodes of a tree become: sums, products, quotients and powers by Python's operators unless a
    domain knows better. What it does not define is refused with NotDerivable."""

    def number(self, value: Fraction) -> T:
        """An exact rational."""
        return self.refuse("number")

    def approximate(self, value: float) -> T:
        """A number known to floating point only."""
        return self.refuse("floating-point number")

    def degrees(self, value: Fraction) -> T:
        """An angle of so many degrees."""
        return self.refuse("angle in degrees")

    def symbol(self, name: str) -> T:
        """A letter, or `pi`."""
        return self.refuse(name)

    def sum(self, terms: list[T]) -> T:
        """What terms add up to, in their order."""
        return reduce(add, terms)

    def product(self, factors: list[T]) -> T:
        """What factors make, in their order."""
        return reduce(mul, factors)

    def quotient(self, top: T, bottom: T) -> T:
        """A fraction."""
        quotient: T = truediv(top, bottom)
        return quotient

    def power(self, base: T, exponent: T) -> T:
        """A power."""
        power: T = pow(base, exponent)
        return power

    def raised(self, base: T, times: int) -> T:
        """A power with a whole exponent."""
        power: T = pow(base, times)
        return power

    def root(self, value: T, degree: int) -> T:
        """The root of this degree."""
        return self.power(value, self.number(Fraction(1, degree)))

    def knows(self, name: str) -> bool:
        """Whether a function that normal forms keep, `exp(x)`, has its value here under its name."""
        return False

    def call(self, function: str, arguments: list[T]) -> T:
        """A function by name."""
        return self.refuse(function)

    def matrix(self, rows: list[list[T]]) -> T:
        """Rows of entries."""
        return self.refuse("matrix")

    def refuse(self, what: str) -> NoReturn:
        """Raises NotDerivable for what has no place in this domain."""
        raise NotDerivable(f"no number for {what}")


def fold(expr: Expr, domain: Domain[T]) -> T:
    """What a tree becomes in a domain, its parts first. Raises what the domain raises, NotDerivable for nodes
    that have no value of their own, such as an indexed name."""
    # in the order of how often they occur; a `match` on dataclasses takes twice as long
    if isinstance(expr, Symbol):
        return domain.symbol(expr.name)
    if isinstance(expr, Number):
        return domain.number(expr.value)
    if isinstance(expr, Product):
        return domain.product([fold(factor, domain) for factor in expr.factors])
    if isinstance(expr, Call):
        return domain.call(expr.function, [fold(argument, domain) for argument in expr.arguments])
    if isinstance(expr, Sum):
        return domain.sum([fold(term, domain) for term in expr.terms])
    if isinstance(expr, Power):
        return domain.power(fold(expr.base, domain), fold(expr.exponent, domain))
    if isinstance(expr, Quotient):
        return domain.quotient(fold(expr.numerator, domain), fold(expr.denominator, domain))
    if isinstance(expr, Degrees):
        return domain.degrees(expr.value)
    if isinstance(expr, Approximate):
        return domain.approximate(expr.value)
    if isinstance(expr, Matrix):
        return domain.matrix([[fold(entry, domain) for entry in row] for row in expr.rows])
    if isinstance(expr, Measured):
        return fold(expr.value, domain)
    return domain.refuse(type(expr).__name__)
