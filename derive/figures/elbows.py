"""Both ways in which two links reach a place, and the triangle that they form with it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import atan2, cos, hypot, pi, radians, sin

from derive.derivation import Caption, Drawing, Phrase, Place, Stroke
from derive.expression import Expr
from derive.figures import solids
from derive.figures.held import Misdrawn
from derive.figures.view import View, around, onto_plane

BENT, RAISED = radians(68), radians(56)  # the angle at the elbow, and the direction of the place
HIGH = 185.0  # points
JOINT = 0.085  # of the reach


@dataclass(frozen=True, slots=True)
class TwoLinks:
    """Two links by their lengths (m) and what these are called, and the names of what is between them: the
    joint variables, the coordinates reached, how far these are, and the angle inside at the elbow."""

    lengths: tuple[float, float]
    called: tuple[Expr, Expr]
    variables: tuple[str, str]
    given: tuple[str, str]
    r: Expr
    inside: Expr


def drawn(arm: TwoLinks) -> Drawing:
    """The arm with its elbow down and the angles marked; pale, with its elbow up. Raises Misdrawn."""
    a, b = arm.lengths
    place = around((0.0, 0.0), hypot(a + b * cos(BENT), b * sin(BENT)), RAISED)
    inner = atan2(b * sin(BENT), a + b * cos(BENT))
    down, up = (around((0.0, 0.0), a, RAISED - side * inner) for side in (1, -1))
    if any(abs(hypot(place[0] - x, place[1] - y) - b) > 1e-9 * (a + b) for x, y in (down, up)):
        raise Misdrawn("an elbow is not where both links reach")
    view, size = onto_plane((0.0, 0.0, 1.0)), JOINT * (a + b)
    assert view is not None
    strokes = [
        Stroke(((0.0, 0.0), up, place), "other"),
        Stroke(((0.0, 0.0), down), "link"), Stroke((down, place), "link"),
        Stroke(((0.0, 0.0), place), "hidden"),
        *_joints(view, (up, down), size),
    ]  # fmt: skip
    marks = [*_angles(arm, down, RAISED - inner, size)]
    strokes += [stroke for drawn_strokes, _ in marks for stroke in drawn_strokes]
    first, second = arm.called
    captions = [
        *(caption for _, caption in marks),
        _beside((0.0, 0.0), down, first), _beside(down, place, second),
        _beside(place, (0.0, 0.0), arm.r),
        Caption(place, arm.given, (1.0, 0.5), "place"),
        Caption(down, Phrase("elbow-down"), (1.0, -0.6), "note", clear=0.5 * size),
        Caption(up, Phrase("elbow-up"), (-1.0, 0.6), "note", clear=0.5 * size),
    ]  # fmt: skip
    about = {"first": first, "second": second, "r": arm.r, "inside": arm.inside}
    return Drawing(
        "elbows", tuple(strokes), tuple(captions), Phrase("elbows-drawn"), Phrase("elbows-seen", about), HIGH,
    )  # fmt: skip


def _joints(view: View, elbows: tuple[Place, Place], size: float) -> Iterator[Stroke]:
    yield from solids.ground(view, (0.0, 0.0, 0.0), size).strokes
    for x, y in ((0.0, 0.0), *elbows):
        yield from solids.cylinder(view, (x, y, 0.0), (0.0, 0.0, 1.0), size).strokes


def _angles(arm: TwoLinks, elbow: Place, first: float, size: float) -> Iterator[tuple[list[Stroke], Caption]]:
    """theta_1 from the horizontal, theta_2 from the first link drawn on, and the angle of the triangle."""
    level = Stroke(((0.0, 0.0), (3.2 * size, 0.0)), "hidden")
    on = Stroke((elbow, around(elbow, 3.2 * size, first)), "hidden")
    one, two = arm.variables
    yield _arc((0.0, 0.0), 2.4 * size, 0.0, first, one, [level])
    yield _arc(elbow, 2.4 * size, first, first + BENT, two, [on])
    yield _arc(elbow, 1.3 * size, first + BENT, first + pi, arm.inside, [], "thin")


def _arc(
    center: Place, radius: float, start: float, end: float, name: Expr | str, more: list[Stroke],
    role: str = "arc",
) -> tuple[list[Stroke], Caption]:  # fmt: skip
    """Part of a circle with its name outside."""
    arc = [around(center, radius, start + (end - start) * k / 24) for k in range(25)]
    spots = [arc[k] for k in (12, 7, 17)]
    (at, towards), *others = [(spot, (spot[0] - center[0], spot[1] - center[1])) for spot in spots]
    return [*more, Stroke(tuple(arc), role)], Caption(at, name, towards, "angle", tuple(others))


def _beside(a: Place, b: Place, name: Expr) -> Caption:
    """The name of a length beside its line, on the right of the way from a to b."""
    way = b[0] - a[0], b[1] - a[1]
    right, left = (way[1], -way[0]), (-way[1], way[0])
    spots = [(a[0] + t * way[0], a[1] + t * way[1]) for t in (0.5, 0.62, 0.4, 0.75, 0.3)]
    others = tuple((spot, side) for spot in spots for side in (right, left))
    return Caption(spots[0], name, right, "length", others[1:])
