"""Which generators of a ring are numbers, and the values of polynomials in them, in ball arithmetic.

A ball that does not hold zero proves that a number is not zero; one that holds it proves nothing.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from flint import arb, ctx, fmpq, fmpq_mpoly

from derive.algebra.angles import PI, Form
from derive.algebra.opaque import ITSELF, Opaque
from derive.algebra.precise import FUNCTIONS
from derive.algebra.rationals import to_flint
from derive.algebra.ring import Ring

if TYPE_CHECKING:
    from derive.algebra.scalar import Scalar

BITS = 192


def is_number(name: str, home: Ring) -> bool:
    """Whether a generator is a number: pi, a root of numbers, the sine of a fixed angle, exp(1)."""
    return home.index[name] in number_places(home)


@lru_cache(maxsize=1024)
def number_places(home: Ring) -> frozenset[int]:
    """The places of the generators that are numbers."""
    return frozenset(
        place
        for place, name in enumerate(home.names)
        if not home.letters(name) and not (isinstance(name, Opaque) and name.function not in FUNCTIONS)
    )


def ball(number: fmpq_mpoly, home: Ring) -> arb:
    """The value of a polynomial in generators that are numbers."""
    with ctx.workprec(BITS):
        return _polynomial(number, home)


def holds_zero(value: arb) -> bool:
    return bool(value.contains(arb(0)))


def _polynomial(number: fmpq_mpoly, home: Ring) -> arb:
    values, total = _values(home), arb(0)
    for exponents, coefficient in number.terms():
        term = arb(coefficient)
        for place, power in enumerate(exponents):
            if power:
                term = term * values[place] ** int(power)
        total = total + term
    return total


@lru_cache(maxsize=1024)
def _values(home: Ring) -> dict[int, arb]:
    """Of each number among the generators, by place; only called at the working precision above."""
    numbers = number_places(home)
    found = {i: _symbol(name) for i, name in enumerate(home.names) if i in numbers and name in home.symbols}
    for k, form in enumerate(home.angles):
        if not form.moving.parts:
            at, (c, s) = _angle(form), home.pair_index(k)
            found[c], found[s] = at.cos(), at.sin()
    for place, root in reversed(tuple(enumerate(home.roots))):
        if place in numbers:
            inside = arb(0)
            for powers, coefficient in root.radicand:
                term = arb(to_flint(coefficient))
                for name, power in powers:
                    term = term * found[home.index[name]] ** power
                inside = inside + term
            found[place] = inside.nonnegative_part().root(root.degree)
    return found


def _angle(form: Form) -> arb:
    return sum((_symbol(atom) * arb(fmpq(n.numerator, n.denominator)) for atom, n in form.parts), arb(0))


def _symbol(name: str) -> arb:
    """Of a symbol, or of an atom of an angle."""
    if not isinstance(name, Opaque):  # a power of pi, or one radian
        base, _, power = name.partition("^")
        return arb.pi() ** int(power or 1) if base == PI else arb(1)
    values = [_scalar(argument) for argument in name.arguments]
    return values[0] if name.function == ITSELF else FUNCTIONS[name.function](*values)


def _scalar(value: Scalar) -> arb:
    top = _polynomial(value.numerator, value.ring)
    return top if value.denominator is None else top / _polynomial(value.denominator, value.ring)
