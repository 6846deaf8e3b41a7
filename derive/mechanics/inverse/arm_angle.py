"""Seven joints by the arm angle: a spherical shoulder, an elbow and a spherical wrist (Shimizu et al. 2008).

The pose fixes both centres, so the arm can only turn about the line between them, as a human arm does. The
frame with its z-axis along that line and its y-axis along the axis of the elbow is known in the base by the
directions of the line and the angle of the turn, and in the frame after the shoulder by the angle of the
elbow: so the rotation of the shoulder is known.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix, dot
from derive.algebra.normal import trig_of
from derive.algebra.numbers.floats import matrix_numbers, scalar_number
from derive.algebra.rationals import as_fraction
from derive.algebra.scalar import Scalar
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.wrist import Spherical, moved, spherical_shoulder, spherical_wrist
from derive.mechanics.poses import homogeneous, position_part, rotation, rotation_part

JOINTS = 7


@dataclass(frozen=True, slots=True)
class ArmAngle:
    """A shoulder and a wrist, whose `centre` (3 by 1) is known in the base. The names of the angles: `psi` of
    the turn, `alpha` and `beta` of the line in the base, `gamma` in the frame after the shoulder, where the
    line is `inside` (3 by 1, in the angle of the elbow). `plane` (3 by 3) has the axis of the elbow as its
    second column. `turn` has nine names for what the shoulder makes."""

    shoulder: Spherical
    wrist: Spherical
    centre: ScalarMatrix
    joints: tuple[str, ...]
    elbow: str
    inside: ScalarMatrix
    plane: ScalarMatrix
    psi: str
    alpha: str
    beta: str
    gamma: str
    turn: tuple[str, ...]

    @property
    def before(self) -> ScalarMatrix:
        """U (3 by 3) of that frame in the base."""
        first, second, third = (trig_of(Scalar.symbol(each)) for each in (self.alpha, self.beta, self.psi))
        return rotation("z", first) @ rotation("y", second) @ rotation("z", third)

    @property
    def after(self) -> ScalarMatrix:
        """V (3 by 3) of that frame in the frame after the shoulder."""
        return self.plane @ rotation("y", trig_of(Scalar.symbol(self.gamma)))

    @property
    def across(self) -> tuple[Scalar, Scalar]:
        """The line after the shoulder by its components in the plane of the elbow, along x and z."""
        seen = self.plane.T @ self.inside
        return seen[0, 0], seen[2, 0]

    def named(self) -> dict[str, Scalar]:
        """What each of the nine names stands for."""
        return dict(zip(self.turn, (self.before @ self.after.T).entries, strict=True))

    def at(self, chain: Chain, point: Mapping[str, float]) -> dict[str, float]:
        """The values of the four angles, where the arm stands at a point."""
        x, y, z = (row[0] for row in matrix_numbers(self.centre - self.shoulder.centre, point))
        alpha, beta = math.atan2(y, x), math.atan2(math.hypot(x, y), z)
        gamma = math.atan2(*(scalar_number(part, point) for part in self.across))
        found = {self.alpha: alpha, self.beta: beta, self.gamma: gamma}
        sides = (scalar_number(part, {**point, **found}) for part in self.swing(chain))
        return {self.psi: math.atan2(*sides), **found}

    def swing(self, chain: Chain) -> tuple[Scalar, Scalar]:
        """The sine and cosine of psi where the arm stands: the axis of the elbow is R_z(alpha) R_y(beta)
        (-sin psi, cos psi, 0) in the base."""
        axis = rotation_part(chain.T[self.shoulder.frame]) @ self.plane.columns(1)
        first, second = (trig_of(Scalar.symbol(each)) for each in (self.alpha, self.beta))
        seen = (rotation("z", first) @ rotation("y", second)).T @ axis
        return -seen[0, 0], seen[1, 0]


def arm_angle(chain: Chain, goal: Goal, psi: str, free_name: Callable[[str], str]) -> ArmAngle | None:
    """That of an arm with seven joints that turn, an elbow between a spherical shoulder and a spherical
    wrist, whose line between the two lies in the plane in which it bends. None of any other, and without a
    pose."""
    if goal.R is None or not goal.whole_position:
        return None
    rows = [i for i, _ in chain.moving]
    if len(rows) != JOINTS or chain.coupling or any(joint.type != "revolute" for _, joint in chain.moving):
        return None
    shoulder, wrist = spherical_shoulder(chain), spherical_wrist(chain)
    if shoulder is None or wrist is None:
        return None
    elbow = chain.joint(rows[3])
    to_elbow = _between(chain, shoulder.frame, rows[3] - 1) @ elbow.before
    inside = moved(_between(chain, shoulder.frame, wrist.frame), wrist.inside) - shoulder.inside
    plane = _plane(rotation_part(to_elbow) @ elbow.axis, position_part(to_elbow) - shoulder.inside)
    if plane is None or dot(plane.columns(1).entries, inside.entries):
        return None
    joints = tuple(chain.joint(row).variable for row in shoulder.rows)
    alpha, beta, gamma = (free_name(name) for name in ("alpha", "beta", "gamma"))
    turn = tuple(free_name(f"u_{i}{j}") for i in (1, 2, 3) for j in (1, 2, 3))
    place = ScalarMatrix.column([part for part in goal.p if part is not None])
    centre = place + goal.R @ wrist.centre
    return ArmAngle(
        shoulder, wrist, centre, joints, elbow.variable, inside, plane, psi, alpha, beta, gamma, turn
    )


def _between(chain: Chain, first: int, last: int) -> ScalarMatrix:
    T = homogeneous(ScalarMatrix.identity(3), (0, 0, 0))
    for local in chain.T_local[first:last]:
        T = T @ local
    return T


def _plane(axis: ScalarMatrix, upper: ScalarMatrix) -> ScalarMatrix | None:
    """x, y and z (in columns) with y along the axis of the elbow, and z along the axis of the frame that the
    upper arm follows most; None where the axis of the elbow is along none."""
    units = [ScalarMatrix.column([int(i == k) for i in range(3)]) for k in range(3)]
    if not any(axis in (unit, -unit) for unit in units):
        return None
    signed = [unit.scaled(Scalar.of(sign)) for unit in reversed(units) for sign in (1, -1)]
    across = [unit for unit in signed if not dot(unit.entries, axis.entries)]
    z = max(across, key=lambda unit: _size(dot(unit.entries, upper.entries)))
    x = axis.cross(z)
    return ScalarMatrix.of([[x[i, 0], axis[i, 0], z[i, 0]] for i in range(3)])


def _size(length: Scalar) -> float:
    """Of a number itself; of a formula one, less than nothing where it has a minus in front."""
    if length.constant is not None:
        return float(length.constant)
    return 1.0 if as_fraction(length.numerator.leading_coefficient()) > 0 else -1.0
