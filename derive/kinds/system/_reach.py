"""Which coefficients of the characteristic polynomial the gains of a controller set, and which stay."""

from __future__ import annotations

import cmath
from collections.abc import Callable, Iterator, Sequence

from derive.control.controllers import GAINS, Controller
from derive.control.oracle.equations import pid, value
from derive.control.rational import Polynomial
from derive.derivation import Phrase
from derive.expression import ONE, Expr, Number, Product, Quotient, Symbol, number
from derive.kinds.system._oracle import Held, Point, reals

S = Symbol("s")
POWERS = {"P": 0, "I": -1, "D": 1}  # of s, by which each term multiplies the error
NOTHING = 1e-8  # of the largest coefficient


def reach(controller: Controller, numerator: Polynomial, order: int, taken: frozenset[str]) -> Phrase | None:
    """What is said of the polynomial D_C D_G + N_C N_G of degree `order`, with the `numerator` of the plant;
    None where a gain is no symbol and no number, or its usual name is taken, or the input moves nothing."""
    gains = gain_names(controller, taken)
    powers = [len(numerator) - 1 - place for place, k in enumerate(numerator) if k]
    shifts = [POWERS[letter] + controller.integrates for letter in controller.family]
    found = [frozenset(power + shift for power in powers) for shift in shifts]
    return told_reach(gains, found, order) if gains is not None and all(found) else None


def gain_names(controller: Controller, taken: frozenset[str]) -> tuple[Expr, ...] | None:
    """Each gain by its symbol, where it is a number by the usual one."""
    names = [
        Symbol(GAINS[letter]) if isinstance(gain, Number) else gain
        for letter, gain in zip(controller.family, controller.gains, strict=True)
    ]
    distinct = len({*names}) == len(names) and all(isinstance(name, Symbol) for name in names)
    return tuple(names) if distinct and taken.isdisjoint(map(str, names)) else None


def told_reach(gains: Sequence[Expr], found: Sequence[frozenset[int]], order: int) -> Phrase:
    """The powers of s that each gain reaches, in words."""
    reached = frozenset[int]().union(*found)
    alone = len(reached) == len(gains) and all(len(each) == 1 for each in found)
    what = [{"gain": gain, "what": _named(each)} for gain, each in zip(gains, found, strict=True)]
    first = sorted(range(len(gains)), key=lambda k: -max(found[k]))
    sets = tuple(Phrase("sets" if alone else "changes", what[k]) for k in first)
    left = frozenset(range(order + 1)) - reached
    if not left:
        return Phrase("reached", {"sets": sets})
    key = "sum-stays" if {order, order - 1} <= left and order > 1 else "others-stay"
    out = Phrase("is-out" if len(left) == 1 else "are-out", {"left": _named(left)})
    return Phrase(key, {"sets": sets, "out": out})


def _named(powers: frozenset[int]) -> tuple[Phrase, ...]:
    """The coefficients of these powers, highest first."""
    named = tuple(S if k == 1 else S ** number(k) for k in sorted(powers, reverse=True) if k)
    what = {0: (), 1: (Phrase("that-of", {"power": named}),)}.get(
        len(named), (Phrase("those-of", {"powers": named}),)
    )
    return (*what, Phrase("constant-term")) if 0 in powers else what


def is_reach(told: Phrase | None, held: Held, whole: Expr, order: int, at: Point) -> Iterator[bool]:
    """The coefficients that a gain reaches are those of the numerator of the loop as it is printed, `whole`,
    without the controller and with the term of the gain alone."""
    if told is None or held.controller is None or order < 1:
        return
    factors = whole.factors if isinstance(whole, Product) else (whole,)
    below = next((each.denominator for each in factors if isinstance(each, Quotient)), ONE)

    def through(letter: str, s: complex) -> complex:
        there = {**at, "s": s}
        top = value(whole, there) * value(below, there)
        return top * pid(letter, (1.0,), s) / held.strength(reals(at), s)

    found = [_powers(letter, through, order) for letter in held.controller.family]
    gains = gain_names(held.controller, held.system.names)
    yield gains is not None and told == told_reach(gains, found, order)


def _powers(letter: str, through: Callable[[str, complex], complex], order: int) -> frozenset[int]:
    """The powers of a polynomial with a coefficient that is not zero, by its values on the unit circle."""
    count = order + 2
    circle = [cmath.exp(2j * cmath.pi * k / count) for k in range(count)]
    values = [through(letter, s) for s in circle]
    sizes = [abs(sum(v * s**-k for s, v in zip(circle, values, strict=True))) for k in range(count)]
    return frozenset(k for k, size in enumerate(sizes) if size > NOTHING * max(sizes))
