"""What a closed loop is held to: its controller, its function as printed, and what is said of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from derive.control.oracle import poles
from derive.control.oracle.equations import is_close, quotient, value
from derive.control.oracle.growth import degree
from derive.control.rational import Rational
from derive.derivation import Claim, Phrase, Step
from derive.expression import ZERO, Expr, Relation, Symbol, free_symbols
from derive.kinds.checks import route
from derive.kinds.system._loop_facts import Facts
from derive.kinds.system._oracle import Held, Point, reals
from derive.kinds.system._point_checks import is_named, point_claims
from derive.kinds.system._reach import is_reach
from derive.kinds.system._transfer_checks import denominator_degree, is_degree


def said(held: Held, told: Facts, steps: Sequence[Step], results: Mapping[str, Expr]) -> Iterator[bool]:
    """Degree, what can be built and what follows without error; which signals, which controller."""
    controller, system = held.controller, held.system
    yield controller is not None and told.family.key == controller.family
    yield (told.input, told.output, told.motor) == (system.input, system.output, system.motor)
    yield "D" in told.family.key if told.derivative else True
    yield told.tracks in (None, Phrase("tracks", {"origin": Relation(Symbol("s"), "=", ZERO)}))
    if told.at is not None and told.at.verdict is not None and controller is not None:
        one = len(controller.gains) == 1
        yield told.at.verdict.about == {"gains": Phrase("this-gain" if one else "these-gains")}
    through = free_symbols(told.through)
    yield value(told.through, dict(zip(sorted(through), (2, 3), strict=True))) == 6
    yield all(any(is_named(Symbol(name), each, system) for each in "CG") for name in through)
    yield from held.compared(lambda at: _degrees(held, told, steps, results, at))


def _degrees(
    held: Held, told: Facts, steps: Sequence[Step], results: Mapping[str, Expr], at: Point
) -> Iterator[bool]:
    plant = replace(held, controller=None)
    whole = next(step.result for step in steps if step.name == "T")
    left = next((step.result for step in steps if step.rule == "cancel"), None)
    lost = told.cancelled.about.get("count", 0) if told.cancelled else 0

    def through(s: complex) -> complex:
        return held.strength(reals(at), s) * plant.gain(reals(at), s)

    def missing(s: complex) -> complex:
        return 1 - value(results["T"], {**at, "s": s})

    yield from is_degree(told.order, denominator_degree(whole, at))
    yield from is_reach(told.reach, held, whole, told.order, at)
    lose = Phrase("motion-cancels", {"count": lost}) if lost else Phrase("factor-cancels", {"s": Symbol("s")})
    yield told.cancelled == (None if left is None else lose)
    if left is not None and (after := denominator_degree(left, at)) is not None:
        yield told.order - after == lost
    if (far := degree(through)) is not None:
        built = "improper-loop" if far > 0 else "ideal-derivative" if "D" in told.family.key else None
        yield (told.derivative.key if told.derivative else None) == built
    if (near := degree(missing, inward=True)) is not None:
        yield near > 0 if told.tracks else near <= 0 or bool(lost)


def loop_point_claims(
    held: Held, whole: Rational | None, evaluated: Mapping[str, Any], told: Facts
) -> Iterator[Claim]:
    """The loop in numbers, and its verdict by the `whole` function, in which nothing has cancelled; None
    where symbols are left."""
    if told.at is None or whole is None:
        yield from point_claims(held, evaluated, "T", told.at)
        return
    num, den = whole.numbers()
    yield from point_claims(held, evaluated, "T", told.at, den)
    yield route(
        "nothing-cancelled",
        held.compared(lambda at: [is_close(quotient(num, den, at["s"]), held.gain(reals(at), at["s"]))]),
    )
    shown, all_of_it = poles.possible(evaluated["T"]["den"]), poles.possible(den)
    if len(shown) == len(all_of_it) == 1:
        yield route(
            "hidden",
            (
                told.at.hidden
                == (Phrase("growth-cancels") if "stable" in shown and "stable" not in all_of_it else None),
            ),
        )
