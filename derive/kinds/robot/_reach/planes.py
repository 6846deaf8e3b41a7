"""What an arm in a plane reaches: rings and sectors, swept by a rail, lifted along the axes."""

from __future__ import annotations

from collections.abc import Sequence

from derive.derivation import Phrase, Said
from derive.errors import NotDerivable
from derive.expression import PI, ZERO, Call, Expr, Symbol, multiply, sqrt
from derive.expression import number as number_tree
from derive.kinds.robot._reach.bends import bend_of, bent
from derive.kinds.robot._reach.ranged import R_MAX, R_MIN, Ranged, distances, within_brackets
from derive.kinds.robot._reach.shapes import Shape
from derive.kinds.robot._reach.spans import Span
from derive.mechanics.reach import moving_joints
from derive.mechanics.slides import Flat

BORDERS = {"both": "borders-both", "folded": "borders-folded", "stretched": "borders-stretched"}
CARRIED = {  # on a rail, what carries the point, and whether that stands aside
    (True, "link", False): "rail-link",
    (True, "links", False): "rail-links",
    (True, "slide", False): "rail-slide",
    (True, "slide", True): "rail-slide-aside",
    (True, "slide-and-link", False): "rail-slide-and-link",
    (True, "slide-and-link", True): "rail-slide-and-link-aside",
    (True, "slide-and-links", False): "rail-slide-and-links",
    (True, "slide-and-links", True): "rail-slide-and-links-aside",
    (False, "link", False): "turning-links",
    (False, "links", False): "turning-links",
    (False, "slide", False): "turning-slide",
    (False, "slide", True): "turning-slide-aside",
    (False, "slide-and-link", False): "turning-slide-and-link",
    (False, "slide-and-link", True): "turning-slide-and-link-aside",
    (False, "slide-and-links", False): "turning-slide-and-links",
    (False, "slide-and-links", True): "turning-slide-and-links-aside",
}


def plane(ranged: Ranged, arm: Flat) -> Shape:
    order = ranged.order
    ways = [ranged.way(each) for each in arm.stretches]
    distance = ways[-1]
    for way in reversed(ways[:-1]):
        distance = order.around(way, distance)
    turn = ranged.turn(arm.turning[0])
    bend = bend_of(ranged, arm, ways)
    if bend:
        distance = bend.distance
    else:
        _refuse_ranges(ranged, arm, turn)
    rail = ranged.span(arm.rail) if arm.rail else None
    lift = ranged.span(arm.lift) if arm.lift else None
    rows = tuple(moving_joints(ranged.chain, ranged.point.position, ranged.point.last))
    formulas = dict(distances(order, distance))
    area = () if bend and turn and not bend.single else _area(ranged, distance, turn, rail)
    measure = ""
    if area and lift is None:
        measure, formulas["area"] = "area", area
    elif area and lift and lift.high is not None:
        measure = "volume"
        formulas["volume"] = tuple(multiply(each, within_brackets(lift)) for each in area)
    if measure:
        formulas[measure] = ranged.simple_end(
            formulas[measure], distance, [each for each in (rail, lift) if each]
        )
    called = _called(ranged, distance, turn, rail)
    description, borders = Phrase(called), None
    if bend and turn:
        first, second = (Symbol(ranged.chain.joint(i).variable) for i in arm.turning)
        last = ranged.typed(arm.stretches[1].aside)
        description = Phrase("bent")
        about: dict[str, Said] = {"first": first, "second": second, "last": last}
        borders = Phrase(BORDERS[bend.passes] if bend.passes else "borders", about)
    if lift:
        description = Phrase("prism" if lift.high is not None else "endless-prism", {"base": description})
    return Shape(
        "rail" if rail else "bent" if bend and turn else "ring", rows, distance, formulas,
        bent(ranged, arm, bend) if bend else _told(ranged, arm), description, turn, rail,
        lift, called="" if borders else called, borders=borders, measure=measure,
        link=ways[-1].low or ZERO,
        far_start=order.simple((ways[0].high or ZERO) - (ways[-1].low or ZERO)),
        gap=_gap(ways) if not (rail or bend) and len(ways) == 2 and distance.high is not None else None,
    )  # fmt: skip


def _refuse_ranges(ranged: Ranged, arm: Flat, turn: tuple[Expr, Expr] | None) -> None:
    if any(ranged.turn(i) for i in arm.turning[1:]) or (turn and (arm.rail or not _is_sector(arm))):
        raise NotDerivable(
            "the workspace within ranges of joints that turn is found of two links, and of one joint "
            "that turns and carries a slide; of this arm it is not derived yet"
        )
    if turn and not ranged.goes_outward(arm.stretches[0]):
        raise NotDerivable("the slide passes the axis of a joint with a range, which is not derived yet")


def _area(
    ranged: Ranged, distance: Span, turn: tuple[Expr, Expr] | None, rail: Span | None
) -> tuple[Expr, ...]:
    """Of what is reached in the plane, by r_min and r_max; none where it has no end."""
    if distance.high is None or distance.low is None or (rail and rail.high is None):
        return ()
    hollow = distance.low != ZERO
    squares = R_MAX**2 - R_MIN**2 if hollow else R_MAX**2
    if turn:
        angle = ranged.order.turn(*turn)
        return (multiply(ranged.order.simple(angle / number_tree(2)), squares),)
    if rail is None:
        return (multiply(PI, squares),)
    length = within_brackets(rail)
    whole = PI * R_MAX**2 + multiply(number_tree(2), R_MAX, length)
    if not hollow:
        return (whole,)
    apart = ranged.order.sign(length - multiply(number_tree(2), distance.low))
    if apart is None:
        return ()
    if apart >= 0:
        return (whole,)
    h = ranged.order.simple(length)
    lens = multiply(
        number_tree(2), R_MIN**2, Call("acos", (h / multiply(number_tree(2), R_MIN),))
    ) - multiply(h / number_tree(2), sqrt(multiply(number_tree(4), R_MIN**2) - h**2))
    return (whole - lens,)


def _told(ranged: Ranged, arm: Flat) -> Phrase:
    slides = tuple(
        Symbol(ranged.chain.joint(each.row).variable) for each in arm.stretches if each.stride is not None
    )
    about: dict[str, Said] = {
        "first": Symbol(ranged.chain.joint(arm.turning[0]).variable),
        "slides": slides,
        "strides": tuple(
            ranged.problem.readable(each.stride) for each in arm.stretches if each.stride is not None
        ),
        "lengths": tuple(ranged.typed(each.aside) for each in arm.stretches if each.stride is None),
    }
    if arm.rail:
        about["rail"] = Symbol(ranged.chain.joint(arm.rail).variable)
    links = len(arm.stretches) - len(slides)
    asides = tuple(
        ranged.typed(each.aside) for each in arm.stretches if each.stride is not None and each.aside
    )
    about["asides"] = asides
    carried = "link" if links == 1 else "links"
    if slides:
        carried = f"slide-and-{carried}" if links else "slide"
    return Phrase(CARRIED[bool(arm.rail), carried, bool(asides)], about)


def _called(ranged: Ranged, distance: Span, turn: tuple[Expr, Expr] | None, rail: Span | None) -> str:
    hole = distance.low != ZERO
    if rail:
        key = "strip" if rail.high is None else "stadium-hole" if hole else "stadium"
        if distance.high is None:
            key = "whole-plane"
        elif key == "stadium-hole":
            across = multiply(number_tree(2), distance.low or ZERO)
            apart = ranged.order.sign(within_brackets(rail) - across)
            key = {-1: "stadium-hole", None: "stadium-perhaps"}.get(apart, "stadium")
    elif distance.high is None:
        key = "outside" if hole else "whole-plane"
    elif turn:
        key = "sector-hole" if hole else "sector"
    else:
        key = "circle" if distance.low == distance.high else "annulus" if hole else "disc"
    return key


def _is_sector(arm: Flat) -> bool:
    """Whether a slide goes straight out from the only axis."""
    (first, *others) = arm.stretches
    return not others and first.stride is not None and not first.aside


def _gap(ways: Sequence[Span]) -> Expr | None:
    """How near to the axis the last of two stretches starts at least, where that is a link."""
    first, last = ways
    return first.low if last.low == last.high and first.low != first.high and first.high else None
