"""The axes of joints: columns of poses, and the twists of joints whose rows follow no convention."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

from derive.audit.asked import Asked, Beyond, Holds, Same, Test
from derive.audit.linear import is_zero
from derive.audit.points import Point
from derive.audit.subjects.robot.arm import Arm, entries
from derive.audit.subjects.robot.displacements import moved, unit
from derive.audit.subjects.robot.kinematics import inverse_pose, twist
from derive.audit.subjects.robot.series import Array, diff, values
from derive.expression import Expr, free_symbols
from derive.mechanics.robot import DHRow, FreeRow

COLUMNS = {"x": 0, "z": 2, "o": 3}


def joint_axes(asked: Asked, point: Point) -> Iterator[Test]:
    """z_k and o_k: third and fourth column of the pose of frame k. k_i and p_i: the axis of the joint of row
    i and a point on it, by the twist of that joint."""
    arm = Arm(asked, point, 1)
    for name in asked.results:
        found = re.fullmatch(r"([xzokp])_(\d+)", name)
        if name in ("phi", "Gamma"):
            by = [asked.formula(each) for each in _driven(arm)]
            slopes = [[each.diff(q) for q in arm.q] for each in by]
            yield Same(name, point.vector(by) if name == "phi" else point.matrix(slopes))
        elif found is None:
            yield Beyond(name, "no column of a pose")
        elif found[1] in COLUMNS:
            yield Same(name, entries(arm.poses[int(found[2])][:3, COLUMNS[found[1]]]))
        else:
            yield _of_joint(arm, name, int(found[2]))


def _driven(arm: Arm) -> list[Expr]:
    """What the motions are by, from the base to the tool, in which joint variables stand."""
    made = [move.by for move in arm.robot.base]
    for link in arm.robot.links:
        match link.row:
            case DHRow(theta, d, a, alpha):
                made += (theta, d, a, alpha) if arm.robot.convention == "standard" else (alpha, a, theta, d)
            case FreeRow(moves):
                made += [move.by for move in moves]
            case screw:
                made.append(screw.by)
    made += [move.by for move in arm.robot.tool]
    return [by for by in made if free_symbols(by) & set(arm.robot.variables)]


def _of_joint(arm: Arm, name: str, i: int) -> Test:
    """The axis of the joint of row i, or a point of it."""
    found = _of_move(arm, i) if arm.robot.coupled else _of_twist(arm, i)
    if found is None:
        return Beyond(name, "the axis of one of several motions")
    axis, o = found
    if name[0] == "k":
        return Same(name, axis.tolist())
    p = np.array(arm.asked.ours(name, arm.point), dtype=object)
    return Holds(name, all(map(is_zero, np.cross(p - o, axis))), "a point of the axis")


def _of_twist(arm: Arm, i: int) -> tuple[Array, Array] | None:
    """Direction and a point of the axis of the only joint of row i, by the twist of that joint."""
    variable = arm.robot.links[i - 1].variable
    if variable is None:
        return None
    S = diff(arm.end, arm.robot.variables.index(variable)) @ inverse_pose(arm.end)
    v, w = np.split(values(twist(S)), 2)
    if not all(map(is_zero, w)):
        return w, np.cross(w, v)
    return v, values(arm.poses[i - 1])[:3, 3]


def _of_move(arm: Arm, i: int) -> tuple[Array, Array] | None:
    """The same of the only motion of row i in which joint variables stand."""
    row = arm.robot.links[i - 1].row
    moves = row.moves if isinstance(row, FreeRow) else ()
    driven = [k for k, move in enumerate(moves) if free_symbols(move.by) & set(arm.robot.variables)]
    if len(driven) != 1:
        return None
    before = values(arm.poses[i - 1] @ moved(moves[: driven[0]], arm))
    return before[:3, :3] @ values(unit(moves[driven[0]].axis, arm)), before[:3, 3]
