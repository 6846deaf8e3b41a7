"""Plans of how a sum is written: as it stands, as a sum of parts, or as a product."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias

from derive.algebra.rationals import Rational
from derive.algebra.readable.terms import Monomial, Terms


@dataclass(frozen=True, slots=True)
class Flat:
    """Terms as they stand."""

    terms: Terms
    price: float


@dataclass(frozen=True, slots=True)
class Split:
    """The sum of parts, each nested on its own."""

    parts: tuple[tuple[Terms, Plan], ...]
    price: float


@dataclass(frozen=True, slots=True)
class Taken:
    """coefficient * monomial * (sum)^power * ..."""

    coefficient: Rational
    monomial: Monomial
    sums: tuple[tuple[Plan, int], ...]
    price: float


Plan: TypeAlias = Flat | Split | Taken


def cheapest(plans: Iterable[Plan]) -> Plan:
    """The first of the lowest price."""
    return min(plans, key=lambda plan: plan.price)
