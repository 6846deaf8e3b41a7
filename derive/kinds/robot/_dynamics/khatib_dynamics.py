"""The equations of motion in Khatib's notation: M qddot + v + G = tau."""

from __future__ import annotations

from collections.abc import Mapping

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.algebra.readable.operation_count import operations
from derive.derivation import Claim, Derivation, Step, named_results
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
    negate,
    terms_of,
    transpose,
)
from derive.kinds.checks import agreement, law, links
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, matrix_of, moment_names
from derive.kinds.robot._dynamics.bodies import weighted
from derive.kinds.robot._dynamics.drives import friction_column
from derive.kinds.robot._dynamics.rates import is_long, oracle, rated, rises
from derive.kinds.robot.dynamics import Facts
from derive.mechanics.robot import gravity_of
from derive.names import require_free

LONGEST = 45  # operations; a longer equation stays in the names of its terms
MASS, WEIGHT, FRICTION, ACCELERATION = Symbol("M"), Symbol("G"), Symbol("F"), Symbol("q_ddot")


def khatib_dynamics(problem: Problem) -> Derivation:
    """tau = M qddot + v + G, with G from the Jacobians of the centers of mass."""
    require_free(problem.symbols, "M", "G", "F", "q_ddot")
    inertia, speed = problem.ask("inertia-matrix"), problem.ask("coriolis-matrices")
    weight = problem.ask("gravity")
    M, v, g = matrix_of(inertia, "D"), matrix_of(speed, "v"), matrix_of(weight, "g")
    friction = friction_column(problem.subject)
    rigid = _rigid(M, v, g, rises(problem.subject.variables))
    tau = rigid if friction is None else _sum(rigid, friction)
    big = is_long(problem)
    steps = (*_weights(problem, g, big), *_torques(tau, friction))
    definitions: dict[Expr, Expr] = {**inertia.definitions, **speed.definitions, **named_results(steps)}
    definitions |= {MASS: M, WEIGHT: g, Symbol("v"): v, Symbol("tau"): tau}
    definitions[ACCELERATION] = column(rises(problem.subject.variables))
    if friction:
        definitions[FRICTION] = friction
    claims = (
        *links(() if big else steps, {**problem.names, **definitions, **moment_names(inertia)}),
        *_laws(problem, g),
        _second_route(problem, rigid),
    )
    parts = {name: value for name, value in speed.results.items() if name in ("C", "B", "v")}
    return Derivation(
        "dynamics",
        steps,
        {"M": M, **parts, "G": g, "tau": tau},
        claims,
        definitions,
        uses=(inertia, speed),
        facts=Facts(big=big, notation="khatib", friction=friction is not None),
        matrices=frozenset({"M", "C", "B"}),
    )


def _weights(problem: Problem, g: Matrix, big: bool) -> tuple[Step, ...]:
    """G = -(J_v1^T m_1 g_0 + J_v2^T m_2 g_0 + ...)."""
    name = Symbol("g_0")
    given = Step("g_0", (name, column(gravity_of(problem.subject))), "given")
    heavy = [body for body in weighted(problem, chain_of(problem)) if body.body.mass != ZERO]
    terms = [Product((transpose(Symbol(f"J_v{body.i}")), Product((body.body.mass, name)))) for body in heavy]
    chain = (WEIGHT, negate(Sum(tuple(terms))) if terms else ZERO)
    return given, Step("G", chain if big else (*chain, g), "weights")


def _rigid(M: Matrix, v: Matrix, g: Matrix, accelerations: list[Expr]) -> Matrix:
    """The right-hand side without friction (n by 1)."""
    return Matrix(
        tuple(
            (add(*map(multiply, row, accelerations), *terms_of(v.rows[k][0]), *terms_of(g.rows[k][0])),)
            for k, row in enumerate(M.rows)
        )
    )


def _sum(left: Matrix, right: Matrix) -> Matrix:
    pairs = zip(left.rows, right.rows, strict=True)
    return Matrix(tuple((add(*terms_of(a), *terms_of(b)),) for (a,), (b,) in pairs))


def _torques(tau: Matrix, friction: Matrix | None) -> tuple[Step, ...]:
    """tau in names, and tau_1, ... written out where they are short."""
    parts: list[Expr] = [Product((MASS, ACCELERATION)), Symbol("v"), WEIGHT]
    whole = Sum(tuple(parts if friction is None else [*parts, FRICTION]))
    equations = [
        Step(f"tau_{k}", (Symbol(f"tau_{k}"), entry), "equation")
        for k, (entry,) in enumerate(tau.rows, 1)
        if operations(entry) <= LONGEST
    ]
    return Step("tau", (Symbol("tau"), whole), "equations"), *equations


def _laws(problem: Problem, g: Matrix) -> tuple[Claim, ...]:
    """G from the Jacobians, though the potential energy gave its readable form."""
    gravity = normal_matrix(column(gravity_of(problem.subject)))
    total = ScalarMatrix.zeros(len(g.rows), 1)
    for body in weighted(problem, chain_of(problem)):
        total = total - (body.motion.J_v.T @ gravity).scaled(body.motion.mass)
    made = problem.final(problem.readable_matrix(total))
    same = normal_matrix(made) == normal_matrix(g)
    return (law("gradient", same),)


def _second_route(problem: Problem, rigid: Matrix) -> Claim:
    torques, arm = normal_matrix(rigid), oracle(problem)

    def ours(at: Mapping[str, float]) -> list[list[float]]:
        return numeric.matrix_numbers(torques, arm.at(at))

    return agreement("motion-of-each-body", rated(problem), ours, arm.torques)
