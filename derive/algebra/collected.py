"""A scalar as a sum over the powers of some of its symbols."""

from __future__ import annotations

from collections.abc import Collection
from typing import TypeAlias

from derive.algebra.scalar import Scalar

Powers: TypeAlias = tuple[tuple[str, int], ...]  # symbol and power, in the order of the ring


def collected(value: Scalar, names: Collection[str]) -> dict[Powers, Scalar]:
    """What stands before each product of powers of these symbols; the product of none has the key ().

    Raises ValueError where one of them stands below the fraction.
    """
    home = value.ring
    places = [i for i, name in enumerate(home.names) if name in names]
    below = Scalar(home, home.one if value.denominator is None else value.denominator)
    if set(below.generators()) & set(names):
        raise ValueError("a symbol to be collected stands below a fraction")
    groups: dict[Powers, dict[tuple[int, ...], object]] = {}
    for exponents, coefficient in value.numerator.to_dict().items():
        key = tuple((home.names[i], int(exponents[i])) for i in places if exponents[i])
        rest = tuple(0 if i in places else power for i, power in enumerate(exponents))
        groups.setdefault(key, {})[rest] = coefficient
    return {key: Scalar(home, home.context.from_dict(terms)) / below for key, terms in groups.items()}
