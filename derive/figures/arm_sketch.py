"""A robot drawn: links, joints, frames, and the names of its lengths and variables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from derive.algebra.numbers.floats import number
from derive.derivation import Caption, Drawing, Stroke
from derive.expression import Expr, Symbol, free_symbols, is_negative
from derive.figures import described, solids
from derive.figures.arm import SMALL, Joint, Part, Posed, joint_size, length_between, place_of
from derive.figures.arm_angles import SHORT, angles, reach, turns
from derive.figures.arm_bodies import hanging, longest, shown_by_body, solid_bodies
from derive.figures.arm_frames import frames_of
from derive.figures.arm_marks import Mark, along_link, marked, whole
from derive.figures.arm_values import values_of
from derive.figures.body_names import body_names
from derive.figures.gripper import gripper
from derive.figures.held import held
from derive.figures.poses import in_pose
from derive.figures.view import Vector, View, along, between, dot, length, unit
from derive.figures.wish import Wish
from derive.mechanics.robot import Robot

MIDDLE, ASIDE = (0.5, 0.35, 0.65, 0.2, 0.8), (0.76, 0.24, 0.5, 0.85, 0.65)  # of a link: its name
MOST_NUMBERS = 3  # lengths that are written as numbers; of more the letters of the table are
OF_ROD = 0.08  # of the longest rod: a joint
MOST, JOINT = 250.0, 16.0  # points: how high an arm is drawn, and how large a joint of it
FEW = 4  # joints that need no more room


def drawn(robot: Robot, where: Mapping[str, Expr], wish: Wish, marks: Sequence[Mark] = ()) -> Drawing:
    """The arm in the pose that is wished for, or one that shows it, with marks on it; symbols have typical
    values."""
    point, usual = values_of(robot, where, [part for mark in marks for part in mark.at])
    wanted = {name: number(value, {}) for name, value in wish.at.items()}
    view, found = in_pose(robot, point | wanted, usual, where, wanted)
    found = replace(found, parts=(*found.parts, *hanging(robot, found)))
    size = max(joint_size(found), OF_ROD * longest(robot, found))
    joints, stubs = _apart(found, size, view)
    held(robot, where, found, joints, size)
    strokes, captions = _sketch(robot, view, found, joints, stubs, size)
    along_them = whole(robot, found, marks) if view.flat else ()
    others = replace(found, parts=tuple(part for part in found.parts if part not in along_them))
    captions = (*captions, *_lengths(view, others, size, ASIDE if marks else MIDDLE))
    for part in along_them:
        signs, name = along_link(view, part, size)
        strokes, captions = (*strokes, *signs), (*captions, name)
    for signs, names in marked(robot, view, found, marks, size):
        strokes, captions = (*strokes, *signs), (*captions, *names)
    said = described.caption(robot, found, view, frozenset(where)), described.seen(robot, found, view)
    high = _highest(strokes, size, len(found.joints) + 2 * len(marks))
    return Drawing("figure", strokes, captions, *said, high, schematic=True)


def _highest(strokes: Sequence[Stroke], size: float, named: int) -> float:
    """How high an arm is drawn, in points: higher with more joints and marks, and no joint too large, but for
    those of a wrist, about which there is much to write."""
    heights = [y for stroke in strokes for _, y in stroke.places]
    largest = JOINT * max(1.0, named / FEW)
    return min(MOST, 125 + 22 * named, (max(heights) - min(heights)) / size * largest + 30)


def _sketch(
    robot: Robot, view: View, posed: Posed, joints: Sequence[Joint], stubs: Sequence[Part], size: float
) -> tuple[tuple[Stroke, ...], tuple[Caption, ...]]:
    """What is drawn of an arm whose joints are so large, from back to front, and its names."""
    base = posed.parts[0].start if posed.parts else place_of(posed.poses[0])
    if robot.by_screws:
        base = place_of(posed.poses[0])
    foot = base if view.flat or robot.by_screws else _foot(posed, joints, base, size)
    things = [solids.ground(view, foot, size), *_links(view, posed.parts, size), *_stubs(view, stubs, size)]
    things += solid_bodies(robot, view, posed, size)
    things += [_joint(view, joint, size) for joint in joints]
    strokes = [stroke for thing in sorted(things, key=lambda each: each.depth) for stroke in thing.strokes]
    captions: list[Caption] = []
    if posed.parts and not (shown_by_body(robot) or hanging(robot, posed)):
        index = "_e" if robot.ends_in_tool or robot.by_screws else str(len(posed.poses) - 1)
        jaws, names = gripper(view, posed, joints, size, index)
        strokes += jaws
        captions += names
    frames = list(frames_of(robot, view, posed, size))
    arrows = [stroke for stroke, _ in frames]
    for arcs, names in angles(robot, view, posed, size) if view.flat else turns(view, joints, size, arrows):
        strokes += arcs
        captions += names
    for more, names in body_names(robot, view, posed, size):
        strokes += more
        captions += names
    for stroke, caption in frames:
        strokes.append(stroke)
        captions.append(caption)
    return tuple(strokes), tuple(captions)


# -- where joints stand -------------------------------------------------------------------------------


def _apart(posed: Posed, size: float, view: View) -> tuple[tuple[Joint, ...], tuple[Part, ...]]:
    """Joints whose axes meet in a point, drawn one behind the other on their axes; and what joins them."""
    groups: dict[tuple[float, ...], list[int]] = {}
    for k, joint in enumerate(posed.joints):
        groups.setdefault(tuple(round(c / size, 3) for c in joint.at), []).append(k)
    moved, stubs = list(posed.joints), []
    for members in groups.values():
        for k, side in _moved(posed, members, view):
            joint = posed.joints[k]
            at = along(joint.at, (side * (_ahead(posed, joint, side) or 1) * 1.45 * size, joint.axis))
            moved[k] = replace(joint, at=at)
            stubs.append(Part(at, joint.at, Symbol("")))
    return tuple(moved), tuple(stubs)


def _moved(posed: Posed, members: Sequence[int], view: View) -> list[tuple[int, int]]:
    """Which joints of one point are drawn before it (-1) and behind it (1) along the arm."""
    if len(members) == 1:
        return []
    if view.flat:  # a slide makes way for the disc of a revolute joint
        return [(k, 1) for k in members if posed.joints[k].slides]
    first, last = members[0], members[-1]
    if len(members) > 2:
        return [(first, -1), (last, 1)]
    turned = first > 0 and not _ahead(posed, posed.joints[first], -1)
    return [(last, 1)] if turned and _ahead(posed, posed.joints[last], 1) else [(first, -1)]


def _ahead(posed: Posed, joint: Joint, side: int) -> int:
    """1 where the axis of a joint points on along the arm, -1 where back, 0 where it lies across."""
    for part in posed.parts if side > 0 else reversed(posed.parts):
        if length_between(part.start if side > 0 else part.end, joint.at) < SMALL:
            way = unit(between(part.start, part.end))
            if abs(dot(way, joint.axis)) > 0.5:
                return 1 if dot(way, joint.axis) > 0 else -1
    return 0


def _foot(posed: Posed, joints: Sequence[Joint], base: Vector, size: float) -> Vector:
    """Where the base stands: under its first joint, if that stands on it."""
    if not joints or joints[0].slides or length_between(posed.joints[0].at, base) > SMALL:
        return base
    first = joints[0]
    upright = abs(first.axis[2]) > 0.99
    return along(first.at, (-0.7 * size, (0.0, 0.0, 1.0))) if upright else first.at


# -- links and joints ---------------------------------------------------------------------------------


def _links(view: View, parts: Sequence[Part], size: float) -> Iterator[solids.Solid]:
    """Thick lines, but for the offsets that are part of a joint."""
    for part in parts:
        if view.flat or not (part.along_joint and length_between(part.start, part.end) < SHORT * size):
            middle = along(part.start, (0.5, between(part.start, part.end)))
            role = "rod" if part.moving else "link"
            line = (view.place(part.start), view.place(part.end))
            yield solids.Solid(view.depth(middle), (Stroke(line, role),))


def _stubs(view: View, parts: Sequence[Part], size: float) -> Iterator[solids.Solid]:
    """What holds the joints of one point together, behind everything near."""
    for part in parts:
        line = (view.place(part.start), view.place(part.end))
        yield solids.Solid(view.depth(part.start) - 2 * size, (Stroke(line, "link"),))


def _joint(view: View, joint: Joint, size: float) -> solids.Solid:
    if joint.slides:
        return solids.box(view, joint.at, joint.axis, size)
    return solids.cylinder(view, joint.at, joint.axis, size, *reach(joint, size))


# -- names --------------------------------------------------------------------------------------------


def _lengths(view: View, posed: Posed, size: float, spots: Sequence[float]) -> Iterator[Caption]:
    """The name of a length beside its piece of a link, on either side, at shares of it in order."""
    drawn = [part for part in posed.parts if part.called and not free_symbols(part.by)]
    crowded = len(drawn) > MOST_NUMBERS
    for part in posed.parts:
        a, b = view.place(part.start), view.place(part.end)
        way = (b[0] - a[0], b[1] - a[1])
        if length(way) < 0.05 * size or part.by == Symbol(""):
            continue
        below = (way[1], -way[0]) if way[0] >= 0 else (-way[1], way[0])
        above = (-below[0], -below[1])
        name = -part.by if is_negative(part.by) else part.by
        if crowded and part in drawn and part.called:
            name = part.called
        shares = [(a[0] + t * way[0], a[1] + t * way[1]) for t in spots]
        others = tuple((place, side) for place in shares for side in (below, above))
        yield Caption(shares[0], name, below, "length", others[1:])
