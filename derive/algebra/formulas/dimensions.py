"""The dimension of a formula: what its names measure, multiplied and divided as they are.

A number has none, and zero has any. Radians count in what is said of a result, and not in what may be added.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from derive.algebra.fold import Domain, fold
from derive.algebra.formulas.functions import INVERSE, TRIGONOMETRIC
from derive.algebra.formulas.units import ANGLE, PLAIN, Dimension, power, times
from derive.errors import NotDerivable
from derive.expression import Expr

# The dimension, and the number it is the dimension of where that is known; no dimension where that is zero.
Found = tuple[Dimension | None, Fraction | None]
LIKE_THEIR_ARGUMENT = ("abs",)


class Unlike(NotDerivable):
    """Quantities of different dimensions are added, or one has a sine."""


def dimension_of_formula(expr: Expr, known: Mapping[str, Dimension | None]) -> Dimension:
    """The dimension of a scalar formula in which the names measure what is known of them, None where
    they are zero; plain where it is zero. Raises Unlike where it cannot be right, NotDerivable where a name
    or a function is not known."""
    return fold(expr, _Dimensions(known))[0] or PLAIN


def comparable(left: Dimension, right: Dimension) -> bool:
    """Whether they may be added; radians do not count."""
    return left[:4] == right[:4]


@dataclass(frozen=True, slots=True)
class _Dimensions(Domain[Found]):
    known: Mapping[str, Dimension | None]

    def number(self, value: Fraction) -> Found:
        return (PLAIN if value else None), value

    def approximate(self, value: float) -> Found:
        return (PLAIN if value else None), None

    def degrees(self, value: Fraction) -> Found:
        return (ANGLE if value else None), None

    def symbol(self, name: str) -> Found:
        if name == "pi":
            return PLAIN, None
        return (self.known[name], None) if name in self.known else self.refuse(name)

    def sum(self, terms: list[Found]) -> Found:
        total: Dimension | None = None
        for dimension, _ in terms:
            if total and dimension and not comparable(total, dimension):
                raise Unlike("what is added is not alike")
            total = total if total not in (None, PLAIN) else dimension or total
        return total, None

    def product(self, factors: list[Found]) -> Found:
        total = PLAIN
        for dimension, _ in factors:
            if dimension is None:
                return None, None
            total = times(total, dimension)
        return total, None

    def quotient(self, top: Found, bottom: Found) -> Found:
        if top[0] is None or bottom[0] is None:
            return None, None
        value = None if None in (top[1], bottom[1]) else Fraction(top[1] or 0) / Fraction(bottom[1] or 1)
        return times(top[0], power(bottom[0], -1)), value

    def power(self, base: Found, exponent: Found) -> Found:
        if base[0] is None or base[0] == PLAIN:
            return base[0], None
        if exponent[1] is None:
            raise NotDerivable("a quantity to a power that is no number")
        m, kg, s, a, rad = (part * exponent[1] for part in base[0])
        if any(part.denominator != 1 for part in (m, kg, s, a)):
            raise Unlike("a root of what is no square")
        return (int(m), int(kg), int(s), int(a), int(rad)), None

    def raised(self, base: Found, times: int) -> Found:
        return self.power(base, (PLAIN, Fraction(times)))

    def call(self, function: str, arguments: list[Found]) -> Found:
        (first, _), *_ = arguments
        if function == "sqrt":
            return self.power(arguments[0], (PLAIN, Fraction(1, 2)))
        if function == "atan2":
            self.sum(arguments)
            return ANGLE, None
        if function in LIKE_THEIR_ARGUMENT:
            return first, None
        if function not in TRIGONOMETRIC | INVERSE | {"exp", "log", "sign"}:
            self.refuse(function)
        if function != "sign" and first and not comparable(first, PLAIN):
            raise Unlike(f"{function} of a quantity that has a unit")
        return (ANGLE if function in INVERSE else PLAIN), None
