"""The rates of a four-bar linkage or a slider-crank for a rate of its crank."""

from __future__ import annotations

from dataclasses import replace

from derive.algebra.normal import normal, normal_matrix
from derive.derivation import Derivation, PageFacts, Result, as_matrix
from derive.expression import Call, Expr, Symbol, negate
from derive.kinds.checks import route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.mechanism._loop import closed, loop_of, rate, units_of
from derive.kinds.mechanism._position_checks import places
from derive.kinds.mechanism._rate_checks import by_differences, jacobians
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.linkages import FourBar, SliderCrank

NEEDS = ("lengths",)
CLAIMS = ("jacobians", "by-differences")
CLAIMED = {"solutions": "by-differences"}
J_X, J_Q = Symbol("J_x"), Symbol("J_q")


class Facts(PageFacts):
    rates: tuple[Symbol, ...]  # of the crank, and of what it moves
    four: bool


def derive(linkage: FourBar | SliderCrank, options: Options, problem: Problem) -> Derivation:
    """The equations of the loop, differentiated: J_x xdot + J_q qdot = 0 (Norton, Design of Machinery,
    section 6.7; Gosselin and Angeles, Singularity analysis of closed-loop kinematic chains).

    Raises NotDerivable where bars of these lengths cannot be joined.
    """
    work, loop = loop_of(linkage, Work(problem, uses=(problem.ask("position"),)))
    driving, moved = rate(loop.angle), tuple(map(rate, loop.unknown))
    J_x, J_q = loop.jacobian(*loop.unknown), loop.jacobian(loop.angle)
    work = work.showing(*loop.steps()).line(J_X, value=J_x).line(J_Q, value=J_q)
    work = work.line(Call("det", (J_X,)), value=J_x.det(), label="det")
    in_names = problem.readable_matrix((J_x.inverse() @ J_q).scaled(-normal(driving)))
    lengths = dict(work.typed)
    value = normal_matrix(in_names, {name: lengths[name] for name in lengths})
    work = work.line(loop.rates, negate(J_X**-1 * J_Q * driving), in_names, value=value, label="rates")
    rates = [entry for (entry,) in as_matrix(work.steps[-1].result, "rates").rows]
    work = work.knowing(dict[Expr, Expr](zip(moved, rates, strict=True)))
    recipe = closed(linkage, problem)
    assemblies = [
        replace(
            each,
            formulas={**each.formulas, **dict(zip(moved, rates, strict=True))},
            unknown=(*each.unknown, *moved),
        )
        for each in recipe.assemblies
    ]
    results: dict[str, Result] = {
        name.name: problem.final(entry) for name, entry in zip(moved, rates, strict=True)
    }
    results["solutions"] = tuple(each.branch(problem, lengths) for each in assemblies)
    there = places(linkage, recipe)
    work = work.claim(route("jacobians", jacobians(linkage, work, loop, there)))
    work = work.claim(route("by-differences", by_differences(linkage, loop, rates, results, there, problem)))
    facts = Facts(
        rates=(driving, *moved), four=isinstance(linkage, FourBar),
        numbers=("solutions",), angle_results=("theta_3", "theta_4"),
    )  # fmt: skip
    return work.answer("velocity", results, facts, units=units_of(problem, recipe.s))


def measures(linkage: FourBar | SliderCrank) -> dict[str, str]:
    """Of what is sought."""
    turning = {"theta_3_dot": "rad/s", "theta_4_dot": "rad/s"}
    return turning | ({"s": "m", "s_dot": "m/s"} if isinstance(linkage, SliderCrank) else {})
