"""Which generators of a ring are numbers, and the values of polynomials in them, in ball arithmetic.

A ball that does not hold zero proves that a number is not zero; one that holds it proves nothing.
"""

from __future__ import annotations

from functools import lru_cache

from flint import arb, ctx, fmpq, fmpq_mpoly

from derive.algebra.ball_arithmetic import FUNCTIONS, balls
from derive.algebra.evaluation import Evaluation
from derive.algebra.generators import Opaque
from derive.algebra.ring import Ring

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


class _Numbers(Evaluation[arb]):
    """Values at the working precision, remembered for each generator."""

    def coefficient(self, value: fmpq) -> arb:
        return arb(value)

    def generator(self, home: Ring, place: int) -> arb:
        return _generator(home, place, ctx.prec)


NUMBERS = _Numbers(balls({}))  # of normal forms in generators that are numbers


@lru_cache(maxsize=4096)
def _generator(home: Ring, place: int, bits: int) -> arb:
    return Evaluation.generator(NUMBERS, home, place)


def ball(number: fmpq_mpoly, home: Ring) -> arb:
    """The value of a polynomial in generators that are numbers, with 192 bits."""
    with ctx.workprec(BITS):
        return NUMBERS.polynomial(number, home)


def holds_zero(value: arb) -> bool:
    """Whether a ball holds zero, so that the number may be zero."""
    return bool(value.contains(arb(0)))
