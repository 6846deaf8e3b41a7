"""The Jacobian of an arm in numbers, by differences of its poses, and the arm as it stands: what its singular
sets are held to."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import Any

from derive.algebra.infix import text
from derive.algebra.numbers import floats as numeric
from derive.algebra.numbers.arrays import arrays
from derive.derivation import Claim, Phrase
from derive.kinds.checks import close, route
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._singular.checks import DIFFERENCES, POINTS, InNumbers
from derive.kinds.robot._singular.minors import Way
from derive.kinds.robot._singular.postures import Postures
from derive.kinds.robot._singular.search import Values
from derive.kinds.robot._singular.sets import Block
from derive.kinds.robot._velocity.task import Task
from derive.mechanics.task import ROWS

WRIST = 3  # joints


def of_arm(task: Task, way: Way) -> InNumbers:
    """That of a task."""
    hand = tuple(i for i, _ in task.found.moving)[-WRIST:] if way.name == "wrist" else ()

    def posture(block: Block, said: Phrase, here: Values) -> bool:
        return Postures(task, block.seen.rows, hand).true(said, here)

    return InNumbers(
        task.found.variables,
        tuple(joint.variable for _, joint in task.found.moving if joint.type == "prismatic"),
        task.symbols,
        oracle_of(task.problem).at,
        task.numbers,
        lambda block, here: _block(task, block, here),
        posture,
    )


def center_seen(task: Task, way: Way, J: InNumbers) -> Iterator[Claim]:
    """The center of a wrist as it is printed: the origin of the frame in its name, which the last three
    joints do not move."""
    if way.name == "wrist":
        some = islice(J.points, POINTS)
        yield route("center-seen", (each for at in some for each in _centered(task, way, at)))


def _centered(task: Task, way: Way, at: Values) -> Iterator[bool]:
    line = next(step for step in way.work.steps if step.name == "center")
    oracle = oracle_of(task.problem)
    name, known = text(line.chain[0]), oracle.at(at)
    p, poses = arrays(line.result, known)[:, 0], oracle.poses(known)
    yield close(p, poses[int(name.removeprefix("o_"))][:3, 3], DIFFERENCES)
    T, last = poses[-1], len(poses) - 1
    J = oracle.jacobian(known, last, T[:3, :3].T @ (p - T[:3, 3]))
    yield close(J[:3, -WRIST:], 0 * J[:3, -WRIST:], DIFFERENCES)


def _block(task: Task, block: Block, here: Values) -> Any:
    """The block by differences of the poses: its rows and columns of the Jacobian of its own point, turned
    into its own frame."""
    import numpy as np

    oracle = oracle_of(task.problem)
    known = oracle.at(here)
    columns = [task.found.variables.index(name) for name in block.variables]
    if block.frame == 0:
        return task.numbers(here)[:, columns]
    poses = oracle.poses(known)
    if block.name in ("J_11", "J_22"):
        p = np.array([row[0] for row in numeric.matrix_numbers(block.seen.point, known)])
        T = poses[-1]
        J = oracle.jacobian(known, len(poses) - 1, T[:3, :3].T @ (p - T[:3, 3]))
    elif block.J.shape == (len(ROWS), len(ROWS)):
        J = oracle.jacobian(known, len(poses) - 1, (0.0, 0.0, 0.0))
    else:
        J = oracle.jacobian(known, task.point.frame, task.point.offset)
    R = poses[block.frame][:3, :3]
    turned = np.vstack([R.T @ J[:3], R.T @ J[3:]])
    return turned[[ROWS.index(row) for row in block.rows]][:, columns]
