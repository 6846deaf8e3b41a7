"""Inverse kinematics: every branch put back into the forward kinematics, where some configuration stands.

The end-effector is where a random configuration brings it. That configuration must be one of the branches
there, and each branch that is real there must bring the end-effector to the same place.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import product
from typing import TypeAlias

import mpmath

from derive.audit.asked import Asked, Holds, Test
from derive.audit.points import ROUNDED, Irrational, Number, Point, agree, floating, shown
from derive.audit.subjects.robot.arm import Arm, entries, numbers
from derive.audit.subjects.robot.linear import is_zero
from derive.audit.subjects.robot.series import values
from derive.audit.text import Json, Unreadable

Values: TypeAlias = dict[str, Number]
PLACES = 3  # configurations at each point
NEAR = mpmath.mpf(10) ** -25
RELATION = re.compile(r"^([^<>=]+?) ([<>]) ([^<>=]+)$")


def inverse_kinematics(asked: Asked, point: Point) -> Iterator[Test]:
    """Every branch, at some configurations; lengths that slide are drawn positive."""
    if point.exact:
        raise Irrational
    robot = asked.subject
    slides = {link.variable: "positive" for link in robot.links if link.joint == "prismatic"}
    for k in range(PLACES):
        seed = 1000 * (k + 1) + point.seed
        here = Point(seed, False, point.angles, {**point.assumptions, **slides})
        yield from _branches(asked, here)
    if "order" in asked.results:
        yield Holds("order", True, "")
    if asked.evaluated:
        yield from _in_numbers(asked, point)


def _branches(asked: Asked, here: Point) -> Iterator[Test]:
    arm = Arm(asked, here, 1)
    target, q = goal(asked, arm), {name: here[name] for name in arm.robot.variables}
    known = here.where(**target)
    found = False
    for k, branch in enumerate(_solutions(asked), 1):
        name = f"solutions[{k}]"
        there = branch_values(asked, branch, known, q)
        if there is None:
            continue
        joints = {joint: there[joint] for joint in q}
        reached = goal(asked, Arm(asked, here.where(**joints), 1))
        if branch.get("true_at", True):
            right = all(_same(reached[each], target[each], each not in "xyz") for each in target)
            yield Holds("solutions", right, f"{name} brings it to {_told(reached)}, not {_told(target)}")
        for condition in str(branch["when"]).split(", "):
            yield Holds("solutions", _met(asked, condition, known.where(**there)), f"{name}: not {condition}")
        found = found or all(_same(joints[joint], q[joint], joint in here.angles) for joint in q)
    yield Holds(
        "solutions", found, f"a branch {_told(q)} is missing where the end-effector is at {_told(target)}"
    )


def _in_numbers(asked: Asked, point: Point) -> Iterator[Test]:
    """The branches at the point that the author gave, angles up to whole turns."""
    here = asked.here
    free = {name: here[name] for name in asked.subject.variables}
    there = [branch_values(asked, branch, here, free) for branch in _solutions(asked)]
    told = asked.objects("evaluated solutions")
    yield Holds("evaluated solutions", len(told) == len(there), f"{len(there)} branches")
    for k, (values_told, found) in enumerate(zip(told, there, strict=False), 1):
        name = f"branch {k}"
        real = values_told.get("real", True)
        yield Holds("evaluated solutions", real == (found is not None), f"{name} is real, or is not")
        for joint, value in values_told.items():
            if found is not None and joint in found:
                right = _same(here.at(asked.read(value)), found[joint], joint in point.angles, ROUNDED)
                yield Holds("evaluated solutions", right, f"{name} has {joint} = {shown(found[joint])}")


def _solutions(asked: Asked) -> list[Mapping[str, Json]]:
    solutions = asked.results["solutions"]
    if not isinstance(solutions, list) or not solutions:
        raise NotImplementedError("there are no solutions")
    return solutions


def branch_values(asked: Asked, branch: Mapping[str, Json], known: Point, q: Values) -> Values | None:
    """The values of a branch, found in turn; of joints that are left free those of q. None where it is not
    real."""
    names = asked.results.get("order") or [name for name in branch if name in q]
    there: Values = {}
    if not isinstance(names, list):
        raise Unreadable("the order is no list")
    free = {name: value for name, value in q.items() if name not in branch}
    for name in map(str, names):
        if name not in branch:
            continue
        try:
            value = known.where(**free, **there).at(asked.read(branch[name]))
        except (ZeroDivisionError, TypeError, ValueError):
            return None
        if isinstance(value, mpmath.mpc):
            if not is_zero(value.imag, 1):
                return None
            value = value.real
        there[name] = value
    return {**free, **there}


def goal(asked: Asked, arm: Arm) -> Values:
    """What is known of the end-effector, by the names that the question gives it."""
    given, T = asked.options.given, values(arm.end)
    if isinstance(given, str):
        found = {f"r{i + 1}{j + 1}": T[i, j] for i, j in product(range(3), repeat=2)}
        return found if given == "orientation" else {**found, **dict(zip("xyz", T[:3, 3], strict=True))}
    moving = [
        axis for axis, row in enumerate(numbers(arm.linear(arm.end[:3, 3]))) if not all(map(is_zero, row))
    ]
    spins = [
        axis for axis, row in enumerate(numbers(arm.angular(arm.end[:3, :3]))) if not all(map(is_zero, row))
    ]
    turned = len(spins) == 1 and given[-1] not in "xyz"
    if len(given) == 4:
        axes = [0, 1, 2]
    elif len(given) == 3 and turned and len(moving) == 2:
        axes = moving
    else:
        axes, turned = (moving if len(given) == 2 else [0, 1, 2]), False
    coordinates = entries(arm.end[:3, 3])
    found = {name: coordinates[axis] for name, axis in zip(given, axes, strict=False)}
    if turned:
        first, second = (axis for axis in range(3) if axis != spins[0])
        column = next(j for j in range(3) if is_zero(T[spins[0], j]))
        found[given[-1]] = mpmath.atan2(T[second, column], T[first, column])
    return found


def _same(one: Number, other: Number, angle: bool, near: mpmath.mpf = NEAR) -> bool:
    """Whether two numbers are one; angles up to whole turns."""
    gap = floating(one) - floating(other)
    if angle:
        gap -= 2 * mpmath.pi * mpmath.nint(gap / (2 * mpmath.pi))
    return agree(gap, 0, max(1, abs(floating(other))), near)


def _met(asked: Asked, condition: str, there: Point) -> bool:
    """Whether a relation holds; what is said in words is not judged."""
    relation = RELATION.match(condition)
    if relation is None:
        return True
    try:
        left, right = (there.at(asked.read(side)) for side in (relation[1], relation[3]))
    except Unreadable:
        return True
    return bool(left > right) if relation[2] == ">" else bool(left < right)


def _told(numbers_by_name: Values) -> str:
    return ", ".join(f"{name} = {shown(value)}" for name, value in numbers_by_name.items())
