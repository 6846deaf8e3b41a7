"""Parallel robots: at the angle of each motor the rod of its leg reaches the point."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from typing import Any

import mpmath
import sympy

from derive.audit.asked import Asked, Beyond, Holds, Same, Test
from derive.audit.linkages import CLOSE, ROUGH, in_turn
from derive.audit.points import Point
from derive.expression import ZERO, Expr, Symbol, free_symbols
from derive.mechanics.linkages import Delta, FiveBar, Stewart

TRIES = 600
THIRD = sympy.pi * 2 / 3


def inverse_kinematics(asked: Asked, point: Point) -> Iterator[Test]:
    """Two angles for each motor, and with each the length of the rod between its joints; or the vectors from
    the base to the platform that was turned and moved."""
    if isinstance(asked.subject, Stewart):
        yield from _vectors(asked, point)
        return
    branches = asked.objects("solutions")
    there = _place(asked, point, branches)
    angles = defaultdict(list)
    for each in branches:
        name = [name for name in each if name != "when"][-1]
        place = in_turn(asked, each, there)
        angles[name].append(place[name])
        yield Holds("solutions", abs(_gap(asked, name, place)) < CLOSE, f"the rod of {name} does not reach")
    apart = (abs(mpmath.expj(one) - mpmath.expj(other)) > ROUGH for one, other in angles.values())
    yield Holds("solutions", all(map(bool, apart)), "both ways to bend a leg are one")
    for told in asked.objects("evaluated solutions") if asked.evaluated else ():
        values = {name: value for name, value in told.items() if name not in ("when", "real")}
        if any(isinstance(value, str) for value in values.values()):
            yield Beyond("evaluated solutions", "symbols are left")
        elif told.get("real", True):
            ((name, value),) = values.items()
            here = asked.here.where(**{name: mpmath.mpf(value)})
            yield Holds("evaluated solutions", abs(_gap(asked, name, here)) < ROUGH, "a rod does not reach")


def _vectors(asked: Asked, point: Point) -> Iterator[Test]:
    """SymPy's own matrices turn the platform."""
    robot, options = asked.subject, asked.options
    letters = options.convention
    turns = [
        *zip(letters.lower(), map(asked.formula, options.orientation or (ZERO, ZERO, ZERO)), strict=True)
    ]
    R = sympy.eye(3)
    for axis, angle in turns if letters.isupper() else turns[::-1]:
        c, s = sympy.cos(angle), sympy.sin(angle)
        R = (
            R
            * {
                "x": sympy.Matrix([[1, 0, 0], [0, c, -s], [0, s, c]]),
                "y": sympy.Matrix([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
                "z": sympy.Matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]]),
            }[axis]
        )
    p = sympy.Matrix([*map(asked.formula, _wanted(asked))])
    for k, (foot, top) in enumerate(zip(robot.base, robot.platform, strict=True), 1):
        start, end = (sympy.Matrix([*map(asked.formula, each)]) for each in (foot, top))
        leg = p + R * end - start
        yield Same(f"L_{k}", point.each([*leg]))
        yield Same(f"l_{k}", point.at(sympy.sqrt(leg.dot(leg))))


def _place(asked: Asked, point: Point, branches: list[Mapping[str, Any]]) -> Point:
    """Where all legs reach."""
    names = [[name for name in each if name != "when"][-1] for each in branches]
    for k in range(TRIES):
        there = _scaled(asked, Point(point.seed * TRIES + k, False, (), asked.assumptions))
        places = [in_turn(asked, each, there) for each in branches]
        if all(mpmath.im(place[name]) == 0 for place, name in zip(places, names, strict=True)):
            return there
    raise NotImplementedError("no position was found that all legs reach")


def _scaled(asked: Asked, there: Point) -> Point:
    """The point with coordinates of the position that are free measured by a rod."""
    robot = asked.subject
    rod = there.at(asked.formula(robot.couplers[0] if isinstance(robot, FiveBar) else robot.forearm))
    free = [each for each in map(asked.formula, _wanted(asked)) if each.is_Symbol]
    return there.where(**{each.name: rod * (there[each.name] - 1) / 2 for each in free})


def _wanted(asked: Asked) -> tuple[Expr, ...]:
    """The position, by the names that the answer gives it where the sheet has none."""
    if asked.options.position:
        return tuple(asked.options.position)
    axes = "xy" if isinstance(asked.subject, FiveBar) else "xyz"
    own = {name for each in (fields_of(asked.subject)) for name in free_symbols(each)}
    return tuple(Symbol(f"p_{axis}" if axis in own else axis) for axis in axes)


def fields_of(robot: FiveBar | Delta | Stewart) -> list[Expr]:
    """Its lengths."""
    if isinstance(robot, Stewart):
        return [part for points in (robot.base, robot.platform) for point in points for part in point]
    if isinstance(robot, FiveBar):
        return [*robot.cranks, *robot.couplers, robot.ground]
    return [robot.base, robot.platform, robot.arm, robot.forearm]


def _gap(asked: Asked, name: str, there: Point) -> Any:
    """The square of the distance between the joints of a rod, less that of its length."""
    robot, leg, angle = asked.subject, int(name.split("_")[-1]), sympy.Symbol(name)
    target = list(map(asked.formula, _wanted(asked)))
    if isinstance(robot, FiveBar):
        crank, rod = (asked.formula(each[leg - 1]) for each in (robot.cranks, robot.couplers))
        foot = asked.formula(robot.ground) * (leg - 1)
        gap = (foot + crank * sympy.cos(angle) - target[0]) ** 2 + (crank * sympy.sin(angle) - target[1]) ** 2
        return there.at(gap - rod**2)
    base, platform, arm, rod = (
        asked.formula(getattr(robot, each)) for each in ("base", "platform", "arm", "forearm")
    )
    out, turn = base + arm * sympy.cos(angle) - platform, THIRD * (leg - 1)
    elbow = [out * sympy.cos(turn), out * sympy.sin(turn), -arm * sympy.sin(angle)]
    return there.at(sum((a - b) ** 2 for a, b in zip(elbow, target, strict=True)) - rod**2)
