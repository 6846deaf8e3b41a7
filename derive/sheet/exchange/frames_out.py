"""The rows of a robot as frames of URDF, in numbers: where each joint stands behind the link before it, about
which axis it moves, and what stands between it and the frame of its row."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from derive.algebra.numbers.floats import Point, number
from derive.errors import NotDerivable, SheetError, SheetErrors
from derive.expression import ZERO, free_symbols
from derive.mechanics.dh import moves
from derive.mechanics.motion import Move
from derive.mechanics.oracle.poses import compose, direction
from derive.mechanics.robot import Link, Robot, ScrewRow
from derive.sheet.source import At

Array: TypeAlias = NDArray[np.float64]
NEAR = 1e-9


@dataclass(frozen=True, slots=True)
class Follows:
    """The joint that another follows: ratio * joint + offset."""

    variable: str
    ratio: float
    offset: float


@dataclass(frozen=True, slots=True)
class Placed:
    """A row: its joint's frame in that of the link before (4 by 4), the axis of the joint in it (3; None of a
    fixed row), whether it turns, what it follows, and the frame of the row in that of its link."""

    link: Link
    place: Array
    axis: Array | None
    turns: bool
    follows: Follows | None
    within: Array


def placed(robot: Robot, point: Point, at: At) -> Iterator[Placed]:
    """Every row. Raises SheetErrors where one moves as no joint of URDF does."""
    behind = np.array(compose(robot.base, point))
    for index, link in enumerate(robot.links):
        found = _placed(robot, link, behind, point, at / "links" / index)
        yield found
        behind = found.within


def _placed(robot: Robot, link: Link, behind: Array, point: Point, at: At) -> Placed:
    made = moves(link, robot)
    moving = [k for k, move in enumerate(made) if free_symbols(move.by) & set(robot.variables)]
    if isinstance(link.row, ScrewRow) and link.row.pitch != ZERO:
        raise at.error("URDF has no helical joint")
    if not moving:
        return Placed(link, behind @ compose(made, point), None, False, None, np.eye(4))
    if len(moving) > 1:
        raise at.error("this row moves in two ways, and a joint of URDF in one", (), "make it two rows")
    k = moving[0]
    variable, ratio, offset = _straight(made[k], robot, point, at)
    axis = np.array(direction(made[k].axis, point))
    before = behind @ compose(made[:k], point)
    follows = None
    if link.variable is None:
        follows = Follows(variable, ratio, offset)
    elif variable != link.variable or abs(abs(ratio) - 1) > NEAR:
        raise at.error(f"this row does not move by {link.variable} alone", (), "URDF has no such joint")
    else:
        axis = axis * round(ratio)
        rest = Move(made[k].kind, made[k].axis, made[k].by)
        before = before @ compose([rest], {**point, **dict.fromkeys(robot.variables, 0.0)})
    return Placed(link, before, axis, made[k].kind == "rotate", follows, compose(made[k + 1 :], point))


def _straight(move: Move, robot: Robot, point: Point, at: At) -> tuple[str, float, float]:
    """The one variable by which a move goes, its factor and what is added. Raises SheetErrors."""
    names = [name for name in robot.variables if name in free_symbols(move.by)]
    if len(names) > 1:
        raise at.error(f"this row moves by {' and '.join(names)}", (), "a joint of URDF follows one other")

    def by(q: float) -> float:
        return number(move.by, {**point, names[0]: q})

    try:
        offset, ratio = by(0.0), by(1.0) - by(0.0)
        even = all(abs(by(q) - offset - ratio * q) <= NEAR for q in (-0.7, 0.3, 2.0))
    except (NotDerivable, ValueError, ArithmeticError):
        even = False
    if not even:
        raise at.error(f"this row does not move in proportion to {names[0]}", (), "URDF has no such joint")
    return names[0], ratio, offset


def numbers_of(robot: Robot, values: Point, needed: set[str], at: At) -> Point:
    """The point at which a robot is written. Raises SheetErrors with the names that have no value."""
    if missing := sorted(needed - set(values) - set(robot.variables) - {"pi"}):
        hint = "give it one: " + " ".join(f"--value {name}=..." for name in missing[:6])
        raise SheetErrors([SheetError(f"{name} has no value", at.place(), hint) for name in missing[:1]])
    return values
