"""What a slide reaches that swings about two axes: shells and parts of them."""

from __future__ import annotations

from itertools import pairwise

from derive.algebra.numbers.floats import completed, number
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Said
from derive.errors import NotDerivable
from derive.expression import PI, ZERO, Expr, Symbol, multiply, replace
from derive.expression import number as number_tree
from derive.kinds.robot._reach.ranged import NEARLY, R_MAX, R_MIN, Ranged, distances
from derive.kinds.robot._reach.shapes import Shape
from derive.kinds.robot._reach.spans import Span
from derive.mechanics.slides import Crossed


def shell(ranged: Ranged, arm: Crossed) -> Shape:
    order = ranged.order
    side = ranged.problem.readable(arm.side)
    seen = ranged.way(arm.stretch)
    distance = order.beside(seen, side)
    first, second, third = arm.rows
    turn, tilt = ranged.turn(first), ranged.turn(second)
    rise: tuple[Expr, Expr, Expr] | None = None
    if turn or tilt:
        if side != ZERO or arm.stretch.aside or not ranged.goes_outward(arm.stretch):
            raise NotDerivable(
                "ranges of the joints that turn are honoured where the slide goes outward from the point "
                "where the axes meet; of this arm the workspace is not derived yet"
            )
        rise = _rise(ranged, arm, tilt, bool(turn))
    formulas = dict(distances(order, distance))
    measure = ""
    if distance.high is not None and distance.low is not None and seen.low is not None:
        measure = "volume"
        formulas["volume"] = _volume(ranged, distance, seen, side, turn, rise)
    key = "shell-part" if turn or tilt else "outside-ball" if distance.high is None else "shell"
    if key != "shell-part" and seen.low == ZERO:
        key = ("whole-space" if side == ZERO else "outside-cylinder") if seen.high is None else "full-ball"
    said = Phrase(key, {"joints": tuple(Symbol(ranged.chain.joint(i).variable) for i in (first, second))})
    if side != ZERO and key != "outside-cylinder":
        said = Phrase("bored-through", {"ball": said})
    about: dict[str, Said] = {
        "first": Symbol(ranged.chain.joint(first).variable),
        "second": Symbol(ranged.chain.joint(second).variable),
        "slides": (Symbol(ranged.chain.joint(third).variable),),
        "strides": (ranged.problem.readable(arm.stretch.stride or Scalar.of(0)),),
        "side": ranged.typed(arm.side),
    }
    told = "crossed-slide" if side == ZERO else "crossed-slide-aside"
    if rise or turn:
        told = "crossed-slide-within" if side == ZERO else "crossed-slide-within-aside"
    return Shape(
        "ball", arm.rows, distance, formulas, Phrase(told, about), said, turn,
        rise=rise, center=arm.center, side=side, called=key if side == ZERO else "", measure=measure,
    )  # fmt: skip


def _rise(
    ranged: Ranged, arm: Crossed, tilt: tuple[Expr, Expr] | None, one_side: bool
) -> tuple[Expr, Expr, Expr]:
    """The sine of the elevation as a function of the second joint, its least and its largest value."""
    function = ranged.problem.readable(arm.rise)
    if tilt is None:
        if one_side:
            raise NotDerivable(
                "the second joint turns past the poles and the first one within a range, which is not "
                "derived yet"
            )
        return function, number_tree(-1), number_tree(1)
    name = Symbol(ranged.chain.joint(arm.rows[1]).variable)
    ends = [number(each, completed({}, ranged.problem.where)) for each in tilt]
    steps = [ends[0] + (ends[1] - ends[0]) * k / 400 for k in range(401)]
    values = [number(function, {name.name: q, **completed({}, ranged.problem.where)}) for q in steps]
    rising = [b >= a for a, b in pairwise(values)]
    if all(rising) or not any(rising):
        low, high = (replace(function, {name: each}) for each in (tilt if rising[0] else tilt[::-1]))
        return function, ranged.order.simple(low), ranged.order.simple(high)
    if one_side:
        raise NotDerivable(
            "the second joint turns past a pole and the first within a range, which is not derived yet"
        )
    lowest, highest = (pick(values) for pick in (min, max))
    low = _extreme(ranged, function, name, tilt, lowest)
    return function, low, _extreme(ranged, function, name, tilt, highest)


def _extreme(ranged: Ranged, function: Expr, name: Symbol, tilt: tuple[Expr, Expr], value: float) -> Expr:
    """The value at an end, or that at a pole."""
    known = completed({}, ranged.problem.where)
    for each in tilt:
        tree = replace(function, {name: each})
        if abs(number(tree, known) - value) < NEARLY:
            return ranged.order.simple(tree)
    return number_tree(round(value))


def _volume(
    ranged: Ranged, distance: Span, seen: Span, side: Expr, turn: tuple[Expr, Expr] | None,
    rise: tuple[Expr, Expr, Expr] | None,
) -> tuple[Expr, ...]:  # fmt: skip
    third = number_tree(3)
    if rise is None:
        bored = side != ZERO
        inner, outer = (seen.low, seen.high) if bored else (R_MIN, R_MAX)
        cubes = (outer or ZERO) ** 3 - (inner or ZERO) ** 3 if seen.low != ZERO else (outer or ZERO) ** 3
        chain: tuple[Expr, ...] = (multiply(number_tree(4) / third, PI, cubes),)
    else:
        _, low, high = rise
        angle = ranged.order.turn(*turn) if turn else multiply(number_tree(2), PI)
        cubes = R_MAX**3 - R_MIN**3 if distance.low != ZERO else R_MAX**3
        chain = (multiply(ranged.order.simple(angle * (high - low) / third), cubes),)
    return ranged.simple_end(chain, distance)
