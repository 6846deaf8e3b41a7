"""The joint rates that give the end-effector a wanted velocity."""

from __future__ import annotations

from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.derivation import Claim, Derivation, PageFacts
from derive.expression import Expr, Symbol
from derive.kinds.checks import SECOND_ROUTE, close, law, links, random_points
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._velocity.solving import Solved, by_inverse, by_pseudo_inverse
from derive.kinds.robot._velocity.splitting import Split, by_wrist
from derive.kinds.robot._velocity.task import RowName, Task, task_of
from derive.mechanics.robot import Robot
from derive.mechanics.wrist import wrist_of

RESULTS = {"qdot": "the joint rates (n), for the velocities vx, vy, vz, wx, wy, wz of the rows"}
EXAMPLE = """\
title: Joint rates for a velocity
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: l1, alpha: 0}
    - {theta: theta2*, d: 0, a: l2, alpha: 0}
  find: inverse-velocity
"""
DIFFERENCES = 1e-5


class Options(OptionsModel):
    """`rows`: the velocities that are wanted; `point`: where, the end-effector if left out."""

    rows: tuple[RowName, ...] = ()
    point: PointOn | None = None


class Facts(PageFacts):
    way: str  # "wrist", "adjugate", ...
    rows: tuple[Symbol, ...]
    frames: tuple[int, ...] = ()  # of the arm and of the hand
    offset: bool = False  # of the center of the wrist
    zero: tuple[tuple[Expr, ...], ...]  # singular where one of these holds
    redundant: bool = False
    minors: tuple[str, ...] = ()  # steps


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """J^-1 v by the adjugate; the least rates (J^T (J J^T)^-1 v) or the least error ((J^T J)^-1 J^T v) where
    J is not square (Siciliano et al., section 3.5).

    Raises NotDerivable where J is singular in every configuration, or too large to be written.
    """
    task = task_of(problem, options.rows, options.point)
    wrist = wrist_of(task.found) if task.square and options.point is None else None
    if wrist:
        return _by_halves(task, by_wrist(task, wrist))
    solved = by_inverse(task) if task.square else by_pseudo_inverse(task)
    qdot = problem.final(solved.qdot)
    claims = (
        *links(solved.steps, {**problem.names, **solved.definitions}),
        _law(task, solved),
        _second_route(task, qdot),
    )
    return Derivation(
        "inverse-velocity", solved.steps, {"qdot": qdot}, claims, solved.definitions,
        uses=(task.base,), facts=_facts(task, solved),
    )  # fmt: skip


def _by_halves(task: Task, split: Split) -> Derivation:
    """The arm first, then the wrist."""
    facts = Facts(
        way="wrist", rows=task.velocities, frames=split.frames, offset=split.offset, zero=split.zero
    )
    claims = (*split.claims, _second_route(task, split.qdot))
    return Derivation(
        "inverse-velocity", split.steps, {"qdot": split.qdot}, claims, split.definitions,
        uses=split.uses, facts=facts,
    )  # fmt: skip


def _law(task: Task, solved: Solved) -> Claim:
    """J qdot = v, exactly; with more rows than joints J^T (J qdot - v) = 0."""
    velocity = ScalarMatrix.column(map(_scalar, task.velocities))
    error = task.J @ solved.exact - velocity.scaled(solved.det)
    if not task.square and not task.redundant:
        return law("least-squares", not task.J.T @ error)
    return law("solves", not error)


def _scalar(name: Symbol) -> Any:
    return normal_matrix(name)[0, 0]


def _second_route(task: Task, qdot: Expr) -> Claim:
    """By NumPy's pseudo-inverse of a Jacobian by differences."""
    import numpy as np

    names = sorted(task.symbols | {name.name for name in task.velocities})
    holds = True
    for at in random_points(names, 3):
        velocity = np.array([at[name.name] for name in task.velocities])
        found = numeric.numbers(qdot, oracle_of(task.problem).at(at))
        holds &= close(found, np.linalg.pinv(task.numbers(at)) @ velocity, DIFFERENCES)
    return Claim("pseudo-inverse", SECOND_ROUTE, bool(holds))


def _facts(task: Task, solved: Solved) -> Facts:
    return Facts(
        way=solved.way,
        rows=task.velocities,
        zero=(solved.zero,),
        redundant=task.redundant,
        minors=tuple(step.name for step in solved.steps if step.rule == "minor"),
    )
