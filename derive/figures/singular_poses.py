"""A planar arm in its singular poses, beside each other, with the direction in which its end cannot move."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import atan2, cos, hypot, pi, radians, sin

from derive.algebra.numbers.floats import number
from derive.derivation import Caption, Drawing, Phrase, Place, Said, Stroke
from derive.expression import Expr, Relation, Symbol
from derive.figures import solids
from derive.figures.arm import Part, Posed, place_of, posed
from derive.figures.arm_values import values_of
from derive.figures.held import Misdrawn, held
from derive.figures.motions import moved, moved_by
from derive.figures.poses import PLANAR, folded, view_of
from derive.figures.typical import completed
from derive.figures.view import View, around
from derive.mechanics.robot import Robot

HIGH = 130.0  # points
JOINT, LOST, ROOM = (
    0.075,
    0.42,
    0.5,
)  # of the reach: a joint, the line of what is lost, the room between poses
FLAT = 1e-6  # of the square of the reach: what the moments of both velocities may differ from zero by


def drawn(robot: Robot, where: Mapping[str, Expr], cases: Sequence[Mapping[str, Expr]]) -> Drawing | None:
    """A pose for each case, which gives some joints their values; None for an arm that is not planar. Raises
    Misdrawn where a pose is not singular."""
    point, _ = values_of(robot, where)
    poses = [_posed(robot, where, point, case) for case in cases]
    view = view_of(_posed(robot, where, point, {}))
    turning = all(not joint.slides for joint in poses[0].joints) if poses else False
    if not turning or not view.flat:
        return None
    reach = sum(hypot(*_way(*_ends(view, part))) for part in poses[0].parts)
    strokes: list[Stroke] = []
    captions: list[Caption] = []
    left = 0.0
    for case, pose in zip(cases, poses, strict=True):
        held(robot, where, pose, pose.joints, reach)
        lines, texts = _pose(view, pose, case, reach)
        places = [place for stroke in lines for place in stroke.places]
        shift = left - min(x for x, _ in places), 0.0
        strokes += [Stroke(tuple(moved_by(p, shift) for p in each.places), each.role) for each in lines]
        captions += [moved(text, shift) for text in texts]
        left += max(x for x, _ in places) - min(x for x, _ in places) + ROOM * reach
    about: dict[str, Said] = {"cases": tuple(_said(case) for case in cases)}
    said = Phrase("singular-drawn"), Phrase("singular-seen", about)
    return Drawing("singular", tuple(strokes), tuple(captions), *said, HIGH)


def _posed(
    robot: Robot, where: Mapping[str, Expr], point: Mapping[str, float], case: Mapping[str, Expr]
) -> Posed:
    values = {name: radians(angle) for name, angle in zip(robot.variables, PLANAR, strict=False)}
    values |= {name: number(value, {}) for name, value in case.items()}
    return posed(robot, completed({**point, **values}, where))


def _pose(
    view: View, pose: Posed, case: Mapping[str, Expr], reach: float
) -> tuple[list[Stroke], list[Caption]]:
    """Links alike, but for one that lies back upon the one before, which is narrow so that both are seen; the
    end marked, and an arrow both ways along what is lost."""
    size = JOINT * reach
    joints = [view.place(joint.at) for joint in pose.joints]
    tip = view.place(place_of(pose.end))
    strokes = [*solids.ground(view, pose.joints[0].at, size).strokes]
    links = [_ends(view, part) for part in pose.parts]
    for k, ends in enumerate(links):
        strokes.append(Stroke(ends, "rod" if k and folded(links[k - 1], ends) else "link"))
    for joint in pose.joints:
        strokes += solids.cylinder(view, joint.at, joint.axis, size).strokes
    lost = _lost(joints, tip, reach)
    across = [(tip[0] + s * LOST * reach * lost[0], tip[1] + s * LOST * reach * lost[1]) for s in (-0.5, 0.5)]
    strokes += [Stroke((tip, end), "lost") for end in across]
    strokes.append(Stroke(tuple(around(tip, 0.3 * size, 2 * pi * k / 24) for k in range(24)), "pin"))
    low = min(y for stroke in strokes for _, y in stroke.places)
    middle = sum(x for x, _ in (*joints, tip)) / (len(joints) + 1)
    title = Caption((middle, low), Phrase("drawn-at", {"at": _said(case)}), (0.0, -1.0), "note")
    return strokes, [Caption(across[1], Phrase("lost-there"), lost, "note"), title]


def _lost(joints: Sequence[Place], tip: Place, reach: float) -> Place:
    """The unit vector along which no joint moves the end: across what every joint moves it along. Raises
    Misdrawn where there is none."""
    moved = [(joint[1] - tip[1], tip[0] - joint[0]) for joint in joints]
    xx, xy, yy = (sum(v[i] * v[j] for v in moved) for i, j in ((0, 0), (0, 1), (1, 1)))
    if abs(xx * yy - xy * xy) > FLAT * reach**4:
        raise Misdrawn("a pose is drawn as singular and is not")
    angle = 0.5 * atan2(2 * xy, xx - yy) + pi / 2  # across the axis of the greater half
    return cos(angle), sin(angle)


def _ends(view: View, part: Part) -> tuple[Place, Place]:
    return view.place(part.start), view.place(part.end)


def _way(a: Place, b: Place) -> Place:
    return b[0] - a[0], b[1] - a[1]


def _said(case: Mapping[str, Expr]) -> tuple[Said, ...]:
    return tuple(Relation(Symbol(name), "=", value) for name, value in case.items())
