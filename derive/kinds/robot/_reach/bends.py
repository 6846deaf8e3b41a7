"""What two links reach by the range of the joint between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from derive.algebra.numbers.floats import completed, number
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Said
from derive.expression import PI, ZERO, Call, Expr, Symbol, free_symbols, replace, sqrt
from derive.kinds.robot._reach.ranged import NEARLY, Ranged
from derive.kinds.robot._reach.spans import Span
from derive.mechanics.slides import Flat

STEPS = 720


@dataclass(frozen=True, slots=True)
class Bend:
    """From where to where two links reach by the range of the joint between them; whether they do so by a
    `single` bend of the elbow; the `cosine` of the angle between them."""

    distance: Span
    single: bool
    cosine: Expr
    passes: str = ""  # where the elbow changes its side: "stretched", "folded", "both"


def bend_of(ranged: Ranged, arm: Flat, ways: Sequence[Span]) -> Bend | None:
    """The distances of two links whose joints have ranges: r^2 = l1^2 + l2^2 + 2 l1 l2 f, f being the
    cosine of the angle between them. None of any other arm."""
    if arm.rail or len(arm.turning) != 2 or any(each.stride is not None for each in arm.stretches):
        return None
    tilt = ranged.turn(arm.turning[1])
    if tilt is None and ranged.turn(arm.turning[0]) is None:
        return None
    l_1, l_2 = (each.aside for each in arm.stretches)
    cosine = (arm.square - l_1 * l_1 - l_2 * l_2) / (Scalar.of(2) * l_1 * l_2)
    function = ranged.problem.readable(cosine)
    name = ranged.chain.joint(arm.turning[1]).variable
    if free_symbols(function) - ranged.problem.where.keys() - {name, PI.name}:
        return None
    ends = tilt or (-PI, PI)
    single, low, high = _extremes(ranged, function, Symbol(name), ends)
    order, squares = ranged.order, ranged.problem.readable(arm.square)
    one, other = (ranged.problem.readable(length) for length in (l_1, l_2))
    gap = {1: one - other, -1: other - one, 0: ZERO}.get(order.sign(one - other) or 0)
    folded = Call("abs", (one - other,)) if order.sign(one - other) is None else order.simple(gap or ZERO)

    def distance(at: Expr | None, straight: Expr) -> Expr:
        return straight if at is None else sqrt(replace(squares, {Symbol(name): at}))

    ends_of = Span(distance(low, folded), distance(high, order.simple(one + other)))
    passed = {(False, True): "stretched", (True, False): "folded", (True, True): "both"}
    passes = "" if single else passed[low is None, high is None]
    return Bend(ends_of, single, function, passes)


def _extremes(
    ranged: Ranged, function: Expr, name: Symbol, ends: tuple[Expr, Expr]
) -> tuple[bool, Expr | None, Expr | None]:
    """Whether a cosine only falls or only rises between two angles, and at which of them it is least and
    largest; None where it is -1 or 1 on the way."""
    known = completed({}, ranged.problem.where)
    start, end = (number(each, known) for each in ends)
    steps = [start + (end - start) * k / STEPS for k in range(STEPS + 1)]
    values = [number(function, {**known, name.name: q}) for q in steps]
    rising = [b > a for a, b in pairwise(values)]
    lowest, highest = values.index(min(values)), values.index(max(values))
    at = {k: q for k, q in ((0, ends[0]), (STEPS, ends[1])) if abs(values[k]) < 1 - NEARLY}
    return all(rising) or not any(rising), at.get(lowest), at.get(highest)


def bent(ranged: Ranged, arm: Flat, bend: Bend) -> Phrase:
    about: dict[str, Said] = {
        "first": Symbol(ranged.chain.joint(arm.turning[0]).variable),
        "lengths": tuple(ranged.typed(each.aside) for each in arm.stretches),
        "function": bend.cosine,
    }
    return Phrase("two-links-within", about)
