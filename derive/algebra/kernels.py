"""Generators for what is no polynomial: square roots of expressions, and functions left as they are."""

from __future__ import annotations

from fractions import Fraction

from derive.algebra.fixed import square_root
from derive.algebra.ring import Root
from derive.algebra.scalar import Scalar, as_fraction


def root(of: Scalar) -> Scalar:
    """The square root. Squares come out as absolute values; sqrt(p/q) is sqrt(p q)/|q|."""
    if of.constant is not None:
        return square_root(of.constant)
    if of.denominator is not None:
        bottom = Scalar(of.ring, of.denominator)
        return root(Scalar(of.ring, of.ring.reduce(of.numerator * of.denominator))) / absolute(bottom)
    content, factors = of.numerator.factor_squarefree()
    outside, inside = Scalar.of(1), Scalar(of.ring, of.ring.constant(as_fraction(content)))
    for factor, power in factors:
        part = Scalar(of.ring, of.ring.reduce(factor))
        outside = outside * absolute(part) ** (power // 2)
        inside = inside * part if power % 2 else inside
    number = as_fraction(content)
    square = number if number > 0 else -number
    return outside * square_root(square) * _root_of_rest(inside / square)


def absolute(of: Scalar) -> Scalar:
    """|of|, as the root of its square; positive numbers come out."""
    if of.constant is not None:
        return Scalar.of(abs(of.constant))
    monic = of / _lead(of)
    return _generator(f"abs({canonical(monic)})", monic * monic) * abs(_lead(of))


def opaque(function: str, arguments: tuple[Scalar, ...]) -> Scalar:
    """A function the normal form knows nothing about: equal where its arguments are."""
    return Scalar.symbol(f"{function}({', '.join(map(canonical, arguments))})")


def canonical(value: Scalar) -> str:
    """A text that is the same for equal polynomials, whatever their rings."""
    bottom = "" if value.denominator is None else f"/({_terms(value, of_bottom=True)})"
    return f"({_terms(value)}){bottom}"


def _terms(value: Scalar, of_bottom: bool = False) -> str:
    polynomial = value.denominator if of_bottom and value.denominator is not None else value.numerator
    names = value.ring.names
    texts = []
    for exponents, coefficient in polynomial.terms():
        powers = sorted((n, e) for n, e in zip(names, exponents, strict=True) if e)
        texts.append("*".join([str(coefficient), *(f"{n}^{e}" for n, e in powers)]))
    return "+".join(sorted(texts)) or "0"


def _root_of_rest(inside: Scalar) -> Scalar:
    if inside.constant == 1:
        return Scalar.of(1)
    return _generator(f"sqrt({canonical(inside)})", inside)


def _generator(name: str, square: Scalar) -> Scalar:
    """A new outermost root with this square."""
    home = square.ring.with_root(Root(name, square.ring.terms(square.numerator)))
    return Scalar(home, home.gen(name))


def _lead(of: Scalar) -> Fraction:
    return as_fraction(of.numerator.leading_coefficient())
