"""The axis of every joint and a point on it, and the poses they are read from, in the base frame."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import Point, numbers
from derive.derivation import Derivation
from derive.expression import Expr
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._chain import axis_lines, chain_of, oracle_of, pose_name
from derive.kinds.robot._columns import pose_lines
from derive.kinds.robot._couplings import motion_lines
from derive.kinds.work import Work
from derive.mechanics.oracle import Oracle
from derive.mechanics.robot import Robot

CLAIMS = ("names",)


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """z and o (3 by 1 each, base frame) of each joint: the third columns of the poses are the axes, the
    fourth their points (Spong et al., section 4.6)."""
    found, last = chain_of(problem), len(robot.links)
    work = Work(problem).resting_on(problem.ask("forward-kinematics"))
    axes = axis_lines(Work(problem), found)
    if found.coupling:
        axes = motion_lines(axes, found.coupling)
    results = {s.name: problem.final(s.result) for s in axes.steps if s.rule != "law"}
    work = pose_lines(work, found, last).step(*axes.steps)
    work = work.knowing({pose_name(i): problem.readable_matrix(found.T[i]) for i in range(1, last + 1)})
    columns = {name: value for name, value in results.items() if name[0] in "zo"}
    for i in range(1, last):
        told = columns if i == 1 else {}  # all of them once, as they are printed
        ours = partial(_told, found.T[i], told)
        route = partial(_composed, oracle_of(problem), i, tuple(told))
        work = work.agrees("poses-composed", problem.symbols, ours, route, frame=i)
    work = by_index(work, results)
    return work.answer("joint-axes", results)


def _told(T: ScalarMatrix, columns: Mapping[str, Expr], at: Point) -> list[Any]:
    return [numbers(T, at), *(numbers(column, at) for column in columns.values())]


def _composed(oracle: Oracle, i: int, columns: tuple[str, ...], at: Point) -> list[Any]:
    """The pose of frame i, and z_k and o_k of others: their third and fourth columns."""
    poses = oracle.poses(at)
    return [poses[i], *(poses[int(name[2:])][:3, 2 if name[0] == "z" else 3] for name in columns)]
