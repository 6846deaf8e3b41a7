"""Whether a given inertia matrix is positive definite, by its minors from the first row or from the last."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import inf
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point, number
from derive.algebra.readable.operation_count import operations
from derive.derivation import Phrase
from derive.expression import PI, ZERO, Call, Expr, Relation, Symbol, multiply
from derive.expression import number as rational
from derive.kinds.checks import close, route
from derive.kinds.matrix._inertia import GivenInertia
from derive.kinds.matrix._worst import holds, worst
from derive.kinds.robot._degrees import in_degrees
from derive.kinds.robot._dynamics.definite import is_positive
from derive.kinds.work import Work
from derive.mechanics.zeros import never_zero
from derive.names import entry_symbol, free

MOST = 6  # rows of a matrix whose minors are worked out
LONGEST = 80  # operations of one that is read
POINTS = 3
MOST_HELD = 3  # joint variables of a minor that is looked at in quarter turns
HALF_TURN, QUARTER = PI, multiply(rational("1/2"), PI)
NOTHING = 1e-12  # an eigenvalue this small beside the others is none


@dataclass(frozen=True)
class Minors:
    """A row of minors, each with one row and column more: rows and columns in this order; values; the sign of
    each in every configuration, None where it is not known."""

    order: tuple[int, ...]
    values: tuple[Expr, ...]
    signs: tuple[int | None, ...]

    @property
    def known(self) -> int:
        """How many signs are."""
        return sum(sign is not None for sign in self.signs)


@dataclass(frozen=True)
class Negative:
    """A minor that is negative in a configuration."""

    minor: Symbol
    value: Expr
    place: tuple[tuple[Symbol, Expr], ...]

    def told(self, found: GivenInertia) -> Phrase:
        pairs = (in_degrees(found.problem, *pair) for pair in self.place)
        where = tuple(Relation(name, "=", value) for name, value in pairs)
        minor = Relation(self.minor, "=", self.value)
        return Phrase("negative-at", {"D": found.name, "minor": minor, "place": where})

    def at(self, found: GivenInertia) -> Point:
        """The configuration, with numbers at random for what does not matter."""
        return {**next(found.points(1)), **{name.name: number(value, {}) for name, value in self.place}}


def minors(work: Work, found: GivenInertia) -> tuple[Work, Phrase, bool]:
    """With a line for each minor, what follows for D, and whether they start at the first row; no lines where
    they are long."""
    size = len(found.variables)
    ways = [_minors(work, found, order) for order in (range(size), range(size)[::-1]) if size <= MOST]
    if not ways or max(operations(value) for way in ways for value in way.values) > LONGEST:
        return work, Phrase("long-minors", {"D": found.name}), True
    best = max(ways, key=lambda way: (way.known, -_conditions(found, way)))
    letter = free(work.problem.taken, "Delta", "M", indices=[f"_{k}" for k in range(1, size + 1)])
    names = [Symbol(f"{letter}_{k}") for k in range(1, size + 1)]
    for k, (name, value) in enumerate(zip(names, best.values, strict=True), 1):
        work = work.line(name, *_formula(found.name, best.order[:k], size), value=value, rule="minor")
    work = work.claim(
        route("minors", (*_in_numbers(work, found, names, best), *_in_letters(found.name, best.order))),
        route("eigenvalues", _judged(work, found, names, best)),
    )
    negative = next(_negative(work, found, names, best), None)
    if negative:
        work = work.claim(route("negative-there", _is_negative(work, found, negative)))
    told = negative.told(found) if negative else _told(work, found, names, best)
    if told.key.startswith("definite-where") and (least := worst(found, _unknown(names, best))):
        work, told = work.claim(route("all-around", holds(found, least))), least.told(found.name)
    first = best.order[0] == 0
    return work.claim(route("minors", _begins(work, found, names[0], first))), told, first


def _begins(work: Work, found: GivenInertia, minor: Symbol, first: bool) -> Iterator[bool]:
    """Whether the least minor is the entry of the first row, or else of the last."""
    for at in found.points(POINTS):
        yield close(number(work[minor], at), found.numbers(at).diagonal()[0 if first else -1])


def _minors(work: Work, found: GivenInertia, order: Sequence[int]) -> Minors:
    """Of the first rows and columns in this order."""
    rows = found.D.rows
    parts = [[[rows[i][j] for j in order[:k]] for i in order[:k]] for k in range(1, len(order) + 1)]
    values = tuple(found.final(ScalarMatrix.of(part).det()) for part in parts)
    return Minors(tuple(order), values, tuple(_sign(work, found, value) for value in values))


def _unknown(names: Sequence[Symbol], way: Minors) -> list[tuple[Symbol, Expr]]:
    """The minors whose sign is not known."""
    rows = zip(names, way.values, way.signs, strict=True)
    return [(name, value) for name, value, sign in rows if sign is None]


def _conditions(found: GivenInertia, way: Minors) -> float:
    """How many they need to be positive; without end where nothing says so."""
    names = [Symbol(f"Delta_{k}") for k, _ in enumerate(way.values, 1)]
    unknown = _unknown(names, way)
    least = worst(found, unknown)
    return len(least.positive) if least else inf if unknown else 0


def _formula(D: Symbol, rows: Sequence[int], size: int) -> tuple[Expr, ...]:
    """The minor of these rows and columns in the names of the entries, where that is short."""
    i, j = min(rows) + 1, max(rows) + 1
    if len(rows) == 1:
        return (entry_symbol("d", i, i),)
    if len(rows) == 2:
        return (entry_symbol("d", i, i) * entry_symbol("d", j, j) - entry_symbol("d", i, j) ** 2,)
    return (Call("det", (D,)),) if len(rows) == size else ()


def _in_letters(D: Symbol, order: Sequence[int]) -> Iterator[bool]:
    """Whether the minors in the names of the entries are those of any symmetric matrix."""
    import numpy as np

    half = np.random.default_rng(0).random((len(order), len(order)))
    whole = half + half.T
    at: dict[str, Any] = {D.name: whole}
    at |= {entry_symbol("d", i + 1, j + 1).name: float(each) for (i, j), each in np.ndenumerate(whole)}
    yield True
    for k in range(1, len(order) + 1):
        rows = [*order[:k]]
        for formula in _formula(D, rows, len(order)):
            yield close(arrays(formula, at), float(np.linalg.det(whole[np.ix_(rows, rows)])))


def _sign(work: Work, found: GivenInertia, minor: Expr) -> int | None:
    """In every configuration, masses and moments of inertia being positive; None where it is not known."""
    return 1 if is_positive(minor, found.variables) else _sign_of(work, found, minor)


def _sign_of(work: Work, found: GivenInertia, minor: Expr) -> int | None:
    """The same where nothing is known but what the sheet says."""
    if (known := work.sign(minor)) is not None:
        return known
    value = normal(minor, work.problem.names)
    if value.letters() <= {*found.variables} and never_zero(value, found.variables):
        return 1 if number(minor, next(found.points(1))) > 0 else -1
    return None


def _told(work: Work, found: GivenInertia, names: list[Symbol], best: Minors) -> Phrase:
    """What the signs say of D."""
    for name, sign in zip(names, best.signs, strict=True):
        if sign in (0, -1):
            return Phrase("vanishing" if sign == 0 else "negative", {"D": found.name, "minor": name})
    unknown = tuple(name for name, sign in zip(names, best.signs, strict=True) if sign is None)
    if unknown:
        key = "definite-where" if len(unknown) == 1 else "definite-where-all"
        return Phrase(key, {"D": found.name, "minors": unknown})
    certain = all(_sign_of(work, found, value) == 1 for value in best.values)
    return Phrase("definite" if certain else "definite-bodies", {"D": found.name})


def _negative(work: Work, found: GivenInertia, names: list[Symbol], best: Minors) -> Iterator[Negative]:
    """Minors of numbers and joint variables that are negative where these are none or quarter turns."""
    for name, sign, value in zip(names, best.signs, best.values, strict=True):
        exact = normal(value, work.problem.names)
        held = [each for each in found.variables if each in exact.letters()]
        if sign is not None or not exact.letters() <= {*held} or len(held) > MOST_HELD:
            continue
        for place in product((ZERO, HALF_TURN, QUARTER, -QUARTER), repeat=len(held)):
            pairs = tuple(zip(map(Symbol, held), place, strict=True))
            there = normal(value, {**work.problem.names, **dict(pairs)})
            if (size := there.constant) is not None and size < 0:
                yield Negative(name, work.problem.readable(there), pairs)


# -- in numbers ---------------------------------------------------------------------------------------


def _in_numbers(work: Work, found: GivenInertia, names: list[Symbol], best: Minors) -> Iterator[bool]:
    """Whether each minor is the determinant of that part of the matrix."""
    import numpy as np

    for at in found.points(POINTS):
        D = found.numbers(at)
        for k, name in enumerate(names, 1):
            rows = sorted(best.order[:k])
            yield close(number(work[name], at), float(np.linalg.det(D[np.ix_(rows, rows)])))


def _judged(work: Work, found: GivenInertia, names: list[Symbol], best: Minors) -> Iterator[bool]:
    """Whether the eigenvalues are all positive where the minors are said to be, and there alone."""
    for at in found.points(POINTS):
        pairs = zip(names, best.signs, strict=True)
        told = [number(work[name], at) > 0 if sign is None else sign > 0 for name, sign in pairs]
        sizes = _eigenvalues(found, at)
        yield bool(sizes[0] > NOTHING * max(abs(sizes))) == all(told)


def _is_negative(work: Work, found: GivenInertia, told: Negative) -> Iterator[bool]:
    """Whether the matrix has a negative eigenvalue where it is said, and the minor its value."""
    at, about = told.at(found), told.told(found).about
    yield bool(_eigenvalues(found, at)[0] < 0)
    minor, place = about["minor"], about["place"]
    assert isinstance(minor, Relation) and isinstance(place, tuple)
    yield minor.sign == "=" and close(number(work[told.minor], at), number(minor.right, {}))
    for each in place:
        assert isinstance(each, Relation) and isinstance(each.left, Symbol)
        yield each.sign == "=" and close(at[each.left.name], number(each.right, {}))


def _eigenvalues(found: GivenInertia, at: Point) -> Any:
    """Of the matrix as it was typed, the smallest first."""
    import numpy as np

    return np.linalg.eigvalsh(found.numbers(at))
