"""Where the end of an arm in a plane takes every orientation: rings about the first axis, by its last link.

The last link, whichever way it points, has to start where the other links reach: between a and b from the
first axis. A position at the distance r needs r + l <= b and |r - l| >= a (Craig, section 4.2).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import isclose

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number, scalar_number, somewhere
from derive.algebra.signs import sign_of
from derive.derivation import Phrase, Said
from derive.errors import NotDerivable
from derive.expression import (
    PI,
    ZERO,
    Call,
    Expr,
    Measured,
    Number,
    Symbol,
    add,
    free_symbols,
    measured,
    multiply,
)
from derive.kinds.fields import TREES
from derive.kinds.problem import Problem
from derive.kinds.robot._reach.regions import Region, final_distance, secondary
from derive.names import free

NOTHING = 1e-12
SAME = 1e-9


@dataclass(frozen=True, slots=True)
class Rings:
    """Between which distances every orientation is possible (`pieces`, from the inside; None where it depends
    on the lengths), the length of the last link, how far it goes, and the hole that the others leave."""

    last: Expr
    far: tuple[Expr, ...]
    gap: Expr
    pieces: tuple[tuple[Expr, Expr], ...] | None
    inner: Symbol
    outer: Symbol

    @property
    def r_max(self) -> Expr:
        return self.far[-1]

    @property
    def low(self) -> Expr:
        """Where the circle of the last link begins to meet the hole."""
        return self.last - self.gap

    @property
    def high(self) -> Expr:
        return self.last + self.gap

    def area(self) -> Expr:
        """pi times the sum of high^2 - low^2."""
        squares = (
            high**2 if low == ZERO else high**2 - low**2 for low, high in self.pieces or () if low != high
        )
        return multiply(PI, add(*squares))


def rings(problem: Problem, region: Region) -> Rings:
    """Of an arm in a plane with three links or more. Raises NotDerivable where a joint slides too."""
    if region.slides:
        raise NotDerivable("the dexterous workspace of an arm that slides along its axes is not derived yet")
    told = secondary(problem, region)
    *others, last = (problem.final(length) for length in region.lengths)
    far, gap = final_distance(problem, told.far), final_distance(problem, told.gap)
    written = add(*others) - last
    chain = (far,) if written == far else (written, far)
    names = (Symbol(free(problem.taken, f"rho_{k}")) for k in (1, 2))
    return Rings(last, chain, gap, _pieces(problem, far, last, gap), *names)


def rings_within(problem: Problem, far: Expr, last: Expr, gap: Expr) -> Rings:
    """The same, where the last link turns round at a position that is no further than `far`, and starts no
    nearer to the axis than `gap`."""
    names = (Symbol(free(problem.taken, f"rho_{k}")) for k in (1, 2))
    return Rings(last, (far,), gap, _pieces(problem, far, last, gap), *names)


def with_unit(told: Phrase, unit: str) -> Phrase:
    """What the region is called, its numbers with their unit."""
    about = {
        key: with_unit(value, unit) if isinstance(value, Phrase)
        else measured(value, unit) if isinstance(value, Number) else value
        for key, value in told.about.items()
    }  # fmt: skip
    return replace(told, about=about)


def _pieces(problem: Problem, far: Expr, last: Expr, gap: Expr) -> tuple[tuple[Expr, Expr], ...] | None:
    reach = _sign(problem, far)
    if reach is None or reach < 0:
        return None if reach is None else ()
    hole = _sign(problem, gap)
    if hole == 0 or reach == 0:
        return ((ZERO, far),)
    signs = [_sign(problem, tree) for tree in (last - gap, far - (last - gap), far - (last + gap))]
    if hole is None or None in signs:
        return None
    center, beyond, outside = (sign or 0 for sign in signs)
    value = {
        name: problem.readable(normal(tree)) for name, tree in (("low", last - gap), ("high", last + gap))
    }
    inside = ((ZERO, value["low"] if beyond > 0 else far),) if center >= 0 else ()
    return (*inside, *(((value["high"], far),) if outside >= 0 else ()))


def _sign(problem: Problem, tree: Expr) -> int | None:
    """1, 0 or -1 of lengths that are positive; None where it depends on them."""
    try:
        value = normal(tree, problem.names)
    except NotDerivable:
        return None
    known = sign_of(value, value.letters())
    if known is not None or value.letters():
        return known
    size = scalar_number(value, {})
    return 0 if abs(size) < NOTHING else 1 if size > 0 else -1


def described(found: Rings) -> Phrase:
    """What the region is called."""
    if found.pieces is None:
        about: dict[str, Said] = {"far": found.r_max, "inner": found.low, "outer": found.high}
        return Phrase("disc-if-any" if found.gap == ZERO else "disc-without-ring", about)
    match found.pieces:
        case ():
            return Phrase("empty")
        case ((low, high),) if low == high:
            return Phrase("the-base" if low == ZERO else "circle-alone", {"far": high})
        case ((low, high),):
            return Phrase("disc-alone" if low == ZERO else "annulus-alone", {"near": low, "far": high})
        case ((_, inside), (low, high)):
            center = "base-and" if inside == ZERO else "disc-and"
            ring = "circle-too" if low == high else "annulus-too"
            about = {"inner": inside, "near": low, "far": high}
            return Phrase(center, about | {"ring": Phrase(ring, about)})
    raise ValueError("more than two rings")


def is_said(found: Rings, told: Phrase) -> bool:
    """Whether what the region is called has the ends of its rings, from the inside."""
    ends = [end for piece in found.pieces or () for end in piece]
    if found.pieces is None:
        names, wanted = ("far", "inner", "outer"), [found.r_max, found.low, found.high]
    else:
        names, wanted = ("inner", "near", "far"), ends[1:] if len(ends) == 4 else ends
    parts = (told, *(each for each in told.about.values() if isinstance(each, Phrase)))
    said = [[_bare(part.about[name]) for name in names if name in part.about] for part in parts]
    return all(each == wanted[-len(each) :] for each in said if each)


def starts_as_said(found: Rings, told: Phrase) -> bool:
    """Whether it is told of the last link, where it is told of one, by its length and by how far it may start
    from the first axis, and how near."""
    values = {"last": found.last, "far": found.r_max, "gap": found.gap}
    r = told.about.get("r")
    if isinstance(r, Symbol):
        values["inside"] = Call("abs", (r - found.last,))
    pairs = ((_bare(told.about[name]), value) for name, value in values.items() if name in told.about)
    return all(isinstance(said, TREES) and _alike(said, value) for said, value in pairs)


def _alike(one: Expr, other: Expr) -> bool:
    """The same number of any lengths."""
    at = {name: somewhere(name) for name in free_symbols(one) | free_symbols(other)}
    return isclose(number(one, at), number(other, at), rel_tol=SAME, abs_tol=SAME)


def _bare(said: Said) -> Said:
    return said.value if isinstance(said, Measured) else said


def holds(pieces: Sequence[tuple[float, float]], r: float) -> bool:
    """Whether a distance lies in one of them."""
    return any(low <= r <= high for low, high in pieces)


def near_an_end(pieces: Sequence[tuple[float, float]], r: float, near: float) -> bool:
    """Whether it is too close to one to be judged in numbers."""
    return any(abs(r - end) < near for piece in pieces for end in piece)


def samples(size: float, count: int) -> Iterator[float]:
    """Distances up to what the arm reaches and a little beyond."""
    return ((k + 0.5) * 1.1 * size / count for k in range(count))
