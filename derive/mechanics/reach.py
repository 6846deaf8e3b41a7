"""How far an arm reaches whose joints turn freely: arms in a plane, and arms of which a first joint swings
such an arm about its axis.

Each link is a segment of fixed length between two axes, seen along them (Siciliano et al., section 2.10;
Craig, section 4.2).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import pairwise
from operator import mul

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.multivariate import square_free
from derive.algebra.rationals import as_fraction
from derive.algebra.roots_and_functions import absolute, root
from derive.algebra.scalar import Scalar
from derive.mechanics.chain import Chain
from derive.mechanics.jacobian import motions_jacobian
from derive.mechanics.lines import dot


@dataclass(frozen=True, slots=True)
class PlanarArm:
    """The lengths of the links between parallel axes, the last one to the point; `center` is a point of the
    first axis (3 by 1). `slides` says that a joint moves the point along the axes as well."""

    lengths: tuple[Scalar, ...]
    center: ScalarMatrix
    slides: bool = False


@dataclass(frozen=True, slots=True)
class SwungArm:
    """Links in a plane, two or more, that a first axis swings about itself: `offset` from it to the second,
    `side` the distance of the point from the plane of the first axis parallel to the links, `height` of the
    second axis; `center` is the point of the first axis at that height (3 by 1)."""

    lengths: tuple[Scalar, ...]
    offset: Scalar
    side: Scalar
    center: ScalarMatrix


def planar_arm(chain: Chain, point: ScalarMatrix, last: int) -> PlanarArm | None:
    """None where the axes are not parallel, or a joint slides in another direction."""
    rows = moving_joints(chain, point, last)
    turning = [i for i in rows if chain.joint(i).type == "revolute"]
    if not turning or any(chain.joint(i).type == "helical" for i in rows):
        return None
    axis, zero = chain.axis(turning[0]), ScalarMatrix.zeros(3, 1)
    if any(chain.axis(i).cross(axis) != zero for i in rows):
        return None
    lengths = _lengths(chain, turning, point)
    return PlanarArm(lengths, chain.point(turning[0]), len(rows) > len(turning)) if lengths else None


def moving_joints(chain: Chain, point: ScalarMatrix, last: int) -> list[int]:
    """The rows whose joints move the point; a wrist does not move its center."""
    if chain.coupling:
        J = motions_jacobian(chain.coupling, point, last)
        return [i for k, i in enumerate(chain.coupling.rows) if any(J.columns(k).entries[:3])]
    return [i for i, joint in chain.moving if i <= last and point.diff(joint.variable)]


def swung_arm(chain: Chain, point: ScalarMatrix, last: int) -> SwungArm | None:
    """None unless three revolute joints or more move the point, all parallel but the first, which is square
    to the others."""
    rows = moving_joints(chain, point, last)
    if len(rows) < 3 or any(chain.joint(i).type != "revolute" for i in rows):
        return None
    first, second = chain.axis(rows[0]), chain.axis(rows[1])
    lengths = _lengths(chain, rows[1:], point)
    if len(lengths) < 2 or dot(first, second):
        return None
    start, shoulder = chain.point(rows[0]), chain.point(rows[1])
    across = first.cross(second)
    offset, height = dot(shoulder - start, across), dot(shoulder - start, first)
    side = dot(point - start, second)
    if any(not _fixed(chain, each) for each in (offset, height, side)):
        return None
    center = start + first.scaled(height)
    return SwungArm(lengths, size(offset * offset), size(side * side), center)


def turns_freely(chain: Chain, moving: Sequence[int], spare: Sequence[int], planar: bool) -> bool:
    """Whether the joints that do not move the point give the end-effector every orientation about it: in a
    plane one whose axis is that of the plane, in space three, each square to the next."""
    axes = [chain.axis(i) for i in spare if chain.joint(i).type == "revolute"]
    if planar:
        return any(axis.cross(chain.axis(moving[0])) == ScalarMatrix.zeros(3, 1) for axis in axes)
    return any(not dot(a, b) and not dot(b, c) for a, b, c in zip(axes, axes[1:], axes[2:], strict=False))


def _lengths(chain: Chain, rows: Sequence[int], point: ScalarMatrix) -> tuple[Scalar, ...]:
    """Of the links between these axes and on to the point; none where they are not parallel. Axes that
    coincide are one."""
    axis, zero = chain.axis(rows[0]), ScalarMatrix.zeros(3, 1)
    if any(chain.axis(i).cross(axis) != zero for i in rows[1:]):
        return ()
    places = [*(chain.point(i) for i in rows), point]
    found = []
    for here, there in pairwise(places):
        seen = axis.cross(there - here)
        square = dot(seen, seen)
        if not _fixed(chain, square):
            return ()
        found += [size(square)] if square else []
    return tuple(found)


def _fixed(chain: Chain, value: Scalar) -> bool:
    return not any(value.diff(name) for name in chain.variables)


def size(square: Scalar) -> Scalar:
    """The root of a square; lengths are taken as positive, so that of a^2 is a. What is a number, cos(58 deg)
    - 1, has its own sign."""
    if square.constant is not None or square.denominator is not None or not square:
        return root(square)
    content, factors = square_free(square.numerator)
    parts = [(Scalar(square.ring, part), power) for part, power in factors]
    inside = reduce(mul, (each for each, n in parts if n % 2), Scalar.of(as_fraction(content)))
    outside = ((each if each.letters() else absolute(each)) ** (n // 2) for each, n in parts)
    return reduce(mul, outside, root(inside))
