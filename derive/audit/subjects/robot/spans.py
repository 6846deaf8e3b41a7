"""What the joints of an arm can and cannot do in a configuration."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from derive.audit.asked import Asked, Test
from derive.audit.linear import Rows
from derive.audit.points import Point
from derive.audit.redundant import rates
from derive.audit.spaces import spaces
from derive.audit.subjects.robot.arm import Arm
from derive.audit.subjects.robot.task import Task


def rank(asked: Asked, point: Point) -> Iterator[Test]:
    """The rows of the Jacobian, or the derivatives of a task, in the configuration of the question."""
    there = asked.here if asked.options.evaluate else point.in_digits()
    arm = Arm(asked, there, 1)
    if not asked.options.task:
        elsewhere = Task(Arm(asked, point.in_digits(), 1))  # in one configuration more rows may be zero
        yield from spaces(asked, Task(arm).rows_in(elsewhere.names), there)
        return
    functions = [asked.formula(each) for each in asked.options.task]
    yield from spaces(asked, [[there.at(f.diff(q)) for q in arm.q] for f in functions], there)


def redundancy(asked: Asked, point: Point) -> Iterator[Test]:
    """The same matrices, and the joint rates for a velocity."""
    there = asked.here if asked.options.evaluate else point.in_digits()
    arm = Arm(asked, there, 1)
    second, J = asked.options.second, _matrix(asked, arm, asked.options)
    names = Task(arm).names
    if asked.options.task:
        names = tuple(f"r{k}_dot" for k, _ in enumerate(asked.options.task, 1))
    other = _matrix(asked, Arm(replace(asked, options=second), there, 1), second) if second else []
    yield from rates(asked, J, there, names, arm.robot.variables, other)


def _matrix(asked: Asked, arm: Arm, options: Any) -> Rows:
    """What options say: functions, rows of the Jacobian, or a matrix."""
    there = arm.point
    if options.task:
        return [[there.at(asked.formula(each).diff(q)) for q in arm.q] for each in options.task]
    if rows := getattr(options, "matrix", ()):
        return [[there.at(asked.formula(entry)) for entry in row] for row in rows]
    task = Task(arm)
    return task.rows_in(options.rows) if options.rows else task.J
