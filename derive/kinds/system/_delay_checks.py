"""The fractions that stand for delays, as they are printed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.control.oracle.delays import exponential
from derive.control.oracle.equations import is_close, value
from derive.derivation import Claim, Step
from derive.expression import Symbol, number
from derive.kinds.checks import route
from derive.kinds.system._oracle import Held, Point
from derive.kinds.system._plant import Delayed


def fraction_claims(held: Held, steps: Sequence[Step]) -> Iterator[Claim]:
    """One for all delays that the page shows."""
    shown = [step for step in steps if step.rule == "delay"]
    if shown:
        yield route(
            "delay-fractions", [*_told(held, shown), *held.compared(lambda at: _fractions(held, shown, at))]
        )


def _told(held: Held, shown: Sequence[Step]) -> Iterator[bool]:
    """What is said of each: what was typed, and up to which power the series agree."""
    yield len(shown) == len(held.system.delays)
    for step, delay in zip(shown, held.system.delays, strict=True):
        told = step.facts
        yield isinstance(told, Delayed) and told.typed == delay.typed and told.order == delay.order
        yield isinstance(told, Delayed) and told.last == Symbol("s") ** number(2 * delay.order)


def _fractions(held: Held, shown: Sequence[Step], at: Point) -> Iterator[bool]:
    for step, delay in zip(shown, held.system.delays, strict=True):
        other = exponential(delay.order, -value(delay.time, at) * at["s"])
        yield is_close(value(step.result, at), other)
