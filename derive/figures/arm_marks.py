"""Points of links marked on an arm: centers of mass, points asked about, how far along a link they are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import pi

from derive.algebra.formulas.with_units import measured, unit_of
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.algebra.readable.form import readable
from derive.derivation import Caption, Place, Stroke
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Number, Symbol
from derive.expression import number as number_of
from derive.figures.arm import SMALL, Part, Posed, length_between, place_of
from derive.figures.held import Misdrawn
from derive.figures.view import Vector, View, around, length
from derive.mechanics.oracle.bodies import com_of
from derive.mechanics.robot import DHRow, Robot

MOST = 3  # joints of an arm in space whose centers of mass are drawn
DIGITS = 6  # of a decimal at most
RADIUS = 0.24  # sizes of a joint: a center of mass
ASIDE = 1.75  # and how far beside its link a length is drawn


@dataclass(frozen=True, slots=True)
class Mark:
    """A point of a link (from 1), in the link's own frame; a center of mass or not."""

    link: int
    at: tuple[Expr, Expr, Expr]
    name: str
    massive: bool


def centers(robot: Robot) -> list[Mark]:
    """The centers of mass that are no origins of frames."""
    bodies = [(number_, link.body) for number_, link in enumerate(robot.links, 1) if link.body]
    return [
        Mark(k, body.com, f"o_c{k}", True)
        for k, body in bodies
        if body.com != "center" and any(part != ZERO for part in body.com)
    ]


def marked(
    robot: Robot, view: View, posed: Posed, marks: Sequence[Mark], size: float
) -> Iterator[tuple[list[Stroke], list[Caption]]]:
    """Each mark with its name, and its distance along its link. Raises Misdrawn where a center of mass is
    elsewhere."""
    if robot.by_screws or not (view.flat or len(posed.joints) <= MOST):
        return
    for mark in marks:
        at = _place(robot, posed, mark)
        place = view.place(at)
        strokes = _center(place, RADIUS * size) if mark.massive else [_disc(place, 0.5 * RADIUS * size)]
        captions = [Caption(place, Symbol(mark.name), (0.7, -0.7), "joint", clear=RADIUS * size)]
        measured = _measured(robot, mark)
        if measured is not None:
            lines, caption = _along(view, place_of(posed.poses[mark.link - 1]), place, measured, size)
            strokes += lines
            captions.append(caption)
        yield strokes, captions


def _place(robot: Robot, posed: Posed, mark: Mark) -> Vector:
    T = posed.poses[mark.link]
    local = [number(part, posed.values) for part in mark.at]
    x, y, z = (float(T[i, 3] + sum(T[i, j] * local[j] for j in range(3))) for i in range(3))
    body = robot.links[mark.link - 1].body
    if mark.massive and body:
        theirs = com_of(body, posed.poses[mark.link - 1], T, posed.values)
        if max(abs(a - b) for a, b in zip((x, y, z), theirs, strict=True)) > 1e-9 * (1 + abs(x) + abs(y)):
            raise Misdrawn(f"the center of mass {mark.link} is drawn where it is not")
    return x, y, z


def _measured(robot: Robot, mark: Mark) -> Expr | None:
    """How far it is from the joint of its link, if it lies on the straight link; None if not."""
    row, (x, y, z) = robot.links[mark.link - 1].row, mark.at
    if not isinstance(row, DHRow) or robot.convention != "standard" or (row.d, y, z) != (ZERO, ZERO, ZERO):
        return None
    try:
        found = readable(normal(row.a + x))
    except NotDerivable:
        return None
    if found == ZERO:
        return None
    unit = unit_of(row.a) or unit_of(x)
    return (
        measured(number_of(found.value, decimal=True), unit) if unit and isinstance(found, Number) else found
    )


def whole(robot: Robot, posed: Posed, marks: Sequence[Mark]) -> tuple[Part, ...]:
    """The links along which the distance of a mark is drawn: their own lengths are drawn along them too."""
    along = [mark.link for mark in marks if _measured(robot, mark) is not None]
    ends = [posed.poses[link - 1 : link + 1] for link in along]
    return tuple(
        part
        for part in posed.parts
        if any(
            length_between(part.start, place_of(a)) < SMALL and length_between(part.end, place_of(b)) < SMALL
            for a, b in ends
        )
    )


def along_link(view: View, part: Part, size: float) -> tuple[list[Stroke], Caption]:
    """The length of a link, on the other side of it than those of marks."""
    return _along(view, part.start, view.place(part.end), part.by, size, -1)


def _along(
    view: View, start: Vector, end: Place, name: Expr, size: float, beside: int = 1
) -> tuple[list[Stroke], Caption]:
    """A length from a joint to a mark, to the left of the link or to the right (-1)."""
    a = view.place(start)
    way = end[0] - a[0], end[1] - a[1]
    far = length(way) or 1.0
    side = -beside * way[1] / far, beside * way[0] / far
    first, last = ((p[0] + ASIDE * size * side[0], p[1] + ASIDE * size * side[1]) for p in (a, end))
    middle = (first[0] + last[0]) / 2, (first[1] + last[1]) / 2
    strokes = [Stroke((middle, first), "measure"), Stroke((middle, last), "measure")]
    for foot, top in ((a, first), (end, last)):
        near = foot[0] + 0.55 * size * side[0], foot[1] + 0.55 * size * side[1]
        strokes.append(Stroke((near, top), "leader"))
    back = (-side[0], -side[1])
    return strokes, Caption(middle, name, side, "length", ((middle, back),))


def _center(place: Place, radius: float) -> list[Stroke]:
    """The sign of a center of mass: a disc with two opposite quarters black."""
    quarters = [
        Stroke((place, *(around(place, radius, (start + k / 8) * pi / 2) for k in range(9))), "pin")
        for start in (0, 2)
    ]
    return [Stroke(_disc(place, radius).places, "cap"), *quarters]


def _disc(place: Place, radius: float) -> Stroke:
    return Stroke(tuple(around(place, radius, 2 * pi * k / 24) for k in range(24)), "pin")
