"""Which letter stands before which: the one rule of order.

In a product: the number and roots of numbers; masses, moments of inertia, sums in which every term has one;
g; the other constants, Latin before Greek, by their letter, then their number, then the rest of the index
(l_1 l_c1 l_2 l_c2); what runs or is unknown (s, t, x, y, z); sums of all these; roots and exponentials; sines
and cosines in the order of the product that made them, then sums that hold some; last rates, for they are
what coefficients multiply. A function written out without parentheses would swallow what follows it: where
there is one, all functions stand at the very end, `l theta_dot cos theta`.

In a sum: terms without sines first, by falling powers of what is unknown, then by their letters, a number
last; then the others by their angles, whichever are sines and whichever cosines, so that the rows of a
rotation agree: c_1 c_2 before c_1, s_1 s_2 before s_1. A positive term goes in front where there is one.

Angles stand in the order of the sheet (joints, turns as they are multiplied), else in that of the alphabets.
"""

from __future__ import annotations

import re
from enum import IntEnum
from functools import lru_cache
from typing import TypeAlias

SortKey: TypeAlias = tuple[object, ...]

MASSES = re.compile(r"^([mM]|[IJ])($|_|\d|[xyz])")  # masses and moments of inertia
RATES = re.compile(r"(^.|_)d?dot$")  # as derive.render prints them with dots
JOINTS = re.compile(r"^(theta|q)_?\d+$")  # their sines are one letter on a page, s_1
UNKNOWN = frozenset("stxyz")
FALLING = frozenset("sxyz")
ALPHABET = (
    "alpha beta gamma delta epsilon varepsilon zeta eta theta vartheta iota kappa lambda mu nu xi pi rho"
    " sigma tau upsilon phi varphi chi psi omega"
)
GREEK = {name: place for place, name in enumerate(ALPHABET.split(" "))}


class Place(IntEnum):
    """What a factor is, in the order of the factors of a product."""

    NUMBER = 0
    MASS = 1
    INERTIA = 2
    SUM_OF_MASSES = 3
    GRAVITY = 4
    CONSTANT = 5
    UNKNOWN = 6
    SUM = 7
    ROOT = 8
    FUNCTION = 9
    SUM_WITH_FUNCTIONS = 10
    RATE = 11
    SUM_OF_RATES = 12
    WRITTEN_OUT = 13  # a function without parentheses


@lru_cache(maxsize=4096)
def place_of(name: str) -> Place:
    """What a letter is, by its name."""
    if weight := MASSES.match(name):
        return Place.MASS if weight[1] in "mM" else Place.INERTIA
    if RATES.search(name):
        return Place.RATE
    if name in UNKNOWN:
        return Place.UNKNOWN
    return Place.GRAVITY if name == "g" else Place.CONSTANT


@lru_cache(maxsize=4096)
def natural(name: str) -> SortKey:
    """a2 before a10, l_1 before l_c1 before l_2, L before L_c, r before Omega."""
    stem, *index = re.findall(r"\d+|[^\W\d_]+", name) or [name]
    numbers = tuple(int(part) for part in index if part.isdigit())
    words = tuple(part.lower() for part in index if not part.isdigit())
    letter = stem.lower()
    return (letter in GREEK, GREEK.get(letter, -1), letter, numbers, words, name)


def in_sum(name: str) -> SortKey:
    """Where a letter stands among others that are added."""
    return (name not in FALLING, place_of(name), natural(name))
