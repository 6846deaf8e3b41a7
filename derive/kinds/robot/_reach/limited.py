"""Workspaces of arms with slides and with ranges of joints: boxes, rings, sectors, what a rail sweeps,
shells."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from derive.algebra.formulas.with_units import measured
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import completed, number
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Said
from derive.errors import NotDerivable
from derive.expression import PI, ZERO, Call, Expr, Symbol, between, free_symbols, multiply, replace, sqrt
from derive.expression import number as number_tree
from derive.kinds.problem import Problem
from derive.kinds.robot._lengths import unit_of_lengths
from derive.kinds.robot._point import Tracked
from derive.kinds.robot._reach.spans import Order, Span
from derive.mechanics.chain import Chain
from derive.mechanics.reach import moving_joints
from derive.mechanics.slides import Crossed, Flat, Stretch, crossed, flat, sliding_only

R_MIN, R_MAX = Symbol("r_min"), Symbol("r_max")
WHOLE, NEARLY = 2 * math.pi, 1e-9
STEPS = 720
Limits = Mapping[str, tuple[Expr, Expr]]


ENDLESS = {"rectangle": "endless-rectangle", "box": "endless-box"}
BORDERS = {"both": "borders-both", "folded": "borders-folded", "stretched": "borders-stretched"}
CARRIED = {  # on a rail, what carries the point, and whether that stands aside
    (True, "link", False): "rail-link",
    (True, "links", False): "rail-links",
    (True, "slide", False): "rail-slide",
    (True, "slide", True): "rail-slide-aside",
    (True, "slide-and-links", False): "rail-slide-and-links",
    (True, "slide-and-links", True): "rail-slide-and-links-aside",
    (False, "link", False): "turning-links",
    (False, "links", False): "turning-links",
    (False, "slide", False): "turning-slide",
    (False, "slide", True): "turning-slide-aside",
    (False, "slide-and-links", False): "turning-slide-and-links",
    (False, "slide-and-links", True): "turning-slide-and-links-aside",
}


@dataclass(frozen=True, slots=True)
class Shape:
    """What is reached: its `kind` ("box", "ring", "rail", "ball"), between which angles the first joint
    turns it (None: all), how far it goes along the `rail` and the `lift` (None: there is none; a Span
    without ends goes on), the `rise` (see Crossed) as a function of the second joint with its least and
    its largest value. `formulas` lead to its distances and its size."""

    kind: str
    rows: tuple[int, ...]
    distance: Span
    formulas: Mapping[str, tuple[Expr, ...]]
    arm: Phrase
    description: Phrase
    turn: tuple[Expr, Expr] | None = None
    rail: Span | None = None
    lift: Span | None = None
    rise: tuple[Expr, Expr, Expr] | None = None
    center: ScalarMatrix | None = None
    side: Expr = ZERO
    called: str = ""  # the key of the region, without what it is said with
    measure: str = ""  # "area", "volume", "" where it has no end or none is found
    sides: tuple[Span, ...] = field(default=())  # of a box
    borders: Phrase | None = None  # what they are
    link: Expr = ZERO  # the last one
    far_start: Expr = ZERO  # how far away it turns round with its start in the ring that the others reach
    gap: Expr | None = None  # the hole of that ring


@dataclass(frozen=True, slots=True)
class Bend:
    """From where to where two links reach by the range of the joint between them; whether they do so by a
    `single` bend of the elbow; the `cosine` of the angle between them."""

    distance: Span
    single: bool
    cosine: Expr
    passes: str = ""  # where the elbow changes its side: "stretched", "folded", "both"


@dataclass(frozen=True, slots=True)
class Limited:
    """The shape that a point of an arm reaches within the `limits` of its joints."""

    problem: Problem
    chain: Chain
    point: Tracked

    def shape(self) -> Shape | None:
        """None for an arm of another build."""
        at = self.point.position, self.point.last
        if rows := sliding_only(self.chain, *at):
            return self._box(rows)
        if (plane := flat(self.chain, *at)) is not None:
            return self._plane(plane)
        if (two := crossed(self.chain, *at)) is not None:
            return self._shell(two)
        return None

    @property
    def order(self) -> Order:
        return Order(self.problem)

    # -- boxes ------------------------------------------------------------------------------------

    def _box(self, rows: tuple[int, ...]) -> Shape:
        spans = tuple(map(self._span, rows))
        names = tuple(Symbol(self.chain.joint(i).variable) for i in rows)
        endless = tuple(name for name, span in zip(names, spans, strict=True) if span.high is None)
        about: dict[str, Said] = {"names": names, "endless": endless}
        what = ("segment", "rectangle", "box")[len(rows) - 1]
        whole = ("whole-line", "whole-plane", "whole-space")[len(rows) - 1]
        key = what if not endless else ENDLESS[what] if len(endless) < len(rows) else whole
        formulas: dict[str, tuple[Expr, ...]] = {}
        measure = "" if endless else ("", "area", "volume")[len(rows) - 1]
        if measure:
            written = multiply(*(_within_brackets(span) for span in spans))
            formulas[measure] = (written, self.order.simple(written))
        return Shape(
            "box", rows, Span(None, None), formulas, Phrase("slides" if len(rows) > 1 else "slide", about),
            Phrase(key, about), measure=measure, sides=spans,
        )  # fmt: skip

    # -- in a plane, and along its axes -----------------------------------------------------------

    def _plane(self, arm: Flat) -> Shape:
        order = self.order
        ways = [self._way(each) for each in arm.stretches]
        distance = ways[-1]
        for way in reversed(ways[:-1]):
            distance = order.around(way, distance)
        turn = self._turn(arm.turning[0])
        bend = self._bend(arm, ways)
        if bend:
            distance = bend.distance
        else:
            self._refuse_ranges(arm, turn)
        rail = self._span(arm.rail) if arm.rail else None
        lift = self._span(arm.lift) if arm.lift else None
        rows = tuple(moving_joints(self.chain, self.point.position, self.point.last))
        formulas = dict(_distances(order, distance))
        area = () if bend and turn and not bend.single else self._area(distance, turn, rail)
        measure = ""
        if area and lift is None:
            measure, formulas["area"] = "area", area
        elif area and lift and lift.high is not None:
            measure = "volume"
            formulas["volume"] = tuple(multiply(each, _within_brackets(lift)) for each in area)
        if measure:
            formulas[measure] = self._simple_end(formulas[measure], distance)
        called = self._called(distance, turn, rail)
        description, borders = Phrase(called), None
        if bend and turn:
            first, second = (Symbol(self.chain.joint(i).variable) for i in arm.turning)
            last = self._typed(arm.stretches[1].aside)
            description = Phrase("bent")
            about: dict[str, Said] = {"first": first, "second": second, "last": last}
            borders = Phrase(BORDERS[bend.passes] if bend.passes else "borders", about)
        if lift:
            description = Phrase("prism" if lift.high is not None else "endless-prism", {"base": description})
        return Shape(
            "rail" if rail else "bent" if bend and turn else "ring", rows, distance, formulas,
            self._bent(arm, bend) if bend else self._told(arm), description, turn, rail,
            lift, called="" if borders else called, borders=borders, measure=measure,
            link=ways[-1].low or ZERO,
            far_start=order.simple((ways[0].high or ZERO) - (ways[-1].low or ZERO)),
            gap=_gap(ways) if not (rail or bend) and len(ways) == 2 and distance.high is not None else None,
        )  # fmt: skip

    def _refuse_ranges(self, arm: Flat, turn: tuple[Expr, Expr] | None) -> None:
        if any(self._turn(i) for i in arm.turning[1:]) or (turn and (arm.rail or not _is_sector(arm))):
            raise NotDerivable(
                "the workspace within ranges of joints that turn is found of two links, and of one joint "
                "that turns and carries a slide; of this arm it is not derived yet"
            )
        if turn and not self._goes_outward(arm.stretches[0]):
            raise NotDerivable("the slide passes the axis of a joint with a range, which is not derived yet")

    def _bend(self, arm: Flat, ways: Sequence[Span]) -> Bend | None:
        """The distances of two links whose joints have ranges: r^2 = l1^2 + l2^2 + 2 l1 l2 f, f being the
        cosine of the angle between them. None of any other arm."""
        if arm.rail or len(arm.turning) != 2 or any(each.stride is not None for each in arm.stretches):
            return None
        tilt = self._turn(arm.turning[1])
        if tilt is None and self._turn(arm.turning[0]) is None:
            return None
        l_1, l_2 = (each.aside for each in arm.stretches)
        cosine = (arm.square - l_1 * l_1 - l_2 * l_2) / (Scalar.of(2) * l_1 * l_2)
        function = self.problem.readable(cosine)
        name = self.chain.joint(arm.turning[1]).variable
        if free_symbols(function) - self.problem.where.keys() - {name, PI.name}:
            return None
        ends = tilt or (-PI, PI)
        single, low, high = self._extremes(function, Symbol(name), ends)
        order, squares = self.order, self.problem.readable(arm.square)
        one, other = (self.problem.readable(length) for length in (l_1, l_2))
        gap = {1: one - other, -1: other - one, 0: ZERO}.get(order.sign(one - other) or 0)
        folded = Call("abs", (one - other,)) if order.sign(one - other) is None else order.simple(gap or ZERO)

        def distance(at: Expr | None, straight: Expr) -> Expr:
            return straight if at is None else sqrt(replace(squares, {Symbol(name): at}))

        ends_of = Span(distance(low, folded), distance(high, order.simple(one + other)))
        passed = {(False, True): "stretched", (True, False): "folded", (True, True): "both"}
        passes = "" if single else passed[low is None, high is None]
        return Bend(ends_of, single, function, passes)

    def _extremes(
        self, function: Expr, name: Symbol, ends: tuple[Expr, Expr]
    ) -> tuple[bool, Expr | None, Expr | None]:
        """Whether a cosine only falls or only rises between two angles, and at which of them it is least and
        largest; None where it is -1 or 1 on the way."""
        known = completed({}, self.problem.where)
        start, end = (number(each, known) for each in ends)
        steps = [start + (end - start) * k / STEPS for k in range(STEPS + 1)]
        values = [number(function, {**known, name.name: q}) for q in steps]
        rising = [b > a for a, b in pairwise(values)]
        lowest, highest = values.index(min(values)), values.index(max(values))
        at = {k: q for k, q in ((0, ends[0]), (STEPS, ends[1])) if abs(values[k]) < 1 - NEARLY}
        return all(rising) or not any(rising), at.get(lowest), at.get(highest)

    def _bent(self, arm: Flat, bend: Bend) -> Phrase:
        about: dict[str, Said] = {
            "first": Symbol(self.chain.joint(arm.turning[0]).variable),
            "lengths": tuple(self._typed(each.aside) for each in arm.stretches),
            "function": bend.cosine,
        }
        return Phrase("two-links-within", about)

    def _area(self, distance: Span, turn: tuple[Expr, Expr] | None, rail: Span | None) -> tuple[Expr, ...]:
        """Of what is reached in the plane, by r_min and r_max; none where it has no end."""
        if distance.high is None or distance.low is None or (rail and rail.high is None):
            return ()
        hollow = distance.low != ZERO
        squares = R_MAX**2 - R_MIN**2 if hollow else R_MAX**2
        if turn:
            angle = self.order.turn(*turn)
            return (multiply(self.order.simple(angle / number_tree(2)), squares),)
        if rail is None:
            return (multiply(PI, squares),)
        length = _within_brackets(rail)
        whole = PI * R_MAX**2 + multiply(number_tree(2), R_MAX, length)
        if not hollow:
            return (whole,)
        apart = self.order.sign(length - multiply(number_tree(2), distance.low))
        if apart is None:
            return ()
        if apart >= 0:
            return (whole,)
        h = self.order.simple(length)
        lens = multiply(
            number_tree(2), R_MIN**2, Call("acos", (h / multiply(number_tree(2), R_MIN),))
        ) - multiply(h / number_tree(2), sqrt(multiply(number_tree(4), R_MIN**2) - h**2))
        return (whole - lens,)

    def _simple_end(self, chain: tuple[Expr, ...], distance: Span) -> tuple[Expr, ...]:
        """With the distances put in."""
        known: dict[Expr, Expr] = {R_MIN: distance.low or ZERO, R_MAX: distance.high or ZERO}
        return (*chain, self.order.simple(replace(chain[-1], known)))

    def _told(self, arm: Flat) -> Phrase:
        slides = tuple(
            Symbol(self.chain.joint(each.row).variable) for each in arm.stretches if each.stride is not None
        )
        about: dict[str, Said] = {
            "first": Symbol(self.chain.joint(arm.turning[0]).variable),
            "slides": slides,
            "strides": tuple(
                self.problem.readable(each.stride) for each in arm.stretches if each.stride is not None
            ),
            "lengths": tuple(self._typed(each.aside) for each in arm.stretches if each.stride is None),
        }
        if arm.rail:
            about["rail"] = Symbol(self.chain.joint(arm.rail).variable)
        links = bool(about["lengths"])
        asides = tuple(
            self._typed(each.aside) for each in arm.stretches if each.stride is not None and each.aside
        )
        about["asides"] = asides
        single = not slides and len(arm.stretches) == 1
        carried = "link" if single else "links" if not slides else "slide-and-links" if links else "slide"
        return Phrase(CARRIED[bool(arm.rail), carried, bool(asides)], about)

    def _called(self, distance: Span, turn: tuple[Expr, Expr] | None, rail: Span | None) -> str:
        hole = distance.low != ZERO
        if rail:
            key = "strip" if rail.high is None else "stadium-hole" if hole else "stadium"
            if distance.high is None:
                key = "whole-plane"
            elif key == "stadium-hole":
                across = multiply(number_tree(2), distance.low or ZERO)
                apart = self.order.sign(_within_brackets(rail) - across)
                key = {-1: "stadium-hole", None: "stadium-perhaps"}.get(apart, "stadium")
        elif distance.high is None:
            key = "outside" if hole else "whole-plane"
        elif turn:
            key = "sector-hole" if hole else "sector"
        else:
            key = "circle" if distance.low == distance.high else "annulus" if hole else "disc"
        return key

    # -- shells -----------------------------------------------------------------------------------

    def _shell(self, arm: Crossed) -> Shape:
        order = self.order
        side = self.problem.readable(arm.side)
        seen = self._way(arm.stretch)
        distance = order.beside(seen, side)
        first, second, third = arm.rows
        turn, tilt = self._turn(first), self._turn(second)
        rise: tuple[Expr, Expr, Expr] | None = None
        if turn or tilt:
            if side != ZERO or arm.stretch.aside or not self._goes_outward(arm.stretch):
                raise NotDerivable(
                    "ranges of the joints that turn are honoured where the slide goes outward from the point "
                    "where the axes meet; of this arm the workspace is not derived yet"
                )
            rise = self._rise(arm, tilt, bool(turn))
        formulas = dict(_distances(order, distance))
        measure = ""
        if distance.high is not None and distance.low is not None and seen.low is not None:
            measure = "volume"
            formulas["volume"] = self._volume(distance, seen, side, turn, rise)
        key = "shell-part" if turn or tilt else "outside-ball" if distance.high is None else "shell"
        if key != "shell-part" and seen.low == ZERO:
            key = (
                ("whole-space" if side == ZERO else "outside-cylinder") if seen.high is None else "full-ball"
            )
        said = Phrase(key, {"joints": tuple(Symbol(self.chain.joint(i).variable) for i in (first, second))})
        if side != ZERO and key != "outside-cylinder":
            said = Phrase("bored-through", {"ball": said})
        about: dict[str, Said] = {
            "first": Symbol(self.chain.joint(first).variable),
            "second": Symbol(self.chain.joint(second).variable),
            "slides": (Symbol(self.chain.joint(third).variable),),
            "strides": (self.problem.readable(arm.stretch.stride or Scalar.of(0)),),
            "side": self._typed(arm.side),
        }
        told = "crossed-slide" if side == ZERO else "crossed-slide-aside"
        if rise or turn:
            told = "crossed-slide-within" if side == ZERO else "crossed-slide-within-aside"
        return Shape(
            "ball", arm.rows, distance, formulas, Phrase(told, about), said, turn,
            rise=rise, center=arm.center, side=side, called=key if side == ZERO else "", measure=measure,
        )  # fmt: skip

    def _rise(self, arm: Crossed, tilt: tuple[Expr, Expr] | None, one_side: bool) -> tuple[Expr, Expr, Expr]:
        """The sine of the elevation as a function of the second joint, its least and its largest value."""
        function = self.problem.readable(arm.rise)
        if tilt is None:
            if one_side:
                raise NotDerivable(
                    "the second joint turns past the poles and the first one within a range, which is not "
                    "derived yet"
                )
            return function, number_tree(-1), number_tree(1)
        name = Symbol(self.chain.joint(arm.rows[1]).variable)
        ends = [number(each, completed({}, self.problem.where)) for each in tilt]
        steps = [ends[0] + (ends[1] - ends[0]) * k / 400 for k in range(401)]
        values = [number(function, {name.name: q, **completed({}, self.problem.where)}) for q in steps]
        rising = [b >= a for a, b in pairwise(values)]
        if all(rising) or not any(rising):
            low, high = (replace(function, {name: each}) for each in (tilt if rising[0] else tilt[::-1]))
            return function, self.order.simple(low), self.order.simple(high)
        if one_side:
            raise NotDerivable(
                "the second joint turns past a pole and the first within a range, which is not derived yet"
            )
        lowest, highest = (pick(values) for pick in (min, max))
        low = self._extreme(function, name, tilt, lowest)
        return function, low, self._extreme(function, name, tilt, highest)

    def _extreme(self, function: Expr, name: Symbol, tilt: tuple[Expr, Expr], value: float) -> Expr:
        """The value at an end, or that at a pole."""
        known = completed({}, self.problem.where)
        for each in tilt:
            tree = replace(function, {name: each})
            if abs(number(tree, known) - value) < NEARLY:
                return self.order.simple(tree)
        return number_tree(round(value))

    def _volume(
        self, distance: Span, seen: Span, side: Expr, turn: tuple[Expr, Expr] | None,
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
            angle = self.order.turn(*turn) if turn else multiply(number_tree(2), PI)
            cubes = R_MAX**3 - R_MIN**3 if distance.low != ZERO else R_MAX**3
            chain = (multiply(self.order.simple(angle * (high - low) / third), cubes),)
        return self._simple_end(chain, distance)

    # -- joints -----------------------------------------------------------------------------------

    def _span(self, row: int) -> Span:
        limits: Limits = self.problem.subject.ranges
        return Span(*limits.get(self.chain.joint(row).variable, (None, None)))

    def _stride(self, stretch: Stretch) -> Span:
        """From where to where the slide goes, counted from the axis."""
        assert stretch.stride is not None
        span, tree = self._span(stretch.row), self.problem.readable(stretch.stride)
        name = Symbol(self.chain.joint(stretch.row).variable)

        def at(end: Expr | None) -> Expr | None:
            return None if end is None else self.order.simple(replace(tree, {name: end}))

        return Span(at(span.low), at(span.high))

    def _typed(self, length: Scalar) -> Expr:
        """A length with its unit, where it is a number."""
        tree = self.problem.readable(length)
        return tree if free_symbols(tree) else measured(tree, unit_of_lengths(self.problem))

    def _goes_outward(self, stretch: Stretch) -> bool:
        """Whether a slide does not pass the axis."""
        low = self._stride(stretch).low
        return low is not None and self.order.sign(low) in (0, 1)

    def _way(self, stretch: Stretch) -> Span:
        """How far it is from one axis to the next."""
        aside = self.problem.readable(stretch.aside)
        if stretch.stride is None:
            return Span(aside, aside)
        return self.order.beside(self.order.size(self._stride(stretch)), aside)

    def _turn(self, row: int) -> tuple[Expr, Expr] | None:
        """The limits of a joint that does not make a whole turn. Raises NotDerivable where that is not
        known."""
        limits: Limits = self.problem.subject.ranges
        span = limits.get(self.chain.joint(row).variable)
        if span is None:
            return None
        try:
            angle = number(span[1] - span[0], completed({}, self.problem.where))
        except KeyError as error:
            raise NotDerivable("ranges of joints that turn are honoured in numbers") from error
        return None if angle >= WHOLE - NEARLY else span


def _is_sector(arm: Flat) -> bool:
    """Whether a slide goes straight out from the only axis."""
    (first, *others) = arm.stretches
    return not others and first.stride is not None and not first.aside


def _gap(ways: Sequence[Span]) -> Expr | None:
    """How near to the axis the last of two stretches starts at least, where that is a link."""
    first, last = ways
    return first.low if last.low == last.high and first.low != first.high and first.high else None


def _within_brackets(span: Span) -> Expr:
    return (span.high or ZERO) - (span.low or ZERO)


def _distances(order: Order, distance: Span) -> Iterator[tuple[str, tuple[Expr, ...]]]:
    for name, tree in (("r_max", distance.high), ("r_min", distance.low)):
        if tree is not None:
            simple = order.simple(tree)
            yield name, (tree,) if tree == simple else (tree, simple)


def ranges_of(problem: Problem, rows: Sequence[int]) -> tuple[Said, ...]:
    """low <= variable <= high of the rows that have limits."""
    links = [problem.subject.links[i - 1] for i in rows]
    return tuple(
        between(measured(link.range[0]), Symbol(link.variable), measured(link.range[1]))
        for link in links
        if link.range
    )
