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
import sympy

from derive.audit.asked import Asked, Beyond, Holds, Test
from derive.audit.linear import is_zero
from derive.audit.points import Irrational, Number, Point, agree, floating, shown
from derive.audit.subjects.robot.arm import Arm, entries, numbers
from derive.audit.subjects.robot.arm_angle import JOINTS, arm_angle
from derive.audit.subjects.robot.series import values
from derive.audit.text import Json, Unreadable

Values: TypeAlias = dict[str, Number]
DEGREE = 4  # of Pieper's polynomial
PLACES = 3  # configurations at each point
NEAR = mpmath.mpf(10) ** -25
ROUNDED_STEP = mpmath.mpf(10) ** -6  # of floats, where a formula turns on a square root
TENFOLD = 10  # of the rounding of a pose
TURN = mpmath.mpf(3) / 10
RELATION = re.compile(r"^([^<>=]+?) ([<>]) ([^<>=]+)$")


def inverse_kinematics(asked: Asked, point: Point) -> Iterator[Test]:
    """Every branch, at some configurations; lengths that slide are drawn positive."""
    if point.exact:
        raise Irrational
    if _are_numbers(asked):
        if "polynomial" in asked.results:
            yield from at_a_pose(asked)
        yield Holds("solutions", True, "")  # they are those under evaluated
        yield from in_numbers(asked, point)
        return
    robot = asked.subject
    slides = {link.variable: "positive" for link in robot.links if link.joint == "prismatic"}
    for k in range(PLACES):
        seed = 1000 * (k + 1) + point.seed
        here = Point(seed, False, point.angles, {**point.assumptions, **slides})
        yield from _branches(asked, here)
    if "order" in asked.results:
        yield Holds("order", True, "")
    if asked.evaluated:
        yield from in_numbers(asked, point)


def _branches(asked: Asked, here: Point) -> Iterator[Test]:
    arm = Arm(asked, here, 1)
    target, q = goal(asked, arm), {name: here[name] for name in arm.robot.variables}
    found = False
    places = with_roots(asked, here.where(**target))
    if "quartic" in asked.results:
        yield Holds("quartic", bool(places), "it has a real root where the arm stands")
    for known, (k, branch) in product(places, enumerate(asked.objects("solutions"), 1)):
        name = f"solutions[{k}]"
        there = branch_values(asked, branch, known, q)
        if there is None:
            continue
        joints = {joint: there[joint] for joint in q}
        reached = goal(asked, Arm(asked, here.where(**joints), 1))
        if branch.get("true_at", True):
            said = f"{name} brings it to {told(reached)}, not {told(target)}"
            yield Holds("solutions", reaches(asked, reached, target), said)
        for condition in str(branch["when"]).split(", "):
            yield Holds("solutions", _met(asked, condition, known.where(**there)), f"{name}: not {condition}")
        found = found or all(same(joints[joint], q[joint], joint in here.angles) for joint in q)
    yield Holds(
        "solutions", found, f"a branch {told(q)} is missing where the end-effector is at {told(target)}"
    )


def in_numbers(asked: Asked, point: Point) -> Iterator[Test]:
    """What is told at the point that the author gave: each branch brings the end-effector there, and none of
    the formulas' is left out; where letters are left the formulas are compared."""
    here = asked.here
    q = {name: here[name] for name in asked.subject.variables}
    formulas = [
        branch_values(asked, branch, place, q)
        for place, branch in product(with_roots(asked, here), asked.objects("solutions"))
    ]
    branches = asked.objects("evaluated solutions")
    tolds = [
        branch_values(asked, branch, here, q) if branch.get("real", True) else None for branch in branches
    ]
    target = {name: here[name] for name in goal(asked, Arm(asked, here, 1))}
    for branch, values_told in zip(branches, tolds, strict=True):
        if values_told is not None and "feasible" in branch:
            inside = all(_is_inside(asked, here, name, values_told[name]) for name in asked.subject.ranges)
            yield Holds(
                "evaluated solutions", inside == branch["feasible"], f"{told(values_told)} is feasible"
            )
    near = ROUNDED_STEP + TENFOLD * _rounding(target)
    tried = 0
    for branch, values_told in zip(branches, tolds, strict=True):
        if values_told is None:
            continue
        for moved in _along(branch, {joint: values_told[joint] for joint in q}):
            reached = goal(asked, Arm(asked, here.where(**moved), 1))
            right = not branch.get("true_at", True) or reaches(asked, reached, target, near)
            tried += 1
            yield Holds("evaluated solutions", right, f"{told(moved)} brings it to {told(reached)}")
    free = any("free" in branch for branch in branches)
    for formula in formulas:  # one that divides zero by zero there leads elsewhere
        if formula is not None and not free and _leads(asked, here, formula, q, target):
            found = any(
                other is not None
                and all(
                    same(other[joint], formula[joint], joint in point.angles, ROUNDED_STEP) for joint in q
                )
                for other in tolds
            )
            yield Holds("evaluated solutions", found, f"{told(formula)} is one of them")
    if not tried and any(formula is not None for formula in formulas):
        yield Holds("evaluated solutions", False, "a branch is real there")
    if not tried and all(formula is None for formula in formulas):  # out of reach
        real = any(branch.get("real", True) for branch in branches)
        if real and any(isinstance(branch.get(joint), str) for branch in branches for joint in q):
            yield Beyond("evaluated solutions", "none is real at the values drawn for its letters")
        else:
            yield Holds("evaluated solutions", not real, "none is real there")
    elif not tried:
        yield Beyond("evaluated solutions", "none is tried there")


def with_roots(asked: Asked, known: Point) -> list[Point]:
    """The point with each real root of the polynomial that the solutions rest on; itself without one."""
    if "quartic" not in asked.results:
        return [known]
    polynomial = asked.result("quartic")
    branch = asked.objects("solutions")[0]
    angles = [asked.read(branch[name]) for name in asked.subject.variables]
    (root,) = {each.args[0] for angle in angles for each in angle.atoms(sympy.atan)}
    tried = range(-DEGREE // 2, DEGREE // 2 + 1)
    there = [floating(known.where(**{root.name: sympy.Integer(each)}).at(polynomial)) for each in tried]
    powers = mpmath.matrix([[mpmath.mpf(each) ** n for n in range(DEGREE, -1, -1)] for each in tried])
    coefficients = list(mpmath.lu_solve(powers, mpmath.matrix(there)))
    half_turn = is_zero(coefficients[0], max(map(abs, coefficients)))
    found = mpmath.polyroots(coefficients[half_turn:], maxsteps=200, extraprec=200)
    real = [each.real for each in found if is_zero(each.imag, max(1, abs(each.real)))]
    real += [mpmath.inf] if half_turn else []
    return [known.where(**{root.name: each}) for each in real]


def _are_numbers(asked: Asked) -> bool:
    """Whether the solutions are those of one pose."""
    branches = asked.objects("solutions")
    values = [(name, asked.read(branch[name])) for branch in branches for name in asked.subject.variables]
    return all(value.is_number or value == sympy.Symbol(name) for name, value in values)


def _rounding(target: Values) -> Number:
    """How far what is typed as a rotation is from one."""
    names = [[f"r{i}{j}" for j in (1, 2, 3)] for i in (1, 2, 3)]
    if not all(name in target for row in names for name in row):
        return mpmath.mpf(0)
    R = mpmath.matrix([[floating(target[name]) for name in row] for row in names])
    off = R * R.T - mpmath.eye(3)
    return max(abs(off[i, j]) for i, j in product(range(3), repeat=2))


def at_a_pose(asked: Asked) -> Iterator[Test]:
    """Solutions that were found in numbers, and the root of the polynomial that each belongs to."""
    polynomial = asked.result("polynomial")
    (root,) = polynomial.free_symbols
    coefficients = [floating(asked.here.at(each)) for each in sympy.Poly(polynomial, root).all_coeffs()]
    found = mpmath.polyroots(coefficients, maxsteps=500, extraprec=500)
    real = [each.real for each in found if is_zero(each.imag, 1)]
    told_roots = {str(entry[root.name]) for entry in asked.objects("evaluated solutions")}
    for x in map(mpmath.mpf, told_roots):
        near = any(abs(x - each) < ROUNDED_STEP * max(1, abs(x)) for each in real)
        yield Holds("polynomial", near, f"{root} = {shown(x)} is no root")
    yield Holds("polynomial", bool(told_roots) or not real, "it has a root")
    yield Holds("solutions", len(told_roots) == len(real), f"{len(real)} roots are real")


def _is_inside(asked: Asked, here: Point, name: str, value: Number) -> bool:
    """Whether a joint value, of an angle by any number of turns, lies between the limits of its joint."""
    low, high = (mpmath.re(floating(here.at(asked.formula(end)))) for end in asked.subject.ranges[name])
    turns = [2 * mpmath.pi * k for k in range(-4, 5)] if name in _turning(asked) else [0]
    return any(low - ROUNDED_STEP <= mpmath.re(value) + turn <= high + ROUNDED_STEP for turn in turns)


def _turning(asked: Asked) -> frozenset[str]:
    return frozenset(link.variable for link in asked.subject.links if link.joint == "revolute")


def _leads(asked: Asked, here: Point, branch: Values, q: Values, target: Values) -> bool:
    """Whether a branch brings the end-effector to its place."""
    reached = goal(asked, Arm(asked, here.where(**{joint: branch[joint] for joint in q}), 1))
    return reaches(asked, reached, target, ROUNDED_STEP)


def _along(branch: Mapping[str, Json], joints: Values) -> Iterator[Values]:
    """The joints as they are told, and where joints are free another choice, with their sums as they are."""
    yield joints
    free, fixed = branch.get("free"), branch.get("fixed")
    if not isinstance(free, list) or not isinstance(fixed, Mapping):
        return
    names = list(map(str, free))
    if not fixed:
        yield {**joints, names[0]: joints[names[0]] + TURN}
    elif len(names) == 2 and len(fixed) == 1:
        back = TURN if " - " in next(iter(fixed)) else -TURN
        yield {**joints, names[0]: joints[names[0]] + TURN, names[1]: joints[names[1]] + back}


def branch_values(asked: Asked, branch: Mapping[str, Json], known: Point, q: Values) -> Values | None:
    """The values of a branch, found in turn; of joints that are left free, or stand for themselves, those of
    q. None where it is not real."""
    names = asked.results.get("order") or [name for name in branch if name in q]
    there: Values = {}
    if not isinstance(names, list):
        raise Unreadable("the order is no list")
    free = {name: value for name, value in q.items() if branch.get(name, name) == name}
    for name in map(str, names):
        if name not in branch or name in free:
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
        if given == "orientation":
            return found
        return {**found, **dict(zip("xyz", T[:3, 3], strict=True)), **_swing(asked, arm)}
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


def _swing(asked: Asked, arm: Arm) -> Values:
    """The arm angle of seven joints, none of which is chosen."""
    robot, free = asked.subject, asked.options.free
    if len(robot.variables) != JOINTS or set(free) & set(robot.variables):
        return {}
    return {free[0] if free else "psi": arm_angle(arm)}


def reaches(asked: Asked, reached: Values, target: Values, near: mpmath.mpf = NEAR) -> bool:
    """Whether the end-effector is where it should be; the angle of a plane counts up to whole turns."""
    angle = asked.options.given[-1] if len(asked.options.given) in (3, 4) else ""
    return all(
        same(reached[each], target[each], each == angle and each not in "xyz", near) for each in target
    )


def same(one: Number, other: Number, angle: bool, near: mpmath.mpf = NEAR) -> bool:
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


def told(numbers_by_name: Values) -> str:
    return ", ".join(f"{name} = {shown(value)}" for name, value in numbers_by_name.items())
