"""Which generators of a ring are numbers, and the values of polynomials in them, in ball arithmetic.

A ball that does not hold zero proves that a number is not zero; one that holds it proves nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Protocol

from flint import arb, ctx, fmpq, fmpq_mpoly

from derive.algebra.angles import Form
from derive.algebra.generators import ITSELF, PI, Opaque
from derive.algebra.multivariate import ball_at
from derive.algebra.rationals import to_flint
from derive.algebra.ring import Ring

BITS = 192
FUNCTIONS: Mapping[str, Callable[..., arb]] = {
    "cos": arb.cos, "sin": arb.sin, "tan": arb.tan, "sqrt": arb.sqrt, "exp": arb.exp, "log": arb.log,
    "acos": arb.acos, "asin": arb.asin, "atan": arb.atan, "atan2": arb.atan2, "abs": abs, "sign": arb.sgn,
    "pow": arb.__pow__,
}  # fmt: skip


class Quotient(Protocol):
    """What functions are applied to: a scalar, by its parts."""

    ring: Ring
    numerator: fmpq_mpoly
    denominator: fmpq_mpoly | None


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
    """The value of a polynomial in generators that are numbers, with 192 bits."""
    with ctx.workprec(BITS):
        return ball_at(number, _values(home).__getitem__)


def holds_zero(value: arb) -> bool:
    """Whether a ball holds zero, so that the number may be zero."""
    return bool(value.contains(arb(0)))


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
    values = [_quotient(argument) for argument in name.arguments]
    return values[0] if name.function == ITSELF else FUNCTIONS[name.function](*values)


def _quotient(value: Quotient) -> arb:
    known = _values(value.ring).__getitem__
    top = ball_at(value.numerator, known)
    return top if value.denominator is None else top / ball_at(value.denominator, known)
