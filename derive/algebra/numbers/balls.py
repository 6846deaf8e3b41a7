"""Numbers in normal form in ball arithmetic: their values, and signs with as many bits as that takes."""

from __future__ import annotations

from functools import lru_cache

from flint import arb, ctx, fmpq_mpoly

from derive.algebra.infix import text
from derive.algebra.precise import precise
from derive.algebra.readable.form import readable
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable, NotReal

BITS, MOST_BITS = 128, 1 << 14  # of the working precision, at first and at most


def number_ball(value: Scalar) -> arb:
    """The value, at the working precision of FLINT. Raises KeyError where a symbol is left."""
    top = _polynomial(value.numerator, value.ring)
    return top if value.denominator is None else top / _polynomial(value.denominator, value.ring)


def number_sign(value: Scalar) -> int:
    """1, 0 or -1. Raises KeyError where a symbol is left, and NotDerivable where no number of bits tells."""
    if not value:
        return 0
    if (exact := value.constant) is not None:
        return 1 if exact > 0 else -1
    bits = BITS
    while bits <= MOST_BITS:
        with ctx.workprec(bits):
            ball = number_ball(value)
            if ball > 0 or ball < 0:
                return 1 if ball > 0 else -1
        bits *= 2
    if ball.is_nan():
        raise NotReal(f"{text(readable(value))} is not real")
    raise NotDerivable(f"{MOST_BITS} bits do not tell whether {text(readable(value))} is zero")


def _polynomial(polynomial: fmpq_mpoly, home: Ring) -> arb:
    total = arb(0)
    for exponents, coefficient in polynomial.terms():
        term = arb(coefficient)
        for name, power in zip(home.names, exponents, strict=True):
            term = term * _generator(home, name, ctx.prec) ** int(power) if power else term
        total = total + term
    return total


@lru_cache(maxsize=1024)
def _generator(home: Ring, name: str, bits: int) -> arb:
    """The value of a generator, at the working precision of so many bits."""
    return precise(readable(Scalar(home, home.gen(name))), {})
