"""What is found about stability at the values asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from derive.algebra.numbers.floats import number
from derive.control.oracle import poles
from derive.control.oracle.equations import is_close, value
from derive.derivation import Claim, Phrase
from derive.expression import Symbol
from derive.kinds.checks import route
from derive.kinds.fields import TREES
from derive.kinds.system._array_checks import characteristic
from derive.kinds.system._checked_array import Printed
from derive.kinds.system._oracle import Held, Point, complexes, reals, same_roots
from derive.kinds.system._relation_checks import holds

CLOSE = 1e-8


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
    yield is_close(value(told.shown[0][-1], at), characteristic(printed, at))
    yield {chain[0]: chain[-1] for chain in told.point} == {
        Symbol(k): v for k, v in (held.given or {}).items()
    }
    for row, trees in zip(evaluated.get("routh", printed.routh.rows), printed.routh.rows, strict=True):
        for found, tree in zip(row, trees, strict=True):
            yield isinstance(found, (*TREES, str)) or _near(found, number(tree, place))
    for found, relation in zip(evaluated["conditions"], printed.conditions, strict=True):
        met = holds(relation, place)
        if isinstance(found, bool) and met is not None:
            yield found == met
    if "poles" not in evaluated:
        return
    polynomial = [number(each, place) for each in printed.coefficients]
    least, most = poles.on_right(polynomial)
    possible = poles.possible(polynomial)
    yield least <= evaluated["unstable_poles"] <= most
    verdict = told.verdict.key if told.verdict else ""
    yield verdict in possible and evaluated["stable"] == (verdict == "stable")
    roots = complexes(evaluated["poles"])
    yield same_roots(told.poles, evaluated["poles"])
    yield is_close(
        poles.product(polynomial[0], roots, at["s"]),
        sum(k * at["s"] ** (len(polynomial) - 1 - place) for place, k in enumerate(polynomial)),
        1e-6,
    )
    failing = tuple(
        each for found, each in zip(evaluated["conditions"], printed.conditions, strict=True) if not found
    )
    if not printed.symbols or printed.told.never or not printed.conditions:
        yield told.met is None
    else:
        yield told.met == (Phrase("not-met", {"failing": failing}) if failing else Phrase("all-met"))


def _near(left: float, right: float) -> bool:
    return abs(left - right) <= CLOSE * max(1.0, abs(left), abs(right))
