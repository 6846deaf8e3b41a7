"""Poses and velocities: forward kinematics, joint axes and Jacobians."""

from __future__ import annotations

from collections.abc import Iterator

from derive.audit.asked import Asked, Same, Test
from derive.audit.points import Point
from derive.audit.subjects.robot.arm import Arm, numbers


def forward_kinematics(asked: Asked, point: Point) -> Iterator[Test]:
    """T_i^{i-1} and the whole pose, the tool included."""
    arm = Arm(asked, point, 0)
    links = len(arm.local)
    to = asked.options.to or links
    if not arm.robot.by_screws:
        for i in range(1, to + 1):
            yield Same(f"T_{i}^{i - 1}", numbers(arm.local[i - 1]))
    yield Same(f"T_{to}^0", numbers(arm.end if to == links else arm.poses[to]))
