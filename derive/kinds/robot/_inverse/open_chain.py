"""The inverse of any open chain, by the sub-problems that a search finds in its equations."""

from __future__ import annotations

import math
import random
from dataclasses import replace
from functools import partial

from derive.derivation import Derivation, Result
from derive.errors import NotDerivable
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._inverse.branches import Solutions
from derive.kinds.robot._inverse.checks import tried
from derive.kinds.robot._inverse.evaluated import by_plan, evaluated
from derive.kinds.robot._inverse.given import Given, goal_of
from derive.kinds.robot._inverse.refused import no_closed_form, refuse_at_once, refuse_self_motion
from derive.kinds.robot._inverse.stages import Stages
from derive.kinds.robot._inverse.target import Target
from derive.kinds.robot._rows.by_rows import by_rows
from derive.kinds.work import Work
from derive.mechanics.budget import Budget
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.plan import Search
from derive.mechanics.inverse.search import MOST_TERMS
from derive.names import free

POINTS = 5


def derive(chain: Chain, given: Given, place: Place | None, problem: Problem) -> Derivation:
    """The plan, worked and tried; for screws without one, that of the rows found for them. Raises
    NotDerivable where there is none, with what is left to solve."""
    goal = goal_of(given, chain, problem)
    refuse_at_once(chain, goal)
    target = Target.of(problem, chain, goal)
    points = sample_points(chain, goal, problem, POINTS)
    refuse_self_motion(target, points)
    unused = partial(free, problem.taken | set(goal.names))
    plan = Search(chain, goal, points[:2], unused, Budget(MOST_TERMS)).plan()
    if not plan.complete and problem.subject.by_screws:
        return by_rows("inverse-kinematics", problem, given=given, evaluate=place)
    if not plan.complete:
        raise NotDerivable(no_closed_form(plan, goal, problem))
    worked = Stages(problem, chain, goal, plan, unused).worked()
    solutions = Solutions(worked.items, chain.variables, frozenset(plan.knowledge.slides), problem, unused)
    trial = tried(solutions, target, points)
    if trial.partial:
        solutions = replace(solutions, reached=trial.reached)
    results: dict[str, Result] = {"solutions": solutions.branches}
    if solutions.order:
        results["order"] = solutions.order
    values = evaluated(
        solutions.branches, place, problem, lambda point: by_plan(solutions, plan, target, place or (), point)
    )
    work = Work(problem, known=worked.definitions, uses=(problem.ask("forward-kinematics"),))
    work = (
        work.showing(*worked.steps).linked(but=worked.conditional).claim(*trial.claims(solutions, points[0]))
    )
    facts = worked.facts(solutions, trial.partial, values.place)
    return work.answer("inverse-kinematics", results, facts, evaluated=values.values)


def sample_points(chain: Chain, goal: Goal, problem: Problem, count: int) -> tuple[dict[str, float], ...]:
    """Configurations of the arm at random, and what is given of its end-effector there: lengths from 0.2 to
    1.9, angles of a whole turn, displacements of both signs but where they are said to be positive."""
    draw, oracle = random.Random(1), oracle_of(problem)
    joints = sorted((joint for _, joint in chain.moving), key=lambda joint: joint.type == "prismatic")
    points = []
    for _ in range(count):
        names = sorted(problem.symbols - {joint.variable for joint in joints})
        point = {name: draw.uniform(0.2, 1.9) for name in names}
        for joint in joints:
            name = joint.variable
            if joint.type != "prismatic":
                point[name] = draw.uniform(-math.pi, math.pi)
            else:
                positive = problem.assumptions.get(name) in ("positive", "nonnegative")
                point[name] = draw.uniform(0.2, 1.9) * (1 if positive else draw.choice((1, -1)))
        at = dict(oracle.at(point))
        points.append({**at, **goal.numbers(oracle.tool(at))})
    return tuple(points)
