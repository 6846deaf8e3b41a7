"""What is wrong with the ranges of joints."""

from __future__ import annotations

from collections.abc import Iterator
from math import tau

from derive.algebra.numbers.floats import completed, number
from derive.errors import SheetError
from derive.expression import Degrees, Expr, Number, walk
from derive.mechanics.robot import Link, Robot
from derive.sheet.source import At
from derive.sheet.subjects.registry import Known

MOST = 4 * tau  # radians: a joint that turns further was meant in degrees


def range_faults(robot: Robot, at: At, known: Known) -> Iterator[SheetError]:
    """A range without a joint, in the units of another joint, that holds a joint variable or ends before it
    begins."""
    for index, link in enumerate(robot.links):
        if link.range is None:
            continue
        route, (low, high) = ("links", index, "range"), link.range
        if link.variable is None:
            message = f"row {index + 1} has no joint that could have a range"
            yield at.fault(message, route, "give it to a row with a star", key=True)
        elif fault := next(filter(None, (_misread(each, link, robot) for each in link.range)), None):
            hint = "write [0.1 m, 0.5 m]" if link.joint == "prismatic" else "write [-90 deg, 90 deg]"
            yield at.fault(fault, route, hint)
        elif _is_empty(low, high, known):
            message = f"the range of {link.variable} ends where it begins, or before"
            yield at.fault(message, route, "write the smaller value first")


def _is_empty(low: Expr, high: Expr, known: Known) -> bool:
    """Whether nothing lies between, where that is decided."""
    try:
        return number(high - low, completed({}, known.where)) <= 0
    except (KeyError, ValueError, ZeroDivisionError):
        return False


def _misread(value: Expr, link: Link, robot: Robot) -> str:
    """Why a limit is none of this joint; empty where it may be one."""
    nodes = [*walk(value)]
    if any(getattr(node, "name", None) in robot.variables for node in nodes):
        return f"the range of {link.variable} moves with a joint"
    typed = next((node.unit for node in nodes if isinstance(node, Number) and node.unit), "")
    if link.joint == "prismatic":
        turned = any(isinstance(node, Degrees) for node in nodes)
        return f"{link.variable} is a length, and its range is in degrees" if turned else ""
    if typed:
        return f"{link.variable} is an angle, and its range is in {typed}"
    if isinstance(value, Number) and abs(value.value) > MOST:
        return f"{link.variable} turns by radians here, and {float(value.value):g} is many turns"
    return ""
