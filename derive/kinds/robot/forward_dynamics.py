"""The accelerations of an arm that its joint forces bring about."""

from __future__ import annotations

from collections.abc import Mapping

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.algebra.readable.operation_count import operations
from derive.derivation import Claim, Derivation, PageFacts, Step, named_results
from derive.expression import Expr, Quotient, Symbol, add, column, multiply, subtract
from derive.kinds.checks import agreement, law, links
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._dynamics.inverse_inertia import DET, Turned, turned
from derive.kinds.robot._dynamics.rates import rated
from derive.kinds.robot._dynamics.terms import terms_of
from derive.mechanics.oracle import Oracle
from derive.mechanics.robot import Robot

RESULTS = {
    "det": "the determinant of D",
    "D_inv": "the inverse of D (n by n)",
    "h": "everything in tau that is no acceleration: Coriolis, centrifugal, gravity, friction (n)",
    "qddot": "the accelerations (n) for the joint forces tau_1, tau_2, ...; rates are written theta1_dot",
}
NEEDS = ("bodies",)
EXAMPLE = """\
title: The accelerations of a planar arm
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [0, 0, 0], inertia: point}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [0, 0, 0], inertia: point}
  find: forward-dynamics
"""
LONGEST = 60  # operations of an acceleration that is still written out


class Facts(PageFacts):
    long: bool
    one: bool  # joint


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """qddot = D^-1 (tau - h), by the adjugate and the determinant (Craig, eq. 6.115)."""
    motion = problem.ask("dynamics")
    inverse = turned(problem, motion, "the accelerations are")
    rest = rest_steps(problem)
    h = column(step.result for step in rest)
    solved = tuple(_acceleration(inverse, rest, k, name) for k, name in enumerate(robot.variables))
    results: dict[str, Expr] = {
        "det": inverse.step.result,
        "D_inv": inverse.inverse,
        "h": h,
        "qddot": column(result for _, result in solved),
    }
    steps = (*rest, inverse.step, *(step for step, _ in solved))
    definitions: dict[Expr, Expr] = {**motion.definitions, **named_results(rest), Symbol("D"): inverse.D}
    known = {**problem.names, **definitions, **inverse.values}
    claims = (
        *links((*rest, inverse.step) if inverse.long else steps, known),
        *_laws(inverse, results),
        *_second_routes(problem, results),
    )
    return Derivation(
        "forward-dynamics",
        steps,
        results,
        claims,
        definitions,
        uses=(motion,),
        facts=Facts(long=inverse.long, one=len(robot.variables) == 1),
        matrices=frozenset({"D_inv"}),
    )


def rest_steps(problem: Problem) -> tuple[Step, ...]:
    """h_k, what is left of tau_k without accelerations: in the names of its terms, and written out."""
    parts = (problem.ask(kind) for kind in ("inertia-matrix", "christoffel", "gravity"))
    steps = []
    for k, terms in enumerate(terms_of(problem, *parts), 1):
        left = [term for term in terms if term.sort != "acceleration"]
        named, written = add(*(term.named for term in left)), add(*(term.written for term in left))
        chain = (Symbol(f"h_{k}"), named, written) if written != named else (Symbol(f"h_{k}"), named)
        steps.append(Step(f"h_{k}", chain, "rest"))
    return tuple(steps)


def _acceleration(inverse: Turned, rest: tuple[Step, ...], k: int, variable: str) -> tuple[Step, Expr]:
    """qddot_k in names, and what it is in full; the step ends with that where it is short."""
    name = Symbol(f"{variable}_ddot")
    forces = [subtract(Symbol(f"tau_{j}"), Symbol(step.name)) for j, step in enumerate(rest, 1)]
    top = add(
        *(multiply(weight, force) for weight, force in zip(inverse.adjugate.rows[k], forces, strict=True))
    )
    named = Quotient(top, DET)
    values: dict[Expr, Expr] = {Symbol(step.name): step.result for step in rest}
    result = inverse.solved(Quotient(top, inverse.det), values)
    short = operations(result) <= LONGEST
    return Step(name.name, (name, named, result) if short else (name, named), "acceleration"), result


def _laws(inverse: Turned, results: Mapping[str, Expr]) -> tuple[Claim, ...]:
    """D D^-1 = 1; of a long arm D adj D = det D."""
    D = normal_matrix(inverse.D, inverse.problem.names)
    adjugate = normal_matrix(inverse.adjugate, {**inverse.problem.names, **inverse.values})
    one = ScalarMatrix.identity(D.shape[0])
    return (law("adjugate", D @ adjugate == one.scaled(D.det())),)


def _second_routes(problem: Problem, results: Mapping[str, Expr]) -> tuple[Claim, ...]:
    """The accelerations put back into Newton's and Euler's equations give the joint forces."""
    arm: Oracle = oracle_of(problem)
    names = problem.subject.variables
    forces = [f"tau_{k}" for k in range(1, len(names) + 1)]

    def back(at: Mapping[str, float]) -> list[float]:
        whole = arm.at(at)
        found = numeric.numbers(results["qddot"], whole)
        moved = {f"{name}_ddot": value for name, value in zip(names, found, strict=True)}
        return [float(tau) for tau in arm.torques({**at, **moved})]

    return (
        agreement(
            "joint-forces",
            rated(problem) | set(forces),
            back,
            lambda at: [at[name] for name in forces],
        ),
    )
