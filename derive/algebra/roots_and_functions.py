"""Generators for what is no polynomial: roots of expressions, and functions left as they are."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import reduce
from operator import mul

from flint import fmpq_mpoly

from derive.algebra.angles import Form
from derive.algebra.exact_values import square_root
from derive.algebra.fixed_angles.constants import ball, holds_zero, is_number
from derive.algebra.generators import Opaque, Root
from derive.algebra.multivariate import factored, square_free
from derive.algebra.rationals import Rational, as_fraction, measure, to_flint
from derive.algebra.ring import Ring, ring
from derive.algebra.scalar import Scalar

# The derivative of a function from its value f, its arguments u, v and their derivatives du, dv.
RATES: Mapping[str, Callable[..., Scalar]] = {
    "exp": lambda f, u, du: f * du,
    "log": lambda f, u, du: 1 / u * du,
    "atan": lambda f, u, du: 1 / (1 + u * u) * du,
    "asin": lambda f, u, du: 1 / root(1 - u * u) * du,
    "acos": lambda f, u, du: -1 / root(1 - u * u) * du,
    "atan2": lambda f, y, x, dy, dx: (x * dy - y * dx) / (x * x + y * y),
    "pow": lambda f, u, n, du, dn: f * n * du / u + (f * opaque("log", (u,)) * dn if dn else dn),
}
# Functions with an argument at which they have a simple value, and that value.
AT = {"exp": (0, 1), "log": (1, 0), "atan": (0, 0), "asin": (0, 0), "acos": (1, 0)}


def root(of: Scalar) -> Scalar:
    """The square root, which is not negative: squares come out as absolute values, 1 - cos^2 as that of a
    sine, and sqrt(p/q) is sqrt(p q)/|q|. Raises NotReal for a negative number."""
    if of.constant is not None:
        return square_root(of.constant)
    if of.denominator is not None:
        bottom = Scalar(of.ring, of.denominator)
        return root(Scalar(of.ring, of.ring.reduce(of.numerator * of.denominator))) / absolute(bottom)
    content, factors = square_free(of.numerator)
    outside, inside = Scalar.of(1), of.ring.constant(as_fraction(content))
    for factor, power in factors:
        outside = outside * absolute(Scalar(of.ring, of.ring.reduce(factor))) ** (power // 2)
        inside = inside * factor if power % 2 else inside
    number = abs(as_fraction(content))
    sines, left = _sines(of.ring, inside / to_flint(number))
    return outside * sines * square_root(number) * _root_of_rest(Scalar(of.ring, of.ring.reduce(left)))


def absolute(of: Scalar) -> Scalar:
    """|of|, each factor's as the root of its square. Numbers come out; a sum of squares is its own."""
    if of.denominator is not None:
        return absolute(Scalar(of.ring, of.numerator)) / absolute(Scalar(of.ring, of.denominator))
    sign = _sign(of)
    if sign is not None:
        return of * sign
    content, factors = factored(of.numerator)
    parts = [_irreducible(Scalar(of.ring, of.ring.reduce(factor))) ** power for factor, power in factors]
    return reduce(mul, parts, Scalar.of(abs(as_fraction(content))))


def _irreducible(of: Scalar) -> Scalar:
    """|of| of what is no product."""
    sign = _sign(of)
    if sign is not None:
        return of * sign
    lead = _lead(in_single_angles(of))
    monic = of / lead
    return generator("abs", (monic,), monic * monic) * abs(lead)


def opaque(function: str, arguments: tuple[Scalar, ...]) -> Scalar:
    """A function that the normal form keeps as a generator, equal where its arguments are; exp(0) and its
    like have their values."""
    if function in AT and arguments[0].constant == AT[function][0]:
        return Scalar.of(AT[function][1])
    return Scalar.symbol(_named(function, arguments))


def _named(function: str, arguments: tuple[Scalar, ...]) -> Opaque[Scalar]:
    text = f"{function}({', '.join(map(canonical, arguments))})"
    return Opaque(text, function, arguments, RATES.get(function))


def canonical(value: Scalar) -> str:
    """A text that is the same for equal polynomials, whatever their rings: over single angles, or over
    such parts of them as the polynomial needs."""
    value = in_single_angles(value)
    bottom = "" if value.denominator is None else f"/({_terms(value.ring, value.denominator)})"
    return f"({_terms(value.ring, value.numerator)}){bottom}"


def in_single_angles(value: Scalar) -> Scalar:
    """The same over single angles, or over such parts of them as the polynomial needs."""
    used = set(value.generators())
    forms = [form for form in value.ring.angles if {f"cos({form})", f"sin({form})"} & used]
    if all(not form.moving.parts or (len(form.parts) == 1 and form.parts[0][1] > 0) for form in forms):
        return value
    coefficients: dict[str, list[Rational]] = {}
    for form in forms:
        for atom, n in form.moving.parts:
            coefficients.setdefault(atom, []).append(n)
    singles = tuple(Form.of({atom: measure(ns)}) for atom, ns in sorted(coefficients.items()))
    return value.into(ring((), singles, value.ring.symbols).union(value.ring))


def _terms(home: Ring, polynomial: fmpq_mpoly) -> str:
    texts = []
    for exponents, coefficient in polynomial.terms():
        powers = sorted((n, e) for n, e in zip(home.names, exponents, strict=True) if e)
        texts.append("*".join([str(coefficient), *(f"{n}^{e}" for n, e in powers)]))
    return "+".join(sorted(texts))


def _sines(home: Ring, inside: fmpq_mpoly) -> tuple[Scalar, fmpq_mpoly]:
    """(|sines|, what is left): each factor 1 - cos^2 is the square of a sine."""
    outside = Scalar.of(1)
    for k in range(len(home.angles)):
        c, s = home.pair(k)
        left, rest = divmod(inside, 1 - c * c)
        if rest == 0 and left != -1:  # -sin^2 has no root
            outside, inside = outside * absolute(Scalar(home, s)), left
    return outside, inside


def _root_of_rest(inside: Scalar) -> Scalar:
    if inside.constant == 1:
        return Scalar.of(1)
    return generator("sqrt", (inside,), inside)


def generator(function: str, arguments: tuple[Scalar, ...], inside: Scalar, degree: int = 2) -> Scalar:
    """The root of this degree of `inside`, as a new generator outside all others, named after the
    function."""
    name = _named(function, arguments)
    home = inside.ring.with_root(Root(name, inside.ring.terms(inside.numerator), degree))
    return Scalar(home, home.gen(name))


def _sign(of: Scalar) -> int | None:
    """1 or -1 for a number, and 1 for a sum of squares: even powers with positive numbers before them."""
    terms = [(as_fraction(k), powers) for powers, k in of.numerator.terms()]
    if all(k > 0 and not any(int(e) % 2 for e in powers) for k, powers in terms):
        return 1
    if all(is_number(name, of.ring) for name in of.generators()):
        value = ball(of.numerator, of.ring)
        return None if holds_zero(value) else 1 if value > 0 else -1
    return None


def _lead(of: Scalar) -> Fraction:
    """The number before the term that comes first by its letters, which is the same in any ring."""
    names = of.ring.names

    def letters(powers: tuple[int, ...]) -> list[tuple[str, int]]:
        return sorted((name, int(e)) for name, e in zip(names, powers, strict=True) if e)

    terms = [(letters(powers), as_fraction(number)) for powers, number in of.numerator.terms()]
    return min(terms, key=lambda term: (not term[0], term[0]))[1]
