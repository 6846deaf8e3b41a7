"""A robot drawn from its own forward kinematics: links, joints, frames and the names of its lengths."""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import atan2, cos, dist, pi, radians, sin
from typing import Any

from derive.algebra.numeric import number
from derive.derivation import Caption, Drawing, Place, Stroke
from derive.expression import Expr, Symbol, free_symbols, is_negative, negate
from derive.mechanics.dh import moves
from derive.mechanics.motion import Move
from derive.mechanics.oracle import compose
from derive.mechanics.pictures import solids
from derive.mechanics.pictures.typical import completed, typical
from derive.mechanics.pictures.view import Vector, View, along, dot, in_space, length, onto_plane, unit
from derive.mechanics.robot import Robot, ScrewRow

POSES = 60  # tried, to find one in which an arm in space can be read
PLANAR = (38, 42, -55, 40, -45, 35)  # degrees, joint after joint of an arm in a plane
SMALL = 1e-9


@dataclass(frozen=True, slots=True)
class Part:
    """A straight piece of a link from one place to another, and the length it is named by."""

    start: Vector
    end: Vector
    by: Expr
    moving: bool  # a prismatic joint stretches it


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint by its axis, and the variable it is named by."""

    at: Vector
    axis: Vector
    name: str
    slides: bool
    before: Vector  # the direction from which its angle counts


@dataclass(frozen=True, slots=True)
class Posed:
    """An arm in one pose."""

    parts: tuple[Part, ...]
    joints: tuple[Joint, ...]
    poses: tuple[Any, ...]  # of the frames 0, 1, ..., 4 by 4
    end: Any  # of the end-effector

    @property
    def places(self) -> list[Vector]:
        return [p for part in self.parts for p in (part.start, part.end)] or [_origin(self.end)]


def drawn(robot: Robot, where: Mapping[str, Expr]) -> Drawing:
    """The arm in a pose that shows it; symbols have typical values."""
    every = [move for link in robot.links for move in moves(link, robot)]
    more = [part for link in robot.links if isinstance(link.row, ScrewRow) for part in link.row.through]
    point, usual = typical([*robot.base, *every, *robot.tool], more, where, robot.variables)
    view, posed = _posed(robot, point, usual, where)
    size = _size(posed)
    return Drawing("figure", *_sketch(robot, view, posed, size))


# -- the pose -----------------------------------------------------------------------------------------


def _posed(
    robot: Robot, point: Mapping[str, float], usual: float, where: Mapping[str, Expr]
) -> tuple[View, Posed]:
    def at(angles: Sequence[float], slides: Sequence[float]) -> Posed:
        values = dict(point)
        for k, link in enumerate(each for each in robot.links if each.variable):
            values[link.variable or ""] = slides[k] * usual if link.joint == "prismatic" else angles[k]
        return _pose(robot, completed(values, where))

    count = len(robot.variables)
    if robot.by_screws:
        found = at([0.0] * count, [0.0] * count)
        return _view(found), found
    first = at(
        [radians(PLANAR[k % len(PLANAR)]) for k in range(count)], [0.8 + 0.1 * k for k in range(count)]
    )
    view = _view(first)
    if view.flat:
        return view, first
    draw = random.Random(count)
    tried = [
        at(
            [draw.choice((-1, 1)) * radians(draw.uniform(15, 75)) for _ in range(count)],
            [draw.uniform(0.6, 1.1) for _ in range(count)],
        )
        for _ in range(POSES)
    ]
    return view, max(tried, key=lambda posed: _clarity(posed, view))


def _pose(robot: Robot, point: Mapping[str, float]) -> Posed:
    import numpy

    T = numpy.eye(4)
    parts: list[Part] = []
    joints: list[Joint] = []
    T = _run(T, robot.base, None, point, parts, joints)
    poses = [T]
    for link in robot.links:
        if isinstance(link.row, ScrewRow):
            joints.append(_screw(link.row, link.variable or "", T, point))
            continue
        T = _run(T, moves(link, robot), link.variable, point, parts, joints)
        poses.append(T)
    if robot.by_screws:
        T = T @ _home(robot, point)
        parts += _between(joints, T)
    T = _run(T, robot.tool, None, point, parts, joints)
    return Posed(tuple(parts), tuple(joints), tuple(poses), T)


def _run(
    T: Any,
    row: Sequence[Move],
    variable: str | None,
    point: Mapping[str, float],
    parts: list[Part],
    joints: list[Joint],
) -> Any:
    """The pose after the moves of a row; the pieces of its link and its joint are added."""
    for move in row:
        after = T @ compose((move,), point)
        moving = variable is not None and Symbol(variable) in _symbols(move.by)
        start, end = _origin(T), _origin(after)
        if moving:
            axis = _direction(T, move, point)
            before = (float(T[0, 0]), float(T[1, 0]), float(T[2, 0]))
            joints.append(Joint(start, axis, variable or "", move.kind == "translate", before))
        if move.kind == "translate" and length_between(start, end) > SMALL:
            parts.append(Part(start, end, move.by, moving))
        T = after
    return T


def _symbols(expr: Expr) -> set[Expr]:
    return {Symbol(name) for name in free_symbols(expr)}


def _direction(T: Any, move: Move, point: Mapping[str, float]) -> Vector:
    if isinstance(move.axis, str):
        k = "xyz".index(move.axis)
        return float(T[0, k]), float(T[1, k]), float(T[2, k])
    local = [number(part, point) for part in move.axis]
    return unit([float(sum(T[i, j] * local[j] for j in range(3))) for i in range(3)])


def _screw(row: ScrewRow, name: str, T: Any, point: Mapping[str, float]) -> Joint:
    import numpy

    at = T @ numpy.array([*(number(part, point) for part in row.through), 1.0])
    axis = _direction(T, Move("rotate", row.axis, row.by), point)
    return Joint((float(at[0]), float(at[1]), float(at[2])), axis, name, row.slide, (1.0, 0.0, 0.0))


def _home(robot: Robot, point: Mapping[str, float]) -> Any:
    from derive.mechanics.oracle import Oracle

    return Oracle(robot, {}).home(point)


def _between(joints: Sequence[Joint], T: Any) -> Iterator[Part]:
    """Straight links from joint to joint of a chain of screws, which says nothing of their shape."""
    stops = [joint.at for joint in joints] + [_origin(T)]
    for start, end in pairwise(stops):
        if length_between(start, end) > SMALL:
            yield Part(start, end, Symbol(""), False)


def _origin(T: Any) -> Vector:
    return float(T[0, 3]), float(T[1, 3]), float(T[2, 3])


def length_between(a: Vector, b: Vector) -> float:
    return dist(a, b)


# -- the view -----------------------------------------------------------------------------------------


def _view(posed: Posed) -> View:
    """The plane an arm moves in, if it does in one; else space."""
    axes = [joint.axis for joint in posed.joints if not joint.slides]
    if not axes:
        return in_space()
    normal = axes[0]
    level = dot(normal, posed.places[0])
    flat = all(abs(abs(dot(axis, normal)) - 1) < 1e-6 for axis in axes)
    flat &= all(abs(dot(joint.axis, normal)) < 1e-6 for joint in posed.joints if joint.slides)
    flat &= all(abs(dot(normal, place) - level) < 1e-6 for place in posed.places)
    return (onto_plane(normal) or in_space()) if flat else in_space()


def _clarity(posed: Posed, view: View) -> float:
    """How well a pose can be read: no link end on, no two joints on one spot, the arm above its base."""
    seen = 1.0
    for part in posed.parts:
        a, b = view.place(part.start), view.place(part.end)
        seen = min(seen, length((b[0] - a[0], b[1] - a[1])) / length_between(part.start, part.end))
    spots = [_origin(T) for T in posed.poses] + [_origin(posed.end)]
    distinct = [p for k, p in enumerate(spots) if all(length_between(p, q) > 1e-6 for q in spots[:k])]
    flat = [view.place(p) for p in distinct]
    spread = max((length((a[0] - b[0], a[1] - b[1])) for a in flat for b in flat), default=0.0) or 1.0
    gaps = [length((a[0] - b[0], a[1] - b[1])) / spread for k, a in enumerate(flat) for b in flat[:k]]
    low = min((p[2] for p in distinct), default=0.0) / spread
    turned = min((1 - abs(dot(view.front, joint.axis)) for joint in posed.joints), default=1.0)
    return (
        1.2 * seen
        + 1.5 * min([0.4, *gaps])
        + min(0.0, low)
        + 0.6 * min(turned, 0.4)
        + 0.15 * flat[-1][1] / spread
    )


def _size(posed: Posed) -> float:
    """Of a joint on paper: a share of the whole arm."""
    places = posed.places
    spans = [max(p[k] for p in places) - min(p[k] for p in places) for k in range(3)]
    return max(max(spans), SMALL) * 0.1 or 0.1


# -- what is drawn ------------------------------------------------------------------------------------


def _apart(posed: Posed, size: float) -> tuple[tuple[Joint, ...], tuple[Part, ...]]:
    """Joints whose axes meet in a point, drawn one behind the other on their axes; and what joins them."""
    groups: dict[tuple[float, ...], list[int]] = {}
    for k, joint in enumerate(posed.joints):
        groups.setdefault(tuple(round(c / size, 3) for c in joint.at), []).append(k)
    moved, stubs = list(posed.joints), []
    for members in groups.values():
        for k, side in _moved(posed, members):
            joint = posed.joints[k]
            at = along(joint.at, (side * (_ahead(posed, joint, side) or 1) * 1.45 * size, joint.axis))
            moved[k] = replace(joint, at=at)
            stubs.append(Part(at, joint.at, Symbol(""), False))
    return tuple(moved), tuple(stubs)


def _moved(posed: Posed, members: Sequence[int]) -> list[tuple[int, int]]:
    """Which joints of one point are drawn before it (-1) and behind it (1) along the arm."""
    if len(members) == 1:
        return []
    first, last = members[0], members[-1]
    if len(members) > 2:
        return [(first, -1), (last, 1)]
    turned = first > 0 and not _ahead(posed, posed.joints[first], -1)
    return [(last, 1)] if turned and _ahead(posed, posed.joints[last], 1) else [(first, -1)]


def _ahead(posed: Posed, joint: Joint, side: int) -> int:
    """1 where the axis of a joint points on along the arm, -1 where back, 0 where it lies across."""
    for part in posed.parts if side > 0 else reversed(posed.parts):
        if length_between(part.start if side > 0 else part.end, joint.at) < SMALL:
            way = unit([b - a for a, b in zip(part.start, part.end, strict=True)])
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
    base = posed.parts[0].start if posed.parts else _origin(posed.poses[0])
    if robot.by_screws:
        base = _origin(posed.poses[0])
    joints, stubs = (posed.joints, ()) if view.flat or robot.by_screws else _apart(posed, size)
    foot = base if view.flat or robot.by_screws else _foot(posed, joints, base, size)
    things = [solids.ground(view, foot, size), *_links(view, posed.parts), *_links(view, stubs, size)]
    things += [_joint(view, joint, size) for joint in joints]
    strokes = [stroke for thing in sorted(things, key=lambda each: each.depth) for stroke in thing.strokes]
    captions = [*_lengths(view, posed, size), *_names(view, joints, size)]
    last = posed.parts[-1] if posed.parts else None
    if last is not None:
        strokes += solids.tip(
            view, last.end, unit([b - a for a, b in zip(last.start, last.end, strict=True)]), size
        )
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
        middle = along(part.start, (0.5, [b - a for a, b in zip(part.start, part.end, strict=True)]))
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
        size_only = negate(part.by) if is_negative(part.by) else part.by
        yield Caption(middle, size_only, side, "length")


def _names(view: View, joints: Sequence[Joint], size: float) -> Iterator[Caption]:
    """The variable of each revolute joint in space, clear of its cylinder; in a plane its angle is drawn."""
    for joint in joints:
        if not view.flat and not joint.slides:
            x, y = dot(view.right, joint.axis), dot(view.up, joint.axis)
            side = (-abs(y), x if y > 0 else -x) if length((x, y)) > 0.3 else (-1.0, 0.3)
            clear = 0.62 * size / (length(side) or 1.0)
            yield Caption(view.place(joint.at), joint.name, (side[0] * clear, side[1] * clear), "joint")


def _angles(view: View, posed: Posed, size: float) -> Iterator[tuple[list[Stroke], Caption]]:
    """The angle of each revolute joint in a plane, from where it counts to the link it turns."""
    for joint in posed.joints:
        after = next((p for p in posed.parts if length_between(p.start, joint.at) < 1e-6), None)
        if joint.slides or after is None:
            continue
        x, y = view.place(joint.at)
        zero, now = (
            view.place(v) for v in (joint.before, [b - a for a, b in zip(joint.at, after.end, strict=True)])
        )
        start, end = atan2(zero[1], zero[0]), atan2(now[1], now[0])
        sweep = (end - start + pi) % (2 * pi) - pi
        radius = 1.7 * size
        arc = [_on(x, y, radius, start + sweep * k / 24) for k in range(25)]
        dashed = ((x, y), _on(x, y, 2.3 * size, start))
        middle = _on(x, y, radius, start + sweep / 2)
        towards = (middle[0] - x, middle[1] - y)
        yield (
            [Stroke(dashed, "hidden"), Stroke(tuple(arc), "arc")],
            Caption(middle, joint.name, towards, "angle"),
        )


def _on(x: float, y: float, radius: float, angle: float) -> Place:
    return x + radius * cos(angle), y + radius * sin(angle)


def _frames(robot: Robot, view: View, posed: Posed, size: float) -> Iterator[tuple[Stroke, Caption]]:
    """x and z of every frame (x and y in a plane, where z points at the reader)."""
    axes = "xyz" if view.flat else "xz"
    shown = list(enumerate(posed.poses)) if not robot.by_screws else [(0, posed.poses[0])]
    for number_, pose in shown:
        yield from solids.triad(view, pose, 1.6 * size, str(number_), axes)
    if robot.ends_in_tool:
        yield from solids.triad(view, posed.end, 1.6 * size, "_e", axes)
