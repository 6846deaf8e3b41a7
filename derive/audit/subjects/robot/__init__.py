"""The arm: poses by the matrices of the textbook, velocities as derivatives of poses, dynamics from energies.

Everything is found in numbers at one configuration: a pose is a power series in the joint variables there
(`series`), so that an arm of six joints costs no more than its numbers do.
"""

from __future__ import annotations

from collections.abc import Iterator

from derive.audit import orientation
from derive.audit.subjects.robot import (
    along_path,
    axes,
    dynamics,
    inverse,
    iteration,
    kinematics,
    rates,
    reach,
    scaling,
    singular,
    spans,
)
from derive.audit.subjects.robot.arm import Arm
from derive.audit.subjects.robot.series import values
from derive.expression import Expr, free_symbols
from derive.mechanics.robot import DHRow, FreeRow, Robot, ScrewRow

KINDS = {
    "forward-kinematics": kinematics.forward_kinematics,
    "joint-axes": axes.joint_axes,
    "jacobian": kinematics.jacobian,
    "velocity": rates.velocity,
    "jacobian-derivative": rates.jacobian_derivative,
    "acceleration": rates.acceleration,
    "statics": kinematics.statics,
    "inverse-velocity": rates.inverse_velocity,
    "inverse-acceleration": rates.inverse_acceleration,
    "joint-motion": along_path.joint_motion,
    "product-of-exponentials": kinematics.product_of_exponentials,
    "space-jacobian": kinematics.space_jacobian,
    "inverse-kinematics": inverse.inverse_kinematics,
    "singularities": singular.singularities,
    "manipulability": singular.manipulability,
    "rank": spans.rank,
    "redundancy": spans.redundancy,
    "workspace": reach.workspace,
    "numerical-inverse-kinematics": iteration.numerical_inverse_kinematics,
    "dh-table": kinematics.dh_table,
    "inertia-matrix": dynamics.inertia_matrix,
    "christoffel": dynamics.christoffel,
    "coriolis-matrix": dynamics.coriolis_matrix,
    "coriolis-matrices": dynamics.coriolis_matrices,
    "gravity": dynamics.gravity,
    "energy": dynamics.energy,
    "dynamics": dynamics.dynamics,
    "residual": dynamics.residual,
    "time-scaling": scaling.time_scaling,
    "newton-euler": dynamics.newton_euler,
    "forward-dynamics": dynamics.forward_dynamics,
    "operational-space-inertia": dynamics.operational_space_inertia,
    "state-space": dynamics.state_space,
    "properties": dynamics.properties,
    "regressor": dynamics.regressor,
    **orientation.kinds(lambda asked, point: values(Arm(asked, point, 0).end)),
}


def angles(robot: Robot) -> frozenset[str]:
    """The names in the angles of rows and moves."""
    return frozenset().union(*map(free_symbols, _angles(robot)))


def _angles(robot: Robot) -> Iterator[Expr]:
    for link in robot.links:
        match link.row:
            case DHRow(theta=theta, alpha=alpha):
                yield from (theta, alpha)
            case FreeRow(moves):
                yield from (move.by for move in moves if move.kind == "rotate")
            case ScrewRow(by=by, slide=False):
                yield by
    yield from (move.by for move in (*robot.base, *robot.tool) if move.kind == "rotate")
