"""The configurations in which the end-effector can no longer move in every direction."""

from __future__ import annotations

from derive.derivation import Branch, Derivation, Result
from derive.kinds.checks import links
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._singular.checks import checked
from derive.kinds.robot._singular.facts import facts_of
from derive.kinds.robot._singular.sets import analysed, branches
from derive.kinds.robot._singular.work import Work, by_determinant, by_minors, by_wrist
from derive.kinds.robot._velocity.task import RowName, Task, task_of
from derive.mechanics.robot import Robot
from derive.mechanics.wrist import wrist_of

RESULTS = {
    "det": "the determinant of J, factored; of J J^T or J^T J where J is not square",
    "solutions": "each singular configuration: the joint variables it fixes, and what it looks like",
}
EXAMPLE = """\
title: Singularities
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: l1, alpha: 0}
    - {theta: theta2*, d: 0, a: l2, alpha: 0}
  find: singularities
"""
WHOLE = ("vx", "vy", "vz", "wx", "wy", "wz")


class Options(OptionsModel):
    """`rows`: the velocities to be commanded; `point`: where, the end-effector if left out."""

    rows: tuple[RowName, ...] = ()
    point: PointOn | None = None


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """Where det J = 0, factor by factor (Siciliano et al., section 3.3; Spong et al., section 4.9).

    Raises NotDerivable where the rows asked for are dependent in every configuration.
    """
    task = task_of(problem, options.rows, options.point)
    work = _work(task, options)
    sets = tuple(analysed(problem, part.block, found) for part in work.parts for found in part.sets)
    claims = (*links(work.steps, {**problem.names, **work.definitions}), *work.laws, *checked(task, sets))
    solutions = branches(problem, sets, work.point)
    if not all(part.complete for part in work.parts):
        solutions = (*solutions, Branch({}, "any other configuration where all minors vanish"))
    results: dict[str, Result] = {"det": problem.final(work.det), "solutions": solutions}
    return Derivation(
        "singularities", work.steps, results, claims, work.definitions,
        uses=work.uses, facts=facts_of(problem, work, sets),
    )  # fmt: skip


def _work(task: Task, options: Options) -> Work:
    whole = set(task.rows) == set(WHOLE) and options.point is None
    wrist = wrist_of(task.found) if whole else None
    if wrist:
        return by_wrist(task, wrist)
    return by_determinant(task) if task.square else by_minors(task)
