"""Partial derivatives through functions the normal form keeps as they are: exp, log and the inverses.

Such a function is one generator, `exp(2*x)`. By the chain rule its rate is its own derivative at its
arguments times their rates; everything else is differentiated with it held fixed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

from derive.algebra.grammar import parse
from derive.algebra.kernels import root
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable
from derive.expression import Call, Expr

# d f(u) by u, given f(u) itself and u.
RATES: Mapping[str, Callable[[Scalar, Scalar], Scalar]] = {
    "exp": lambda f, u: f,
    "log": lambda f, u: 1 / u,
    "atan": lambda f, u: 1 / (1 + u * u),
    "asin": lambda f, u: 1 / root(1 - u * u),
    "acos": lambda f, u: -1 / root(1 - u * u),
}


def partial(value: Scalar, name: str, normal: Callable[[Expr], Scalar]) -> Scalar:
    """The partial derivative by a name; `normal` brings trees to their normal form.

    Raises NotDerivable where a function that holds the name has no rule here.
    """
    inner = [each for each in value.ring.opaque if _holds(each, name) and each in set(value.generators())]
    if not inner:
        return value.diff(name)
    held = {each: f"held_{k}" for k, each in enumerate(inner, 1)}
    fixed = value.substitute({each: Scalar.symbol(stand_in) for each, stand_in in held.items()})
    total = fixed.diff(name)
    for each, stand_in in held.items():
        total = total + fixed.diff(stand_in) * _rate(each, name, normal)
    return total.substitute({stand_in: Scalar.symbol(each) for each, stand_in in held.items()})


def _holds(generator: str, name: str) -> bool:
    return bool(re.search(rf"\b{re.escape(name)}\b", generator))


def _rate(generator: str, name: str, normal: Callable[[Expr], Scalar]) -> Scalar:
    """The derivative of one function by a name."""
    call = parse(generator) if not generator.startswith("pow(") else None
    if not isinstance(call, Call):
        raise NotDerivable(f"the derivative of {generator} by {name} is not known")
    arguments = [normal(argument) for argument in call.arguments]
    rates = [partial(argument, name, normal) for argument in arguments]
    if call.function == "atan2":
        (y, x), (dy, dx) = arguments, rates
        return (x * dy - y * dx) / (x * x + y * y)
    rule = RATES.get(call.function)
    if rule is None:
        raise NotDerivable(f"the derivative of {call.function} by {name} is not known")
    return rule(Scalar.symbol(generator), arguments[0]) * rates[0]
