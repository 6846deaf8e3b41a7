"""A body with flat faces drawn: pale faces, edges that are whole where they are seen and dashed elsewhere."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from math import acos, cos, sin
from typing import TypeAlias

from derive.algebra.numbers.floats import number
from derive.derivation import Caption, Stroke
from derive.errors import NotDerivable
from derive.expression import free_symbols
from derive.figures.view import Vector, View, along, between, cross, dot, unit
from derive.figures.wish import Polyhedron

SHARES = 24  # pieces of an edge that are looked at
NEAR = 1e-6  # of the size of a body
ARC = 0.3  # of the shorter edge: the radius of an angle
Face: TypeAlias = tuple[Vector, ...]


def corners_of(
    body: Polyhedron, origins: Mapping[str, Vector], point: Mapping[str, float]
) -> dict[str, Vector]:
    """The places of the corners, those of the frames among them."""
    found = dict(origins)
    for name, (x, y, z) in body.corners.items():
        found[name] = (number(x, point), number(y, point), number(z, point))
    return found


def drawn(body: Polyhedron, places: Mapping[str, Vector], view: View) -> tuple[list[Stroke], list[Stroke]]:
    """The faces that look at the reader, from back to front, and all edges. Raises NotDerivable for a face
    that is not flat."""
    _known([name for face in body.faces for name in face], places)
    faces = [tuple(places[name] for name in face) for face in body.faces]
    for face, names in zip(faces, body.faces, strict=True):
        if not _flat(face):
            raise NotDerivable(f"the face {', '.join(names)} is not flat")
    seen = [face for face in faces if dot(_outward(face, faces), view.front) > 0]
    seen.sort(key=lambda face: sum(view.depth(p) for p in face) / len(face))
    pale = [Stroke(tuple(map(view.place, face)), "face") for face in seen]
    edges = {frozenset(edge) for face in body.faces for edge in pairwise((*face, face[0]))}
    lines = [
        line
        for edge in sorted(map(sorted, edges))
        for line in _edge(places[edge[0]], places[edge[1]], faces, view)
    ]
    return pale, lines


def lengths(
    body: Polyhedron, places: Mapping[str, Vector], point: Mapping[str, float], view: View
) -> Iterator[Caption]:
    """The names of lengths by their edges. Raises NotDerivable where one is not as long as is said."""
    middle = view.place(_middle(tuple(places[name] for face in body.faces for name in face)))
    for one, other, name in body.lengths:
        _known((one, other), places)
        a, b = places[one], places[other]
        long = dot(between(a, b), between(a, b)) ** 0.5
        if abs(long - number(name, point)) > NEAR * max(1.0, long):
            raise NotDerivable(f"the edge from {one} to {other} is not as long as is said")
        start, end = view.place(a), view.place(b)
        way = end[0] - start[0], end[1] - start[1]
        spots = [(start[0] + t * way[0], start[1] + t * way[1]) for t in (0.5, 0.35, 0.65, 0.2, 0.8)]
        out = spots[0][0] - middle[0], spots[0][1] - middle[1]
        side = (way[1], -way[0]) if way[1] * out[0] - way[0] * out[1] > 0 else (-way[1], way[0])
        back = (-side[0], -side[1])
        others = tuple((spot, turned) for spot in spots for turned in (side, back))
        yield Caption(spots[0], name, side, "length", others[1:])


def angles(
    body: Polyhedron, places: Mapping[str, Vector], point: Mapping[str, float], view: View
) -> Iterator[tuple[Stroke, Caption]]:
    """An arc at the vertex of each angle, and its name. Raises NotDerivable where one is not as large as is
    said."""
    for one, vertex, other, name in body.angles:
        _known((one, vertex, other), places)
        ways = [between(places[vertex], places[corner]) for corner in (one, other)]
        a, b = map(unit, ways)
        whole = acos(max(-1.0, min(1.0, dot(a, b))))
        if free_symbols(name) <= point.keys() and abs(number(name, point) - whole) > NEAR:
            raise NotDerivable(f"the angle at {vertex} is not as large as is said")
        far = ARC * min(dot(way, way) ** 0.5 for way in ways)
        across = unit(along(b, (-dot(a, b), a)))
        turns = (whole * k / SHARES for k in range(SHARES + 1))
        arc = [
            view.place(along(places[vertex], (far * cos(turn), a), (far * sin(turn), across)))
            for turn in turns
        ]
        foot, middle = view.place(places[vertex]), arc[SHARES // 2]
        towards = middle[0] - foot[0], middle[1] - foot[1]
        yield Stroke(tuple(arc), "thin"), Caption(middle, name, towards, "angle")


def _known(names: Iterable[str], places: Mapping[str, Vector]) -> None:
    """Raises NotDerivable for a corner that is none."""
    if unknown := [name for name in names if name not in places]:
        raise NotDerivable(f"there is no corner {unknown[0]}")


def _edge(a: Vector, b: Vector, faces: Sequence[Face], view: View) -> Iterator[Stroke]:
    """Its pieces that are seen, and those that are not."""
    way = between(a, b)
    hidden = [_covered(along(a, ((k + 0.5) / SHARES, way)), faces, view) for k in range(SHARES)]
    start = 0
    for k in range(1, SHARES + 1):
        if k == SHARES or hidden[k] != hidden[start]:
            ends = (along(a, (start / SHARES, way)), along(a, (k / SHARES, way)))
            yield Stroke(tuple(map(view.place, ends)), "hidden" if hidden[start] else "edge")
            start = k


def _covered(place: Vector, faces: Sequence[Face], view: View) -> bool:
    """Whether a face stands between a place and the reader."""
    return any(_pierced(place, view.front, face) > NEAR for face in faces)


def _pierced(start: Vector, way: Vector, face: Face) -> float:
    """How far along a ray it goes through the inside of a face; 0 where it does not."""
    normal = _normal(face)
    steep = dot(normal, way)
    if abs(steep) < 1e-9:
        return 0.0
    far = dot(normal, between(start, face[0])) / steep
    return far if far > NEAR and _inside(along(start, (far, way)), face, normal) else 0.0


def _inside(place: Vector, face: Face, normal: Vector) -> bool:
    """Whether a place of its plane lies within a face, by how often a line to the outside leaves it."""
    drop = max(range(3), key=lambda k: abs(normal[k]))
    i, j = (k for k in range(3) if k != drop)
    x, y = place[i], place[j]
    within = False
    for p, q in pairwise((*face, face[0])):
        if (p[j] > y) != (q[j] > y) and x < p[i] + (y - p[j]) / (q[j] - p[j]) * (q[i] - p[i]):
            within = not within
    return within and not _on_rim(place, face)


def _on_rim(place: Vector, face: Face) -> bool:
    """Whether a place lies on an edge of a face, and so is covered by nothing."""
    for p, q in pairwise((*face, face[0])):
        way = between(p, q)
        share = min(1.0, max(0.0, dot(between(p, place), way) / dot(way, way)))
        gap = between(along(p, (share, way)), place)
        if dot(gap, gap) ** 0.5 < 1e-4 * dot(way, way) ** 0.5:
            return True
    return False


def _outward(face: Face, faces: Sequence[Face]) -> Vector:
    """The unit vector out of the body: away from where a ray meets an odd number of other faces."""
    normal = _normal(face)
    place = _within(face, normal)
    crossed = sum(_pierced(place, normal, other) > 0 for other in faces if other is not face)
    return (-normal[0], -normal[1], -normal[2]) if crossed % 2 else normal


def _within(face: Face, normal: Vector) -> Vector:
    """A place inside a face, which need not be convex: the middle of the first three corners that has it."""
    ring = (*face, *face[:2])
    for k in range(len(face)):
        place = _middle(ring[k : k + 3])
        if _inside(place, face, normal):
            return place
    return _middle(face)


def _normal(face: Face) -> Vector:
    """The unit normal of a flat face, by the area that its corners go round (Newell)."""
    total = (0.0, 0.0, 0.0)
    for p, q in pairwise((*face, face[0])):
        total = along(total, (1.0, cross(between(face[0], p), between(face[0], q))))
    return unit(total)


def _flat(face: Face) -> bool:
    try:
        normal = _normal(face)
    except ZeroDivisionError:
        return False
    size = max(dot(between(face[0], p), between(face[0], p)) ** 0.5 for p in face)
    return all(abs(dot(normal, between(face[0], p))) < NEAR * size for p in face)


def _middle(places: Sequence[Vector]) -> Vector:
    x, y, z = (sum(p[k] for p in places) / len(places) for k in range(3))
    return x, y, z
