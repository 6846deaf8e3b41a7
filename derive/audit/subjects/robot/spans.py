"""What the joints of an arm can and cannot do in a configuration."""

from __future__ import annotations

from collections.abc import Iterator

from derive.audit.asked import Asked, Test
from derive.audit.points import Point
from derive.audit.spaces import spaces
from derive.audit.subjects.robot.arm import Arm
from derive.audit.subjects.robot.task import Task


def rank(asked: Asked, point: Point) -> Iterator[Test]:
    """The rows of the Jacobian, or the derivatives of a task, in the configuration of the question."""
    there = asked.here if asked.options.evaluate else point.in_digits()
    arm = Arm(asked, there, 1)
    if not asked.options.task:
        yield from spaces(asked, Task(arm).J, there)
        return
    functions = [asked.formula(each) for each in asked.options.task]
    yield from spaces(asked, [[there.at(f.diff(q)) for q in arm.q] for f in functions], there)
