"""Normal forms that are numbers: their values in ball arithmetic, and signs with as many bits as needed."""

from __future__ import annotations

from flint import arb, ctx

from derive.algebra.fixed_angles.constants import NUMBERS
from derive.algebra.infix import text
from derive.algebra.readable.form import readable
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable, NotReal

FEWEST_BITS, MOST_BITS = 128, 1 << 14  # with which a sign is asked for, at first and at most


def number_ball(value: Scalar) -> arb:
    """The value, at the working precision of FLINT. Raises KeyError where a symbol is left."""
    return NUMBERS.quotient(value)


def number_sign(value: Scalar) -> int:
    """1, 0 or -1. Raises KeyError where a symbol is left, and NotDerivable where no number of bits tells."""
    if not value:
        return 0
    if (exact := value.constant) is not None:
        return 1 if exact > 0 else -1
    bits = FEWEST_BITS
    while bits <= MOST_BITS:
        with ctx.workprec(bits):
            ball = number_ball(value)
            if ball > 0 or ball < 0:
                return 1 if ball > 0 else -1
        bits *= 2
    if ball.is_nan():
        raise NotReal(f"{text(readable(value))} is not real")
    raise NotDerivable(f"{MOST_BITS} bits do not tell whether {text(readable(value))} is zero")
