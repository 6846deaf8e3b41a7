"""Numerical inverse kinematics: each row of the table follows from the one before, at 60 digits."""

from __future__ import annotations

from collections.abc import Iterator

import mpmath

from derive.audit.asked import Asked, Holds, Test
from derive.audit.points import Irrational, Number, Point, agree, shown
from derive.audit.subjects.robot.arm import Arm, entries
from derive.audit.subjects.robot.task import ROWS, Task

NEAR = mpmath.mpf(10) ** -8  # of floats after a step
NONE = mpmath.mpf(10) ** -9  # an error that is none


def numerical_inverse_kinematics(asked: Asked, point: Point) -> Iterator[Test]:
    """The start, the steps by Newton's method or down the slope of H = |e|^2/2, the errors and the end."""
    if point.exact:
        raise Irrational
    options = asked.options
    fixed = {name: asked.formula(value) for name, value in (*(options.evaluate or ()), *options.start)}
    place = point.where(**fixed)
    rows = [[point.at(entry) for entry in row] for row in asked.result("iterations")]
    variables = asked.subject.variables
    start = [place[name] for name in variables]
    yield Holds("iterations", _close(rows[0][1:-2], start), f"the start is {shown(start)}")
    target = [place.at(asked.formula(part)) for part in options.target]
    for k, row in enumerate(rows):
        q = row[1:-2]
        error, J = _error(asked, place.where(**dict(zip(variables, q, strict=True))), target)
        size = mpmath.norm(error)
        told = [k, *q, size, size**2 / 2]
        yield Holds("iterations", _close(row, told, NONE), f"row {k} is {shown(told)}")
        if k + 1 < len(rows):
            step = (
                _newton(J, error) if options.method == "newton" else _descent(J, error, _step(asked, place))
            )
            after = [a + b for a, b in zip(q, step, strict=True)]
            right = _close(rows[k + 1][1:-2], after)
            yield Holds("iterations", right, f"the step after row {k} leads to {shown(after)}")
    yield Holds("solution", _close(asked.ours("solution", point), rows[-1][1:-2]), "the last row")
    ended = len(rows) == options.iterations + 1 or _ended(asked, place, rows[-1][1:-2], target)
    yield Holds("iterations", ended, "it ends too early")


def _close(ours: object, theirs: list[Number], least: mpmath.mpf = NEAR) -> bool:
    if not isinstance(ours, list) or len(ours) != len(theirs):
        return False
    scale = max(1, *map(abs, theirs))
    return all(agree(a, b, scale, max(NEAR, least)) for a, b in zip(ours, theirs, strict=True))


def _error(asked: Asked, there: Point, target: list[Number]) -> tuple[mpmath.matrix, mpmath.matrix]:
    """Where the end-effector should be, less where it is; and the rows of J for these coordinates."""
    task = Task(Arm(asked, there, 1))
    linear = [row for row, moves in zip(ROWS[:3], _moves(asked, there), strict=True) if moves]
    names = tuple(linear) if len(linear) == len(target) else (*linear, "wz")
    place = dict(zip(ROWS, entries(task.place), strict=False))
    reached = [place[name] if name != "wz" else _turn(asked, there) for name in names]
    if len(reached) != len(target):
        raise NotImplementedError("the coordinates of the target are not known")
    error = mpmath.matrix([a - b for a, b in zip(target, reached, strict=True)])
    return error, mpmath.matrix(task.rows_in(names))


def _moves(asked: Asked, there: Point) -> list[bool]:
    """Which coordinates of the end-effector change, asked at a random configuration."""
    free = {name: value for name, value in there.fixed.items() if name not in asked.subject.variables}
    task = Task(Arm(asked, Point(77, False, there.angles, there.assumptions, free), 1))
    return [name in task.moving for name in ROWS[:3]]


def _turn(asked: Asked, there: Point) -> Number:
    """The angle of the last link of an arm in its plane: the sum of what its joints turn."""
    turning = [link.variable for link in asked.subject.links if link.joint == "revolute"]
    return sum(there[name] for name in turning)


def _step(asked: Asked, place: Point) -> Number | None:
    return None if asked.options.step is None else place.at(asked.formula(asked.options.step))


def _newton(J: mpmath.matrix, error: mpmath.matrix) -> mpmath.matrix:
    """J^-1 e; the least step where there are more joints, the least error where there are fewer."""
    if J.rows <= J.cols:
        return J.T * mpmath.lu_solve(J * J.T, error)
    return mpmath.lu_solve(J.T * J, J.T * error)


def _descent(J: mpmath.matrix, error: mpmath.matrix, step: Number | None) -> mpmath.matrix:
    """alpha J^T e, with the alpha that is best for a linear f where none is given."""
    slope = J.T * error
    if step is None:
        change = J * slope
        step = (slope.T * slope)[0] / (change.T * change)[0]
    return slope * step


def _ended(asked: Asked, place: Point, q: list[Number], target: list[Number]) -> bool:
    """Whether there is a reason to stop: no error left, a singular J, or no slope."""
    error, J = _error(asked, place.where(**dict(zip(asked.subject.variables, q, strict=True))), target)
    if mpmath.norm(error) < NONE:
        return True
    if asked.options.method == "newton":
        values = mpmath.svd_r(J, compute_uv=False)
        return bool(min(values) < NEAR * max(values))
    return bool(mpmath.norm(J.T * error) < NONE * mpmath.norm(error))
