"""The geometric Jacobian, column by column (Siciliano et al., eq. 3.30; Spong et al., section 4.6)."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.mechanics.chain import Chain
from derive.mechanics.coupling import Coupling, Drive


@dataclass(frozen=True, slots=True)
class MovingPoint:
    """A point (3 by 1, base frame) that moves with frame `last` (n + 1: the tool's); `drift` (3 by n) is how
    it moves in that frame, None where it is fixed there."""

    position: ScalarMatrix
    last: int
    drift: ScalarMatrix | None = None

    def jacobian(self, chain: Chain) -> ScalarMatrix:
        """J (6 by n), linear rows first."""
        J = jacobian(chain, self.position, self.last)
        if self.drift is None:
            return J
        return J + ScalarMatrix.stacked([self.drift, ScalarMatrix.zeros(*self.drift.shape)])


def halves(J: ScalarMatrix) -> tuple[ScalarMatrix, ScalarMatrix]:
    """J_v and J_w (3 by n each): the linear rows of a Jacobian (6 by n), and the angular ones."""
    return J.block(slice(0, 3), slice(None)), J.block(slice(3, 6), slice(None))


def jacobian(chain: Chain, point: ScalarMatrix, last: int) -> ScalarMatrix:
    """J (6 by n), linear rows first, of a point (3 by 1, base frame) that is fixed in frame `last`. Of
    coupled joints it is that of the motions of the rows times the rates of these.

    Joints after that frame do not move the point: their columns are zero.
    """
    if chain.coupling:
        return motions_jacobian(chain.coupling, point, last) @ chain.coupling.gamma
    return ScalarMatrix.beside([column(chain, point, i, last) for i, _ in chain.moving])


def motions_jacobian(coupling: Coupling, point: ScalarMatrix, last: int) -> ScalarMatrix:
    """J_phi (6 by m): the columns of the motions of the rows, each as if it went alone."""
    return ScalarMatrix.beside([_of_drive(drive, point, last) for drive in coupling.drives])


def _of_drive(drive: Drive, point: ScalarMatrix, last: int) -> ScalarMatrix:
    if drive.i > last:
        return ScalarMatrix.zeros(6, 1)
    if drive.slides:
        return ScalarMatrix.stacked([drive.axis, ScalarMatrix.zeros(3, 1)])
    return ScalarMatrix.stacked([drive.axis.cross(point - drive.point), drive.axis])


def drift(chain: Chain, R: ScalarMatrix, p: ScalarMatrix) -> ScalarMatrix | None:
    """R dp/dq (3 by n): how a point at p (3 by 1) of a frame turned by R moves in that frame; None where no
    joint variable stands in p."""
    rates = ScalarMatrix.of([entry.diff(name) for name in chain.variables] for entry in p.entries)
    return R @ rates if rates else None


def column(chain: Chain, point: ScalarMatrix, i: int, last: int) -> ScalarMatrix:
    """The column (6 by 1) of the joint of row i, z x (p - o) over z for a revolute joint, h z more above
    where it has the pitch h; z over 0 for a prismatic one; 0 beyond `last`.

    Raises ValueError for a fixed row."""
    if i > last:
        return ScalarMatrix.zeros(6, 1)
    z = chain.axis(i)
    if chain.joint(i).type == "prismatic":
        return ScalarMatrix.stacked([z, ScalarMatrix.zeros(3, 1)])
    v = z.cross(point - chain.point(i))
    pitch = chain.joint(i).pitch
    return ScalarMatrix.stacked([v + z.scaled(pitch) if pitch else v, z])
