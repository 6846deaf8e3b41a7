"""The acceleration of a point of an arm in numbers, from nothing but where it is along a motion."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from derive.algebra.ball_arithmetic import precise
from derive.algebra.numbers.floats import Point
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._velocity.task import Task
from derive.mechanics.oracle.displacements import along, course, many_digits
from derive.mechanics.oracle.values import Array


def acceleration_seen(task: Task, at: Point) -> Any:
    """(a, alpha) (6) of the point of a task, whose rates and accelerations stand in the point too."""
    import numpy as np

    oracle = replace(oracle_of(task.problem), value=precise)
    with many_digits(oracle.at(at)) as here:
        moved = course(*(_pose(task, oracle, now) for now in along(here, task.found.variables)))
        return np.concatenate([moved.a, moved.alpha])


def _pose(task: Task, oracle: Any, at: Any) -> Array:
    """The pose (4 by 4) of the frame that carries the point, its origin moved there."""
    import numpy as np

    poses = oracle.poses(at)
    frame = task.point.frame
    T = poses[-1] @ oracle.in_hand(at) if frame >= len(poses) else poses[frame]
    p = np.array([oracle.value(part, at) for part in task.point.offset])
    moved = np.array(T)
    moved[:3, 3] = T[:3, 3] + T[:3, :3] @ p
    return moved
