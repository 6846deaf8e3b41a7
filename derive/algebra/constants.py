"""Which generators of a ring are numbers, and the values of polynomials in them, in ball arithmetic.

A ball that does not hold zero proves that a number is not zero; one that holds it proves nothing.
"""

from __future__ import annotations

from functools import lru_cache

from flint import arb, ctx, fmpq, fmpq_mpoly

from derive.algebra.angles import PI, RADIAN, Form
from derive.algebra.grammar import parse
from derive.algebra.precise import precise
from derive.algebra.rationals import to_flint
from derive.algebra.ring import Ring

BITS = 192


def is_number(name: str, home: Ring) -> bool:
    """Whether a generator is a root of numbers or the sine or cosine of a fixed angle."""
    return home.index[name] in number_places(home)


@lru_cache(maxsize=1024)
def number_places(home: Ring) -> frozenset[int]:
    """The places of the generators that are numbers; a root of a number comes after those it stands in."""
    found = {i for k, form in enumerate(home.angles) if not form.moving.parts for i in home.pair_index(k)}
    for place, root in reversed(tuple(enumerate(home.roots))):
        if all(home.index[name] in found for powers, _ in root.radicand for name, _ in powers):
            found.add(place)
    return frozenset(found)


def ball(number: fmpq_mpoly, home: Ring) -> arb:
    """The value of a polynomial in generators that are numbers."""
    with ctx.workprec(BITS):
        values, total = _values(home), arb(0)
        for exponents, coefficient in number.terms():
            term = arb(coefficient)
            for place, power in enumerate(exponents):
                if power:
                    term = term * values[place] ** int(power)
            total = total + term
        return total


def holds_zero(value: arb) -> bool:
    return bool(value.contains(arb(0)))


@lru_cache(maxsize=1024)
def _values(home: Ring) -> dict[int, arb]:
    """Of each number among the generators."""
    found: dict[int, arb] = {}
    for k, form in enumerate(home.angles):
        if not form.moving.parts:
            at, (c, s) = angle_value(form), home.pair_index(k)
            found[c], found[s] = at.cos(), at.sin()
    numbers = number_places(home)
    for place, root in reversed(tuple(enumerate(home.roots))):
        if place in numbers:
            inside = arb(0)
            for powers, coefficient in root.radicand:
                term = arb(to_flint(coefficient))
                for name, power in powers:
                    term = term * found[home.index[name]] ** power
                inside = inside + term
            found[place] = inside.nonnegative_part().sqrt()
    return found


def angle_value(form: Form) -> arb:
    """A fixed angle in radians."""
    return sum((_atom(atom) * arb(fmpq(n.numerator, n.denominator)) for atom, n in form.parts), arb(0))


def _atom(atom: str) -> arb:
    known = {PI: arb.pi(), RADIAN: arb(1)}
    return known[atom] if atom in known else precise(parse(atom), {})
