"""What is said about a transfer function and on the way to it, worked out again from what is printed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.control.oracle.equations import Numeric, value
from derive.control.oracle.growth import degree
from derive.derivation import Claim, Step
from derive.expression import ONE, Expr, Product, Quotient, Symbol, free_symbols
from derive.kinds.checks import route
from derive.kinds.system._oracle import Held, Point, reals
from derive.kinds.system._transfer_facts import Eliminated, Facts

NEARLY = 1e-9


def said(held: Held, told: Facts, steps: Sequence[Step], G: Expr) -> Claim:
    """Degree, proper or not, integrating or not; which inputs and which signals."""
    names = tuple(step.name for step in steps if step.rule == "elimination")
    plain = [
        told.motor == held.system.motor,
        (told.input, told.output) == (held.source, held.system.output),
        told.disturbed == (held.source != held.system.input),
        (*told.eliminations, "relation") == names,
    ]
    return route("as-said", [*plain, *held.compared(lambda at: _degrees(told, steps, G, at))])


def _degrees(told: Facts, steps: Sequence[Step], G: Expr, at: Point) -> Iterator[bool]:
    whole = next(step.chain[2] for step in steps if step.name == "G")
    left = next((step.result for step in steps if step.rule == "cancel"), whole)
    vanishes = not abs(value(G, at))
    yield told.vanishes == vanishes
    yield from is_degree(told.order, denominator_degree(whole, at))
    yield from is_degree(told.order - told.cancelled, denominator_degree(left, at))
    if vanishes:
        return
    far, near = (degree(lambda s: value(G, {**at, "s": s}), inward) for inward in (False, True))
    if far is not None:
        yield told.proper == (far <= 0)
    if near is not None:
        yield near < 0 if told.integrates else near >= 0 or told.cancelled > 0


def is_degree(told: int, seen: int | None) -> Iterator[bool]:
    """Whether a degree is the one that is seen, if one is."""
    if seen is not None:
        yield told == seen


def denominator_degree(tree: Expr, at: Point) -> int | None:
    """The degree in s of what stands below the bar."""
    factors = tree.factors if isinstance(tree, Product) else (tree,)
    below = next((each.denominator for each in factors if isinstance(each, Quotient)), ONE)
    return degree(lambda s: value(below, {**at, "s": s}))


def eliminations(held: Held, steps: Sequence[Step]) -> Claim:
    """What each elimination is said to be: the equation holds, the signal stands in it, and what is put in
    has been found before."""
    done = [step for step in steps if step.rule == "elimination"]
    return route("eliminations", [*_told(done), *held.compared(lambda at: _holding(held, done, at))])


def _told(steps: Sequence[Step]) -> Iterator[bool]:
    known: list[Symbol] = []
    for step in steps:
        told = step.facts
        if not isinstance(told, Eliminated):
            yield False
            continue
        if told.explicit:
            yield step.chain[0] in told.equation and step.chain[1] in told.equation
        inside = frozenset[str]().union(*map(free_symbols, told.equation))
        before = {each for each in known if each.name in inside}
        yield {*told.put} <= before and bool(told.put) == bool(before)
        if step.name != "relation":
            yield told.signal == step.chain[0] and told.signal not in known
            yield told.signal.name in inside or bool(told.put)
            yield told.explicit == (told.signal in told.equation)
            known.append(told.signal)


def _holding(held: Held, steps: Sequence[Step], at: Point) -> Iterator[bool]:
    solved = Numeric.of(held.system, held.source, reals(at))
    found = {**at, **solved.signals(at["s"], {held.source: 1.0})}
    size = max(map(abs, found.values()))
    for step in steps:
        told = step.facts
        left, right = (
            (value(side, found) for side in told.equation) if isinstance(told, Eliminated) else (1, 0)
        )
        yield abs(left - right) <= NEARLY * max(abs(left), abs(right), size)
