"""The pose of the end-effector as a product of exponentials of screw axes, for any arm."""

from __future__ import annotations

from dataclasses import replace

from derive.derivation import Derivation, PageFacts
from derive.expression import Symbol
from derive.kinds.checks import is_rotation
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import LINKS_ALONE, chain_of, end_frame, oracle_of
from derive.kinds.robot._rows.exponentials import NAMED, Exponentials, ScrewsTold
from derive.kinds.work import Work
from derive.mechanics.poses import rotation_part
from derive.mechanics.robot import Robot
from derive.mechanics.screws import screw_form

ENDS = ("compose", "entry")  # what is left to say where the screws themselves are given

CLAIMS = ("orthogonal", "right-handed", "pose", "poses-in-numbers")


class Facts(PageFacts):
    screws: ScrewsTold | None  # where the arm is given by rows
    product: str  # a step


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """The joint axes at zero, their twists (6 by 1), the home pose and the product (4 by 4; Lynch and Park,
    section 4.1; Murray, Li and Sastry, section 3.2). Raises NotDerivable where no joint moves."""
    arm, oracle, n = screw_form(robot, problem.readable), oracle_of(problem), len(robot.links)
    screws = Exponentials(problem, arm, len(arm.links), True, False, Symbol(f"T_{end_frame(robot)}^0"))
    work = screws.lines(Work(problem, uses=(problem.ask("forward-kinematics"),)))
    results = {step.name: problem.final(step.result) for step in work.steps if step.rule in NAMED}
    results[f"T_{n}^0"] = work.final(screws.name)
    if robot.by_screws:
        work = replace(work, steps=tuple(step for step in work.steps if step.rule in ENDS))
    work = screws.proved(work).claim(*is_rotation(rotation_part(screws.pose), f"R_{n}^0"))
    work = work.law("pose", screws.pose == chain_of(problem).T_tool)
    work = work.agrees("poses-in-numbers", problem.symbols, screws.pose, oracle.tool)
    page_names = {f"T_{n}^0": screws.name.name}
    facts = Facts(
        screws=None if robot.by_screws else screws.told(),
        product=screws.name.name,
        page_names=page_names,
    )
    unread = frozenset() if robot.by_screws else LINKS_ALONE
    return work.answer("product-of-exponentials", results, facts, unread=unread)
