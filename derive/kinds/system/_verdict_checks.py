"""What is concluded from an array of Routh, held to the roots themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from math import log

from derive.algebra.numbers.floats import number
from derive.control.oracle import poles
from derive.control.oracle.equations import value
from derive.derivation import Phrase, Result
from derive.expression import ZERO, Approximate, Expr, Number, Relation, Symbol, free_symbols
from derive.expression import number as tree
from derive.kinds.fields import TREES
from derive.kinds.system._checked_array import NOWHERE, Printed
from derive.kinds.system._oracle import Held
from derive.kinds.system._relation_checks import CLEAR, all_hold
from derive.kinds.system._stability_facts import NEVER, Around

ENOUGH = 6  # points with a stable loop
OUT = 2.3  # a place further out than 1
SYMBOLIC = {*NEVER.values(), "marginal", "marginal-where", "always", "left-where"}
IN_NUMBERS = {
    "no-change", "one-change", "two-changes", "changes", "small-is-positive", "on-the-axis", "is-stable",
    "is-unstable", "is-marginal", "unstable-by-a-repeated-root",
}  # fmt: skip
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


def sought(printed: Printed) -> Iterator[bool]:
    """The same where a wide search finds that all roots lie left, or that the conditions are said to hold."""
    met = 0
    for at, polynomial in printed.far_and_near():
        possible = poles.possible(polynomial)
        try:
            said = all_hold(printed.conditions, at)
        except NOWHERE:
            continue
        if said is None or len(possible) > 1:
            continue
        if said or possible == {"stable"}:
            yield said and possible == {"stable"} and not printed.told.never
            met += 1
        if met == ENOUGH:
            return


def marginal(printed: Printed) -> Iterator[bool]:
    """What is never stable is marginally so just where that is said."""
    conditions = printed.told.marginal
    for at, _, verdict in _verdicts(printed):
        met = False if conditions is None else all_hold(conditions, at)
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
    said, critical = printed.told.limit, printed.told.critical
    relation = said.about["equation"] if said else None
    if step is None or not isinstance(relation, Relation) or not isinstance(relation.left, TREES):
        return
    yield relation.sign == "="
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
    told, symbolic = printed.told, bool(printed.symbols)
    motor = "motor" if held.system.motor else "system"
    what = Phrase("loop" if held.controller is not None else motor)
    everywhere = (
        told.criterion,
        *told.concluded,
        *([told.at.verdict] if told.at and told.at.verdict else ()),
    )
    yield all(each.about.get("what", what) == what for each in everywhere)
    yield told.criterion.key == ("criterion-hidden" if "hidden" in told.criterion.about else "criterion")
    yield {each.key for each in told.concluded} <= (SYMBOLIC if symbolic else IN_NUMBERS)
    yield (told.said("always") is not None) == (symbolic and not told.never and not told.conditions)
    yield (told.said("left-where") is not None) == (bool(told.conditions) and printed.degree > 1)
    written = tuple(bound for each in told.conditions for bound in _bounds(each))
    yield written == (() if told.never or not symbolic else printed.conditions)
    beside = bool(printed.positive & {*printed.symbols})
    yield (told.needed is not None) == bool(told.conditions)
    yield told.needed is None or told.needed.key == ("needed-beside" if beside else "needed")
    yield (told.limit is None) == all(step.name != "limit" for step in printed.steps)
    if told.limit:
        several, s = len(told.conditions) > 1, Symbol("s")
        about = {"equation": told.limit.about["equation"], "s": s, "square": s ** tree(2)}
        yield told.limit == Phrase("limit-while" if several else "limit-alone", about)
    signs = [_signs(polynomial) for _, polynomial in printed.points()]
    met = [0 not in each and len(each) == 1 for each in signs]
    key, _, enough = told.coefficients.key.partition("-")
    yield {"met": all(met), "violated": not any(met), "open": symbolic}[key]
    yield key == "violated" or bool(enough) == (printed.degree <= 2)
    yield from _mended(printed)
    yield told.never or not symbolic or not any(map(_is_plain, printed.conditions))
    if told.one_sign:
        yield told.one_sign == Phrase("one-sign", {"coefficients": printed.coefficients})
        yield printed.degree <= 2
    if not symbolic:
        yield from _on_axis(printed, results)


def _bounds(condition: Relation) -> tuple[Relation, ...]:
    """What 0 < K < 5 says of K: K > 0 and K < 5."""
    if not isinstance(inner := condition.left, Relation):
        return (condition,)
    assert not isinstance(inner.left, Relation)  # two bounds at most
    return Relation(inner.right, ">", inner.left), Relation(inner.right, "<", condition.right)


def _mended(printed: Printed) -> Iterator[bool]:
    """The special cases of the array, as they are told, and what is concluded from them."""
    told = printed.told
    vanished = any(step.rule == "auxiliary" for step in printed.steps)
    small = printed.epsilon is not None
    yield small == any(row[0] == printed.epsilon for row in printed.routh.rows)
    second = printed.routh.rows[1][0] == printed.epsilon if printed.degree else False
    yield told.second == (Phrase("second-row", {"epsilon": printed.routh.rows[1][0]}) if second else None)
    yield (told.said("small-is-positive") is not None) == (small and not printed.symbols)
    yield told.said("never-by-zeros") is None or vanished
    yield told.said("never-by-a-zero") is None or small
    for step in printed.steps:
        said = step.facts
        if not isinstance(said, Around):
            continue
        row = said.before.about.get("row") if said.before else None
        yield row is None or step.name.endswith(f"_{row}")
        before, after = (each.key if each else "" for each in (said.before, said.after))
        yield before == {"epsilon": "next-vanishes", "auxiliary": "row-vanishes"}.get(step.rule, "")
        yield step.rule == "auxiliary" or after == {
            "epsilon": "small-number",
            "derivative": "fills-the-row",
        }.get(step.rule, "")
        yield step.rule != "epsilon" or (
            said.after is not None and said.after.about == {"epsilon": printed.epsilon}
        )
        if step.rule == "auxiliary" and said.after and not printed.symbols:
            at_one, further = (abs(value(step.result, {"s": s})) for s in (1.0, OUT))
            power = log(further / at_one) / log(OUT) if at_one else 0.5
            origin = abs(power - round(power)) < CLEAR  # a single term
            yield said.after.key == ("root-at-the-origin" if origin else "symmetric-roots")


def _on_axis(printed: Printed, results: Mapping[str, Result]) -> Iterator[bool]:
    """How many roots are said to lie right of the axis, and which on it; of numbers."""
    told = printed.told
    (_, polynomial), *_ = printed.points()
    least, most = poles.on_right(polynomial)
    changed = told.said("no-change", "one-change", "two-changes", "changes")
    on_right = results["unstable_poles"]
    yield changed is not None or printed.degree < 2
    if changed is not None:
        found = changed.about["count"]
        count = found if isinstance(found, int) else -1
        yield least <= count <= most and on_right == tree(count)
        yield changed.key == {0: "no-change", 1: "one-change", 2: "two-changes"}.get(count, "changes")
    yield told.said("unstable-by-a-repeated-root") is None or on_right == ZERO
    yield told.said("is-unstable") is None or on_right != ZERO
    axis = told.said("on-the-axis")
    shown = axis.about["roots"] if axis else ()
    places = [value(z, {"j": 1j}) for z in shown if isinstance(z, TREES)] if isinstance(shown, tuple) else []
    yield all(poles.is_zero_at(polynomial, z) and not z.real for z in places)
    yield bool(places) or printed.degree < 2 or not poles.possible(polynomial) <= MARGINAL


def _is_plain(relation: Relation) -> bool:
    """Whether no symbols stand in it: then it holds or not, and is no condition."""
    sides = (relation.left, relation.right)
    return not any(free_symbols(side) - {"pi"} for side in sides if isinstance(side, TREES))


def _signs(polynomial: Sequence[float]) -> set[int]:
    return {(k > 0) - (k < 0) for k in polynomial}
