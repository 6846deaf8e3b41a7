"""The inertia matrix of an arm from the Jacobians of its centres of mass."""

from __future__ import annotations

from collections.abc import Mapping

from derive.algebra.normal import normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.algebra.readable.matrix_factor import factored_matrix
from derive.algebra.readable.operation_count import operations
from derive.derivation import Claim, Derivation, PageFacts, Step, named_results
from derive.expression import ZERO, Expr, Matrix, Product, Sum, Symbol, children, free_symbols, transpose
from derive.kinds.checks import agreement, law, links
from derive.kinds.fields import OptionsModel
from derive.kinds.naming import entry_symbol, fits
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.robot._dynamics.bodies import Weighted, weighted
from derive.kinds.robot._dynamics.body_steps import (
    body_definitions,
    com_jacobian_steps,
    com_steps,
    inertia_steps,
)
from derive.kinds.robot._dynamics.drives import rotor_steps, with_rotors
from derive.kinds.robot._dynamics.local_jacobians import local_definitions, local_parts, local_steps
from derive.mechanics.chain import Chain
from derive.mechanics.dynamics import inertia_matrix, link_inertia
from derive.mechanics.robot import Robot
from derive.names import require_free

RESULTS = {
    "D": "the inertia matrix (n by n)",
    "J_v1, J_w1, ...": "for each link, the linear and angular Jacobian of its com (3 by n)",
}
NEEDS = ("bodies",)
EXAMPLE = """\
title: The inertia matrix of a planar arm
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [-a1/2, 0, 0], inertia: {rod: a1, axis: x}}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [-a2/2, 0, 0], inertia: {rod: a2, axis: x}}
  find: inertia-matrix
"""


LONGEST_ENTRY = 60  # operations; an arm with a longer entry of D is worked in the frames of its links


class Options(OptionsModel):
    """None."""


class Facts(PageFacts):
    big: bool  # each link is worked in its own frame
    shapes: bool
    drifts: bool
    changing: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """D = sum of m J_v^T J_v + J_w^T R I R^T J_w (Spong et al., eq. 6.30)."""
    require_free(problem.symbols, "D")
    found = chain_of(problem)
    bodies = weighted(problem, found)
    D = with_rotors(inertia_matrix([body.motion for body in bodies]), robot)
    written = problem.readable_matrix(D)
    named = {name: value for body in bodies for name, value in body.named.items()}
    big = max(map(operations, children(written))) > LONGEST_ENTRY
    rests_on = problem.ask("forward-kinematics" if big else "joint-axes")
    working = _local if big else _base
    steps, definitions = working(problem, found, bodies, written, named)
    definitions = {**rests_on.definitions, **definitions, **_entries(written), **named, Symbol("D"): written}
    results = _results(problem, bodies, written, named)
    claims = (
        *links(steps, {**problem.names, **definitions}),
        law("symmetric", D == D.T),
        *_second_routes(problem, results),
    )
    drifts = any(body.at.drift for body in bodies)
    names = set(robot.variables)
    changing = any(not names.isdisjoint(free_symbols(each)) for body in bodies for each in body.moments)
    facts = Facts(big=big, shapes=bool(named), drifts=drifts, changing=changing, numbers=("D",))
    return Derivation(
        "inertia-matrix",
        steps,
        results,
        claims,
        definitions,
        uses=(rests_on,),
        facts=facts,
        matrices=frozenset(results),
    )


def _base(
    problem: Problem, found: Chain, bodies: tuple[Weighted, ...], written: Matrix, named: dict[Expr, Expr]
) -> tuple[tuple[Step, ...], dict[Expr, Expr]]:
    """By the Jacobians of the centres of mass in the base frame."""
    steps = (*_motion(problem, found, bodies), *_sum(problem, bodies, written, named))
    definitions: dict[Expr, Expr] = {}
    for body in bodies:
        definitions |= body_definitions(problem, found, body)
    return steps, definitions | named_results(steps)


def _local(
    problem: Problem, found: Chain, bodies: tuple[Weighted, ...], written: Matrix, named: dict[Expr, Expr]
) -> tuple[tuple[Step, ...], dict[Expr, Expr]]:
    """By those Jacobians in the frames of the links; D stays a sum over them."""
    parts = (*local_parts(bodies), *rotor_steps(problem.subject))
    total = Step("D", (Symbol("D"), Sum(tuple(Symbol(part.name) for part in parts))), "sum")
    steps = (*local_steps(problem, bodies), *inertia_steps(problem, bodies), *parts, total)
    # The step of D compares the sum over the links with D itself, multiplied out.
    return steps, named_results(steps) | local_definitions(problem, bodies)


def _motion(problem: Problem, found: Chain, bodies: tuple[Weighted, ...]) -> tuple[Step, ...]:
    """Frames, axes, coms, Jacobians and inertias; the same name once."""
    steps = [
        *(step for body in bodies for step in com_steps(problem, found, body)),
        *(step for body in bodies for step in com_jacobian_steps(problem, found, body)),
        *inertia_steps(problem, bodies),
    ]
    return tuple({step.name: step for step in steps}.values())


def _sum(
    problem: Problem, bodies: tuple[Weighted, ...], written: Matrix, named: dict[Expr, Expr]
) -> tuple[Step, ...]:
    """What each link brings, and D."""
    parts = []
    for body in bodies:
        name, own = Symbol(f"D_{body.i}"), problem.readable_matrix(link_inertia(body.motion))
        chain = (name, _formula(body), own) if fits(own) else (name, _formula(body))
        parts.append(Step(name.name, chain, "link-inertia"))
    parts += rotor_steps(problem.subject)
    total = Sum(tuple(Symbol(step.name) for step in parts)) if len(parts) > 1 else Symbol(parts[0].name)
    if not fits(written):
        entries = [Step(str(name.name), (name, value), "entry") for name, value in _upper(written).items()]
        return (*parts, Step("D", (Symbol("D"), total), "sum"), *entries)
    final = problem.final(written, named)
    closed = () if final == written else (factored_matrix(normal_matrix(final), problem.style),)
    return (*parts, Step("D", (Symbol("D"), total, written, *closed), "sum"))


def _formula(body: Weighted) -> Expr:
    """m J_v^T J_v + J_w^T R I R^T J_w in names."""
    i = body.i
    J_v, J_w, R = Symbol(f"J_v{i}"), Symbol(f"J_w{i}"), Symbol(f"R_{i}^0")
    linear = Product((body.body.mass, transpose(J_v), J_v))
    angular = Product((transpose(J_w), R, body.I, transpose(R), J_w))
    if not body.turns:
        return linear
    return angular if body.body.mass == ZERO else Sum((linear, angular))


def _entries(D: Matrix) -> dict[Expr, Expr]:
    """d_11, d_12, ...: every entry by its name."""
    return {
        entry_symbol("d", i, j): entry for i, row in enumerate(D.rows, 1) for j, entry in enumerate(row, 1)
    }


def _upper(D: Matrix) -> dict[Symbol, Expr]:
    """d_ij with i <= j; the others by symmetry."""
    return {
        entry_symbol("d", i + 1, j + 1): D.rows[i][j]
        for i in range(len(D.rows))
        for j in range(i, len(D.rows))
    }


def _results(
    problem: Problem, bodies: tuple[Weighted, ...], written: Matrix, named: dict[Expr, Expr]
) -> dict[str, Expr]:
    results: dict[str, Expr] = {"D": problem.final(written, named)}
    for body in bodies:
        results[f"J_v{body.i}"] = problem.final(problem.readable_matrix(body.motion.J_v))
        results[f"J_w{body.i}"] = problem.final(problem.readable_matrix(body.motion.J_w))
    return results


def _second_routes(problem: Problem, results: Mapping[str, Expr]) -> tuple[Claim, ...]:
    """D against the torques of unit accelerations by Newton and Euler."""
    oracle, names = oracle_of(problem), problem.subject.variables
    D = problem.normal_matrix(results["D"])

    def columns(at: Mapping[str, float]) -> list[list[float]]:
        still = {f"{name}_dot": 0.0 for name in names} | {f"{name}_ddot": 0.0 for name in names}
        rest = oracle.torques({**at, **still})
        return [list(oracle.torques({**at, **still, f"{name}_ddot": 1.0}) - rest) for name in names]

    return (
        agreement(
            "unit-accelerations",
            problem.symbols | {"g"},
            lambda at: numeric.matrix_numbers(D, oracle.at(at)),
            columns,
        ),
    )
