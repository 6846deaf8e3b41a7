"""The Jacobians of a five-bar linkage, a Delta robot or a Stewart-Gough platform, a row for each leg."""

from __future__ import annotations

from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.kinds.mechanism._extending import jacobian_of_legs
from derive.kinds.mechanism._facts import JacobianFacts
from derive.kinds.mechanism._rods import jacobians_of_rods
from derive.kinds.mechanism.inverse_kinematics import Options as Options
from derive.kinds.problem import Problem
from derive.mechanics.linkages import Delta, FiveBar, Stewart

Facts = JacobianFacts
NEEDS = ("motors",)
CLAIMS = ("by-differences",)
CLAIMED = {"J": "by-differences"}
INTRODUCED = "[xyz]"  # where the end-effector is


def derive(robot: FiveBar | Delta | Stewart, options: Options, problem: Problem) -> Derivation:
    """J_x v = J_q thetadot of legs with cranks, ldot = J (v, omega) of legs that extend.

    Raises NotDerivable for a position with another number of coordinates.
    """
    if isinstance(robot, Stewart):
        legs = problem.answer("inverse-kinematics", options)
        turn = (options.convention, options.orientation)
        return jacobian_of_legs(robot, options.position, turn, legs, problem)
    size = 3 if isinstance(robot, Delta) else 2
    if options.position is not None and len(options.position) != size:
        raise NotDerivable(f"{len(options.position)} coordinates are given, {size} are needed", "position")
    if options.orientation is not None:
        raise NotDerivable("a platform that never turns has no orientation", "orientation")
    return jacobians_of_rods(robot, options.position, problem)
