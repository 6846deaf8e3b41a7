"""Where an arm is singular, and how well it moves elsewhere."""

from __future__ import annotations

from collections.abc import Iterator

import mpmath

from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.points import Irrational, Point, agree, shown
from derive.audit.putting_back import put_back
from derive.audit.singular_sets import ZERO, singular_sets, size
from derive.audit.subjects.robot.arm import Arm
from derive.audit.subjects.robot.task import Task


def singularities(asked: Asked, point: Point) -> Iterator[Test]:
    """det J and its zeros, set by set."""
    names = Task(Arm(asked, point, 1)).names
    yield from singular_sets(asked, point, lambda at: Task(Arm(asked, at, 1)).rows_in(names))


def manipulability(asked: Asked, point: Point) -> Iterator[Test]:
    """w; the semi-axes of both ellipsoids where numbers are given, by the eigenvectors of J J^T."""
    task = Task(Arm(asked, point, 1))
    square = len(task.J) == len(task.J[0])
    if point.exact and not square:
        raise Irrational
    yield Same("w", abs(size(task.J)) if square else mpmath.sqrt(size(task.J)))
    if "axes" not in asked.results:
        return
    if point.exact:
        raise Irrational
    fixed = {name: asked.formula(value) for name, value in asked.options.evaluate}
    J = mpmath.matrix(Task(Arm(asked, point.where(**fixed), 1)).rows_in(task.names))
    eigenvalues, vectors = mpmath.eigsy(J * J.T)
    sizes = [mpmath.sqrt(abs(value)) for value in eigenvalues][::-1]
    order = list(range(len(sizes)))[::-1]
    yield Same("axes", sizes)
    forces = asked.results["force_axes"]
    for told, each in zip(forces if isinstance(forces, list) else [], reversed(sizes), strict=True):
        if each <= ZERO:
            yield Holds("force_axes", told == "infinite", "a force there is infinite")
        else:
            yield put_back("force_axes", point, asked.read(told), 1 / each, f"it is {shown(1 / each)}")
    for name, expected in (("directions", order), ("force_directions", order[::-1])):
        ours = point.matrix(asked.result(name))
        for k, direction in zip(expected, ours, strict=True):
            part = [vectors[i, k] for i in range(len(sizes))]
            along = sum(a * b for a, b in zip(part, direction, strict=True))
            alone = sum(abs(other - sizes[order.index(k)]) < 1e-6 for other in sizes) == 1
            right = agree(abs(along), 1, 1, mpmath.mpf(10) ** -9) or not alone
            yield Holds(name, right, f"{shown(part)} is one of them")
