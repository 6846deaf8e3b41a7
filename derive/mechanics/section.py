"""An arm that a first joint turns about a fixed axis, in section through that axis: how far its point is from
the axis and how high, which the other joints decide (Craig, section 4.2; Angeles, section 4.5)."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.mechanics.chain import Chain
from derive.mechanics.lines import dot
from derive.mechanics.reach import moving_joints

MOST = 2  # joints after the first


@dataclass(frozen=True, slots=True)
class Section:
    """`first` turns the arm and `others` (rows, one or two) move the point in the section: the square of its
    distance from the axis, and its height along the axis above the origin of the base."""

    first: int
    others: tuple[int, ...]
    square: Scalar
    height: Scalar

    def determinant(self, chain: Chain) -> Scalar | None:
        """That of the derivatives of both by two other joints; None where there are not two."""
        if len(self.others) != MOST:
            return None
        a, b = (chain.joint(i).variable for i in self.others)
        return self.square.diff(a) * self.height.diff(b) - self.square.diff(b) * self.height.diff(a)


@dataclass(frozen=True, slots=True)
class OnSphere:
    """A point that two axes through `center` (3 by 1) carry: its distance from there squared, and between
    which heights above the center it goes along the first axis, as `middle` and the square of what it goes
    up and down from it."""

    center: ScalarMatrix
    square: Scalar
    middle: Scalar
    swing: Scalar


def section(chain: Chain, point: ScalarMatrix, last: int, most: int = MOST) -> Section | None:
    """None where the first joint that moves the point slides, or the axis is not fixed, or more than so many
    others move it."""
    rows = moving_joints(chain, point, last)
    if not 2 <= len(rows) <= most + 1 or any(chain.joint(i).type == "helical" for i in rows):
        return None
    first, *others = rows
    if chain.joint(first).type != "revolute" or chain.coupling is not None:
        return None
    w, start = chain.axis(first), chain.point(first)
    if any(entry.diff(name) for each in (w, start) for entry in each.entries for name in chain.variables):
        return None
    way = point - start
    along = dot(way, w)
    return Section(first, tuple(others), dot(way, way) - along * along, dot(point, w))


def on_sphere(chain: Chain, found: Section, point: ScalarMatrix) -> OnSphere | None:
    """None unless two joints turn about axes that meet at a known angle and are not parallel."""
    if len(found.others) > 1 or chain.joint(found.others[0]).type != "revolute":
        return None
    w, o = chain.axis(found.first), chain.point(found.first)
    u, q = chain.axis(found.others[0]), chain.point(found.others[0])
    across = w.cross(u)
    sine = dot(across, across)
    if not sine or sine.letters() or dot(q - o, across):
        return None
    along = dot((q - o).cross(u), across) / sine
    center = o + w.scaled(along)
    way = point - center
    lever = dot(way, u)
    square = dot(way, way)
    return OnSphere(center, square, lever * dot(w, u), (square - lever * lever) * sine)
