"""What one answer may cost: what no page could hold is refused before it fills the time and the memory.

Work is counted, never timed, so that the same sheet is refused or answered on every machine. A unit is the
product of two terms; eight million of them take some seconds.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

from flint import fmpq_mpoly

from derive.errors import TooManyTerms

MOST_PRODUCTS = 1_000_000  # of terms, in one multiplication; arms of seven joints need some two thousand
MOST_IN_PRODUCT = 100_000  # terms of what comes out: some 10 MB
MOST_WORK = 8_000_000  # units for one answer, with all that it rests on
MOST_TERMS = 100_000  # written out in the answers to one problem
MOST_IN_ONE = 10_000  # in one expression

A_CALL = 10  # units of any operation, however small
A_TERM_READ = 50  # units of a term brought into a readable form

REMEDY = "give numbers to some of the symbols"


@dataclass(slots=True)
class _Work:
    """What is left of the work that an answer may take."""

    left: int


_WORK: ContextVar[_Work | None] = ContextVar("work", default=None)


@contextmanager
def one_answer() -> Iterator[None]:
    """What is done inside counts as work for one answer; inside another's it counts for that one."""
    if _WORK.get() is not None:
        yield
        return
    token = _WORK.set(_Work(MOST_WORK))
    try:
        yield
    finally:
        _WORK.reset(token)


@contextmanager
def at_most(units: int) -> Iterator[None]:
    """What is done inside may take so many units of the answer's work: an attempt that others follow."""
    work = _WORK.get()
    if work is None:
        yield
        return
    allowed = min(units, work.left)
    own = _Work(allowed)
    token = _WORK.set(own)
    try:
        yield
    finally:
        _WORK.reset(token)
        work.left -= allowed - max(own.left, 0)


@contextmanager
def no_charge() -> Iterator[None]:
    """What is done inside is a check, and counts as no work for an answer."""
    token = _WORK.set(None)
    try:
        yield
    finally:
        _WORK.reset(token)


def spend(units: int) -> None:
    """Counts work. Raises TooManyTerms where an answer has taken more than any page is worth."""
    work = _WORK.get()
    if work is None:
        return
    work.left -= units + A_CALL
    if work.left < 0:
        raise TooManyTerms(
            f"the answer is too long: more than {MOST_WORK // 10**6} million products of terms; {REMEDY}"
        )


def multiplied(left: fmpq_mpoly, right: fmpq_mpoly) -> fmpq_mpoly:
    """The product. Raises TooManyTerms where it would be out of all proportion."""
    products = len(left) * len(right)
    if products > MOST_PRODUCTS:
        raise TooManyTerms(
            f"the answer is too long: an expression of {len(left)} terms times one of {len(right)}; {REMEDY}"
        )
    spend(products)
    found = left * right
    if len(found) > MOST_IN_PRODUCT:
        raise TooManyTerms(f"the answer is too long: an expression of {len(found)} terms; {REMEDY}")
    return found


def count(one: int, all_together: int) -> None:
    """Raises TooManyTerms where so many terms are to be written out."""
    if one > MOST_IN_ONE or all_together > MOST_TERMS:
        raise TooManyTerms(
            f"the answer is too long: over {MOST_IN_ONE if one > MOST_IN_ONE else MOST_TERMS} terms "
            f"multiplied out; {REMEDY}"
        )
