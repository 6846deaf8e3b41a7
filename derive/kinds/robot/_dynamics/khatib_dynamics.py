"""The equations of motion in Khatib's notation: M qddot + v + G = tau."""

from __future__ import annotations

from collections.abc import Iterable

from derive.algebra.normal import normal_matrix
from derive.derivation import Derivation
from derive.expression import ZERO, Expr, Sum, Symbol, add, column, symbols, transpose
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._chain import chain_of
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.bodies import Weighted, weighted
from derive.kinds.robot._dynamics.drives import Facts, friction_terms
from derive.kinds.robot._dynamics.terms import equations, written_out
from derive.kinds.robot.coriolis_matrices import MEANINGS
from derive.kinds.work import Work
from derive.mechanics.dynamics import gravity_of
from derive.names import require_free

M, V, G, F, ACCELERATION, TAU, G_0 = symbols("M v G F q_ddot tau g_0")


def khatib_dynamics(problem: Problem) -> Derivation:
    """tau = M qddot + v + G, with G from the Jacobians of the centers of mass."""
    require_free(problem.taken, "M", "G", "F", "q_ddot")
    arm, speed, robot = Arm(problem), problem.ask("coriolis-matrices"), problem.subject
    g, friction = problem.ask("gravity").matrix("g"), friction_terms(robot)
    work = Work(problem).resting_on(arm.inertia, speed)
    work = work.knowing({M: arm.inertia.matrix("D"), ACCELERATION: column(arm.accelerations)})
    rubs = any(friction)
    if rubs:
        work = work.knowing({F: column(add(*terms) for terms in friction)})
    tau = column(written_out(terms, problem.style) for terms in equations(problem))
    work = work.linked() if arm.long else work  # lines in names: nothing to compare
    bodies = weighted(problem, chain_of(problem))
    heavy = [body for body in bodies if body.body.mass != ZERO]
    work = work.line(G_0, value=column(gravity_of(robot)), rule="given")
    weights = _weights(heavy) if heavy else ZERO
    work = work.line(G, weights, value=weights if arm.long else g, rule="weights").knowing({G: g})
    whole = M * ACCELERATION + V + G + (F if rubs else 0)
    work = work.line(TAU, whole, value=whole, rule="equations").knowing({TAU: tau})
    for k, (entry,) in enumerate(tau.rows, 1):
        work = work.line(f"tau_{k}", value=entry, rule="equation", spare=(entry,))
    made = normal_matrix(_weights(bodies), {**problem.names, **work.definitions})
    work = work.law("gradient", made == normal_matrix(g))
    work = arm.moved(work, tau)
    parts = {name: value for name, value in speed.results.items() if name in ("C", "B", "v")}
    results = {"M": work[M], **parts, "G": g, "tau": tau}
    return by_index(work, results, MEANINGS).answer(
        "dynamics",
        results,
        Facts(big=arm.long, friction=rubs, notation="khatib"),
        matrices=frozenset({"M", "C", "B"}),
    )


def _weights(bodies: Iterable[Weighted]) -> Expr:
    """G = -(J_v1^T m_1 g_0 + J_v2^T m_2 g_0 + ...)."""
    terms = (transpose(Symbol(f"J_v{each.i}")) * (each.body.mass * G_0) for each in bodies)
    return -Sum(tuple(terms))
