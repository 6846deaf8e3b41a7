"""An answer about stability as it is printed, held to roots and determinants in floating point."""

from __future__ import annotations

import itertools
import random
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from derive.algebra.numbers.floats import number
from derive.control.oracle import hurwitz, poles
from derive.control.oracle.equations import Numeric, divides_by_s, is_close, value
from derive.derivation import Claim, Result, Step
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    ZERO,
    Approximate,
    Expr,
    Indexed,
    Matrix,
    Number,
    Relation,
    Symbol,
    free_symbols,
)
from derive.kinds.checks import route
from derive.kinds.fields import TREES
from derive.kinds.system._oracle import Held, Point, complexes, reals, same_roots
from derive.kinds.system._point_checks import verdict_claim
from derive.kinds.system._stability_facts import Facts

TRIED, LARGEST = 40, 6.0  # points, and the largest value of a symbol there
CLEAR = 1e-7  # of the sides of a relation: closer ones are not told apart
CLOSE = 1e-8
MOST = 12  # equations whose determinant is taken
MARGINAL = frozenset({"integrator", "oscillator"})
NOWHERE = (ValueError, ZeroDivisionError, OverflowError, NotDerivable)


@dataclass(frozen=True)
class Printed:
    """What stands on the page: the array as a result, the conditions, the steps, and what the words are
    told."""

    routh: Matrix
    conditions: tuple[Relation, ...]
    steps: Sequence[Step]
    told: Facts
    positive: frozenset[str]
    letter: str  # of the entries

    @cached_property
    def symbols(self) -> list[str]:
        """Those the array is made of, without the small number."""
        sides = [side for each in self.conditions for side in (each.left, each.right)]
        trees = [
            *(entry for row in self.routh.rows for entry in row),
            *(t for t in sides if isinstance(t, TREES)),
        ]
        found = frozenset[str]().union(*map(free_symbols, trees))
        return sorted(found - {self.told.epsilon.name, "pi"})

    @property
    def degree(self) -> int:
        """Of the polynomial: the array has one row more."""
        return len(self.routh.rows) - 1

    @property
    def coefficients(self) -> tuple[Expr, ...]:
        """Of the polynomial, highest power first: the first two rows in turn, as the second was before it was
        mended."""
        first, second = self.routh.rows[:2]
        if self.first_mended == 2:
            second = (ZERO, *second[1:]) if second[0] == self.told.epsilon else (ZERO,) * len(second)
        both = [entry for pair in zip(first, second, strict=True) for entry in pair]
        return tuple(both[: self.degree + 1])

    @property
    def first_mended(self) -> int:
        """The first row that was mended; the one after the last where none was."""
        small = (i for i, row in enumerate(self.routh.rows, 1) if row[0] == self.told.epsilon)
        rows = (int(s.name.rsplit("_", 1)[-1]) for s in self.steps if s.rule == "auxiliary")
        return min((*small, *rows), default=self.degree + 2)

    def points(self) -> Iterator[tuple[dict[str, float], list[float]]]:
        """Values of the symbols and the polynomial there; every second point has negative ones. Points
        where it is not real, or of lower degree, are passed over."""
        draw = random.Random(" ".join(self.symbols))
        for k in range(TRIED if self.symbols else 1):
            at = {
                name: draw.uniform(0.05, LARGEST)
                * (1 if name in self.positive or k % 2 else draw.choice((1, -1)))
                for name in self.symbols
            }
            try:
                found = [number(each, at) for each in self.coefficients]
            except NOWHERE:
                continue
            if found[0]:
                yield at, found


def routes(held: Held, printed: Printed, results: Mapping[str, Result]) -> Iterator[Claim]:
    """The polynomial against the equations, the array against determinants, what is concluded against
    roots."""
    told = printed.told
    yield route("polynomial", held.compared(lambda at: _is_of_array(printed, at)))
    if not divides_by_s(held.system) and len(held.system.equations) <= MOST:
        yield route("determinant", held.compared(lambda at: _is_determinant(held, printed, at)))
    yield route("minors", _minors(printed))
    yield route("array-as-printed", _array(printed))
    stable = [*_stable(printed)]
    if stable:
        yield route("exactly-stable", stable)
    if told.marginal is not None and (marginal := [*_marginal(printed, told.marginal)]):
        yield route("marginally-stable", marginal)
    if "epsilon" not in told.mended and (changes := [*_changes(printed)]):
        yield route("sign-changes-at-random", changes)
    yield route("as-said", _said(held, printed, results))
    if limit := [*_limit(printed)]:
        yield route("limit", limit)
    if not printed.symbols:
        (_, polynomial), *_ = printed.points()
        yield verdict_claim(polynomial, told.verdict)


# -- the polynomial and the array ---------------------------------------------------------------------


def _characteristic(printed: Printed, at: Point) -> complex:
    """As the page ends with it."""
    chains = {step.name: step.chain for step in printed.steps}
    return value(chains.get("values", chains["characteristic"])[-1], at)


def _is_of_array(printed: Printed, at: Point) -> Iterator[bool]:
    """The polynomial is that of the array, times the factor that is left out."""
    rows = 0j
    for coefficient in printed.coefficients:
        rows = rows * at["s"] + value(coefficient, at)
    factor = ONE if printed.told.factor is None else printed.told.factor
    ours = _characteristic(printed, at)
    yield is_close(ours, value(factor, at) * rows) and bool(ours)


def _is_determinant(held: Held, printed: Printed, at: Point) -> Iterator[bool]:
    """Up to what holds no s it is the determinant of the equations, the integral of a controller brought
    up."""
    import numpy

    shares = []
    for s in (at["s"], 2 * at["s"].conjugate() + 0.3):
        solved = Numeric.of(held.system, held.source, reals(at))
        controller = held.controller
        matrix = solved.matrix(s) if controller is None else solved.loop(s, held.strength(reals(at), s))
        below = s if controller is not None and "I" in controller.family else 1.0
        shares.append(_characteristic(printed, {**at, "s": s}) / (below * numpy.linalg.det(matrix)))
    yield is_close(shares[0], shares[1], 1e-6)


def _minors(printed: Printed) -> Iterator[bool]:
    """Entries by determinants of Hurwitz, down to the row that has to be mended; one is where the words say
    so."""
    regular = printed.first_mended
    for at, polynomial in list(printed.points())[:3]:
        size = max(map(abs, polynomial))
        for i, row in enumerate(printed.routh.rows[: regular - 1], 1):
            for j, tree in enumerate(row, 1):
                other = hurwitz.entry(polynomial, i, j)
                if other is not None:
                    ours = number(tree, at)
                    yield abs(ours - other) <= CLOSE * max(size, abs(ours), abs(other))
        if regular <= printed.degree + 1:
            first = hurwitz.entry(polynomial, regular, 1)
            yield first is None or abs(first) <= CLOSE * size
        yield bool(printed.told.mended) == (regular <= printed.degree + 1)


def _array(printed: Printed) -> Iterator[bool]:
    """The table and the first column hold the entries; a long one by its name, whose indices say where it
    is."""
    told, rows = printed.told, printed.routh.rows
    yield told.degree == printed.degree
    yield told.column == tuple(row[0] for row in rows)
    heads = {step.chain[0]: step for step in printed.steps if step.rule == "entry"}
    for name, step in heads.items():
        i, j = _place(name, printed.letter)
        yield step.name == f"entry_{i}_{j}" and step.result == rows[i - 1][j - 1]
    if told.array is None:
        yield printed.degree < 2
        return
    for i, (row, cells) in enumerate(zip(rows, told.array.rows, strict=True), 1):
        yield cells[0] == str(i) and cells[1] == _power(printed.degree + 1 - i)
        for j, (entry, cell) in enumerate(zip(row, cells[2:], strict=True), 1):
            named = isinstance(cell, Symbol | Indexed) and cell != entry
            yield (
                _place(cell, printed.letter) == (i, j)
                if named
                else cell == entry or (cell == "" and entry == ZERO)
            )


def _place(name: object, letter: str) -> tuple[int, int]:
    """The row and the column that a name r_ij says."""
    if isinstance(name, Indexed) and name.base == letter:
        i, j = (round(number(index, {})) for index in name.lower)
        return i, j
    text = name.name if isinstance(name, Symbol) else ""
    start, _, index = text.partition("_")
    return (int(index[0]), int(index[1])) if start == letter and len(index) == 2 else (0, 0)


def _power(power: int) -> Expr:
    s = Symbol("s")
    return ONE if power == 0 else s if power == 1 else s**power


# -- what follows -------------------------------------------------------------------------------------


def _holds(relation: Relation, at: Mapping[str, float]) -> bool | None:
    """Whether it holds; None where its sides are too close."""
    if not isinstance(relation.left, TREES):
        return None
    left, right = number(relation.left, at), number(relation.right, at)
    if abs(left - right) <= CLEAR * max(abs(left), abs(right), 1e-3):
        return None
    return (left > right) == (relation.sign == ">")


def _met(relations: Iterable[Relation], at: Mapping[str, float]) -> bool | None:
    """Whether all hold."""
    found = [_holds(each, at) for each in relations]
    return False if False in found else None if None in found else True


def _verdicts(printed: Printed) -> Iterator[tuple[dict[str, float], list[float], str]]:
    """Points at which floats tell where the roots lie."""
    for at, polynomial in printed.points():
        found = poles.possible(polynomial)
        if len(found) == 1:
            (verdict,) = found
            yield at, polynomial, verdict


def _stable(printed: Printed) -> Iterator[bool]:
    """The conditions hold exactly where all roots lie left; where none can, it is said."""
    for at, _, verdict in _verdicts(printed):
        try:
            met = _met(printed.conditions, at)
        except NOWHERE:
            continue
        if met is not None:
            yield met == (verdict == "stable")
            yield not (printed.told.never and verdict == "stable")


def _marginal(printed: Printed, conditions: tuple[Relation, ...]) -> Iterator[bool]:
    for at, _, verdict in _verdicts(printed):
        met = _met(conditions, at)
        if met is not None:
            yield met == (verdict in MARGINAL)


def _changes(printed: Printed) -> Iterator[bool]:
    """Sign changes of the first column, at random: roots on the right."""
    for at, polynomial in printed.points():
        try:
            column = [number(row[0], at) for row in printed.routh.rows]
        except NOWHERE:
            continue
        if all(abs(entry) > CLEAR for entry in column):
            least, most = poles.on_right(polynomial)
            yield least <= sum(a * b < 0 for a, b in itertools.pairwise(column)) <= most


def _limit(printed: Printed) -> Iterator[bool]:
    """A pair of roots with the frequency told where the limiting condition is an equality."""
    step = next((each for each in printed.steps if each.name == "limit"), None)
    relation, critical = printed.told.limiting, printed.told.critical
    if step is None or relation is None or not isinstance(relation.left, TREES):
        return
    apart = relation.left - relation.right
    for at, _ in list(printed.points())[:8]:
        for name in sorted(free_symbols(apart)):
            there = _crossing(apart, at, name)
            if there is None:
                continue
            square = number(step.result, there)
            if square > CLEAR:
                polynomial = [number(each, there) for each in printed.coefficients]
                yield poles.is_zero_at(polynomial, complex(0.0, square**0.5))
    if critical is not None:
        (open_, gain), (omega, *omegas) = critical
        there = {open_.name: number(gain, {})} if isinstance(open_, Symbol) else {}
        polynomial = [number(each, there) for each in printed.coefficients]
        yield from (poles.is_zero_at(polynomial, complex(0.0, number(each, {}))) for each in omegas)
        yield isinstance(omegas[-1], Number | Approximate)
        yield all(number(each, {}) > 0 for each in omegas) and omega**2 == step.chain[0]
        yield abs(number(apart, there)) <= CLEAR


def _crossing(apart: Expr, at: Mapping[str, float], name: str) -> dict[str, float] | None:
    """Where the sides become equal as one symbol grows, the others as they are; None where they do not."""
    low, high = 1e-3, 100.0
    try:
        signs = [number(apart, {**at, name: x}) for x in (low, high)]
        if signs[0] * signs[1] >= 0:
            return None
        for _ in range(80):
            middle = (low + high) / 2
            low, high = (
                (middle, high) if number(apart, {**at, name: middle}) * signs[0] > 0 else (low, middle)
            )
    except NOWHERE:
        return None
    return {**at, name: (low + high) / 2}


def _said(held: Held, printed: Printed, results: Mapping[str, Result]) -> Iterator[bool]:
    """The sentences, at the points where floats tell."""
    told = printed.told
    yield told.closed == (held.controller is not None) and told.motor == held.system.motor
    yield told.symbolic == bool(printed.symbols) and told.origin == ZERO
    yield told.conditions == printed.conditions
    yield told.assumed == bool(printed.positive & {*printed.symbols})
    signs = [_signs(polynomial) for _, polynomial in printed.points()]
    met = [0 not in each and len(each) == 1 for each in signs]
    yield {"met": all(met), "violated": not any(met), "open": bool(printed.symbols)}[told.coefficients]
    vanished = any(step.rule == "auxiliary" for step in printed.steps)
    small = any(row[0] == told.epsilon for row in printed.routh.rows)
    yield {*told.mended} == {*["derivative"] * vanished, *["epsilon"] * small}
    decided = [_holds(each, {}) for each in printed.conditions if _is_plain(each)]
    yield told.never or not ({False, None} & {*decided})
    if told.one_sign:
        yield told.one_sign == printed.coefficients and printed.degree <= 2
    if not printed.symbols:
        (_, polynomial), *_ = printed.points()
        least, most = poles.on_right(polynomial)
        yield least <= told.changes <= most and results["unstable_poles"] == _whole(told.changes)
        places = [value(tree, {"j": 1j}) for tree in told.axis]
        yield all(poles.is_zero_at(polynomial, z) and not z.real and z.imag >= 0 for z in places)
        on_axis = poles.possible(polynomial) <= MARGINAL
        yield bool(places) or not on_axis


def _is_plain(relation: Relation) -> bool:
    """Whether no symbols stand in it: then it holds or not, and equal numbers say that it does not."""
    sides = (relation.left, relation.right)
    return not any(free_symbols(side) - {"pi"} for side in sides if isinstance(side, TREES))


def _whole(count: int) -> Expr:
    from derive.expression import number as tree

    return tree(count)


def _signs(polynomial: Sequence[float]) -> set[int]:
    return {(k > 0) - (k < 0) for k in polynomial}


# -- at the values asked for --------------------------------------------------------------------------


def point_routes(held: Held, printed: Printed, evaluated: Mapping[str, Any]) -> Iterator[Claim]:
    """What is found at the values asked for: the polynomial and its roots, the array, which conditions
    hold."""
    if printed.told.at is not None:
        yield route("in-numbers", held.compared(lambda at: _at_values(held, printed, evaluated, at)))


def _at_values(held: Held, printed: Printed, evaluated: Mapping[str, Any], at: Point) -> Iterator[bool]:
    told = printed.told.at
    if told is None:
        return
    place = reals(at)
    yield len(told.shown[0]) == 2 and told.shown[0][0] == printed.steps[0].chain[0]
    yield is_close(value(told.shown[0][-1], at), _characteristic(printed, at))
    yield {chain[0]: chain[-1] for chain in told.point} == {
        Symbol(k): v for k, v in (held.given or {}).items()
    }
    for row, trees in zip(evaluated.get("routh", printed.routh.rows), printed.routh.rows, strict=True):
        for found, tree in zip(row, trees, strict=True):
            yield isinstance(found, (*TREES, str)) or _near(found, number(tree, place))
    for found, relation in zip(evaluated["conditions"], printed.conditions, strict=True):
        holds = _holds(relation, place)
        if isinstance(found, bool) and holds is not None:
            yield found == holds
    if "poles" not in evaluated:
        return
    polynomial = [number(each, place) for each in printed.coefficients]
    least, most = poles.on_right(polynomial)
    possible = poles.possible(polynomial)
    yield least <= evaluated["unstable_poles"] <= most
    yield told.verdict in possible and evaluated["stable"] == (told.verdict == "stable")
    roots = complexes(evaluated["poles"])
    yield same_roots(told.poles, evaluated["poles"])
    yield is_close(
        poles.product(polynomial[0], roots, at["s"]),
        sum(k * at["s"] ** (len(polynomial) - 1 - place) for place, k in enumerate(polynomial)),
        1e-6,
    )
    yield told.failing == tuple(
        each for found, each in zip(evaluated["conditions"], printed.conditions, strict=True) if not found
    )


def _near(left: float, right: float) -> bool:
    return abs(left - right) <= CLOSE * max(1.0, abs(left), abs(right))
