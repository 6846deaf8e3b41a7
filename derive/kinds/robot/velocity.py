"""The linear and angular velocity of a point of an arm."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, PageFacts, Step
from derive.expression import Expr, Matrix, Product, Symbol, column
from derive.kinds.checks import law, links
from derive.kinds.fields import OptionsModel
from derive.kinds.naming import fits
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, closing
from derive.kinds.robot._point import PointOn, tracked
from derive.mechanics.robot import Robot

RESULTS = {"v": "linear velocity (3)", "omega": "angular velocity (3); rates are written theta1_dot"}
EXAMPLE = """\
title: The velocity of a point
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  find: velocity
  point: {link: 2, at: [-a2/2, 0, 0]}
"""


class Options(OptionsModel):
    """`point`: where; the end-effector if left out."""

    point: PointOn | None = None


class Facts(PageFacts):
    rates: tuple[Symbol, ...]


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """(v, omega) = J qdot (Spong et al., eq. 4.49)."""
    base = problem.ask("jacobian", point=options.point)
    J, rates = base.definitions[Symbol("J")], [Symbol(f"{name}_dot") for name in robot.variables]
    rate = column(rates)
    twist = normal_matrix(J) @ normal_matrix(rate)
    written = problem.readable_matrix(twist)
    name = Matrix(((Symbol("v"),), (Symbol("omega"),)))
    v, omega = Matrix(written.rows[:3]), Matrix(written.rows[3:])
    product = Product((Symbol("J"), Symbol("q_dot")))
    chain = (
        (name, product, Product((J, rate)), written)
        if isinstance(J, Matrix) and fits(J)
        else (name, product, written)
    )
    step = Step("twist", chain, "velocity")
    definitions: dict[Expr, Expr] = {
        Symbol("q_dot"): rate,
        Symbol("v"): v,
        Symbol("omega"): omega,
        Symbol("J"): J,
    }
    steps = (closing(step, problem.final(written)),)
    return Derivation(
        "velocity",
        steps,
        {"v": problem.final(v), "omega": problem.final(omega)},
        (*links(steps, {**problem.names, **definitions}), _law(problem, options, twist)),
        definitions,
        uses=(base,),
        facts=Facts(rates=tuple(rates)),
    )


def _law(problem: Problem, options: Options, twist: ScalarMatrix) -> Claim:
    """v is the time derivative of the position, by the chain rule."""
    found = chain_of(problem)
    position = tracked(problem, found, options.point).position
    total = ScalarMatrix.zeros(3, 1)
    for name in found.variables:
        total = total + position.diff(name).scaled(Scalar.symbol(f"{name}_dot"))
    return law("rate-of-the-point", total == twist.block(slice(0, 3), slice(0, 1)))
