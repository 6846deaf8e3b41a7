"""The equations of motion by the recursion of Newton and Euler, line by line, held against Euler-Lagrange."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, PageFacts, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, column
from derive.kinds.checks import law, links
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, matrix_of, moment_names
from derive.kinds.robot._dynamics.bodies import Weighted, weighted
from derive.kinds.robot._dynamics.body_steps import inertia_steps
from derive.kinds.robot._dynamics.drives import with_rotors
from derive.kinds.robot._dynamics.rates import is_long, symbols_of
from derive.kinds.robot._dynamics.recursion import Line, Recursion, step_of, written
from derive.mechanics.newton_euler import LinkBody, NewtonEuler
from derive.mechanics.robot import Robot, gravity_of

RESULTS = {"tau": "the joint forces (n), with rates theta1_dot and accelerations theta1_ddot"}
NEEDS = ("bodies",)
EXAMPLE = """\
title: Newton and Euler
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [-a1/2, 0, 0], inertia: [0, 0, I1]}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [-a2/2, 0, 0], inertia: [0, 0, I2]}
  find: newton-euler
"""
BASE = Symbol("o_0_ddot")
LONGEST_TORQUE = 90  # operations of a joint force that is still written out


class Facts(PageFacts):
    long: bool
    levers: bool
    offsets: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """Out with the motion, back with the forces (Siciliano et al., section 7.5; Craig, section 6.5).

    Raises NotDerivable where a row moves by more than its own variable, or a body in its link.
    """
    if robot.coupled or robot.shifting:
        raise NotDerivable(
            "the recursion takes joints that each move one row, and bodies that are fixed to their links; "
            "find: dynamics has the equations of motion of this arm"
        )
    poses, motion = problem.ask("forward-kinematics"), problem.ask("dynamics")
    long = is_long(problem)
    bodies = weighted(problem, chain_of(problem))
    arm = _arm(problem, bodies)
    recursion = _swept(problem, arm, bodies, long)
    constants = tuple(recursion.constants())
    lines = (*recursion.outward(), *recursion.inward())
    worked = tuple(step_of(problem, line, long) for line in lines)
    steps = (
        *(_constant(problem, line) for line in constants),
        *inertia_steps(problem, bodies),
        _base(problem, arm),
        *(worked if long else _torque_steps(motion, worked)),
    )
    definitions = _definitions(problem, recursion, (*constants, *(() if long else lines)))
    moments = moment_names(problem.ask("inertia-matrix"))
    claims = (
        *links(() if long else steps, {**problem.names, **definitions, **moments}),
        *_laws(problem, arm),
    )
    return Derivation(
        "newton-euler",
        steps,
        {"tau": matrix_of(motion, "tau")},
        claims,
        definitions,
        uses=(poses,),
        facts=Facts(
            long=long,
            levers=any(any(row.arm) for row in arm.rows),
            offsets=any(any(row.out) for row in arm.rows),
        ),
    )


def _arm(problem: Problem, bodies: tuple[Weighted, ...]) -> NewtonEuler:
    """The arm with its bodies, ready for sweeps with rates by name."""
    carried: list[LinkBody | None] = [None] * len(problem.subject.links)
    for body in bodies:
        carried[body.i - 1] = LinkBody(body.motion.mass, body.com, body.motion.inertia)
    names = problem.subject.variables
    others = [Scalar.symbol(f"{name}_{dots}") for name in names for dots in ("dot", "ddot")]
    return NewtonEuler.of(chain_of(problem), carried, (*others, *_gravity(problem)))


def _gravity(problem: Problem) -> tuple[Scalar, ...]:
    return normal_matrix(column(gravity_of(problem.subject))).entries


def _swept(problem: Problem, arm: NewtonEuler, bodies: tuple[Weighted, ...], long: bool) -> Recursion:
    """The sweep with rates by name; of a long arm with none, for its lines stay in names."""
    names = problem.subject.variables
    rate = [0 if long else Scalar.symbol(f"{name}_dot") for name in names]
    rise = [0 if long else Scalar.symbol(f"{name}_ddot") for name in names]
    swept = arm.sweep(rate, rise, _gravity(problem))
    return Recursion(arm, swept, {body.i: body for body in bodies}, problem.subject.links)


def _constant(problem: Problem, line: Line) -> Step:
    return Step(line.name.name, (line.name, written(problem, line)), "constant")


def _base(problem: Problem, arm: NewtonEuler) -> Step:
    """The base accelerates upwards, which stands for gravity."""
    value = problem.readable_matrix(ScalarMatrix.column(arm.at_base(_gravity(problem))))
    return Step(BASE.name, (BASE, value), "base")


def _torque_steps(motion: Derivation, steps: tuple[Step, ...]) -> tuple[Step, ...]:
    """Each tau_k ended by what Euler and Lagrange gave, where that is not too long."""
    tau = matrix_of(motion, "tau")
    values = {f"tau_{k}": entry for k, (entry,) in enumerate(tau.rows, 1)}
    found = []
    for step in steps:
        value = values.get(step.name)
        short = value is not None and operations(value) <= LONGEST_TORQUE
        chain = (*step.chain[:2], value) if short and value is not None else step.chain[:2]
        found.append(step if value is None else Step(step.name, chain, "torque", step.facts))
    return tuple(found)


def _definitions(problem: Problem, recursion: Recursion, lines: tuple[Line, ...]) -> dict[Expr, Expr]:
    """What the names of the recursion stand for."""
    found: dict[Expr, Expr] = {line.name: written(problem, line) for line in lines}
    found[BASE] = _base(problem, recursion.arm).result
    for i, row in enumerate(recursion.arm.rows, 1):
        found[Symbol(f"R_{i}^{i - 1}")] = problem.readable_matrix(row.R)
    return found | {body.I: body.matrix for body in recursion.bodies.values()}


def _laws(problem: Problem, arm: NewtonEuler) -> tuple[Claim, ...]:
    """D, every c_ijk and g of the recursion are those of Euler and Lagrange."""
    inertia, weight = problem.ask("inertia-matrix"), problem.ask("gravity")
    D = normal_matrix(inertia.definitions[Symbol("D")])
    known, count = problem.names, len(problem.subject.variables)
    g = [normal(weight.definitions[Symbol(f"g_{k}")], known) for k in range(1, count + 1)]
    held = [normal(problem.readable(entry), known) for entry in arm.gravity_torques(_gravity(problem))]
    symbols, found = symbols_of(problem), arm.christoffel()
    return (
        law("inertia", with_rotors(arm.inertia_matrix(), problem.subject) == D),
        law(
            "christoffel",
            all(found[ijk] == symbols[ijk] for ijk in symbols),
        ),
        law("gravity", held == g),
    )
