"""The torques of an arm as a linear function of its inertial parameters.

Ten numbers say all that matters of a body: its mass m, its first moments m c, and its inertia, both about
a point of the axis of its joint and along the axes of its frame. Kinetic and potential energy are linear in
them, and so are the torques (Siciliano et al., section 7.2.2; Khalil and Dombre, chapter 9, whose names are
used here). Taken about that point, a body turned by the first joint needs its inertia about the axis only.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.mechanics.chain import Chain
from derive.mechanics.dynamics import kinetic_energy, rate_column
from derive.mechanics.jacobian import jacobian
from derive.mechanics.poses import position_part, rotation_part

# In this order a parameter is expressed by those before it; the last ones are the usual ones to go.
NAMES = ("ZZ", "XX", "XY", "XZ", "YZ", "MX", "MY", "YY", "MZ", "M")
MOMENTS = {"MX": (1, 2), "MY": (2, 0), "MZ": (0, 1)}  # the components of v and omega that they go with
ELEMENTS = {"XX": (0, 0), "YY": (1, 1), "ZZ": (2, 2), "XY": (0, 1), "XZ": (0, 2), "YZ": (1, 2)}


@dataclass(frozen=True, slots=True)
class Parameter:
    """One of the ten of link i: its name, and the column it has in the regressor (n)."""

    name: str
    i: int
    column: tuple[Scalar, ...]


def reference(chain: Chain, i: int) -> ScalarMatrix:
    """The point of link i that its ten numbers refer to (3 by 1, base frame): on the axis of a revolute
    joint, which is the origin o_{i-1} after Denavit and Hartenberg; the origin of the link's frame otherwise,
    and where joints are coupled."""
    joint = chain.joints[i - 1]
    on_axis = joint is not None and joint.type == "revolute" and chain.coupling is None
    return chain.point(i) if on_axis else position_part(chain.T[i])


def parameters_of(mass: Scalar, com: ScalarMatrix, inertia: ScalarMatrix) -> dict[str, Scalar]:
    """The ten numbers of a body from mass, com (3 by 1, from the reference) and inertia about the com
    (3 by 3), all along the axes of its frame."""
    x, y, z = com.entries
    square = x * x + y * y + z * z
    found = {"M": mass, "MX": mass * x, "MY": mass * y, "MZ": mass * z}
    for name, (i, j) in ELEMENTS.items():
        shift = (square if i == j else Scalar.of(0)) - com[i, 0] * com[j, 0]
        found[name] = inertia[i, j] + mass * shift
    return found


def columns(chain: Chain, i: int, gravity: ScalarMatrix, wanted: Sequence[str]) -> Iterator[Parameter]:
    """What each parameter of link i does to the torques, those that do nothing left out; `gravity` is the
    acceleration in the base frame (3 by 1)."""
    R, o = rotation_part(chain.T[i]), reference(chain, i)
    J = jacobian(chain, o, i)
    v, w = (R.T @ J.block(rows, slice(None)) for rows in (slice(0, 3), slice(3, 6)))
    for name in wanted:
        D = _inertia(name, v, w)
        column = _torques(D, _potential(name, R, o, gravity), chain.variables)
        if any(column):
            yield Parameter(name, i, column)


def _inertia(name: str, v: ScalarMatrix, w: ScalarMatrix) -> ScalarMatrix:
    """D of a body with this parameter alone: K = m v^2/2 + m c . (v x w) + w . I w / 2."""
    if name == "M":
        return v.T @ v
    if name in ELEMENTS:
        i, j = ELEMENTS[name]
        product = _outer(w, i, w, j)
        return product if i == j else product + product.T
    j, k = MOMENTS[name]
    product = _outer(v, j, w, k) - _outer(v, k, w, j)
    return product + product.T


def _outer(A: ScalarMatrix, i: int, B: ScalarMatrix, j: int) -> ScalarMatrix:
    """Row i of A, transposed, times row j of B (n by n)."""
    home = A.ring.union(B.ring)
    left, right = A.into(home).rows[i], B.into(home).rows[j]
    return ScalarMatrix(tuple(tuple(a * b for b in right) for a in left))


def _potential(name: str, R: ScalarMatrix, o: ScalarMatrix, gravity: ScalarMatrix) -> Scalar:
    if name == "M":
        return -(gravity.T @ o)[0, 0]
    if name in ELEMENTS:
        return Scalar.of(0)
    return -(gravity.T @ R.columns("XYZ".index(name[1])))[0, 0]


def _torques(D: ScalarMatrix, P: Scalar, variables: Sequence[str]) -> tuple[Scalar, ...]:
    """D qddot + dD/dt qdot - d(qdot^T D qdot / 2)/dq + dP/dq (n)."""
    rate, rise = rate_column(variables), rate_column(variables, "ddot")
    if not D:
        return tuple(P.diff(name) for name in variables)
    by_joint = [D.diff(name) for name in variables]
    turning = ScalarMatrix.zeros(*D.shape)
    for derivative, speed in zip(by_joint, rate.entries, strict=True):
        turning = turning + derivative.scaled(speed) if derivative else turning
    moved = (D @ rise + turning @ rate).entries
    found = []
    for derivative, name, torque in zip(by_joint, variables, moved, strict=True):
        slope = kinetic_energy(derivative, rate) if derivative else Scalar.of(0)
        found.append(torque - slope + P.diff(name))
    return tuple(found)
