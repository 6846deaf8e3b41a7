"""The kinetic and the potential energy of an arm, link by link."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from derive.algebra.normal import normal, normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, PageFacts, Result, Step, Table, named_results
from derive.expression import (
    ZERO,
    Expr,
    Matrix,
    Product,
    Sum,
    Symbol,
    add,
    column,
    multiply,
    number,
    transpose,
)
from derive.kinds.checks import agreement, law, links
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import TREES, Problem
from derive.kinds.robot._chain import chain_of, moment_names
from derive.kinds.robot._dynamics.bodies import Weighted, weighted
from derive.kinds.robot._dynamics.drives import ROTORS, rotors
from derive.kinds.robot._dynamics.rates import is_long, oracle, rate_column, rated, rates
from derive.mechanics.dynamics import link_inertia
from derive.mechanics.robot import Robot

RESULTS = {
    "K_1, K_2, ..., K_m": "the kinetic energy of each link, and of the rotors where there are motors",
    "P_1, P_2, ...": "the potential energy of each link",
    "K": "the kinetic energy of the arm; rates are written theta1_dot",
    "P": "its potential energy",
}
NEEDS = ("bodies",)
EXAMPLE = """\
title: The energies of a planar arm
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [-a1/2, 0, 0], inertia: {rod: a1, axis: x}}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [-a2/2, 0, 0], inertia: {rod: a2, axis: x}}
  find: energy
"""
HALF = number("1/2")
RATE = Symbol("q_dot")
LONGEST_CELL = 24  # operations of an energy that still fits into a table


class Options(OptionsModel):
    """None."""


class Facts(PageFacts):
    big: bool
    table: Table | None


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """K_i = (m v_c^T v_c + w^T R I R^T w) / 2 and P_i = -m g^T o_c (Spong et al., eq. 6.26 and 6.33)."""
    inertia, weight = problem.ask("inertia-matrix"), problem.ask("gravity")
    big, bodies = is_long(problem), weighted(problem, chain_of(problem))
    named = moment_names(inertia)
    velocities = () if big else tuple(step for body in bodies for step in _velocities(problem, body))
    links_of = tuple(_link(problem, body, named, big) for body in bodies)
    parts = (*links_of, *_of_rotors(robot))
    K = _total(problem, parts, named, big)
    steps = (*velocities, *parts, K)
    definitions: dict[Expr, Expr] = {
        **inertia.definitions,
        **weight.definitions,
        **named_results(steps),
        RATE: column(rates(robot.variables)),
    }
    results = _results(problem, parts, K, weight)
    claims = (
        *links(() if big else steps, {**problem.names, **definitions, **named}),
        _quadratic(problem, inertia, K, named),
        _balance(problem, results),
    )
    return Derivation(
        "energy",
        tuple(Step(step.name, step.chain[:-1], step.rule) for step in steps) if big else steps,
        results,
        claims,
        definitions,
        uses=(inertia, weight),
        facts=Facts(big=big, table=_table(results)),
    )


def _velocities(problem: Problem, body: Weighted) -> tuple[Step, ...]:
    """v_c1 and omega_1 of a link in the base frame; the latter where its rotation stores energy."""
    rate = rate_column(problem.subject.variables)
    found = [("v_c", "J_v", body.motion.J_v)] + ([("omega_", "J_w", body.motion.J_w)] if body.turns else [])
    return tuple(
        Step(
            f"{name}{body.i}",
            (
                Symbol(f"{name}{body.i}"),
                Product((Symbol(f"{J}{body.i}"), RATE)),
                problem.readable_matrix(value @ rate),
            ),
            "velocity",
        )
        for name, J, value in found
    )


def _link(problem: Problem, body: Weighted, named: Mapping[Expr, Expr], big: bool) -> Step:
    """K_i in the velocities of the link, and written out."""
    name, i = Symbol(f"K_{body.i}"), body.i
    D = link_inertia(body.motion)
    if big:
        form = Product((HALF, transpose(RATE), Symbol(f"D_{i}"), RATE))
        value = quadratic(problem.readable_matrix(D), problem.subject.variables)
        return Step(
            name.name, (name, form, problem.final(value, named) if named else value), "kinetic-energy"
        )
    rate = rate_column(problem.subject.variables)
    K = (rate.T @ D @ rate)[0, 0] * Fraction(1, 2)
    return Step(name.name, (name, _formula(body), *_written(problem, K, named)), "kinetic-energy")


def _formula(body: Weighted) -> Expr:
    v, omega, R = Symbol(f"v_c{body.i}"), Symbol(f"omega_{body.i}"), Symbol(f"R_{body.i}^0")
    linear = multiply(HALF, body.body.mass, transpose(v), v)
    angular = Product((HALF, transpose(omega), R, body.I, transpose(R), omega))
    return add(linear, angular) if body.turns else linear


def _written(problem: Problem, value: Scalar, named: Mapping[Expr, Expr]) -> tuple[Expr, ...]:
    """Readable, and with the names of shapes' moments and of `where` replaced."""
    written = problem.readable(value)
    final = problem.final(written, named)
    return (written,) if final == written else (written, final)


def quadratic(D: Matrix, variables: tuple[str, ...]) -> Expr:
    """qdot^T D qdot / 2 as a sum over the entries of D."""
    rate, n = rates(variables), range(len(variables))
    squares = [multiply(HALF, D.rows[i][i], rate[i], rate[i]) for i in n]
    mixed = [multiply(D.rows[i][j], rate[i], rate[j]) for i in n for j in n if i < j]
    return add(*squares, *mixed)


def _of_rotors(robot: Robot) -> tuple[Step, ...]:
    """K_m, the spin of the rotors."""
    matrix = rotors(robot)
    if matrix is None:
        return ()
    form = Product((HALF, transpose(RATE), ROTORS, RATE))
    value = quadratic(matrix, robot.variables)
    return (Step("K_m", (Symbol("K_m"), form, value), "rotors"),)


def _total(problem: Problem, parts: tuple[Step, ...], named: Mapping[Expr, Expr], big: bool) -> Step:
    names = add(*(Symbol(step.name) for step in parts))
    if big:
        value = add(*(part for step in parts for part in _terms(step.result)))
    else:
        value = problem.readable(sum((normal(step.result) for step in parts), Scalar.of(0)))
    return Step("K", (Symbol("K"), names, problem.final(value, named)), "sum")


def _terms(expr: Expr) -> tuple[Expr, ...]:
    return expr.terms if isinstance(expr, Sum) else (expr,)


def _results(problem: Problem, parts: tuple[Step, ...], K: Step, weight: Derivation) -> dict[str, Result]:
    kinetic = {step.name: problem.final(step.result) for step in parts}
    potential = {
        step.name: problem.final(step.result) for step in weight.steps if step.rule == "potential-energy"
    }
    return {**kinetic, **potential, "K": K.result, "P": weight.results["P"]}


def _table(results: Mapping[str, Result]) -> Table | None:
    """Link, kinetic and potential energy; None where an entry is too long for a table."""
    numbers = [name[2:] for name in results if name.startswith("K_")]
    rows = [
        (label if label != "m" else "rotors", results[f"K_{label}"], results.get(f"P_{label}", ZERO))
        for label in numbers
    ]
    found = [(label, *(cell for cell in cells if isinstance(cell, TREES))) for label, *cells in rows]
    cells = [cell for _, *row in found for cell in row]
    if any(isinstance(cell, str) or operations(cell) > LONGEST_CELL for cell in cells):
        return None
    return Table(("link", "kinetic energy", "potential energy"), tuple(found))


def _quadratic(problem: Problem, inertia: Derivation, K: Step, named: Mapping[Expr, Expr]) -> Claim:
    """K is the quadratic form of D."""
    known: dict[Expr, Expr] = {**problem.names, **named}
    D, rate = normal_matrix(inertia.definitions[Symbol("D")], known), rate_column(problem.subject.variables)
    form = (rate.T @ D @ rate)[0, 0] * Fraction(1, 2)
    return law("quadratic-form", form == normal(K.result))


def _balance(problem: Problem, results: Mapping[str, Result]) -> Claim:
    """The rate of K + P is the power of the joint forces, which Newton and Euler give."""
    energy = normal(_tree(results["K"])) + normal(_tree(results["P"]))
    names, arm = problem.subject.variables, oracle(problem)
    along = [(energy.diff(name), f"{name}_dot") for name in names]
    along += [(energy.diff(f"{name}_dot"), f"{name}_ddot") for name in names]

    def rate(at: Mapping[str, float]) -> float:
        whole = arm.at(at)
        return float(sum(numeric.scalar_number(part, whole) * at[name] for part, name in along))

    def power(at: Mapping[str, float]) -> float:
        torques = zip(arm.torques(at), names, strict=True)
        return float(sum(tau * at[f"{name}_dot"] for tau, name in torques))

    return agreement("power", rated(problem), rate, power)


def _tree(result: Result) -> Expr:
    """A result that is a scalar expression. Raises TypeError for any other."""
    if not isinstance(result, TREES):
        raise TypeError("an energy is a scalar")
    tree: Expr = result
    return tree
