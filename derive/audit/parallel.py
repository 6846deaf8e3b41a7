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


def meeting(asked: Asked, point: Point) -> Iterator[Test]:
    """The point of a five-bar linkage has both distances, in each of two places."""
    angles, target = sympy.symbols("theta_1:3"), sympy.symbols("x y")
    gaps = [
        _square(asked, leg, angle, list(target)) - asked.formula(rod) ** 2
        for leg, (angle, rod) in enumerate(zip(angles, asked.subject.couplers, strict=True), 1)
    ]
    there = point.in_digits()
    found = [in_turn(asked, each, there) for each in asked.objects("solutions")]
    yield Holds("solutions", len(found) == 2 and abs(found[0]["x"] - found[1]["x"]) > ROUGH, "they are one")
    for place in found:
        size = 1 + sum(abs(place[name.name]) ** 2 for name in target)
        near = all(abs(place.at(gap)) < CLOSE * size for gap in gaps)
        yield Holds("solutions", bool(near), "a coupler does not reach")
    for told in asked.objects("evaluated solutions") if asked.evaluated else ():
        values = {name: value for name, value in told.items() if name not in ("when", "real")}
        if any(isinstance(value, str) for value in values.values()):
            yield Beyond("evaluated solutions", "symbols are left")
        elif told.get("real", True):
            here = asked.here.where(**{name: mpmath.mpf(value) for name, value in values.items()})
            yield Holds(
                "evaluated solutions", all(abs(here.at(gap)) < ROUGH for gap in gaps), "it is not there"
            )


def five_bar_singularities(asked: Asked, point: Point) -> Iterator[Test]:
    """Sums and differences of two bars that belong together."""
    robot = asked.subject
    (a_1, a_2), (b_1, b_2) = (tuple(map(asked.formula, bars)) for bars in (robot.cranks, robot.couplers))
    pairs = {"r_1": (a_1, b_1), "r_2": (a_2, b_2), "e": (b_1, b_2)}
    lists = {"solutions": point.in_digits()} | (
        {"evaluated solutions": asked.here} if asked.evaluated else {}
    )
    for name, place in lists.items():
        for told in asked.objects(name):
            ((what, value),) = ((key, each) for key, each in told.items() if key != "when")
            size = place.at(asked.read(value))
            one, other = (place.at(each) for each in pairs[what])
            near = min(abs(size - (one + other)), abs(size - abs(one - other)))
            yield Holds(name, bool(near < ROUGH), "no bars lie in line")


def jacobian(asked: Asked, point: Point) -> Iterator[Test]:
    """The squares of the rods differentiated; or directions of the legs, and their moments."""
    robot = asked.subject
    if isinstance(robot, Stewart):
        rows = []
        for leg, lever in _legs(asked):
            direction = leg / sympy.sqrt(leg.dot(leg))
            rows.append([*direction, *lever.cross(direction)])
        yield Same("J", point.each(rows))
        return
    target = [sympy.Symbol(f"_p{k}") for k in range(len(_wanted(asked)))]
    placed = dict(zip(target, map(asked.formula, _wanted(asked)), strict=True))
    angles = sympy.symbols("theta_1:4")[: len(target)]
    squares = [_square(asked, leg, angle, target) / 2 for leg, angle in enumerate(angles, 1)]
    J_x = [[sympy.diff(each, name).subs(placed) for name in target] for each in squares]
    J_q = [[-sympy.diff(each, name).subs(placed) for name in angles] for each in squares]
    yield Same("J_x", point.each(J_x))
    yield Same("J_q", point.each(J_q))


def _vectors(asked: Asked, point: Point) -> Iterator[Test]:
    for k, (leg, _) in enumerate(_legs(asked), 1):
        yield Same(f"L_{k}", point.each([*leg]))
        yield Same(f"l_{k}", point.at(sympy.sqrt(leg.dot(leg))))


def _legs(asked: Asked) -> Iterator[tuple[sympy.Matrix, sympy.Matrix]]:
    """The vector along each leg, and that from the middle of the platform to its end; SymPy's own matrices
    turn it."""
    robot, options = asked.subject, asked.options
    letters, given = options.convention, options.orientation or (ZERO, ZERO, ZERO)
    turns = [*zip(letters.lower(), map(asked.formula, given), strict=True)]
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
    for foot, top in zip(robot.base, robot.platform, strict=True):
        start, end = (sympy.Matrix([*map(asked.formula, each)]) for each in (foot, top))
        yield p + R * end - start, R * end


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
    robot, leg = asked.subject, int(name.split("_")[-1])
    rod = robot.couplers[leg - 1] if isinstance(robot, FiveBar) else robot.forearm
    target = list(map(asked.formula, _wanted(asked)))
    return there.at(_square(asked, leg, sympy.Symbol(name), target) - asked.formula(rod) ** 2)


def _square(asked: Asked, leg: int, angle: sympy.Symbol, target: list[sympy.Expr]) -> sympy.Expr:
    """Of the distance between the joints of a rod."""
    robot = asked.subject
    if isinstance(robot, FiveBar):
        crank = asked.formula(robot.cranks[leg - 1])
        foot = asked.formula(robot.ground) * (leg - 1)
        elbow = [foot + crank * sympy.cos(angle), crank * sympy.sin(angle)]
    else:
        base, platform, arm = (asked.formula(getattr(robot, each)) for each in ("base", "platform", "arm"))
        out, turn = base + arm * sympy.cos(angle) - platform, THIRD * (leg - 1)
        elbow = [out * sympy.cos(turn), out * sympy.sin(turn), -arm * sympy.sin(angle)]
    return sum((b - a) ** 2 for a, b in zip(elbow, target, strict=True))
