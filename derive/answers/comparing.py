"""Whether a published scalar is the derived one: proved by normal form, or refuted by a point.

`differs` is said only where both have values at a point and these surely differ; what neither can decide is
`undecided`. A decimal of three digits or more stands for all numbers that are rounded to it, and any decimal
does where the sheet asks for numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Literal, TypeAlias

from flint import arb

from derive.algebra.normal import normal, walk_over
from derive.answers.budget import ROOTS, parts_of, too_many_turns
from derive.answers.points import (
    Names,
    Point,
    Sampling,
    apart,
    distance,
    has_none_at,
    turning,
    unknowns,
    value_at,
)
from derive.answers.regions import proved_around
from derive.errors import FormulaError, NotDerivable
from derive.expression import (
    Approximate,
    Call,
    Degrees,
    Expr,
    Number,
    Power,
    Symbol,
    children,
    walk,
    with_value,
)
from derive.expression import replace as replaced

Verdict: TypeAlias = Literal["equal", "differs", "undecided"]
UNDECIDED = (NotDerivable, FormulaError, ValueError, ZeroDivisionError, OverflowError, RecursionError)
TRIED = 60  # points, until
ENOUGH = 8  # of them give real values
MOST_ROOTS = 5  # different roots and inverse functions in a tree whose normal form is asked for
MOST_NODES = 200
TIGHT = 1e-9  # relative: as near as a number in floating point is known
DIGITS = 3  # of a decimal that counts as rounded


@dataclass(frozen=True)
class Terms:
    """On what terms two scalars are compared: what names stand for in each, and where to look."""

    published: Names
    derived: Names
    sampling: Sampling = field(default_factory=Sampling)
    angle: bool = False  # up to whole turns
    evaluated: bool = False  # in numbers, at a point of the sheet's
    own: Names = field(default_factory=dict)  # those names that the published solution gives a value itself

    @property
    def names(self) -> tuple[Names, Names]:
        return self.published, self.derived

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
    if doubtful and (note := rounded(published, derived, terms)):
        return Finding("equal" if note == ROUNDED else "undecided", note=note)
    if found.verdict != "undecided" or not found.values:
        return found
    if _is_rounded(derived) and _gap(found.values) < TIGHT:
        return Finding("equal", note=COMPUTED)
    if proved_around(
        published, derived, terms.names, _where_both_are(published, derived, terms), terms.angle
    ):
        return Finding("equal")
    return replace(found, note=found.note or unproved(published, derived, terms))


def unproved(published: Expr, derived: Expr, terms: Terms) -> str:
    """Why what agrees wherever it was tried is not proved."""
    parts = [
        part
        for tree, names in zip((published, derived), terms.names, strict=True)
        for part in parts_of(tree, names)
    ]
    return TURNS if too_many_turns(parts) else AGREES


def proved(published: Expr, derived: Expr, terms: Terms) -> bool:
    """Whether the normal form shows them equal, as a whole, or part by part where they are built alike."""
    if published == derived and _mean_the_same(published, terms):
        return True
    if light((published, derived), terms.names):
        return _proved_whole(published, derived, terms)
    parts, others = children(published), children(derived)
    if type(published) is not type(derived) or not parts or len(parts) != len(others):
        return False
    if isinstance(published, Call) and isinstance(derived, Call) and published.function != derived.function:
        return False
    plain = replace(terms, angle=False)
    return all(proved(one, other, plain) for one, other in zip(parts, others, strict=True))


def _mean_the_same(tree: Expr, terms: Terms) -> bool:
    """Whether each name in a tree stands for the same on both sides."""
    pending, seen = [tree], set[Expr]()
    while pending:
        for node in walk(pending.pop()):
            if isinstance(node, Symbol) and node not in seen:
                seen.add(node)
                ours, theirs = terms.derived.get(node), terms.published.get(node)
                if ours != theirs:
                    return False
                pending.extend([ours] if ours is not None else [])
    return True


def light(trees: Sequence[Expr], names: Sequence[Names]) -> bool:
    """Whether the normal forms of trees are found in a moment: roots within roots take long, angles that are
    large multiples of each other too."""
    parts = [list(parts_of(tree, known)) for tree, known in zip(trees, names, strict=True)]
    for found in parts:
        roots = len({part for part in found if isinstance(part, Call) and part.function in ROOTS})
        if roots > MOST_ROOTS or (roots > 1 and len(found) > MOST_NODES):
            return False
    return not too_many_turns([part for found in parts for part in found])


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


def _turned(published: Expr, derived: Expr, theirs: Names, ours: Names) -> bool:
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


def _where_both_are(published: Expr, derived: Expr, terms: Terms) -> list[Point]:
    """The points at which both have values."""
    found = _values(published, derived, terms)
    return [point for point, theirs, ours in found if theirs is not None and ours is not None]


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
AGREES = "they agree wherever it was tried, which is no proof"
TURNS = "they agree wherever it was tried; an angle is too large a multiple of another for a proof"


def rounded(published: Expr, derived: Expr, terms: Terms) -> str:
    """Whether rounding explains all of the difference: a note, or nothing."""
    compared = 0
    for theirs, ours, most in _with_room(published, derived, terms):
        if distance(theirs, ours, terms.angle) > most * 1.000001:
            return ""
        compared += 1
    return digits_note(published, terms) if compared else ""


def digits_note(published: Expr, terms: Terms) -> str:
    """What can be said of numbers that are right as they are rounded; nothing where none is."""
    given = [digits(node) for node in _decimals(published, terms)]
    if not given:
        return ""
    return TOO_FEW if min(given) < DIGITS and not terms.evaluated else ROUNDED


def _with_room(published: Expr, derived: Expr, terms: Terms) -> Iterator[tuple[arb, arb, float]]:
    """Both values at points, and how far the first may be off because its decimals are rounded."""
    if not _decimals(published, terms):
        return
    for point, theirs, ours in _values(published, derived, terms):
        if theirs is not None and ours is not None:
            yield theirs, ours, room(published, theirs, terms, point)


def room(published: Expr, value: arb, terms: Terms, point: Point) -> float:
    """How much the value at a point may change by half a unit in the last place of each decimal."""
    return sum((_moved(published, node, value, terms, point) for node in _decimals(published, terms)), 0.0)


def _decimals(published: Expr, terms: Terms) -> set[Number | Degrees]:
    """The numbers that count as rounded: decimals, also in degrees, of two digits at least in a formula."""
    nodes = {part for part in parts_of(published, terms.own) if isinstance(part, Number | Degrees)}
    least = 1 if terms.evaluated else DIGITS - 1
    return {node for node in nodes if _is_decimal(node) and digits(node) >= least}


def _is_decimal(node: Number | Degrees) -> bool:
    return node.decimal if isinstance(node, Number) else _places(node) > 0


def _moved(published: Expr, decimal: Number | Degrees, value: arb, terms: Terms, point: Point) -> float:
    last = Fraction(1, 2 * 10 ** _places(decimal))
    other: dict[Expr, Expr] = {decimal: with_value(decimal, decimal.value + last)}
    own = {name: replaced(tree, other) for name, tree in terms.own.items()}
    moved = value_at(replaced(published, other), {**terms.published, **own}, point)
    return abs(float((moved - value).mid())) if moved is not None else 0.0


def digits(node: Number | Degrees) -> int:
    """Significant digits of a decimal, zeros at its end included; of 0.00 those after the point."""
    places = _places(node)
    return (
        len(str(abs(node.value.numerator * 10**places // node.value.denominator))) if node.value else places
    )


def _places(node: Number | Degrees) -> int:
    """Digits after the point as typed, or as many as the value has."""
    places, scaled = 0, node.value
    while scaled.denominator != 1 and places < 40:
        places, scaled = places + 1, scaled * 10
    return max(places, node.places)
