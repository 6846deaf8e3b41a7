"""The joint variables that bring the end-effector to a given place, in closed form."""

from __future__ import annotations

from functools import partial
from typing import Any

from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.kinds.evaluation import Evaluation
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot import _inverse_planar
from derive.kinds.robot._by_rows import by_rows
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.robot._inverse_branches import Solutions
from derive.kinds.robot._inverse_checks import tried
from derive.kinds.robot._inverse_evaluated import evaluated
from derive.kinds.robot._inverse_given import Given, goal_of
from derive.kinds.robot._inverse_opening import Opening
from derive.kinds.robot._inverse_page import Page
from derive.kinds.robot._inverse_reasons import loose, no_closed_form, refuse
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.plan import Clock, Search
from derive.mechanics.inverse.sample import configurations
from derive.mechanics.robot import Robot
from derive.mechanics.two_link import two_link

RESULTS = {
    "solutions": "every branch: a value for each joint variable, and when; a value that would fill pages "
    "is in terms of joint variables found before it",
    "order": "then only: the joint variables in the order in which to evaluate them",
}
EXAMPLE = """\
title: Inverse kinematics
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  find: inverse-kinematics
  given: [x, y]
"""
POINTS = 5


class Options(OptionsModel):
    """`given`: `pose` (r11 ... r33, x, y, z), `orientation`, or names for the known coordinates of the
    end-effector: two or three of its position, or two and its angle in the plane."""

    given: Given = ("x", "y")
    evaluate: Evaluation = None


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """By named sub-problems, each chosen by the form of the equations (Paul; Craig, chapter 4; Siciliano et
    al., section 2.12)."""
    chain = chain_of(problem)
    arm = two_link(chain)
    if arm is not None and isinstance(options.given, tuple) and len(options.given) == 2:
        return _inverse_planar.derive(arm, options.given, options.evaluate, problem)
    goal = goal_of(options.given, chain, problem)
    refuse(chain, goal)
    points = sample_points(chain, goal, problem, POINTS)
    loose(chain, goal, problem, points)
    free = partial(free_name, problem=problem, goal=goal)
    plan = Search(chain, goal, points[:2], free, Clock()).plan()
    if not plan.complete and robot.by_screws:
        return by_rows("inverse-kinematics", options, problem)
    if not plan.complete:
        raise NotDerivable(no_closed_form(plan, goal, problem))
    page = Page(problem, chain, goal, plan, Opening(problem, chain, goal, plan, free).written())
    slides = frozenset(plan.knowledge.slides)
    solutions = Solutions(page.items, chain.variables, slides, problem, page.singular)
    results: dict[str, Any] = {"solutions": solutions.branches}
    if solutions.nested:
        results["order"] = ", ".join(solutions.order)
    trial = tried(solutions, goal, problem, points)
    values = evaluated(solutions, goal, problem, options.evaluate)
    return Derivation(
        "inverse-kinematics",
        page.steps,
        results,
        (*page.claims(), *trial.claims(points[0])),
        page.definitions,
        values.values,
        uses=(problem.ask("forward-kinematics"),),
        facts={**page.facts(solutions), **values.facts, "partial": trial.partial},
    )


def sample_points(chain: Chain, goal: Goal, problem: Problem, count: int) -> tuple[dict[str, float], ...]:
    """Configurations of the arm, and what is given of its end-effector there."""
    turning = [joint.variable for _, joint in chain.moving if joint.type != "prismatic"]
    slides = {
        joint.variable: problem.assumptions.get(joint.variable) in ("positive", "nonnegative")
        for _, joint in chain.moving
        if joint.type == "prismatic"
    }
    oracle = oracle_of(problem)
    points = []
    for point in configurations(problem.symbols, turning, slides, count):
        at = dict(oracle.at(point))
        points.append({**at, **goal.numbers(oracle.tool(at))})
    return tuple(points)


def free_name(name: str, problem: Problem, goal: Goal) -> str:
    """The name, or one like it that stands for nothing else."""
    taken = problem.symbols | set(problem.where) | set(goal.names)
    while name in taken:
        stem, _, index = name.partition("_")
        name = f"{stem}{stem[-1]}_{index}"
    return name
