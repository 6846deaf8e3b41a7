"""How an arm moves: velocities and accelerations, and the joint rates that make them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import sympy

from derive.audit.asked import Asked, Same, Test
from derive.audit.linear import Rows, product, solve, transposed
from derive.audit.points import Number, Point
from derive.audit.subjects.robot.arm import Arm
from derive.audit.subjects.robot.series import Array, diff, values
from derive.audit.subjects.robot.task import ROWS, Task

RISES = dict(zip(ROWS, ("ax", "ay", "az", "alphax", "alphay", "alphaz"), strict=True))


def velocity(asked: Asked, point: Point) -> Iterator[Test]:
    """J times the rates."""
    task = Task(Arm(asked, point, 1))
    whole = values(task.whole) @ rates(task.arm)
    yield Same("v", whole[:3].tolist())
    yield Same("omega", whole[3:].tolist())


def rates(arm: Arm, order: str = "dot") -> Array:
    """The rates of the joint variables (n), or their accelerations."""
    return np.array([arm.point[f"{name}_{order}"] for name in arm.robot.variables], dtype=object)


def along(array: Array, rate: Array) -> Array:
    """The derivative of an array of series by time."""
    found: Array = sum(
        (values(diff(array, i)) * speed for i, speed in enumerate(rate)), np.zeros(array.shape, object)
    )
    return found


def jacobian_derivative(asked: Asked, point: Point) -> Iterator[Test]:
    """The derivative of J by time, and what it adds to the acceleration."""
    task = Task(Arm(asked, point))
    if asked.options.task:
        yield from _functions_derivative(asked, task.arm)
        return
    names = asked.options.rows or task.moving
    J_dot = along(task.rows(names), rates(task.arm))
    yield Same("J_dot", J_dot.tolist())
    yield Same("bias", (J_dot @ rates(task.arm)).tolist())


def _functions_derivative(asked: Asked, arm: Arm) -> Iterator[Test]:
    functions = [asked.formula(each) for each in asked.options.task]
    speeds = list(zip(arm.q, rates(arm), strict=True))
    zero = arm.point.number(0)
    J_dot = [
        [sum((arm.point.at(f.diff(q, p)) * u for p, u in speeds), zero) for q in arm.q] for f in functions
    ]
    yield Same("J_dot", J_dot)
    yield Same("bias", [_bend(arm, f) for f in functions])


def acceleration(asked: Asked, point: Point) -> Iterator[Test]:
    """J times the accelerations of the joints, and what its derivative makes of their rates."""
    task = Task(Arm(asked, point))
    J_dot = along(task.rows(ROWS), rates(task.arm))
    whole = values(task.rows(ROWS)) @ rates(task.arm, "ddot") + J_dot @ rates(task.arm)
    for name, letter in (("a", "v"), ("alpha", "w")):
        wanted = [row for row in asked.options.rows or ROWS if row[0] == letter]
        if wanted:
            yield Same(name, [whole[ROWS.index(row)] for row in wanted])


def inverse_velocity(asked: Asked, point: Point) -> Iterator[Test]:
    """qdot: of all that come nearest to v, the smallest."""
    arm = Arm(asked, point, 1)
    names, J = _wanted(asked, arm)
    if "J" in asked.results:
        yield Same("J", J)
    yield Same("qdot", nearest(J, [[point[name]] for name in names]))


def inverse_acceleration(asked: Asked, point: Point) -> Iterator[Test]:
    """qddot: the same of what the rates leave of the wanted acceleration."""
    arm = Arm(asked, point)
    names, J = _wanted(asked, arm)
    if asked.options.task:
        bias = [_bend(arm, asked.formula(each)) for each in asked.options.task]
        wanted = [point[name.replace("_dot", "_ddot")] for name in names]
    else:
        bias = list(along(Task(arm).rows(names), rates(arm)) @ rates(arm))
        wanted = [point[RISES[name]] for name in names]
    yield Same("qddot", nearest(J, [[a - h] for a, h in zip(wanted, bias, strict=True)]))


def _wanted(asked: Asked, arm: Arm) -> tuple[tuple[str, ...], Rows]:
    """The names of what is wanted, and the matrix that makes it of joint rates."""
    if not asked.options.task:
        task = Task(arm)
        return task.names, task.J
    functions = [asked.formula(each) for each in asked.options.task]
    names = tuple(f"r{k}_dot" for k, _ in enumerate(functions, 1))
    return names, [[arm.point.at(f.diff(q)) for q in arm.q] for f in functions]


def _bend(arm: Arm, function: sympy.Expr) -> Number:
    """The second derivative by time of a function while the joints keep their rates."""
    speeds = list(zip(arm.q, rates(arm), strict=True))
    terms = (arm.point.at(function.diff(p, q)) * u * v for p, u in speeds for q, v in speeds)
    return sum(terms, arm.point.number(0))


def nearest(J: Rows, v: Rows) -> list[Number]:
    """J^-1 v, or J^+ v."""
    m, n = len(J), len(J[0])
    if m == n:
        found = solve(J, v)
    elif m < n:
        found = product(transposed(J), solve(product(J, transposed(J)), v))
    else:
        found = solve(product(transposed(J), J), product(transposed(J), v))
    return [row[0] for row in found]
