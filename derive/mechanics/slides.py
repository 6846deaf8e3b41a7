"""Arms whose joints turn about parallel axes and slide across or along them, from axis to axis; arms that
only slide; and a slide on two axes that cross."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.mechanics.chain import Chain
from derive.mechanics.lines import dot
from derive.mechanics.reach import moving_joints, size


@dataclass(frozen=True, slots=True)
class Stretch:
    """From one axis to the next, or to the point, seen along the axes: what slides goes by `stride` and is
    `aside` of that line; of one of fixed length, `aside`, no joint slides."""

    aside: Scalar
    stride: Scalar | None = None
    row: int = 0


@dataclass(frozen=True, slots=True)
class Flat:
    """`turning` rows and the stretches after them; the row `rail` slides the first axis across, the row
    `lift` the point along the axes (0: none)."""

    turning: tuple[int, ...]
    stretches: tuple[Stretch, ...]
    rail: int
    lift: int
    square: Scalar  # of the distance between the first axis and the point


@dataclass(frozen=True, slots=True)
class Crossed:
    """Two axes square to each other that meet in `center` (3 by 1), and a slide square to the second: seen
    along that one the `stretch` goes from there to the point, which is at the distance `side` from its
    plane; `rise` is the part of the unit vector along the slide that is along the first axis."""

    rows: tuple[int, int, int]
    stretch: Stretch
    rise: Scalar
    side: Scalar
    center: ScalarMatrix


def sliding_only(chain: Chain, point: ScalarMatrix, last: int) -> tuple[int, ...]:
    """The rows of an arm that only slides, each square to the others; none of another."""
    rows = moving_joints(chain, point, last)
    if any(chain.joint(i).type != "prismatic" for i in rows) or not 0 < len(rows) <= 3:
        return ()
    square = all(not dot(chain.axis(i), chain.axis(k)) for i in rows for k in rows if i < k)
    return tuple(rows) if square else ()


def flat(chain: Chain, point: ScalarMatrix, last: int) -> Flat | None:
    """None where axes are not parallel, or a joint slides neither across nor along them, or two slide between
    the same axes."""
    rows = moving_joints(chain, point, last)
    turning = [i for i in rows if chain.joint(i).type == "revolute"]
    if not turning or any(chain.joint(i).type == "helical" for i in rows):
        return None
    axis, zero = chain.axis(turning[0]), ScalarMatrix.zeros(3, 1)
    if any(chain.axis(i).cross(axis) != zero for i in turning):
        return None
    slides = [i for i in rows if i not in turning]
    along = [i for i in slides if chain.axis(i).cross(axis) == zero]
    across = [i for i in slides if not dot(chain.axis(i), axis)]
    rails = [i for i in across if i < turning[0]]
    if len(along) + len(across) < len(slides) or len(along) > 1 or len(rails) > 1:
        return None
    places = [*(chain.point(i) for i in turning), point]
    bounds = [*turning, last + 1]
    found = []
    for (here, there), (start, end) in zip(pairwise(places), pairwise(bounds), strict=True):
        between = [i for i in across if start < i < end]
        stretch = _stretch(chain, axis, there - here, between)
        if stretch is None:
            return None
        found.append(stretch)
    seen = axis.cross(point - places[0])
    rail, lift = (each[0] if each else 0 for each in (rails, along))
    return Flat(tuple(turning), tuple(found), rail, lift, dot(seen, seen))


def crossed(chain: Chain, point: ScalarMatrix, last: int) -> Crossed | None:
    """None unless the rows turn, turn and slide so."""
    rows = moving_joints(chain, point, last)
    if [chain.joint(i).type for i in rows] != ["revolute", "revolute", "prismatic"]:
        return None
    first, second, third = rows
    one, other, along = map(chain.axis, rows)
    if dot(one, other) or dot(other, along):
        return None
    between = chain.point(second) - chain.point(first)
    if dot(between, one.cross(other)):
        return None
    center = chain.point(second) - other.scaled(dot(between, other))
    side = dot(point - center, other)
    stretch = _stretch(chain, other, point - center, [third])
    if stretch is None or _moves(chain, side, 0):
        return None
    return Crossed((first, second, third), stretch, dot(one, along), size(side * side), center)


def _stretch(chain: Chain, axis: ScalarMatrix, way: ScalarMatrix, between: Sequence[int]) -> Stretch | None:
    seen = axis.cross(way)
    square = dot(seen, seen)
    if len(between) > 1:
        return None
    if between:
        (row,) = between
        stride = dot(way, chain.axis(row))
        square = square - stride * stride
        if stride.diff(chain.joint(row).variable) != Scalar.of(1) or _moves(chain, stride, row):
            return None
    if _moves(chain, square, 0):
        return None
    return Stretch(size(square), stride, row) if between else Stretch(size(square))


def _moves(chain: Chain, value: Scalar, but: int) -> bool:
    """Whether joints other than that of a row change the value."""
    own = chain.joint(but).variable if but else ""
    return any(value.diff(name) for name in chain.variables if name != own)
