"""Ours: chain, Jacobians of the coms, D, Christoffel symbols and g, in normal form."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from benchmarks.cases import Asked
from benchmarks.peers import Point
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.scalar import Scalar
from derive.expression import Expr
from derive.mechanics.bodies import Body
from derive.mechanics.chain import Chain, chain
from derive.mechanics.dynamics import LinkMotion, christoffel, gravity_of, inertia_matrix, potential_energy
from derive.mechanics.jacobian import jacobian
from derive.mechanics.moments import moments
from derive.mechanics.poses import position_part, rotation_part
from derive.mechanics.robot import Robot


@dataclass(frozen=True, slots=True)
class Answer:
    """What was derived; what was not asked is empty."""

    chain: Chain
    J: ScalarMatrix | None = None
    D: ScalarMatrix | None = None
    c: dict[tuple[int, int, int], Scalar] = field(default_factory=dict)
    g: tuple[Scalar, ...] = ()


def given(robot: Robot) -> Robot:
    return robot


def derive(robot: Robot, asked: Sequence[Asked]) -> Answer:
    """Everything in normal form: equal entries are `==`."""
    found = chain(robot)
    J = jacobian(found, position_part(found.T_tool), len(robot.links)) if "jacobian" in asked else None
    if "D" not in asked:
        return Answer(found, J)
    links = [_motion(found, i, link.body) for i, link in enumerate(robot.links, 1) if link.body]
    D = inertia_matrix(links)
    P = potential_energy(links, _column(found, gravity_of(robot)))
    g = tuple(P.diff(name) for name in robot.variables)
    return Answer(found, J, D, christoffel(D, robot.variables), g)


def check(answer: Answer, point: Point) -> float:
    """d_11 + d_1n, or the same entries of J."""
    matrix = answer.D or answer.J
    if matrix is None:
        raise ValueError("nothing was derived that could be checked")
    return scalar_number(matrix[0, 0] + matrix[0, matrix.shape[1] - 1], point)


def _motion(found: Chain, i: int, body: Body) -> LinkMotion:
    R, home = rotation_part(found.T[i]), found.T[i].ring
    if body.com == "center":
        raise ValueError("a benchmark robot gives each com by its coordinates")
    com = position_part(found.T[i]) + R @ _column(found, body.com)
    J = jacobian(found, com, i)
    xx, yy, zz, xy, yz, xz = (normal(moment) for moment in moments(body))
    inertia = ScalarMatrix.of(((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))).into(home)
    linear, angular = J.block(slice(0, 3), slice(None)), J.block(slice(3, 6), slice(None))
    return LinkMotion(normal(body.mass).into(home), com, linear, angular, R, inertia)


def _column(found: Chain, parts: Sequence[Expr]) -> ScalarMatrix:
    return ScalarMatrix.column([normal(part) for part in parts]).into(found.T[0].ring)
