"""Three consecutive joints whose axes meet in one point: a spherical wrist (Pieper), or a spherical shoulder.

None of the three moves that point. Seen from the base, the centre of a wrist depends on the joints before it
alone; seen from the end-effector, the centre of a shoulder depends on the joints after it alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce

from derive.algebra.matrix import ScalarMatrix, dot
from derive.algebra.scalar import Scalar
from derive.mechanics.chain import Chain
from derive.mechanics.poses import homogeneous, inverse_pose, position_part, rotation_part

THREE = 3


@dataclass(frozen=True, slots=True)
class Spherical:
    """`rows` are those of its joints. `centre` (3 by 1) is seen from its own end of the arm, the end-effector
    of a wrist, the base of a `shoulder`; `inside` is the same point on the other side of the three joints, in
    frame `frame`, that before a wrist or that after a shoulder."""

    rows: tuple[int, int, int]
    centre: ScalarMatrix
    inside: ScalarMatrix
    shoulder: bool = False

    @property
    def frame(self) -> int:
        """That of the arm from which it is seen as one fixed point."""
        return self.rows[-1] if self.shoulder else self.rows[0] - 1


@dataclass(frozen=True, slots=True)
class Line:
    """A joint axis: a point and a direction (3 by 1 each)."""

    point: ScalarMatrix
    direction: ScalarMatrix

    def seen_from(self, T: ScalarMatrix) -> Line:
        """In the frame that T leads to from the line's own."""
        return Line(moved(T, self.point), rotation_part(T) @ self.direction)

    def holds(self, point: ScalarMatrix) -> bool:
        """Whether a point (3 by 1) lies on it."""
        return not self.direction.cross(point - self.point)


def spherical_wrist(chain: Chain) -> Spherical | None:
    """The last three joints where they are revolute and their axes meet in one point."""
    found = _meeting(chain, [i for i, _ in chain.moving][-THREE:])
    if found is None:
        return None
    (first, middle, last), near, at_last = found
    beyond = inverse_pose(inverse_pose(chain.T[last]) @ chain.T_tool) @ inverse_pose(chain.T_local[last - 1])
    return Spherical((first, middle, last), moved(beyond, at_last), moved(chain.T_local[first - 1], near))


def spherical_shoulder(chain: Chain) -> Spherical | None:
    """Likewise the first three."""
    found = _meeting(chain, [i for i, _ in chain.moving][:THREE])
    if found is None:
        return None
    (first, middle, last), near, at_last = found
    inside = moved(inverse_pose(chain.T_local[last - 1]), at_last)
    return Spherical((first, middle, last), moved(chain.T[first], near), inside, shoulder=True)


def _meeting(chain: Chain, rows: list[int]) -> tuple[tuple[int, int, int], ScalarMatrix, ScalarMatrix] | None:
    """The rows of three joints, the point in which their axes meet in the frame after the first and in that
    before the last; None where there is no such point."""
    if len(rows) < THREE or any(chain.joint(i).type != "revolute" for i in rows):
        return None
    first, middle, last = rows
    between = fixed_between(chain, middle, last)
    inside = meeting(_after(chain, middle), _before(chain, last).seen_from(between))
    if inside is None:
        return None
    near = moved(fixed_between(chain, first, middle) @ chain.T_local[middle - 1], inside)
    if not _after(chain, first).holds(near):
        return None
    return (first, middle, last), near, moved(inverse_pose(between), inside)


def meeting(one: Line, other: Line) -> ScalarMatrix | None:
    """The point two lines have in common; None where they are parallel or miss each other."""
    normal = one.direction.cross(other.direction)
    size = dot(normal.entries, normal.entries)
    if not size:
        return None
    offset = one.direction.cross(one.point - other.point)
    along: Scalar = dot(normal.entries, offset.entries) / size
    point = other.point + other.direction.scaled(along)
    return point if one.holds(point) else None


def moved(T: ScalarMatrix, point: ScalarMatrix) -> ScalarMatrix:
    """A point (3 by 1) seen from the frame that T leads to."""
    return rotation_part(T) @ point + position_part(T)


def fixed_between(chain: Chain, first: int, last: int) -> ScalarMatrix:
    """T from frame `last` - 1 to frame `first`: the rows between that do not move."""
    rows = [chain.T_local[k] for k in range(first, last - 1)]
    return reduce(ScalarMatrix.__matmul__, rows, homogeneous(ScalarMatrix.identity(3), (0, 0, 0)))


def _before(chain: Chain, i: int) -> Line:
    """The axis of joint i in frame i - 1."""
    joint = chain.joint(i)
    return Line(position_part(joint.before), rotation_part(joint.before) @ joint.axis)


def _after(chain: Chain, i: int) -> Line:
    """The axis of joint i in frame i, which it moves about itself."""
    return _before(chain, i).seen_from(inverse_pose(chain.T_local[i - 1]))
