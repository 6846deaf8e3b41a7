"""Roots as they are told, a pair of conjugates at once: -1 ± 2 j."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias

from derive.control.oracle.equations import value
from derive.derivation import Phrase, Record
from derive.expression import Approximate, Expr, Symbol, number
from derive.kinds.fields import TREES

WHOLE_BELOW = 10**6
J = Symbol("j")
Told: TypeAlias = Expr | Phrase


class Roots(Record):
    each: tuple[Told, ...]
    several: bool


def roots_told(found: Sequence[complex]) -> Roots | None:
    """As they are said; None where there are none."""
    return Roots(each=tuple(_in_pairs(list(found))), several=len(found) > 1) if found else None


def _in_pairs(left: list[complex]) -> Iterator[Told]:
    while left:
        root = left.pop(0)
        if root.conjugate() not in left or root.imag == 0:
            yield root_tree(root)
            continue
        left.remove(root.conjugate())
        beside = root_tree(complex(0, abs(root.imag)))
        about = {"imaginary": beside} | ({"real": rounded(root.real)} if root.real else {})
        yield Phrase("pair" if root.real else "imaginary-pair", about)


def said_roots(told: Roots | None) -> list[complex]:
    """Each root that is said, of a pair both; none of a pair whose second part is not positive."""
    return [root for each in (told.each if told else ()) for root in _said(each)]


def _said(told: Told) -> Iterator[complex]:
    if not isinstance(told, Phrase):
        yield value(told, {J.name: 1j})
        return
    real = told.about["real"] if told.key == "pair" else number(0)
    imaginary = told.about["imaginary"]
    if isinstance(real, TREES) and isinstance(imaginary, TREES):
        ends = value(real, {}), value(imaginary, {J.name: 1j})
        if ends[1].imag > 0:
            yield from (ends[0] + ends[1], ends[0] - ends[1])


def by_place(found: Iterable[complex]) -> list[complex]:
    """In an order of their own, that of conjugates being the same however the others are rounded."""
    return sorted(found, key=lambda root: (round(root.real, 9), round(root.imag, 9)))


def root_tree(root: complex) -> Expr:
    """A root as it is printed, with j for the imaginary unit."""
    re, im = rounded(root.real), rounded(abs(root.imag))
    if root.imag == 0:
        return re
    imaginary = J if im == number(1) else im * J
    signed = -imaginary if root.imag < 0 else imaginary
    return signed if root.real == 0 else re + signed


def rounded(value: float) -> Expr:
    """A whole number stays exact."""
    whole = abs(value) < WHOLE_BELOW and value == int(value)
    return number(int(value)) if whole else Approximate(value)
