"""What one answer may cost: expressions that no page could hold are refused before they fill the memory."""

from __future__ import annotations

from flint import fmpq_mpoly

from derive.errors import NotDerivable

MOST_PRODUCTS = 4_000_000  # of terms, in one multiplication; arms of seven joints need some two thousand
MOST_TERMS = 100_000  # written out in the answers to one problem
MOST_IN_ONE = 10_000  # in one expression


def multiplied(left: fmpq_mpoly, right: fmpq_mpoly) -> fmpq_mpoly:
    """The product. Raises NotDerivable where it would be out of all proportion."""
    if len(left) * len(right) > MOST_PRODUCTS:
        raise NotDerivable(
            f"the answer is too long: an expression of {len(left)} terms times one of {len(right)}; "
            "give numbers to some of the symbols"
        )
    return left * right


def count(one: int, all_together: int) -> None:
    """Raises NotDerivable where so many terms are to be written out."""
    if one > MOST_IN_ONE or all_together > MOST_TERMS:
        raise NotDerivable(
            f"the answer is too long: over {MOST_IN_ONE if one > MOST_IN_ONE else MOST_TERMS} terms "
            "multiplied out; give numbers to some of the symbols"
        )
