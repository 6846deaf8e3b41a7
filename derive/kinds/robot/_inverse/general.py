"""The inverse of any open chain, by the sub-problems that a search finds in its equations."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._inverse.branches import Solutions
from derive.kinds.robot._inverse.checks import tried
from derive.kinds.robot._inverse.evaluated import evaluated
from derive.kinds.robot._inverse.given import goal_of
from derive.kinds.robot._inverse.opening import Opening
from derive.kinds.robot._inverse.page import Page
from derive.kinds.robot._inverse.reasons import loose, no_closed_form, refuse
from derive.kinds.robot._rows.by_rows import by_rows
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.budget import Budget
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.plan import Search
from derive.mechanics.inverse.sample import configurations
from derive.names import free

POINTS = 5


def derive(chain: Chain, options: Any, problem: Problem) -> Derivation:
    """The plan, written and tried; for screws without one, that of the rows found for them. Raises
    NotDerivable where there is none, with what is left to solve."""
    goal = goal_of(options.given, chain, problem)
    refuse(chain, goal)
    points = sample_points(chain, goal, problem, POINTS)
    loose(chain, goal, problem, points)
    unused = partial(free, problem.taken | set(goal.names))
    plan = Search(chain, goal, points[:2], unused, Budget()).plan()
    if not plan.complete and problem.subject.by_screws:
        return by_rows("inverse-kinematics", problem, given=options.given, evaluate=options.evaluate)
    if not plan.complete:
        raise NotDerivable(no_closed_form(plan, goal, problem))
    page = Page(problem, chain, goal, plan, Opening(problem, chain, goal, plan, unused).written())
    slides = frozenset(plan.knowledge.slides)
    solutions = Solutions(page.items, chain.variables, slides, problem, unused)
    trial = tried(solutions, goal, problem, points)
    if trial.partial:
        solutions = replace(solutions, reached=trial.reached)
    results: dict[str, Any] = {"solutions": solutions.branches}
    if solutions.order:
        results["order"] = solutions.order
    values = evaluated(solutions, page.opened.items, chain, plan, goal, options.evaluate)
    return Derivation(
        "inverse-kinematics",
        page.steps,
        results,
        (*page.claims(), *trial.claims(solutions, points[0])),
        page.definitions,
        values.values,
        uses=(problem.ask("forward-kinematics"),),
        facts={
            **page.facts(solutions),
            **values.facts,
            **problem.angular(solutions.turning),
            "partial": trial.partial,
        },
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
