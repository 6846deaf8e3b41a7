"""The geometric Jacobian, column by column (Siciliano et al., eq. 3.30; Spong et al., section 4.6)."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.mechanics.chain import Chain


def jacobian(chain: Chain, point: ScalarMatrix, last: int) -> ScalarMatrix:
    """J (6 by n), linear rows first, of a point (3 by 1, base frame) that moves with frame `last`.

    Joints after that frame do not move the point: their columns are zero.
    """
    return ScalarMatrix.beside([column(chain, point, i, last) for i, _ in chain.moving])


def column(chain: Chain, point: ScalarMatrix, i: int, last: int) -> ScalarMatrix:
    """z x (p - o) over z for a revolute joint, h z more above where it has the pitch h; z over 0 for a
    prismatic one; 0 beyond `last`."""
    if i > last:
        return ScalarMatrix.zeros(6, 1)
    z = chain.axis(i)
    if chain.joint(i).type == "prismatic":
        return ScalarMatrix.stacked([z, ScalarMatrix.zeros(3, 1)])
    v = z.cross(point - chain.point(i))
    pitch = chain.joint(i).pitch
    return ScalarMatrix.stacked([v + z.scaled(pitch) if pitch else v, z])
