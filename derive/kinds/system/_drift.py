"""How a system that integrates moves in the end under a constant input: at a rate that stays."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from derive.algebra.numbers.floats import number as number_of
from derive.algebra.readable.form import readable
from derive.control.oracle.equations import is_close, value
from derive.control.rational import Rational
from derive.derivation import Phrase, Step
from derive.expression import Approximate, Expr, Symbol, is_negative
from derive.kinds.system._oracle import Held, Point, reals
from derive.kinds.system._plant import AtPoint, Plant

NEAR = 1e-5  # of the origin, where the limit of s G(s) is taken
CLOSE = 1e-6


class DriftAtPoint(AtPoint):
    drift: tuple[Expr, ...] = ()  # the rate in numbers
    way: Phrase | None = None  # which way it moves


def integrates_once(rational: Rational) -> bool:
    """Whether it is proper and its denominator has the factor s once, its numerator not."""
    once = bool(rational.num and rational.num[-1]) and not rational.den[-1] and bool(rational.den[-2])
    return once and rational.proper


def drift(solved: Plant, rational: Rational) -> tuple[Expr, Expr]:
    """The rate of the output, and s G(s) at s = 0 times the input."""
    rate = Symbol(f"{solved.system.output.name}_dot")
    return rate, readable(rational.num[-1] / rational.den[-2], solved.style) * solved.solution.source


def in_decimals(chain: tuple[Expr, Expr], solved: Plant) -> tuple[Expr, Expr]:
    """With the rate rounded, where decimals were typed and it is none of a few digits."""
    source = solved.solution.source
    rate = number_of(chain[-1], {source.name: 1.0})
    if not solved.style.decimals or rate == round(rate, 3):
        return chain
    return chain[0], Approximate(abs(rate)) * source if rate > 0 else -(Approximate(abs(rate)) * source)


def way_of(chain: tuple[Expr, ...], solved: Plant) -> Phrase:
    """Which way the output moves, by the sign of the rate in numbers."""
    ends = {"input": solved.solution.source, "output": solved.system.output}
    return Phrase("falls" if is_negative(chain[-1]) else "rises", ends)


def is_drift(steps: Sequence[Step], once: bool, held: Held, at: Point) -> Iterator[bool]:
    """The rate that is told, against the equations close to s = 0."""
    found = [step.chain for step in steps if step.rule == "drift"]
    yield len(found) == once
    for head, rate in found:
        yield head == Symbol(f"{held.system.output.name}_dot")
        near, far = (h * held.gain(reals(at), complex(h)) for h in (NEAR, 2 * NEAR))
        yield is_close(value(rate, {**at, held.source.name: 1.0}), 2 * near - far, CLOSE)


def is_drift_there(told: DriftAtPoint, steps: Sequence[Step], held: Held, at: Point) -> Iterator[bool]:
    """The rate in numbers is that of the line, and moves the way it is said to."""
    driven: Mapping[str, complex] = {**at, held.source.name: 1.0}
    (line,) = (step.chain for step in steps if step.rule == "drift")
    yield len(told.drift) == 2 and told.drift[0] == line[0]
    yield is_close(value(told.drift[-1], {held.source.name: 1.0}), value(line[-1], driven))
    ends = {"input": held.source, "output": held.system.output}
    yield told.way == Phrase("falls" if value(line[-1], driven).real < 0 else "rises", ends)
