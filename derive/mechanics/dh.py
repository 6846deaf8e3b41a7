"""Rows of a robot as sequences of elementary motions: Denavit and Hartenberg's, and screws."""

from __future__ import annotations

from typing import Literal

from derive.expression import ZERO, multiply
from derive.mechanics.motion import Move
from derive.mechanics.robot import DHRow, FreeRow, Link, Robot, ScrewRow

UNIT: tuple[Literal["x", "y", "z"], ...] = ("x", "y", "z")


def standard(row: DHRow) -> tuple[Move, ...]:
    """Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha) (Spong, Hutchinson, Vidyasagar, eq. 3.10)."""
    return (
        Move("rotate", "z", row.theta),
        Move("translate", "z", row.d),
        Move("translate", "x", row.a),
        Move("rotate", "x", row.alpha),
    )


def modified(row: DHRow) -> tuple[Move, ...]:
    """Rot_x(alpha) Trans_x(a) Rot_z(theta) Trans_z(d), alpha and a those of the axis before
    (Craig, eq. 3.6)."""
    return (
        Move("rotate", "x", row.alpha),
        Move("translate", "x", row.a),
        Move("rotate", "z", row.theta),
        Move("translate", "z", row.d),
    )


def screw(row: ScrewRow) -> tuple[Move, ...]:
    """To the axis, about and along it, and back: e^{[S] q} (Lynch and Park, section 3.3.3)."""
    if row.slide:
        return (Move("translate", row.axis, row.by),)
    parts = [(axis, part) for axis, part in zip(UNIT, row.through, strict=True) if part != ZERO]
    along = (Move("translate", row.axis, multiply(row.pitch, row.by)),) if row.pitch != ZERO else ()
    return (
        *(Move("translate", axis, part) for axis, part in parts),
        Move("rotate", row.axis, row.by),
        *along,
        *(Move("translate", axis, -part) for axis, part in parts),
    )


CONVENTIONS = {"standard": standard, "modified": modified}


def moves(link: Link, robot: Robot) -> tuple[Move, ...]:
    """The elementary motions of one row, about current axes."""
    match link.row:
        case FreeRow(made):
            return made
        case ScrewRow():
            return screw(link.row)
        case DHRow():
            return CONVENTIONS[robot.convention](link.row)
