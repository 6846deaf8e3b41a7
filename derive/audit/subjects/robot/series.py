"""Power series in the joint variables about one configuration, cut off: derivatives in exact numbers.

A pose as a series of order 2 holds everything that kinematics and dynamics ask of it at that configuration:
the Jacobian are its first derivatives, D follows from these, and c_ijk from theirs.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from derive.audit.budget import spend
from derive.audit.points import Number

Monomial: TypeAlias = tuple[int, ...]  # indices of variables in order: (0, 0, 2) is x_0^2 x_2
Array: TypeAlias = npt.NDArray[np.object_]  # of numbers, or of series


class Series:
    """The coefficient of each monomial up to an order; those that are zero are left out."""

    __slots__ = ("order", "terms")

    def __init__(self, terms: Mapping[Monomial, Number], order: int) -> None:
        self.terms = {powers: number for powers, number in terms.items() if number and len(powers) <= order}
        self.order = order

    def __add__(self, other: Series | Number) -> Series:
        if not isinstance(other, Series):
            other = Series({(): other}, self.order)
        terms = dict(self.terms)
        for powers, number in other.terms.items():
            terms[powers] = terms.get(powers, 0) + number
        return Series(terms, min(self.order, other.order))

    __radd__ = __add__

    def __neg__(self) -> Series:
        return Series({powers: -number for powers, number in self.terms.items()}, self.order)

    def __sub__(self, other: Series | Number) -> Series:
        return self + -other

    def __rsub__(self, other: Number) -> Series:
        return -self + other

    def __mul__(self, other: Series | Number) -> Series:
        if not isinstance(other, Series):
            return Series({powers: number * other for powers, number in self.terms.items()}, self.order)
        order = min(self.order, other.order)
        terms: dict[Monomial, Number] = {}
        for left, number in self.terms.items():
            for right, factor in other.terms.items():
                if len(left) + len(right) <= order:
                    spend(1)
                    powers = tuple(sorted(left + right))
                    terms[powers] = terms.get(powers, 0) + number * factor
        return Series(terms, order)

    __rmul__ = __mul__

    def __truediv__(self, number: int) -> Series:
        return Series({powers: factor / number for powers, factor in self.terms.items()}, self.order)

    @property
    def value(self) -> Number:
        """At the configuration itself."""
        return self.terms.get((), 0)

    def diff(self, i: int) -> Series:
        """The derivative by variable i, known to one order less."""
        terms: dict[Monomial, Number] = {}
        for powers, number in self.terms.items():
            if times := powers.count(i):
                at = powers.index(i)
                terms[powers[:at] + powers[at + 1 :]] = number * times
        return Series(terms, self.order - 1)


def values(array: Array) -> Array:
    """An array of series at the configuration itself; numbers stay what they are."""
    return mapped(array, lambda entry: entry.value if isinstance(entry, Series) else entry)


def diff(array: Array, i: int) -> Array:
    """An array of series, each differentiated by variable i."""
    return mapped(array, lambda entry: entry.diff(i) if isinstance(entry, Series) else 0)


def mapped(array: Array, change: Any) -> Array:
    """A function of each entry."""
    found = np.empty(array.shape, dtype=object)
    for at, entry in np.ndenumerate(array):
        found[at] = change(entry)
    return found
