"""The equations of motion of an arm after Euler and Lagrange."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from derive.algebra.numbers import floats as numeric
from derive.algebra.numbers.compiled import compiled
from derive.algebra.readable.operation_count import operations
from derive.derivation import Claim, Derivation, PageFacts, Step
from derive.expression import Expr, Matrix, Symbol, add, column
from derive.kinds.checks import agreement, links
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot import inertia_matrix
from derive.kinds.robot._chain import moment_names, oracle_of
from derive.kinds.robot._dynamics.drives import friction_column, friction_sorts
from derive.kinds.robot._dynamics.terms import Term, terms_of
from derive.mechanics.robot import Robot

RESULTS = {
    "D": "the inertia matrix",
    "c_111, c_121, ...": "the Christoffel symbols",
    "P": "potential energy",
    "g": "its partial derivatives (n)",
    "tau": "the joint forces (n), with rates theta1_dot and accelerations theta1_ddot",
    "M, C, B, v, G": "with `notation: khatib`, in place of those above: M qddot + v + G = tau",
}
NEEDS = ("bodies",)
EXAMPLE = """\
title: Equations of motion
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: [-a1/2, 0, 0], inertia: {rod: a1, axis: x}}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [-a2/2, 0, 0], inertia: {rod: a2, axis: x}}
  find: dynamics
"""
LONGEST = 45  # operations; a longer equation stays in the names of its terms


class Options(OptionsModel):
    """`notation`: spong (D, c_ijk, g by Euler and Lagrange) or khatib (M, v, G)."""

    notation: Literal["spong", "khatib"] = "spong"


class Facts(PageFacts):
    big: bool
    notation: str
    friction: bool = False  # in the notation of Khatib
    viscous: bool = False
    coulomb: bool = False


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """tau_k = sum d_kj qddot_j + sum c_ijk qdot_i qdot_j + g_k (Spong et al., eq. 6.39)."""
    if options.notation == "khatib":
        from derive.kinds.robot._dynamics.khatib_dynamics import khatib_dynamics  # seldom asked for

        return khatib_dynamics(problem)
    inertia, speed, weight = (problem.ask(kind) for kind in ("inertia-matrix", "christoffel", "gravity"))
    names: dict[Expr, Expr] = {**inertia.definitions, **speed.definitions, **weight.definitions}
    terms = terms_of(problem, inertia, speed, weight)
    big = inertia.told(inertia_matrix.Facts).big
    viscous, coulomb = friction_sorts(robot)
    steps = () if big else tuple(_equation(k, each) for k, each in enumerate(terms, 1))
    tau = column(add(*[term.written for term in each]) for each in terms)
    rigid = column(add(*[term.written for term in each if term.sort != "friction"]) for each in terms)
    results = {"D": inertia.results["D"], **speed.results, **weight.results, "tau": tau}
    known = {**problem.names, **names, **moment_names(inertia)}
    claims = (*links(steps, known), _second_route(problem, rigid))
    return Derivation(
        "dynamics",
        steps,
        results,
        claims,
        names,
        uses=(inertia, speed, weight),
        facts=Facts(big=big, notation="spong", viscous=viscous, coulomb=coulomb),
        matrices=frozenset({"D"}),
    )


def _equation(k: int, terms: tuple[Term, ...]) -> Step:
    """In the names of its terms, and written out where that is short."""
    name, named = Symbol(f"tau_{k}"), add(*[term.named for term in terms])
    written = add(*[term.written for term in terms])
    chain = (name, named, written) if operations(written) <= LONGEST and written != named else (name, named)
    return Step(name.name, chain, "euler-lagrange")


def _second_route(problem: Problem, rigid: Matrix) -> Claim:
    """Newton's and Euler's laws for each body, against tau without friction and with it."""
    oracle, names = oracle_of(problem), problem.subject.variables
    rates = {f"{name}{dots}" for name in names for dots in ("_dot", "_ddot")}
    torques, rubbing = [compiled(entry) for (entry,) in rigid.rows], friction_column(problem.subject)

    def ours(at: Mapping[str, float]) -> list[float]:
        whole = oracle.at(at)
        found = [torque(whole) for torque in torques]
        friction = numeric.numbers(rubbing, whole) if rubbing else [0.0] * len(found)
        return [a + b for a, b in zip(found, friction, strict=True)]

    return agreement(
        "motion-of-each-body",
        problem.symbols | rates | {"g"},
        ours,
        lambda at: oracle.torques(at),
    )
