"""The equations of motion as a system of first order, and its linearisation about an equilibrium."""

from __future__ import annotations

from derive.derivation import Derivation, PageFacts, Step
from derive.expression import Expr, Symbol, column
from derive.kinds.evaluation import Evaluation
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import matrix_of
from derive.kinds.robot._dynamics.drives import friction_sorts
from derive.kinds.robot._dynamics.linearisation import linearised
from derive.mechanics.robot import Robot

RESULTS = {
    "x": "the state: the joint variables, then their rates (2n)",
    "f": "dx/dt for the joint forces tau_1, tau_2, ... (2n)",
    "tau_0": "the joint forces that hold the arm at the equilibrium (n)",
    "A": "of the linearisation dx/dt = A x + B u in the deviations from the equilibrium (2n by 2n)",
    "B": "the same (2n by n); u is tau - tau_0",
}
NEEDS = ("bodies",)
EXAMPLE = """\
title: An arm about an equilibrium
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [0, 0, 0], inertia: point}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [0, 0, 0], inertia: point}
  find: state-space
  at: {theta1: -90 deg, theta2: 0}
"""


class Options(OptionsModel):
    """`at`: the equilibrium, values of joint variables; one left out stays as it is. Without `at` the
    equations are not linearised."""

    at: Evaluation = None


class Facts(PageFacts):
    at: tuple[tuple[Symbol, Expr], ...]
    linear: bool
    long: bool
    viscous: bool
    coulomb: bool
    held: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """x = (q, qdot), and A, B about rest at `at` (Spong et al., section 8.1; Siciliano et al., 8.4)."""
    forward, motion = problem.ask("forward-dynamics"), problem.ask("dynamics")
    names = robot.variables
    rates = [Symbol(f"{name}_dot") for name in names]
    rises = [Symbol(f"{name}_ddot") for name in names]
    x = column([*map(Symbol, names), *rates])
    solved = matrix_of(forward, "qddot")
    f = column([*rates, *(entry for (entry,) in solved.rows)])
    steps = [
        Step("x", (Symbol("x"), x), "state"),
        Step("f", (Symbol("x_dot"), column([*rates, *rises])), "state"),
    ]
    linear = None if options.at is None else linearised(problem, motion, dict(options.at))
    return Derivation(
        "state-space",
        (*steps, *(linear.steps if linear else ())),
        {"x": x, "f": f, **(linear.results if linear else {})},
        linear.claims if linear else (),
        {**forward.definitions, **(linear.definitions if linear else {})},
        uses=(forward,),
        facts=Facts(
            at=tuple((Symbol(name), value) for name, value in (options.at or ())),
            linear=linear is not None,
            long=bool(linear and linear.long),
            viscous=bool(linear and linear.friction),
            coulomb=friction_sorts(robot)[1],
            held=bool(linear and linear.torques),
        ),
        matrices=frozenset({"A", "B"}),
    )
