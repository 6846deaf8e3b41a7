"""What is concluded from an array of Routh, held to the roots themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from derive.algebra.numbers.floats import number
from derive.control.oracle import poles
from derive.control.oracle.equations import value
from derive.derivation import Result
from derive.expression import Approximate, Expr, Number, Relation, Symbol, free_symbols
from derive.expression import number as tree
from derive.kinds.fields import TREES
from derive.kinds.system._checked_array import NOWHERE, Printed
from derive.kinds.system._oracle import Held
from derive.kinds.system._relation_checks import CLEAR, all_hold, holds

MARGINAL = frozenset({"integrator", "oscillator"})


def _verdicts(printed: Printed) -> Iterator[tuple[dict[str, float], list[float], str]]:
    """Points at which floats tell where the roots lie."""
    for at, polynomial in printed.points():
        found = poles.possible(polynomial)
        if len(found) == 1:
            (verdict,) = found
            yield at, polynomial, verdict


def stable(printed: Printed) -> Iterator[bool]:
    """The conditions hold exactly where all roots lie left; where none can, it is said."""
    for at, _, verdict in _verdicts(printed):
        try:
            met = all_hold(printed.conditions, at)
        except NOWHERE:
            continue
        if met is not None:
            yield met == (verdict == "stable")
            yield not (printed.told.never and verdict == "stable")


def marginal(printed: Printed, conditions: tuple[Relation, ...]) -> Iterator[bool]:
    for at, _, verdict in _verdicts(printed):
        met = all_hold(conditions, at)
        if met is not None:
            yield met == (verdict in MARGINAL)


def changes(printed: Printed) -> Iterator[bool]:
    """Sign changes of the first column, at random: roots on the right."""
    for at, polynomial in printed.points():
        try:
            column = [number(row[0], at) for row in printed.routh.rows]
        except NOWHERE:
            continue
        if all(abs(entry) > CLEAR for entry in column):
            least, most = poles.on_right(polynomial)
            yield least <= sum(a * b < 0 for a, b in pairwise(column)) <= most


def limit(printed: Printed) -> Iterator[bool]:
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


def said(held: Held, printed: Printed, results: Mapping[str, Result]) -> Iterator[bool]:
    """The sentences, at the points where floats tell."""
    told = printed.told
    yield told.closed == (held.controller is not None) and told.motor == held.system.motor
    yield told.symbolic == bool(printed.symbols)
    yield told.conditions == (() if told.never else printed.conditions)
    yield told.assumed == bool(printed.positive & {*printed.symbols})
    signs = [_signs(polynomial) for _, polynomial in printed.points()]
    met = [0 not in each and len(each) == 1 for each in signs]
    yield {"met": all(met), "violated": not any(met), "open": bool(printed.symbols)}[told.coefficients]
    vanished = any(step.rule == "auxiliary" for step in printed.steps)
    small = any(row[0] == told.epsilon for row in printed.routh.rows)
    yield {*told.mended} == {*["derivative"] * vanished, *["epsilon"] * small}
    decided = [holds(each, {}) for each in printed.conditions if _is_plain(each)]
    yield told.never or not ({False, None} & {*decided})
    if told.one_sign:
        yield told.one_sign == printed.coefficients and printed.degree <= 2
    if not printed.symbols:
        (_, polynomial), *_ = printed.points()
        least, most = poles.on_right(polynomial)
        yield least <= told.changes <= most and results["unstable_poles"] == tree(told.changes)
        places = [value(tree, {"j": 1j}) for tree in told.axis]
        yield all(poles.is_zero_at(polynomial, z) and not z.real for z in places)
        on_axis = poles.possible(polynomial) <= MARGINAL
        yield bool(places) or not on_axis


def _is_plain(relation: Relation) -> bool:
    """Whether no symbols stand in it: then it holds or not, and equal numbers say that it does not."""
    sides = (relation.left, relation.right)
    return not any(free_symbols(side) - {"pi"} for side in sides if isinstance(side, TREES))


def _signs(polynomial: Sequence[float]) -> set[int]:
    return {(k > 0) - (k < 0) for k in polynomial}
