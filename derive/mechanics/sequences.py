"""In which order the factors of a motion stand in its product, and which other motions have the same product.

A motion about a world axis multiplies what was reached so far from the left, one about a current axis
from the right (Spong et al., section 2.4; Siciliano et al., section 2.3). So the factors made so far
always stand side by side, and a new one comes to stand at the left or the right end.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, islice
from typing import Literal, TypeAlias

from derive.mechanics.motion import Move

Side: TypeAlias = Literal["first", "left", "right"]
Mode: TypeAlias = Literal["single", "world", "current", "mixed"]

MOST_MIXED = 6  # mixed sequences listed; their number doubles with every factor


@dataclass(frozen=True, slots=True)
class Placing:
    """Where the factor of move `index` (from 0) is multiplied on; `product` are the indices of the
    factors so far, from left to right."""

    index: int
    side: Side
    product: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Alternative:
    """Another way to make a motion: how its axes are taken, and its moves in the order they are made."""

    mode: Mode
    moves: tuple[Move, ...]


def placings(moves: Sequence[Move]) -> tuple[Placing, ...]:
    """One for each move, in the order of the motion."""
    product: deque[int] = deque()
    found = []
    for index, move in enumerate(moves):
        side: Side = "first" if not product else "left" if move.about == "world" else "right"
        if side == "left":
            product.appendleft(index)
        else:
            product.append(index)
        found.append(Placing(index, side, tuple(product)))
    return tuple(found)


def order(moves: Sequence[Move]) -> tuple[int, ...]:
    """The indices of the moves as their factors stand in the product, from left to right."""
    placed = placings(moves)
    return placed[-1].product if placed else ()


def in_product_order(moves: Sequence[Move]) -> tuple[Move, ...]:
    """The moves as their factors stand in the product, so that all of them are about current axes."""
    return tuple(replace(moves[index], about="current") for index in order(moves))


def mode(moves: Sequence[Move]) -> Mode:
    """How the axes of a motion are taken. The first move does not count: at the start the current axes
    are those of the world."""
    axes = {move.about for move in moves[1:]}
    if not axes:
        return "single"
    return "mixed" if len(axes) > 1 else axes.pop()


def equivalents(moves: Sequence[Move]) -> Iterator[Alternative]:
    """Other sequences of the same moves with the same product: all about current axes, all about world
    axes, then mixed ones. The given sequence is left out, and what differs only in the first axes."""
    factors = in_product_order(moves)
    seen = {_key(moves)}
    uniform = (Alternative("current", factors), Alternative("world", _built(factors, len(factors) - 1, "")))
    mixed = (Alternative("mixed", made) for made in _mixed(factors))
    for found in chain(uniform, islice(mixed, MOST_MIXED)):
        if _key(found.moves) not in seen:
            seen.add(_key(found.moves))
            yield found


def _mixed(factors: tuple[Move, ...]) -> Iterator[tuple[Move, ...]]:
    """Starting at each inner factor, each order of going on to the left and to the right."""
    for start in range(1, len(factors) - 1):
        for sides in _interleavings(start, len(factors) - 1 - start):
            yield _built(factors, start, sides)


def _interleavings(left: int, right: int) -> Iterator[str]:
    """Every text of so many L and R."""
    if not left or not right:
        yield "L" * left + "R" * right
        return
    yield from ("L" + rest for rest in _interleavings(left - 1, right))
    yield from ("R" + rest for rest in _interleavings(left, right - 1))


def _built(factors: tuple[Move, ...], start: int, sides: str) -> tuple[Move, ...]:
    """The moves that make the product from its factor `start` on; without `sides` all to the left."""
    low = high = start
    made = [replace(factors[start], about="current")]
    for side in sides or "L" * start:
        if side == "L":
            low -= 1
            made.append(replace(factors[low], about="world"))
        else:
            high += 1
            made.append(replace(factors[high], about="current"))
    return tuple(made)


def _key(moves: Sequence[Move]) -> tuple[Move, ...]:
    """The same for sequences that differ only in the axes of the first move."""
    return tuple(replace(move, about="current") if k == 0 else move for k, move in enumerate(moves))
