"""Whether a published scalar is the derived one: proved by normal form, or refuted by a point.

`differs` is said only where both have values at a point and these surely differ; what neither can decide is
`undecided`. A decimal of three digits or more stands for all numbers that are rounded to it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Literal, TypeAlias

from flint import arb

from derive.algebra.normal import normal, walk_over
from derive.answers.points import (
    Names,
    Point,
    Sampling,
    apart,
    has_none_at,
    turning,
    unknowns,
    value_at,
)
from derive.errors import FormulaError, NotDerivable
from derive.expression import Approximate, Call, Expr, Number, Power, Symbol, children, walk
from derive.expression import replace as replaced

Verdict: TypeAlias = Literal["equal", "differs", "undecided"]
UNDECIDED = (NotDerivable, FormulaError, ValueError, ZeroDivisionError, OverflowError, RecursionError)
TRIED = 60  # points, until
ENOUGH = 8  # of them give real values
MOST_ROOTS = 5  # different roots and inverse functions in a tree whose normal form is asked for
MOST_NODES = 200
ROOTS = ("sqrt", "abs", "atan2", "atan", "acos", "asin")
TIGHT = 1e-9  # relative: as near as a number in floating point is known
DIGITS = 3  # of a decimal that counts as rounded


@dataclass(frozen=True)
class Terms:
    """On what terms two scalars are compared: what names stand for in each, and where to look."""

    published: Names
    derived: Names
    sampling: Sampling = field(default_factory=Sampling)
    angle: bool = False  # up to whole turns

    def points(self, left: Expr, right: Expr, odd: bool = False) -> Iterator[Point]:
        names = unknowns(left, self.published) | unknowns(right, self.derived)
        signed = turning((left,), self.published) | turning((right,), self.derived)
        sampling = replace(self.sampling, signed=self.sampling.signed | signed)
        yield from (sampling.odd if odd else sampling.usual)(names, TRIED)


@dataclass(frozen=True)
class Finding:
    """A verdict; where it differs a point, and the values there (None where there is none)."""

    verdict: Verdict
    witness: Point = field(default_factory=dict)
    values: tuple[float | None, float | None] | None = None
    note: str = ""


def compare(published: Expr, derived: Expr, terms: Terms) -> Finding:
    """What can be said about a published scalar and the derived one."""
    if proved(published, derived, terms):
        return Finding("equal")
    found = _looked_up(published, derived, terms)
    doubtful = found.verdict == "differs" or _is_rounded(derived)
    if doubtful and (note := _rounded(published, derived, terms)):
        return Finding("equal" if note == ROUNDED else "undecided", note=note)
    if found.verdict == "undecided" and _is_rounded(derived) and found.values and _gap(found.values) < TIGHT:
        return Finding("equal", note=COMPUTED)
    if found.verdict == "undecided" and found.values and _same_direction(published, derived, terms):
        return Finding("equal")
    return found


def proved(published: Expr, derived: Expr, terms: Terms) -> bool:
    """Whether the normal form shows them equal, as a whole, or part by part where they are built alike."""
    if published == derived:
        return True
    if light(published, terms.published) and light(derived, terms.derived):
        return _proved_whole(published, derived, terms)
    parts, others = children(published), children(derived)
    if type(published) is not type(derived) or not parts or len(parts) != len(others):
        return False
    if isinstance(published, Call) and isinstance(derived, Call) and published.function != derived.function:
        return False
    plain = replace(terms, angle=False)
    return all(proved(one, other, plain) for one, other in zip(parts, others, strict=True))


def light(tree: Expr, names: Names) -> bool:
    """Whether the normal form of a tree is found in a moment: roots within roots take long."""
    pending, seen, nodes, roots = [tree], set[Expr](), 0, 0
    while pending:
        node = pending.pop()
        nodes += 1
        if isinstance(node, Symbol | Call) and node not in seen:
            seen.add(node)
            roots += isinstance(node, Call) and node.function in ROOTS
            if node in names:
                pending.append(names[node])
        pending.extend(children(node))
        if roots > MOST_ROOTS or (roots > 1 and nodes > MOST_NODES):
            return False
    return True


def _proved_whole(published: Expr, derived: Expr, terms: Terms) -> bool:
    """Equal as they stand, or for what is said to be positive."""
    positive = terms.sampling.positive
    roots: Names = {Symbol(name): Power(Symbol(f"{name}_root"), Number(Fraction(2))) for name in positive}
    for more in ({}, roots) if roots else ({},):
        theirs, ours = {**terms.published, **more}, {**terms.derived, **more}
        if terms.angle and _turned(published, derived, theirs, ours):
            return True
        try:
            if normal(published, theirs) == normal(derived, ours):
                return True
        except UNDECIDED:
            continue
    return False


def _same_direction(published: Expr, derived: Expr, terms: Terms) -> bool:
    """Angles that agree at every point tried and have the same sine and cosine."""
    return not terms.angle and _turned(published, derived, terms.published, terms.derived)


def _turned(published: Expr, derived: Expr, theirs: Names, ours: Names) -> bool:
    if not (light(published, theirs) and light(derived, ours)):
        return False
    try:
        one = walk_over([published], theirs).trig(published)
        other = walk_over([derived], ours).trig(derived)
        return bool(one[0] == other[0] and one[1] == other[1])
    except UNDECIDED:
        return False


def _looked_up(published: Expr, derived: Expr, terms: Terms) -> Finding:
    """What values at points tell. A finding that is undecided has values where some were compared."""
    best, agreed, bare = None, None, None
    for point, theirs, ours in _values(published, derived, terms):
        if ours is None:
            continue
        if theirs is None:
            if has_none_at(published, terms.published, point):
                bare = bare or Finding("differs", point, (None, float(ours.mid())))
            continue
        numbers = float(theirs.mid()), float(ours.mid())
        if _apart(theirs, ours, derived, terms):
            if best is None or _gap(numbers) > 100 * _gap(best.values):
                best = Finding("differs", point, numbers)
        else:
            agreed = agreed or Finding("undecided", values=numbers)
    if best is None and agreed is None:
        return bare or Finding("undecided", note="no point was found where both have a real value")
    return best or _signs(published, derived, terms) or agreed or Finding("undecided")


def _values(
    published: Expr, derived: Expr, terms: Terms, odd: bool = False
) -> Iterator[tuple[Point, arb | None, arb | None]]:
    """Values at points until enough have both."""
    both = 0
    for point in terms.points(published, derived, odd):
        theirs = value_at(published, terms.published, point)
        ours = value_at(derived, terms.derived, point)
        yield point, theirs, ours
        both += theirs is not None and ours is not None
        if both == ENOUGH:
            return


def _signs(published: Expr, derived: Expr, terms: Terms) -> Finding | None:
    """Undecided, with the reason, where they agree for positive parameters and differ for others."""
    for point, theirs, ours in _values(published, derived, terms, odd=True):
        if theirs is not None and ours is not None and _apart(theirs, ours, derived, terms):
            names = sorted(name for name in point if point[name] < 0 and name not in terms.sampling.signed)
            listed = ", ".join(names)
            return Finding(
                "undecided", note=f"equal where {listed} > 0, not everywhere: declare it under symbols"
            )
    return None


def _apart(theirs: arb, ours: arb, derived: Expr, terms: Terms) -> bool:
    return apart(theirs, ours, terms.angle, terms.sampling.rounded or _is_rounded(derived))


def _is_rounded(derived: Expr) -> bool:
    """Whether it is known in floating point only."""
    return any(isinstance(node, Approximate) for node in walk(derived))


def _gap(values: tuple[float | None, float | None] | None) -> float:
    """How far two values are apart, as against their size."""
    if values is None or values[0] is None or values[1] is None:
        return 0.0
    size = max(abs(values[0]), abs(values[1])) or 1.0
    return abs(values[0] - values[1]) / size


# -- decimals that are rounded --------------------------------------------------------------------

ROUNDED = "to the digits given"
COMPUTED = "to the digits computed"
TOO_FEW = "agrees to the digits given, which are few"


def _rounded(published: Expr, derived: Expr, terms: Terms) -> str:
    """Whether rounding explains all of the difference: a note, or nothing."""
    decimals = {node for node in walk(published) if isinstance(node, Number) and node.decimal}
    decimals = {node for node in decimals if digits(node.value) >= DIGITS - 1}
    if not decimals:
        return ""
    compared = 0
    for point, theirs, ours in _values(published, derived, terms):
        if theirs is None or ours is None:
            continue
        room = sum(_room(published, node, theirs, terms, point) for node in decimals)
        if abs(float((theirs - ours).mid())) > room * 1.000001:
            return ""
        compared += 1
    few = any(digits(node.value) < DIGITS for node in decimals)
    return "" if not compared else TOO_FEW if few else ROUNDED


def _room(published: Expr, decimal: Number, value: arb, terms: Terms, point: Point) -> float:
    """How much the value changes by half a unit in the last place of one decimal."""
    last = Fraction(1, 2 * 10 ** _places(decimal.value))
    moved = value_at(replaced(published, {decimal: Number(decimal.value + last)}), terms.published, point)
    return abs(float((moved - value).mid())) if moved is not None else 0.0


def digits(value: Fraction) -> int:
    """Significant digits of a decimal."""
    return len(str(abs(value.numerator * 10 ** _places(value) // value.denominator)))


def _places(value: Fraction) -> int:
    places, scaled = 0, value
    while scaled.denominator != 1 and places < 40:
        places, scaled = places + 1, scaled * 10
    return places
