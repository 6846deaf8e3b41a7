"""The pose of the end-effector as a product of exponentials of screw axes, for any arm."""

from __future__ import annotations

from derive.algebra.numbers.floats import matrix_numbers
from derive.derivation import Claim, Derivation, PageFacts
from derive.expression import Expr, Symbol
from derive.kinds.checks import agreement, is_rotation, law, links
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, end_frame, oracle_of
from derive.kinds.robot._rows.exponentials import Exponentials, ScrewsTold
from derive.mechanics.poses import rotation_part
from derive.mechanics.robot import Robot
from derive.mechanics.screws import screw_form

RESULTS = {
    "S_1, S_2, ...": "the twist of each joint at zero (6, linear part first)",
    "M": "the pose of the end-effector at zero (4 by 4)",
    "E_1, E_2, ...": "the motion e^{[S_i] q_i} that each joint gives to all that follows (4 by 4)",
    "T_n^0": "the pose of the end-effector (4 by 4)",
}
EXAMPLE = """\
title: A planar arm by its screws
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  find: product-of-exponentials
"""
NAMED = ("exponential", "home", "twist")
ENDS = ("compose", "entry")  # what is left to say where the screws themselves are given


class Options(OptionsModel):
    """None."""


class Facts(PageFacts):
    screws: ScrewsTold
    rows: bool  # the arm is given by rows


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """The joint axes at zero, their twists, the home pose and the product (Lynch and Park, section 4.1;
    Murray, Li and Sastry, section 3.2). Raises NotDerivable where no joint moves."""
    arm = screw_form(robot, problem.readable)
    name = Symbol(f"T_{end_frame(robot)}^0")
    work = Exponentials(problem, arm, len(arm.links), True, frames=False, name=name)
    written, definitions = work.steps(), work.definitions()
    steps = tuple(step for step in written if step.rule in ENDS) if robot.by_screws else written
    results: dict[str, Expr] = {
        step.name: problem.final(step.result) for step in written if step.rule in NAMED
    }
    results[last := f"T_{len(robot.links)}^0"] = problem.final(definitions[work.name])
    claims = (
        *links(steps, {**problem.names, **definitions}),
        *work.claims(),
        *is_rotation(rotation_part(work.pose), f"R_{len(robot.links)}^0"),
        *_same_arm(problem, work),
    )
    uses = (problem.ask("forward-kinematics"),)
    facts = Facts(screws=work.told(), rows=not robot.by_screws, page_names={last: name.name})
    return Derivation("product-of-exponentials", steps, results, claims, definitions, uses=uses, facts=facts)


def _same_arm(problem: Problem, work: Exponentials) -> tuple[Claim, ...]:
    """The product is the pose that the rows of the arm give."""
    oracle = oracle_of(problem)
    return (
        law("pose", work.pose == chain_of(problem).T_tool),
        agreement(
            "poses-in-numbers",
            problem.symbols,
            lambda at: matrix_numbers(work.pose, oracle.at(at)),
            lambda at: oracle.tool(oracle.at(at)),
        ),
    )
