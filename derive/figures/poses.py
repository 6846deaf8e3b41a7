"""How an arm is looked at, and in which pose it is drawn: one that can be read, as near to zero as may be."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise, product
from math import degrees, dist, radians

from derive.algebra.numbers.floats import number
from derive.derivation import Place
from derive.expression import Expr, free_symbols
from derive.figures.arm import SMALL, Posed, length_between, place_of, posed
from derive.figures.typical import completed
from derive.figures.view import View, dot, in_space, onto_plane, unit
from derive.mechanics.robot import Link, Robot

GOOD = 0.95  # clear enough for no other pose to be tried
STRIDES, MOST_SLIDES = (0.8, 0.5, 1.3), 3  # usual lengths
JAWS = 0.8  # of the last link: what is drawn beyond it
BENT = 0.08  # what a bent joint counts against a pose
PLANAR = (38, 42, -55, 40, -45, 35)  # degrees, joint after joint of an arm in a plane


def in_pose(
    robot: Robot, point: Mapping[str, float], usual: float, where: Mapping[str, Expr],
    wanted: Mapping[str, float],
) -> tuple[View, Posed]:  # fmt: skip
    """How an arm is looked at, and the arm in a pose that shows it: in a plane with its joints bent; in space
    with all angles at zero where that can be read, else with as few as possible at a right angle; of screws
    with all joints at zero. `point` gives the symbols values, `usual` is the size of a length (m); joints
    that are `wanted` somewhere are there."""

    def at(angles: Sequence[float], slides: Sequence[float]) -> Posed:
        values = dict(point)
        for k, link in enumerate(each for each in robot.links if each.variable):
            values[link.variable or ""] = (
                slides[k] * usual if link.joint == "prismatic" else radians(angles[k])
            )
        return posed(robot, completed({**values, **wanted}, where))

    count = len(robot.variables)
    if robot.by_screws:
        found = at([0.0] * count, [0.0] * count)
        return view_of(found), found
    out = [0.8 + 0.1 * k for k in range(count)]
    moving = [link for link in robot.links if link.variable]
    here = completed(point, where)
    first = at([_in_range(link, PLANAR[k % len(PLANAR)], here) for k, link in enumerate(moving)], out)
    view = view_of(first)
    if view.flat:
        return view, first
    turning = [
        k for k, link in enumerate(moving) if link.joint != "prismatic" and link.variable not in wanted
    ]
    best, most, angles = first, float("-inf"), [0.0] * count
    for bent in _bent(turning):
        if most >= GOOD - BENT * len(bent):
            break
        turned = [bent.get(k, 0.0) for k in range(count)]
        tried = at(turned, out)
        if (value := clarity(tried, view) - BENT * len(bent)) > most:
            best, most, angles = tried, value, turned
    sliding = [k for k, link in enumerate(moving) if link.joint == "prismatic"]
    if crossings(best, view) and sliding:  # rods that cross are none where some are longer than others
        others = [at(angles, [by.get(k, 1.0) for k in range(count)]) for by in _drawn_out(sliding)]
        best = max((best, *others), key=lambda each: clarity(each, view) - crossings(each, view, JAWS))
    return view, best


def _in_range(link: Link, angle: float, here: Mapping[str, float]) -> float:
    """This angle, or the opposite, where its joint can have it; else the middle of its range (degrees)."""
    if link.range is None or any(not free_symbols(end) <= here.keys() for end in link.range):
        return angle
    low, high = (degrees(number(end, here)) for end in link.range)
    inside = [each for each in (angle, -angle) if low <= each <= high]
    return inside[0] if inside else (low + high) / 2


def _drawn_out(sliding: Sequence[int]) -> Iterator[Mapping[int, float]]:
    """How far joints slide, in usual lengths."""
    for far in product(STRIDES, repeat=min(len(sliding), MOST_SLIDES)):
        yield dict(zip(sliding, far, strict=False))


def _bent(turning: Sequence[int]) -> Iterator[Mapping[int, float]]:
    """Which joints are bent, and by how many degrees: none, one, two."""
    yield {}
    for k in turning:
        yield from ({k: angle} for angle in (90.0, -90.0))
    for i, k in enumerate(turning[1:4]):
        for m in turning[i + 2 : i + 4]:
            yield from ({k: a, m: b} for a in (90.0, -90.0, 45.0, -45.0) for b in (90.0, -90.0))


def view_of(shown: Posed) -> View:
    """The plane an arm moves in, if it does in one; else space."""
    axes = [joint.axis for joint in shown.joints if not joint.slides]
    if not axes:
        return in_space()
    normal = axes[0]
    level = dot(normal, shown.places[0])
    flat = all(abs(abs(dot(axis, normal)) - 1) < 1e-6 for axis in axes)
    flat &= all(abs(dot(joint.axis, normal)) < 1e-6 for joint in shown.joints if joint.slides)
    flat &= all(abs(dot(normal, place) - level) < 1e-6 for place in shown.places)
    return (onto_plane(normal) or in_space()) if flat else in_space()


def clarity(shown: Posed, view: View) -> float:
    """How well a pose can be read, 1 at best: no link end on, none upon another, no two joints on one spot,
    no axis end on, the arm above its base."""
    lines = [(view.place(part.start), view.place(part.end)) for part in shown.parts]
    seen = min(
        (
            dist(a, b) / length_between(part.start, part.end)
            for part, (a, b) in zip(shown.parts, lines, strict=True)
        ),
        default=1.0,
    )
    spots = [place_of(T) for T in shown.poses] + [place_of(shown.end)]
    distinct = [p for k, p in enumerate(spots) if all(length_between(p, q) > 1e-6 for q in spots[:k])]
    flat = [view.place(p) for p in distinct]
    spread = max((dist(a, b) for a in flat for b in flat), default=0.0) or 1.0
    gap = min((dist(a, b) / spread for k, a in enumerate(flat) for b in flat[:k]), default=1.0)
    low = min((p[2] for p in distinct), default=0.0) / spread
    met = crossings(shown, view)
    back = sum(folded(a, b) for a, b in pairwise(lines))
    return min(1.0, seen / 0.5) - max(0.0, 0.12 - gap) * 4 + min(0.0, low) - 0.6 * met - 0.8 * back


def crossings(shown: Posed, view: View, beyond: float = 0.0) -> int:
    """How many links that do not follow one another are seen across each other, the last one longer by a part
    of it."""
    lines = [(view.place(part.start), view.place(part.end)) for part in shown.parts]
    if lines:
        (x, y), (u, v) = lines[-1]
        lines[-1] = (x, y), (u + beyond * (u - x), v + beyond * (v - y))
    return sum(_meet(a, b) for k, a in enumerate(lines) for b in lines[: max(0, k - 1)])


def _meet(a: tuple[Place, Place], b: tuple[Place, Place]) -> bool:
    """Whether two straight lines on paper have a place in common."""
    (p, q), (r, s) = a, b

    def side(x: Place, y: Place, z: Place) -> float:
        return (y[0] - x[0]) * (z[1] - x[1]) - (y[1] - x[1]) * (z[0] - x[0])

    return side(p, q, r) * side(p, q, s) <= SMALL and side(r, s, p) * side(r, s, q) <= SMALL


def folded(a: tuple[Place, Place], b: tuple[Place, Place]) -> bool:
    """Whether a link lies back upon the one before."""
    (p, q), (_, s) = a, b
    back, on = unit((p[0] - q[0], p[1] - q[1], 0.0)), unit((s[0] - q[0], s[1] - q[1], 0.0))
    return dot(back, on) > 0.97
