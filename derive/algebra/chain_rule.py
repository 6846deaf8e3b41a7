"""Partial derivatives through functions of functions, by the chain rule over the generators of a ring.

Each generator that depends on a name contributes its own rate: sin(u) that of u times cos(u), a root with
r^n = u that of u over n r^(n - 1), exp(u) and its like by the table below. The arguments are scalars
themselves, so this goes as deep as they do. Rings without such functions take the faster way of
`derive.algebra.calculus`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from derive.algebra.opaque import Opaque
from derive.algebra.ring import Ring
from derive.algebra.roots_and_functions import opaque
from derive.algebra.roots_and_functions import root as square_root
from derive.algebra.scalar import Scalar
from derive.algebra.trigonometry import angle_of
from derive.errors import NotDerivable

# d f(u) by u, given f(u) itself and u.
RATES: Mapping[str, Callable[[Scalar, Scalar], Scalar]] = {
    "exp": lambda f, u: f,
    "log": lambda f, u: 1 / u,
    "atan": lambda f, u: 1 / (1 + u * u),
    "asin": lambda f, u: 1 / square_root(1 - u * u),
    "acos": lambda f, u: -1 / square_root(1 - u * u),
}


def along(value: Scalar, name: str) -> Scalar:
    """The partial derivative of a scalar without a denominator by a name.

    Raises NotDerivable where the name stands inside a function that has no rate here.
    """
    home = value.ring
    total = Scalar.of(0)
    for place, generator in enumerate(home.names):
        slope = value.numerator.derivative(place)
        if slope != 0 and (rate := _rate(home, generator, place, name)):
            total = total + Scalar(home, home.reduce(slope)) * rate
    return total


def _rate(home: Ring, generator: str, place: int, name: str) -> Scalar:
    """The derivative of one generator."""
    roots, angles = len(home.roots), len(home.angles)
    if place < roots:
        root = home.roots[place]
        rate = Scalar(home, home.polynomial(root.radicand)).diff(name)
        below = Scalar(home, home.gen(root.name)) ** (root.degree - 1) * root.degree
        return rate / below if rate else rate
    if place < roots + 2 * angles:
        is_cosine, k = divmod(place - roots, angles)
        rate = angle_of(home.angles[k]).diff(name)
        c, s = (Scalar(home, generator) for generator in home.pair(k))
        return -s * rate if is_cosine else c * rate
    if isinstance(generator, Opaque):
        return _of_function(generator, name)
    return Scalar.of(int(generator == name))


def _of_function(generator: Opaque, name: str) -> Scalar:
    arguments, rates = generator.arguments, [argument.diff(name) for argument in generator.arguments]
    if not any(rates):
        return Scalar.of(0)
    value = Scalar.symbol(generator)
    if generator.function == "atan2":
        (y, x), (dy, dx) = arguments, rates
        return (x * dy - y * dx) / (x * x + y * y)
    if generator.function == "pow":
        (base, exponent), (base_rate, exponent_rate) = arguments, rates
        grown = value * opaque("log", (base,)) * exponent_rate if exponent_rate else exponent_rate
        return value * exponent * base_rate / base + grown
    if generator.function not in RATES:
        raise NotDerivable(f"the derivative of {generator.function} by {name} is not known")
    return RATES[generator.function](value, arguments[0]) * rates[0]
