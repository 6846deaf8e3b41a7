"""The planar arm of two revolute joints, and its inverse by the law of cosines."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.angles import Form
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar, trig
from derive.mechanics.chain import Chain


@dataclass(frozen=True, slots=True)
class TwoLink:
    """x = a_1 c_1 + a_2 c_12, y = a_1 s_1 + a_2 s_12, with the names of the joint variables."""

    a_1: Scalar
    a_2: Scalar
    theta_1: str
    theta_2: str


def two_link(chain: Chain) -> TwoLink | None:
    """The lengths of such an arm; None where the chain is no such arm.

    Read off the position of the end-effector, so that it does not matter how its rows were written.
    """
    if len(chain.variables) != 2 or any(joint.type != "revolute" for _, joint in chain.moving):
        return None
    first, second = chain.variables
    p = chain.T_tool.columns(3)
    x, y, z = p[0, 0], p[1, 0], p[2, 0]
    if any(z.diff(name) for name in chain.variables):
        return None
    (c1, s1), (c12, s12) = trig(Form.of({first: 1})), trig(Form.of({first: 1, second: 1}))
    a_2 = x.diff(second) * -s12 + y.diff(second) * c12
    a_1 = x * c1 + y * s1 - a_2 * (c12 * c1 + s12 * s1)
    arm = ScalarMatrix.of([[a_1 * c1 + a_2 * c12], [a_1 * s1 + a_2 * s12]])
    constant = not any(a.diff(name) for a in (a_1, a_2) for name in chain.variables)
    if not (constant and a_1 and a_2 and arm == p.block(slice(0, 2), slice(0, 1))):
        return None
    return TwoLink(a_1, a_2, first, second)
