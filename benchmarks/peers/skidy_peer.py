"""skidy: closed-form equations of motion from screws at the home configuration."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import redirect_stdout
from io import StringIO
from typing import Any

import sympy
from skidy import SymbolicKinDyn, joint_screw, mass_matrix_mixed_data

from benchmarks.cases import Asked
from benchmarks.peers import Point, formulas
from benchmarks.rows import rows_of
from derive.mechanics.robot import Robot


def given(robot: Robot) -> formulas.Given:
    return formulas.read(rows_of(robot), sympy)


def derive(given: formulas.Given, asked: Sequence[Asked]) -> formulas.Answer:
    """Kinematics or dynamics in closed form, not simplified; it prints as it goes."""
    robot, q = _robot(given), sympy.Matrix([row.q for row in given.rows])
    rates = sympy.Matrix([sympy.Symbol(f"{name}_dot") for name in q])
    accelerations = sympy.Matrix([sympy.Symbol(f"{name}_ddot") for name in q])
    plain = {"simplify": False, "parallel": False}
    with redirect_stdout(StringIO()):
        robot.closed_form_kinematics_body_fixed(q, rates, accelerations, **plain)
        if "D" not in asked:
            return formulas.Answer(_linear_first(robot.Jh_ee))
        robot.closed_form_inv_dyn_body_fixed(q, rates, accelerations, **plain)
    return formulas.Answer(robot.M, {}, tuple(robot.Qgrav))


def check(answer: formulas.Answer, point: Point) -> float:
    return formulas.check(answer, point, sympy)


def _linear_first(J: Any) -> Any:
    return sympy.Matrix.vstack(J[3:, :], J[:3, :])


def _robot(given: formulas.Given) -> SymbolicKinDyn:
    home = {row.q: 0 for row in given.rows}
    poses = [pose.subs(home) for pose in formulas.poses_of(given)]
    screws = [
        joint_screw(list(pose[:3, 2]), list(pose[:3, 3]), row.revolute)
        for pose, row in zip(poses, given.rows, strict=False)
    ]
    weights = [mass_matrix_mixed_data(row.mass, row.inertia, row.com, frame="com") for row in given.rows]
    return SymbolicKinDyn(
        gravity_vector=given.gravity,
        ee=sympy.eye(4),
        body_ref_config=poses[1:],
        joint_screw_coord=screws,
        config_representation="spatial",
        Mb=weights,
    )
