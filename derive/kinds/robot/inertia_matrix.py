"""The inertia matrix of an arm from the Jacobians of its centres of mass."""

from __future__ import annotations

from derive.algebra.normal import normal_matrix
from derive.algebra.readable.form import factored_matrix
from derive.algebra.readable.operation_count import operations
from derive.derivation import Derivation, PageFacts, Phrase
from derive.expression import ZERO, Expr, Matrix, Product, Symbol, add, children, free_symbols, transpose
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._chain import LINKS_ALONE, chain_of, oracle_of
from derive.kinds.robot._dynamics.bodies import Weighted, inertias, weighted
from derive.kinds.robot._dynamics.body_steps import (
    body_definitions,
    centers_told,
    com_jacobian_steps,
    com_step,
    inertia_steps,
    local_steps,
    pose_definitions,
)
from derive.kinds.robot._dynamics.drives import ROTORS, rotors, with_rotors
from derive.kinds.robot._dynamics.matrix_laws import quadratic_law
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.dynamics import inertia_matrix, link_inertia
from derive.mechanics.robot import Robot
from derive.names import entry_symbol, require_free

NEEDS = ("bodies",)
CLAIMS = ("symmetric", "unit-accelerations", "names")
MOST_IN_THE_BASE = (
    60  # operations of an entry of D; an arm with a longer one is worked in the frames of its links
)
MANY = {
    "changing-moment": "changing-moments",
    "moment-of-shape": "moments-of-shapes",
    "steady-moment": "steady-moments",
}
D = Symbol("D")


class Facts(PageFacts):
    """What is said of the moments of inertia, whether the arm is `big`, that a com moves in its link, and
    what the matrices of inertia are called."""

    I: Symbol
    centers: Phrase | None  # where they are given
    moments: Phrase
    one: bool  # inertia matrix
    only: int | None  # the link that alone adds to D, of several
    big: bool
    drifts: Phrase | None
    alone: tuple[Symbol, ...]  # the Jacobian of a single center of mass, and its two parts
    followed: bool  # a joint comes after a center of mass


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """D = sum of m J_v^T J_v + J_w^T R I R^T J_w (Spong et al., eq. 6.30); of a big arm with the Jacobians in
    the frames of the links, where they hold only the angles between joint and link and stay short.

    Raises NotDerivable where no link has a mass, or a joint is helical.
    """
    require_free(problem.symbols, "D")
    found = chain_of(problem)
    bodies = weighted(problem, found)
    value = with_rotors(inertia_matrix([body.motion for body in bodies]), robot)
    written = problem.readable_matrix(value)
    moments = {name: value for body in bodies for name, value in body.named.items()}
    big = max(map(operations, children(written))) > MOST_IN_THE_BASE
    work = Work(problem).resting_on(problem.ask("forward-kinematics" if big else "joint-axes"))
    heavy = tuple(body for body in bodies if body.turns or body.body.mass != ZERO) or bodies
    for body in bodies:
        work = work.knowing(body_definitions(problem, body))
    work = _local(work, bodies) if big else _base(work, found, heavy)
    work = _sum(work.showing(quadratic_law(inertias(bodies))), heavy, written, moments, big)
    # What rests on D takes it with the names of moments kept.
    work = work.knowing({entry_symbol("d", *ij): entry for ij, entry in _entries(written).items()})
    work = work.knowing({**moments, D: written})
    names = [f"J_{part}{body.i}" for body in bodies for part in "vw"]
    results = {"D": problem.final(written, moments), **{name: work.final(name) for name in names}}
    work = work.law("symmetric", value == value.T).agrees(
        "unit-accelerations",
        problem.symbols | {"g"},
        results["D"],
        oracle_of(problem).inertia_matrix,
    )
    work = by_index(work, results)
    changing = any(
        not free_symbols(each).isdisjoint(robot.variables) for body in bodies for each in body.moments
    )
    one = sum(body.turns for body in bodies) == 1
    key = "changing-moment" if changing else "moment-of-shape" if moments else "steady-moment"
    facts = Facts(
        I=inertias(bodies),
        centers=None if big else centers_told(heavy),
        moments=Phrase(key if one else MANY[key]),
        one=one,
        only=heavy[0].i if len(heavy) == 1 < len(robot.links) else None,
        big=big,
        drifts=Phrase("drifts") if any(body.at.drift for body in bodies) else None,
        alone=_jacobians(heavy[0].i) if len(heavy) == 1 and not big else (),
        followed=any(link.variable for link in robot.links[min(body.i for body in heavy) :]),
        numbers=("D",),
    )
    return work.answer("inertia-matrix", results, facts, matrices=frozenset(results), unread=LINKS_ALONE)


def _jacobians(i: int) -> tuple[Symbol, ...]:
    return tuple(Symbol(f"J_{part}{i}") for part in "cvw")


def _base(work: Work, found: Chain, bodies: tuple[Weighted, ...]) -> Work:
    """Coms, their Jacobians and inertias in the base frame."""
    for body in bodies:
        work = work.knowing(pose_definitions(work.problem, found, body))
    work = work.step(*(com_step(work.problem, body) for body in bodies))
    steps = (step for body in bodies for step in com_jacobian_steps(work.problem, found, body))
    once = {step.name: step for step in steps}  # motions of coupled joints
    return work.step(*once.values(), *inertia_steps(work.problem, bodies))


def _local(work: Work, bodies: tuple[Weighted, ...]) -> Work:
    """Jacobians of the coms and inertias in the frames of the links."""
    return work.step(*local_steps(work.problem, bodies), *inertia_steps(work.problem, bodies))


def _sum(
    work: Work, bodies: tuple[Weighted, ...], written: Matrix, moments: dict[Expr, Expr], big: bool
) -> Work:
    """What each link brings, and D; of a big arm sums in names, compared with D multiplied out."""
    problem, names = work.problem, list[Symbol]()
    for body in bodies:
        names.append(name := Symbol(f"D_{body.i}"))
        formula = _formula(body, big)
        own = formula if big else problem.readable_matrix(link_inertia(body.motion))
        spare = () if big else (own,)
        work = work.line(name, formula, value=own, rule="link-inertia", spare=spare)
    if matrix := rotors(problem.subject):
        work = work.line(ROTORS, value=matrix, rule="rotors")
        names.append(ROTORS)
    total = add(*names)
    if big:
        return work.line(D, total, value=total, rule="sum")
    final = problem.final(written, moments)
    if final == written:
        names_of = {(i - 1, j - 1): entry_symbol("d", min(i, j), max(i, j)) for i, j in _entries(written)}
        return work.line(D, total, value=written, rule="sum", entries=names_of)
    end = factored_matrix(normal_matrix(final), problem.style)
    return work.line(D, total, written, value=end, rule="sum", spare=(written,))


def _formula(body: Weighted, big: bool) -> Expr:
    """m J_v^T J_v + J_w^T R I R^T J_w in names, of a big arm in the frame of the link."""
    frame = f"{body.i}^{body.i}" if big else str(body.i)
    J_v, J_w, R = Symbol(f"J_v{frame}"), Symbol(f"J_w{frame}"), Symbol(f"R_{body.i}^0")
    turned = (body.I,) if big else (R, body.I, transpose(R))
    linear = body.body.mass * transpose(J_v) * J_v
    angular = Product((transpose(J_w), *turned, J_w))
    if not body.turns:
        return linear
    return angular if body.body.mass == ZERO else linear + angular


def _entries(D: Matrix) -> dict[tuple[int, int], Expr]:
    """Every entry of D, indices from 1."""
    return {(i, j): entry for i, row in enumerate(D.rows, 1) for j, entry in enumerate(row, 1)}
