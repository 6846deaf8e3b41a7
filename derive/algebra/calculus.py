"""Partial derivatives of polynomials of a ring, by the chain rule through angles and roots of polynomials.

Functions of functions are left to `derive.algebra.scalar`.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache

from flint import fmpq_mpoly

from derive.algebra.angles import Form
from derive.algebra.rationals import Rational
from derive.algebra.ring import Ring

Powers = tuple[tuple[str, int], ...]

ONE = ((Fraction(1), ()),)  # the rate of a joint angle in its own form


def derivative(polynomial: fmpq_mpoly, home: Ring, name: str) -> tuple[fmpq_mpoly, fmpq_mpoly | None]:
    """(numerator, denominator) of the derivative by a symbol or an angle, in the same ring; the
    denominator is None where there is none (roots bring one)."""
    plain = _along_symbols_and_angles(polynomial, home, name)
    top, bottom = plain, None
    for root in home.roots:
        along = polynomial.derivative(home.index[root.name])
        inside = home.polynomial(root.radicand)
        if along == 0 or inside.is_constant():
            continue
        # r^n = u gives r' = u' / (n r^(n - 1))
        rate, rate_bottom = derivative(inside, home, name)
        below = root.degree * home.gen(root.name) ** (root.degree - 1)
        extra, extra_bottom = along * rate, below * (rate_bottom or home.one)
        top, bottom = top * extra_bottom + extra * (bottom or home.one), (bottom or home.one) * extra_bottom
    return home.reduce(top), bottom


@lru_cache(maxsize=1024)
def with_rates(home: Ring, name: str) -> Ring:
    """The ring with the symbols that the rates of its angles need: d cos(w t)/dt holds w."""
    needed = [
        symbol
        for form in home.angles
        for _, powers in _rate(form, name)
        for symbol, _ in powers
    ]  # fmt: skip
    return home.with_symbols(needed)


def _along_symbols_and_angles(polynomial: fmpq_mpoly, home: Ring, name: str) -> fmpq_mpoly:
    result = polynomial.derivative(home.index[name]) if name in home.index else home.zero
    turning = _turning(home, name)
    for k, rate in turning:
        (c, s), (c_at, s_at) = home.pair(k), home.pair_index(k)
        along = polynomial.derivative(s_at) * c - polynomial.derivative(c_at) * s
        result = result + (along if rate is None else along * rate)
    return home.reduce(result) if turning else result


@lru_cache(maxsize=1024)
def _turning(home: Ring, name: str) -> tuple[tuple[int, fmpq_mpoly | None], ...]:
    """(k, rate) of the angles of the ring that change with the name; None for a rate of 1."""
    rates = ((k, _rate(form, name)) for k, form in enumerate(home.angles))
    return tuple(
        (k, None if rate == ONE else home.polynomial((powers, n) for n, powers in rate))
        for k, rate in rates
        if rate
    )


@lru_cache(maxsize=1024)
def _rate(form: Form, name: str) -> tuple[tuple[Rational, Powers], ...]:
    """d form / d name as (coefficient, powers of symbols); an atom may be a product, `w*t^2`."""
    found = []
    for atom, coefficient in form.parts:
        powers = {f: int(n or 1) for f, _, n in (factor.partition("^") for factor in atom.split("*"))}
        if name in powers:
            n = powers.pop(name)
            rest = powers | ({name: n - 1} if n > 1 else {})
            found.append((coefficient * n, tuple(rest.items())))
    return tuple(found)
