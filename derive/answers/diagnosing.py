"""What probably went wrong in an answer: the smallest repair that makes it right, in a word or two."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import islice

from flint import arb

from derive.answers.points import Point, apart, unknowns, value_at
from derive.answers.terms import Terms
from derive.expression import (
    PI,
    Call,
    Degrees,
    Expr,
    Number,
    Power,
    Product,
    Sum,
    Symbol,
    children,
    number,
    rebuild,
    walk,
)
from derive.expression import replace as replaced

MOST = 400  # repairs that are tried, fewer of a long answer
MOST_NODES = 60_000  # of all repairs together
POINTS = 3
SWAPPED = {"sin": "cos", "cos": "sin"}
FACTORS = (2, 3, 4)
TWO = number(2)
_STEM = re.compile(r"([A-Za-z]+?)_?(\d+|[a-z]?)((?:_d?dot)?)")

SIGN = "sign"
SIGN_OF_TERM = "sign of one term"
TRIG = "sine and cosine swapped"
DEGREES = "degrees and radians"
ATAN2 = "arguments of atan2 swapped"
INDEX = "index"
EXTRA = "a term too many"
MISSING = "a term is missing"
TRANSPOSED = "transposed"
SHAPE = "shape"
ROWS = "rows swapped"
COLUMNS = "columns swapped"
SQUARE = "a square is missing"
NO_SQUARE = "a square too many"

Repair = tuple[str, Expr]


@dataclass(frozen=True)
class Tested:
    """The derived values at a few points, against which repairs are held."""

    terms: Terms
    points: tuple[tuple[Point, arb], ...]

    def fits(self, repaired: Expr) -> bool:
        """Whether a repair has the derived values everywhere."""
        for point, ours in self.points:
            value = value_at(repaired, self.terms.published, point)
            if value is None or apart(value, ours, self.terms.angle, self.terms.sampling.rounded):
                return False
        return bool(self.points)


def diagnose(published: Expr, derived: Expr, terms: Terms) -> str:
    """The first repair that makes a published scalar equal, or an empty text."""
    tested = Tested(terms, _tested_at(published, derived, terms))
    repairs = _repairs(published, derived, unknowns(derived, terms.derived))
    most = min(MOST, 10 + MOST_NODES // (1 + sum(1 for _ in walk(published))))
    return next((name for name, tree in islice(repairs, most) if tested.fits(tree)), "")


def _tested_at(published: Expr, derived: Expr, terms: Terms) -> tuple[tuple[Point, arb], ...]:
    """A few points, one of them where the answer is wrong."""
    unchanged = Tested(terms, ())
    found: list[tuple[Point, arb]] = []
    shown = False
    for point, ours in _derived_values(published, derived, terms):
        wrong = not replace(unchanged, points=((point, ours),)).fits(published)
        if len(found) < POINTS - 1 or (wrong and not shown):
            found.append((point, ours))
            shown = shown or wrong
        if shown and len(found) >= POINTS:
            break
    return tuple(found)


def _derived_values(published: Expr, derived: Expr, terms: Terms) -> Iterator[tuple[Point, arb]]:
    for point in terms.points(published, derived):
        value = value_at(derived, terms.derived, point)
        if value is not None:
            yield point, value


def _repairs(published: Expr, derived: Expr, names: frozenset[str]) -> Iterator[Repair]:
    """Likely slips first."""
    yield SIGN, -published
    yield TRIG, _all_swapped(published)
    yield from _each_named(published, ATAN2, _other_way_round)
    yield from _scaled(published)
    yield from _each_named(published, SIGN_OF_TERM, _sign_changed)
    yield from _each_named(published, TRIG, _swapped)
    yield from _each_named(published, SQUARE, _squared)
    yield from _each_named(published, NO_SQUARE, _unsquared)
    yield from ((DEGREES, tree) for tree in _in_degrees(published))
    for n, factor in (("2", Fraction(1, 2)), ("1/2", Fraction(2))):
        yield from _each_named(published, f"factor {n} in one term", partial(_one_scaled, factor=factor))
    yield from ((INDEX, tree) for tree in _renamed(published, names))
    yield from _each_named(published, EXTRA, _shortened)
    if isinstance(derived, Sum):
        yield from ((MISSING, published + term) for term in derived.terms)


def _each_named(tree: Expr, name: str, change: Callable[[Expr], Iterator[Expr]]) -> Iterator[Repair]:
    return ((name, repaired) for repaired in _each(tree, change))


def _scaled(published: Expr) -> Iterator[Repair]:
    """A factor that should not be there is named as it stands in the answer."""
    for n in FACTORS:
        yield f"factor {n}", published / n
        yield f"factor 1/{n}", n * published
    yield "factor -2", published / -2
    yield "factor -1/2", -2 * published


def _each(tree: Expr, change: Callable[[Expr], Iterator[Expr]]) -> Iterator[Expr]:
    """The tree with one of its nodes changed, in every way and at every place."""
    yield from change(tree)
    for child in dict.fromkeys(children(tree)):
        for changed in _each(child, change):
            yield _with(tree, child, changed)


def _with(tree: Expr, child: Expr, changed: Expr) -> Expr:
    """The node with one of its parts replaced, the first of those that are alike."""
    left = [1]

    def one(part: Expr) -> Expr:
        if part == child and left:
            left.pop()
            return changed
        return part

    return rebuild(tree, one)


def _sign_changed(node: Expr) -> Iterator[Expr]:
    if isinstance(node, Sum):
        for k, term in enumerate(node.terms):
            yield Sum((*node.terms[:k], -term, *node.terms[k + 1 :]))


def _shortened(node: Expr) -> Iterator[Expr]:
    if isinstance(node, Sum):
        for k in range(len(node.terms)):
            yield Sum((*node.terms[:k], *node.terms[k + 1 :]))


def _one_scaled(node: Expr, factor: Fraction) -> Iterator[Expr]:
    if isinstance(node, Sum):
        for k, term in enumerate(node.terms):
            yield Sum((*node.terms[:k], Number(factor) * term, *node.terms[k + 1 :]))


def _swapped(node: Expr) -> Iterator[Expr]:
    if isinstance(node, Call) and node.function in SWAPPED:
        yield Call(SWAPPED[node.function], node.arguments)


def _squared(node: Expr) -> Iterator[Expr]:
    if isinstance(node, Symbol | Call | Sum) and node != PI:
        yield node**2


def _unsquared(node: Expr) -> Iterator[Expr]:
    if isinstance(node, Power) and node.exponent == TWO:
        yield node.base


def _all_swapped(tree: Expr) -> Expr:
    if isinstance(tree, Call) and tree.function in SWAPPED:
        return Call(SWAPPED[tree.function], tree.arguments)
    return rebuild(tree, _all_swapped)


def _other_way_round(node: Expr) -> Iterator[Expr]:
    if isinstance(node, Call) and node.function == "atan2":
        yield Call("atan2", node.arguments[::-1])


def _in_degrees(published: Expr) -> Iterator[Expr]:
    """Degrees read as radians, in a sine or as the answer itself; and the other way round."""
    yield _degrees_in_trig(published)
    yield published * (PI / 180)
    yield published * (180 / PI)


def _degrees_in_trig(tree: Expr) -> Expr:
    if isinstance(tree, Call) and tree.function in ("cos", "sin", "tan"):
        return Call(tree.function, tuple(_as_degrees(argument) for argument in tree.arguments))
    return rebuild(tree, _degrees_in_trig)


def _as_degrees(angle: Expr) -> Expr:
    match angle:
        case Number(value):
            return Degrees(value)
        case Sum(terms):
            return Sum(tuple(map(_as_degrees, terms)))
        case Product((Number(value),)):
            return Degrees(value)
        case _:
            return angle


def _renamed(published: Expr, names: frozenset[str]) -> Iterator[Expr]:
    """One symbol for another of its kind, everywhere and at one place; one joint angle more or less."""
    used = sorted({node.name for node in walk(published) if isinstance(node, Symbol) and node != PI})
    for name in used:
        for other in sorted(names):
            if other != name and _kind(other) == _kind(name):
                yield replaced(published, {Symbol(name): Symbol(other)})
                yield from _each(published, partial(_one_renamed, name=name, other=other))
    angles = sorted({node for node in walk(published) if isinstance(node, Call)}, key=repr)
    arguments = {angle for call in angles if call.function in SWAPPED for angle in call.arguments}
    choices = [*arguments, *(Symbol(name) for name in sorted(names) if name[-1:].isdigit())]
    choices += [a + Symbol(b) for a in arguments for b in sorted(names) if b[-1:].isdigit()]
    for choice in sorted(choices, key=repr):
        yield from _each(published, partial(_other_angle, angle=choice))


def _other_angle(node: Expr, angle: Expr) -> Iterator[Expr]:
    if isinstance(node, Call) and node.function in SWAPPED and node.arguments != (angle,):
        yield Call(node.function, (angle,))


def _one_renamed(node: Expr, name: str, other: str) -> Iterator[Expr]:
    if node == Symbol(name):
        yield Symbol(other)


def _kind(name: str) -> tuple[str, str]:
    """What a name is without its index: a of a1, L of L_c and L."""
    found = _STEM.fullmatch(name)
    return (found[1], found[3]) if found else (name, "")
