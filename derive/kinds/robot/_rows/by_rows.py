"""A chain of screws answered by way of its link parameters, where they bring a structure to light."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal

from derive.algebra.matrix import ScalarMatrix
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, free_symbols, sqrt
from derive.expression import atan2 as direction
from derive.kinds.pose._numbers import known_angle
from derive.kinds.problem import Memo, Problem
from derive.kinds.robot._rows.dh_found import found_rows
from derive.mechanics.motion import Move
from derive.mechanics.poses import position_part, rotation_part
from derive.mechanics.robot import Link, Robot

ALONG: tuple[Literal["x", "y", "z"], ...] = ("x", "y", "z")


def by_rows(kind: str, problem: Problem, **options: Any) -> Derivation:
    """The answer for the same arm by link parameters, which it rests on. Raises NotDerivable."""
    other = replace(problem, subject=arm_of_rows(problem.subject, problem), memo=Memo())
    found = other.ask(kind, **options)
    return replace(found, uses=(problem.ask("dh-table"), *found.uses))


def arm_of_rows(robot: Robot, problem: Problem) -> Robot:
    """The arm by the rows found for it. Raises NotDerivable for a helical joint, and for a turned base or
    tool that is no number."""
    rows, _ = found_rows(robot, "standard", problem)
    triples = zip(rows.rows, rows.joints, rows.variables, strict=True)
    links = tuple(Link(row, joint, variable) for row, joint, variable in triples)
    return Robot(robot.name, "standard", links, _moves(rows.base, problem), _moves(rows.tool, problem))


def _moves(T: ScalarMatrix, problem: Problem) -> tuple[Move, ...]:
    """A fixed pose as moves about current axes: along x, y, z, then about z, y, x."""
    lengths = zip(ALONG, position_part(T).entries, strict=True)
    shifts = (Move("translate", axis, problem.readable(part)) for axis, part in lengths if part)
    R = rotation_part(T)
    if ScalarMatrix.identity(3) == R:
        return tuple(shifts)
    angles = zip(reversed(ALONG), _angles(R, problem), strict=True)
    return (*shifts, *(Move("rotate", axis, angle) for axis, angle in angles))


def _angles(R: ScalarMatrix, problem: Problem) -> tuple[Expr, Expr, Expr]:
    """Yaw, pitch and roll of a rotation of numbers (Siciliano et al., eq. 2.22); no roll at the pole."""
    r = [[problem.readable(entry) for entry in row] for row in R.rows]
    if any(free_symbols(entry) for row in r for entry in row):
        raise NotDerivable("the end-effector is turned against the last joint by an angle that is no number")
    if not R[0, 0] and not R[1, 0]:
        yaw = direction(-r[0][1], r[1][1])
        pitch = direction(-r[2][0], ZERO)
        return known_angle(yaw, problem), known_angle(pitch, problem), ZERO
    yaw = direction(r[1][0], r[0][0])
    pitch = direction(-r[2][0], sqrt(r[0][0] ** 2 + r[1][0] ** 2))
    roll = direction(r[2][1], r[2][2])
    return known_angle(yaw, problem), known_angle(pitch, problem), known_angle(roll, problem)
