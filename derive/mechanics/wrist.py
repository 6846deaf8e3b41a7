"""Arms that end in three axes through one point: their singularities split at the centre of the wrist.

About that point the last three joints move nothing, and J = [[J_11, 0], [J_21, J_22]]
(Siciliano et al., section 3.3.1; Spong et al., section 4.9.1).
"""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.mechanics.chain import Chain
from derive.mechanics.jacobian import jacobian
from derive.mechanics.poses import position_part, rotation_part


@dataclass(frozen=True, slots=True)
class Wrist:
    """`center` (3 by 1, base frame) is the origin of frame `frame`; J_11 (3 by 3) is the velocity of the
    centre by the first three joints in the axes of frame `arm`, J_22 (3 by 3) the angular velocity by the
    last three in those of frame `hand`. `arm_rows` and `hand_rows` are the rows of those joints."""

    center: ScalarMatrix
    frame: int
    J_11: ScalarMatrix
    J_22: ScalarMatrix
    arm: int
    hand: int
    arm_rows: tuple[int, ...]
    hand_rows: tuple[int, ...]


def wrist_of(chain: Chain) -> Wrist | None:
    """The split of an arm of six joints whose last three axes meet; None for any other."""
    rows = tuple(i for i, _ in chain.moving)
    if len(rows) != 6 or any(chain.joint(i).type != "revolute" for i in rows[3:]):
        return None
    if chain.coupling and chain.coupling.rows[-1] > len(chain.T_local):  # the tool moves against the hand
        return None
    frame = _meeting(chain, rows[3:])
    if frame is None:
        return None
    center = position_part(chain.T[frame])
    J = jacobian(chain, center, len(chain.T_local))
    arm, hand = rows[0], rows[3] - 1
    linear, angular = slice(0, 3), slice(3, 6)
    if J.block(linear, angular):  # coupled joints: the last variables move the center as well
        return None
    return Wrist(
        center,
        frame,
        rotation_part(chain.T[arm]).T @ J.block(linear, linear),
        rotation_part(chain.T[hand]).T @ J.block(angular, angular),
        arm,
        hand,
        rows[:3],
        rows[3:],
    )


def _meeting(chain: Chain, rows: tuple[int, ...]) -> int | None:
    """The last frame that moves with the wrist and whose origin lies on all of these axes."""
    zero = ScalarMatrix.zeros(3, 1)
    for frame in range(len(chain.T_local), rows[0] - 2, -1):
        origin = position_part(chain.T[frame])
        if all(chain.axis(i).cross(origin - chain.point(i)) == zero for i in rows):
            return frame
    return None
