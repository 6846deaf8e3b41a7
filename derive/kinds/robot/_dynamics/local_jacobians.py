"""Big arms: the Jacobians of the centres of mass in the frames of their own links.

In its own frame a link's motion holds only the angles between joint and link, so that its entries stay
short where those of D would fill pages; D, its derivatives and g are sums over them.
"""

from __future__ import annotations

from derive.derivation import Step
from derive.expression import ZERO, Expr, Product, Sum, Symbol, transpose
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.bodies import Weighted


def local_steps(problem: Problem, bodies: tuple[Weighted, ...]) -> tuple[Step, ...]:
    """J_v and J_w of each link in its own frame (3 by n)."""
    steps: list[Step] = []
    for body in bodies:
        for part, J in (("v", body.motion.J_v), ("w", body.motion.J_w)):
            name = Symbol(f"J_{part}{body.i}^{body.i}")
            base = Symbol(f"J_{part}{body.i}")
            local = body.motion.R.T @ J
            route = Product((transpose(Symbol(f"R_{body.i}^0")), base))
            steps.append(Step(name.name, (name, route, problem.readable_matrix(local)), "local-jacobian"))
    return tuple(steps)


def local_definitions(problem: Problem, bodies: tuple[Weighted, ...]) -> dict[Expr, Expr]:
    """What J_v1, J_w1, ... and R_1^0, ... stand for, and I_1, ..."""
    names: dict[Expr, Expr] = {}
    for body in bodies:
        names[Symbol(f"J_v{body.i}")] = problem.readable_matrix(body.motion.J_v)
        names[Symbol(f"J_w{body.i}")] = problem.readable_matrix(body.motion.J_w)
        names[Symbol(f"R_{body.i}^0")] = problem.readable_matrix(body.motion.R)
        names[body.I] = body.matrix
        names[Symbol(f"o_c{body.i}")] = problem.readable_matrix(body.motion.com)
    return names


def local_parts(bodies: tuple[Weighted, ...]) -> tuple[Step, ...]:
    """D_i of each link in the names of its local Jacobians."""
    named = ((f"D_{body.i}", _formula(body)) for body in bodies)
    return tuple(Step(name, (Symbol(name), formula), "link-inertia") for name, formula in named)


def _formula(body: Weighted) -> Expr:
    J_v, J_w = Symbol(f"J_v{body.i}^{body.i}"), Symbol(f"J_w{body.i}^{body.i}")
    linear = Product((body.body.mass, transpose(J_v), J_v))
    if not body.turns:
        return linear
    angular = Product((transpose(J_w), body.I, J_w))
    return angular if body.body.mass == ZERO else Sum((linear, angular))
