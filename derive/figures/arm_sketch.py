"""A robot drawn: links, joints, frames, and the names of its lengths and variables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from math import atan2, pi

from derive.derivation import Caption, Drawing, Stroke
from derive.expression import Expr, Symbol, is_negative
from derive.figures import solids
from derive.figures.arm import SMALL, Joint, Part, Posed, in_pose, joint_size, length_between, place_of
from derive.figures.typical import typical
from derive.figures.view import Vector, View, along, around, between, dot, length, unit
from derive.mechanics.dh import moves
from derive.mechanics.robot import Robot, ScrewRow


def drawn(robot: Robot, where: Mapping[str, Expr]) -> Drawing:
    """The arm in a pose that shows it; symbols have typical values."""
    every = [move for link in robot.links for move in moves(link, robot)]
    more = [part for link in robot.links if isinstance(link.row, ScrewRow) for part in link.row.through]
    point, usual = typical([*robot.base, *every, *robot.tool], more, where, robot.variables)
    view, found = in_pose(robot, point, usual, where)
    return Drawing("figure", *_sketch(robot, view, found, joint_size(found)))


# -- what is drawn ------------------------------------------------------------------------------------


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
            stubs.append(Part(at, joint.at, Symbol(""), False))
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


def _sketch(
    robot: Robot, view: View, posed: Posed, size: float
) -> tuple[tuple[Stroke, ...], tuple[Caption, ...]]:
    base = posed.parts[0].start if posed.parts else place_of(posed.poses[0])
    if robot.by_screws:
        base = place_of(posed.poses[0])
    joints, stubs = _apart(posed, size, view)
    foot = base if view.flat or robot.by_screws else _foot(posed, joints, base, size)
    things = [solids.ground(view, foot, size), *_links(view, posed.parts), *_links(view, stubs, size)]
    things += [_joint(view, joint, size) for joint in joints]
    strokes = [stroke for thing in sorted(things, key=lambda each: each.depth) for stroke in thing.strokes]
    captions = [*_lengths(view, posed, size), *_names(view, joints, size)]
    last = posed.parts[-1] if posed.parts else None
    if last is not None:
        strokes += solids.tip(view, last.end, unit(between(last.start, last.end)), size)
    if view.flat:
        for arc, caption in _angles(view, posed, size):
            strokes += arc
            captions.append(caption)
    for stroke, caption in _frames(robot, view, posed, size):
        strokes.append(stroke)
        captions.append(caption)
    return tuple(strokes), tuple(captions)


def _links(view: View, parts: Sequence[Part], behind: float = 0.0) -> Iterator[solids.Solid]:
    """Thick lines; `behind` puts them so far back."""
    for part in parts:
        middle = along(part.start, (0.5, between(part.start, part.end)))
        role = "rod" if part.moving else "link"
        line = (view.place(part.start), view.place(part.end))
        yield solids.Solid(view.depth(middle) - 2 * behind, (Stroke(line, role),))


def _joint(view: View, joint: Joint, size: float) -> solids.Solid:
    if joint.slides:
        return solids.box(view, joint.at, joint.axis, size)
    return solids.cylinder(view, joint.at, joint.axis, size)


def _lengths(view: View, posed: Posed, size: float) -> Iterator[Caption]:
    """The name of a length beside its piece of a link."""
    for part in posed.parts:
        a, b = view.place(part.start), view.place(part.end)
        way = (b[0] - a[0], b[1] - a[1])
        if length(way) < 0.6 * size or part.by == Symbol(""):
            continue
        middle = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
        side = (way[1], -way[0]) if way[0] >= 0 else (-way[1], way[0])  # below the link
        size_only = -part.by if is_negative(part.by) else part.by
        yield Caption(middle, size_only, side, "length")


def _names(view: View, joints: Sequence[Joint], size: float) -> Iterator[Caption]:
    """The variable of each revolute joint in space, clear of its cylinder; in a plane its angle is drawn."""
    for joint in joints:
        if not view.flat and not joint.slides:
            x, y = dot(view.right, joint.axis), dot(view.up, joint.axis)
            side = (-abs(y), x if y > 0 else -x) if length((x, y)) > 0.3 else (-1.0, 0.3)
            yield Caption(view.place(joint.at), joint.name, side, "joint", clear=0.62 * size)


def _angles(view: View, posed: Posed, size: float) -> Iterator[tuple[list[Stroke], Caption]]:
    """The angle of each revolute joint in a plane, from where it counts to the link it turns."""
    for joint in posed.joints:
        after = next((p for p in posed.parts if length_between(p.start, joint.at) < 1e-6), None)
        if after is None and not joint.slides:
            yield [], Caption(view.place(joint.at), joint.name, (-1.0, 1.0), "joint", clear=0.5 * size)
        if joint.slides or after is None:
            continue
        center = view.place(joint.at)
        zero, now = view.place(joint.before), view.place(between(joint.at, after.end))
        start, end = atan2(zero[1], zero[0]), atan2(now[1], now[0])
        sweep = (end - start + pi) % (2 * pi) - pi
        radius = 1.7 * size
        arc = [around(center, radius, start + sweep * k / 24) for k in range(25)]
        dashed = (center, around(center, 2.3 * size, start))
        middle = around(center, radius, start + sweep / 2)
        towards = (middle[0] - center[0], middle[1] - center[1])
        yield (
            [Stroke(dashed, "hidden"), Stroke(tuple(arc), "arc")],
            Caption(middle, joint.name, towards, "angle"),
        )


def _frames(robot: Robot, view: View, posed: Posed, size: float) -> Iterator[tuple[Stroke, Caption]]:
    """x and z of every frame (x and y in a plane, where z points at the reader)."""
    axes = "xyz" if view.flat else "xz"
    shown = list(enumerate(posed.poses)) if not robot.by_screws else [(0, posed.poses[0])]
    for number_, pose in shown:
        yield from solids.triad(view, pose, 1.6 * size, str(number_), axes)
    if robot.ends_in_tool:
        yield from solids.triad(view, posed.end, 1.6 * size, "_e", axes)
