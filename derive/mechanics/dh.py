"""Rows of Denavit-Hartenberg parameters as sequences of elementary motions."""

from __future__ import annotations

from derive.mechanics.motion import Move
from derive.mechanics.robot import DHRow, FreeRow, Link, Robot


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


CONVENTIONS = {"standard": standard, "modified": modified}


def moves(link: Link, robot: Robot) -> tuple[Move, ...]:
    """The elementary motions of one row, about current axes."""
    return link.row.moves if isinstance(link.row, FreeRow) else CONVENTIONS[robot.convention](link.row)
