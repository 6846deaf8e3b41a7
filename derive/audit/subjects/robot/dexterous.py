"""Where an end-effector takes every orientation: by how it turns about a point that it holds, and in a plane
by where its last link may start."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import mpmath
import numpy as np

from derive.audit.asked import Asked, Holds, Test
from derive.audit.points import Point, floating
from derive.audit.subjects.robot.arm import Arm, entries
from derive.audit.subjects.robot.series import values
from derive.audit.subjects.robot.task import Task

SAMPLES = 200
NEAR = 1e-9


def dexterous(asked: Asked, lengths: Point) -> Iterator[Test]:
    """r_min, r_max and area of the rings, if it is made of rings; else that it is empty, or all that is
    reached: of this only the description is judged."""
    task = Task(Arm(asked, lengths, 1))
    said = str(asked.results["description"])
    if "description" in asked.evaluated:
        yield Holds("evaluated description", asked.evaluated["description"] == said, said)
    if "r_max" in asked.results and _links(task) > 2 and _planar(task):
        yield from _rings(asked, task, lengths)
        yield Holds("description", "empty" not in said.split(",")[0].split(), said)
        return
    freedom, all_ways = _freedom(task), 1 if _planar(task) else 3
    never = said.startswith(("empty", "the point"))
    if _planar(task) and _links(task) > 2 and never:
        near, far, last = _others(task)
        yield Holds("description", far - last <= NEAR or last < near, said)
    else:
        yield Holds("description", (freedom < all_ways) == never, f"it turns in {freedom} ways")


def _jacobian(task: Task) -> Any:
    return np.array([[float(floating(entry)) for entry in row] for row in values(task.whole)], dtype=float)


def _axes(task: Task) -> list[tuple[Any, Any]]:
    """A point and the direction of the axis of each joint that turns and moves the point."""
    J, p = _jacobian(task), np.array([float(floating(each)) for each in entries(task.place)])
    columns = [(J[:3, i], J[3:, i]) for i in range(J.shape[1])]
    turning = [(v, w) for v, w in columns if np.linalg.norm(w) > NEAR and np.linalg.norm(v) > NEAR]
    return [(p + np.cross(w, v), w) for v, w in turning]


def _planar(task: Task) -> bool:
    axes = [w for _, w in _axes(task)]
    return all(np.linalg.norm(np.cross(axes[0], w)) < NEAR for w in axes)


def _links(task: Task) -> int:
    return len(_axes(task))


def _freedom(task: Task) -> int:
    """In how many ways it turns while the point stays."""
    J = _jacobian(task)
    _, sizes, rows = np.linalg.svd(J[:3])
    still = rows[int((sizes > NEAR).sum()) :].T
    return int(np.linalg.matrix_rank(J[3:] @ still, tol=NEAR)) if still.size else 0


def _others(task: Task) -> tuple[float, float, float]:
    """Between which distances the last axis is, and the length of the last link."""
    p = np.array([float(floating(each)) for each in entries(task.place)])
    axes = _axes(task)
    w = axes[0][1]
    points = [*(o for o, _ in axes), p]
    *others, last = (float(np.linalg.norm(np.cross(w, b - a))) for a, b in pairwise(points))
    return max(0.0, 2 * max(others) - sum(others)), sum(others), last


def _rings(asked: Asked, task: Task, lengths: Point) -> Iterator[Test]:
    near, far, last = _others(task)
    r_max = float(floating(asked.ours("r_max", lengths)))
    yield Holds("r_max", abs(r_max - (far - last)) < NEAR * (far + last), f"it is {far - last}")
    if "rings" not in asked.results:
        return
    told = [[float(floating(end)) for end in row] for row in lengths.matrix(asked.result("rings"))]
    distances = ((k + 0.5) * (far + last) / SAMPLES for k in range(SAMPLES))
    right = all(
        any(low <= r <= high for low, high in told) == (r + last <= far and abs(r - last) >= near)
        for r in distances
        if all(abs(r - end) > NEAR for row in told for end in row)
    )
    yield Holds("rings", right, f"the others reach from {near} to {far}")
    yield Holds("r_min", abs(float(floating(asked.ours("r_min", lengths))) - told[0][0]) < NEAR, f"{told}")
    if "area" in asked.results:
        size = float(mpmath.pi) * sum(high**2 - low**2 for low, high in told)
        yield Holds("area", abs(float(floating(asked.ours("area", lengths))) - size) < NEAR * size, f"{size}")
