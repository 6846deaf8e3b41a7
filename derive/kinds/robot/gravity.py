"""The potential energy of an arm and the torques that hold it still."""

from __future__ import annotations

from derive.derivation import Derivation, PageFacts, Phrase
from derive.expression import ZERO, Derivative, Symbol, add, column, symbols, transpose
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._chain import BODIES_ALONE, LINKS_ALONE, chain_of, oracle_of
from derive.kinds.robot._dynamics.at_rest import NEARLY, Rubbing, held_by_friction
from derive.kinds.robot._dynamics.bodies import Weighted, weighted
from derive.kinds.robot._dynamics.body_steps import (
    body_definitions,
    centers_told,
    com_step,
    pose_definitions,
)
from derive.kinds.robot._efforts import efforts
from derive.kinds.robot._units import of_energies, of_joints, together
from derive.kinds.robot.inertia_matrix import Facts as InertiaFacts
from derive.kinds.work import Work
from derive.mechanics.dynamics import gravity_of, potential_energy
from derive.mechanics.robot import Robot
from derive.names import require_free

NEEDS = ("bodies",)
CLAIMS = ("torques-at-rest", "names")
measures = together(of_joints("g", effort=True), of_energies("P"))


P, G_0 = symbols("P g_0")


class Facts(PageFacts):
    efforts: Phrase  # what holds the arm at rest
    rubbing: tuple[Phrase, ...]  # the joints that dry friction holds too
    centers: Phrase | None  # where the centers of mass are, if that is told here


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """P = - sum of m g^T o_c and g_k = dP/dq_k (Spong et al., eq. 6.33 and 6.40)."""
    require_free(problem.taken, "P", "g_0")
    bodies = weighted(problem, chain_of(problem))
    heavy = tuple(body for body in bodies if body.body.mass != ZERO)
    alone = _is_alone(problem) and bool(heavy)
    work = _from_centers(problem, heavy) if alone else Work(problem).resting_on(problem.ask("inertia-matrix"))
    work = work.given(G_0, column(gravity_of(robot)))
    for body in bodies:
        work = _energy(work, body)
    whole = potential_energy([body.motion for body in bodies], work.value_matrix(G_0))
    work = work.line(P, add(*(Symbol(f"P_{body.i}") for body in bodies)), value=whole, rule="sum").closed(P)
    slopes = {Symbol(f"g_{k}"): Derivative(P, Symbol(q)) for k, q in enumerate(robot.variables, 1)}
    for name, slope in slopes.items():
        work = work.line(name, slope, rule="gradient")
    g = column(map(work.final, slopes))
    work = work.agrees("torques-at-rest", problem.symbols | {"g"}, g, oracle_of(problem).torques_at_rest)
    results = {"P": work.final(P), "g": g}
    facts = Facts(
        efforts=efforts(robot),
        rubbing=held_by_friction(robot),
        centers=centers_told(heavy) if alone else None,
    )
    if any(link.friction for link in robot.links):
        told = Rubbing(oracle_of(problem), facts.rubbing)
        work = work.agrees(
            "dry-friction-told", problem.symbols | {"g"}, told.as_told, told.as_it_moves, NEARLY
        )
    return by_index(work, results).answer("gravity", results, facts, unread=LINKS_ALONE | BODIES_ALONE)


def _is_alone(problem: Problem) -> bool:
    """Whether nothing else is asked that needs the inertia matrix, and that would fill pages."""
    if any(kind != "gravity" for kind, _ in problem.questions):
        return False
    return problem.ask("inertia-matrix").told(InertiaFacts).big


def _from_centers(problem: Problem, bodies: tuple[Weighted, ...]) -> Work:
    """The board with the centers of mass (3 by 1 each, in the base)."""
    work = Work(problem).resting_on(problem.ask("forward-kinematics"))
    for body in bodies:
        work = work.knowing(pose_definitions(problem, chain_of(problem), body))
        work = work.knowing(body_definitions(problem, body))
    return work.step(*(com_step(problem, body) for body in bodies))


def _energy(work: Work, body: Weighted) -> Work:
    """P_i = -m g^T o_ci."""
    name, mass = Symbol(f"P_{body.i}"), body.body.mass
    if mass == ZERO:
        return work.line(name, ZERO, rule="potential-energy")
    formula = -(mass * transpose(G_0) * Symbol(f"o_c{body.i}"))
    value = potential_energy([body.motion], work.value_matrix(G_0))
    return work.line(name, formula, value=value, rule="potential-energy")
