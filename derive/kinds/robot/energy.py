"""The kinetic and the potential energy of an arm, link by link."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.derivation import Derivation, PageFacts
from derive.expression import (
    Expr,
    Matrix,
    Number,
    Sum,
    Symbol,
    add,
    column,
    factors_of,
    free_symbols,
    multiply,
    number,
    symbols,
    terms_of,
    transpose,
)
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import EVERY, by_index
from derive.kinds.robot._chain import BODIES_ALONE, chain_of
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.bodies import Weighted, inertias, weighted
from derive.kinds.robot._dynamics.drives import ROTORS, rotors
from derive.kinds.robot._dynamics.matrix_laws import energy_law
from derive.kinds.robot._units import of_energies, of_variables, together
from derive.kinds.work import Work
from derive.mechanics.dynamics import kinetic_energy, link_inertia, rate_column, time_derivative
from derive.mechanics.robot import Robot
from derive.names import require_free

NEEDS = ("bodies",)
CLAIMS = ("quadratic-form", "names", "power")
measures = together(of_variables, of_energies("K", "P"))


HALF = number("1/2")
K, P, RATE = symbols("K P q_dot")


MEANINGS = {**EVERY, r"omega_(\d+)": lambda arm, i, _: arm.courses[i].omega}


class Facts(PageFacts):
    big: bool
    potential: tuple[tuple[Expr, Expr], ...]  # of each link, found with its gravity


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """K_i = (m v_c^T v_c + w^T R I R^T w) / 2 and P_i = -m g^T o_c (Spong et al., eq. 6.26 and 6.33)."""
    require_free(problem.taken, "K", "q_dot")
    arm = Arm(problem)
    bodies = weighted(problem, chain_of(problem))
    work = Work(problem).resting_on(arm.inertia, problem.ask("gravity")).knowing({RATE: column(arm.rates)})
    work = work.showing(energy_law(inertias(bodies)))
    work = work.linked() if arm.long else _velocities(work, bodies)  # in names there is nothing to compare
    for body in bodies:
        work = _link(work, arm, body)
    if matrix := rotors(robot):
        work = _form(work, arm, "m", ROTORS, matrix, "rotors")
    sorts = ("kinetic-energy", "rotors")
    names = [step.name for step in work.steps if step.rule in sorts]
    whole = add(*map(Symbol, names))
    value = add(*(part for name in names for part in terms_of(work[name])))
    if arm.long:
        work = work.line(K, whole, value=whole, rule="sum").knowing({K: arm.final(value)})
    else:
        work = work.line(K, whole, value=value, rule="sum").closed(K)
    kinetic = normal(work[K])
    D = normal_matrix(work["D"], {**problem.names, **arm.moments})
    work = work.law("quadratic-form", kinetic == kinetic_energy(D, rate_column(arm.variables)))
    energy = ScalarMatrix(((kinetic + normal(work.final(P)),),))
    work = work.agrees(
        "power",
        arm.moving,
        time_derivative(energy, arm.variables),
        lambda at: arm.rigid.torques(at) @ [at[rate.name] for rate in arm.rates],
    )
    parts = [*names, *(f"P_{body.i}" for body in bodies), "K", "P"]
    results = {name: work.final(name) for name in parts}
    weights = tuple((Symbol(name), value) for name, value in results.items() if name.startswith("P_"))
    work = by_index(work, results, MEANINGS)
    facts = Facts(big=arm.long, potential=() if arm.long else weights)
    return work.answer("energy", results, facts, unread=BODIES_ALONE)


def _velocities(work: Work, bodies: tuple[Weighted, ...]) -> Work:
    """v_c1 and omega_1 of each link in the base frame; the latter where its rotation stores energy."""
    for body in bodies:
        work = work.line(f"v_c{body.i}", Symbol(f"J_v{body.i}") * RATE, rule="velocity")
        if body.turns:
            work = work.line(f"omega_{body.i}", Symbol(f"J_w{body.i}") * RATE, rule="velocity")
    return work


def _link(work: Work, arm: Arm, body: Weighted) -> Work:
    """K_i in the velocities of the link, and written out; of a long arm by its part of D."""
    D = link_inertia(body.motion)
    if arm.long:
        return _form(work, arm, str(body.i), Symbol(f"D_{body.i}"), work.problem.readable_matrix(D))
    v, omega, R = Symbol(f"v_c{body.i}"), Symbol(f"omega_{body.i}"), Symbol(f"R_{body.i}^0")
    linear = multiply(HALF, body.body.mass, transpose(v), v)
    angular = HALF * transpose(omega) * R * body.I * transpose(R) * omega
    formula = linear + angular if body.turns else linear
    written = _halves(work, work.readable(kinetic_energy(D, rate_column(arm.variables))), arm)
    return work.line(f"K_{body.i}", formula, written, value=arm.final(written), rule="kinetic-energy")


def _halves(work: Work, energy: Expr, arm: Arm) -> Expr:
    """With 1/2 (m l^2/4 + I) in place of 1/8 (m l^2 + 4 I) before the rates."""
    return add(*(_half(work, term, {rate.name for rate in arm.rates}) for term in terms_of(energy)))


def _half(work: Work, term: Expr, rates: set[str]) -> Expr:
    number, *others = factors_of(term)
    sums = [each for each in others if isinstance(each, Sum) and not rates & free_symbols(each)]
    if not isinstance(number, Number) or len(sums) != 1 or number == HALF:
        return term
    others.remove(sums[0])
    return multiply(HALF, work.readable(normal(multiply(number, sums[0])) * 2), *others)


def _form(work: Work, arm: Arm, index: str, name: Symbol, D: Matrix, rule: str = "kinetic-energy") -> Work:
    """K_m = qdot^T D_m qdot / 2, as a sum over the entries of the matrix."""
    formula = HALF * transpose(RATE) * name * RATE
    rates = [*enumerate(arm.rates)]
    value = add(
        *(multiply(HALF, D.rows[i][i], rate, rate) for i, rate in rates),
        *(multiply(D.rows[i][j], p, q) for i, p in rates for j, q in rates if i < j),
    )
    K_i = Symbol(f"K_{index}")
    work = work.line(K_i, formula, value=formula if arm.long else value, rule=rule)
    return work.knowing({K_i: arm.final(value)})
