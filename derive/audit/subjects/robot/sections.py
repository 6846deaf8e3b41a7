"""Workspaces in section: distance and height from the poses, and what is told in numbers by the formulas that
were audited so, on a grid and by Newton's method."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import mpmath
import numpy as np
import sympy

from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.points import Point, floating, shown
from derive.audit.subjects.robot.arm import Arm, entries
from derive.audit.subjects.robot.series import Array, values
from derive.audit.subjects.robot.task import Task

GRID, FEWER, COARSE, STEPS = 500, 101, 40, 40
NEAR, TO_AXIS, SAME = 2e-3, 2e-2, 1e-4
ENDS = ("r_min", "r_max", "z_min", "z_max")


def in_section(asked: Asked, point: Point) -> Iterator[Test]:
    """rho^2, z and the determinant; then the numbers."""
    task = Task(Arm(asked, point, 1))
    J_v, J_w, p = values(task.whole[:3]), values(task.whole[3:]), np.array(entries(task.place), dtype=object)
    moving = [i for i in range(task.arm.n) if any(J_v[:, i])]
    w = J_w[:, moving[0]]
    o = p + np.cross(w, J_v[:, moving[0]])  # on the first axis, at the height of the point
    away = p - o
    yield Same("rho2", away @ away)
    if "z" in asked.results:
        yield Same("z", p @ w)
    if "det" in asked.results:
        yield Same("det", -2 * _triple(*(J_v[:, i] for i in moving)))
    yield from _numbers(asked)


def on_two_axes(asked: Asked, point: Point) -> Iterator[Test]:
    """The radius of the sphere on which a point stays, and to where it comes along the first axis."""
    task = Task(Arm(asked, point, 1))
    J_v, J_w, p = values(task.whole[:3]), values(task.whole[3:]), np.array(entries(task.place), dtype=object)
    one, other = (i for i in range(task.arm.n) if any(J_v[:, i]))
    (a, u), (b, v) = ((p + np.cross(J_w[:, i], J_v[:, i]), J_w[:, i]) for i in (one, other))
    across = np.cross(u, v)
    sine = across @ across
    center = a + u * ((np.cross(b - a, v) @ across) / sine)
    way = p - center
    lever = way @ v
    middle, swing = lever * (u @ v), mpmath.sqrt((way @ way - lever**2) * sine)
    told = {"r_min": mpmath.sqrt(way @ way), "r_max": mpmath.sqrt(way @ way)}
    told |= {"z_min": middle - swing, "z_max": middle + swing}
    for name, value in told.items():
        if name in asked.results:
            ours = asked.ours(name, point)
            yield Holds(name, abs(floating(ours) - value) < SAME, f"{shown(value)} is found")
    if "z_min" not in asked.results:
        whole = abs(swing - told["r_max"]) < SAME and abs(middle) < SAME
        yield Holds("description", bool(whole), "a part of the sphere is not reached")
    yield Holds("description", True, "")


def stays(asked: Asked, point: Point) -> Iterator[Test]:
    """A point that no joint moves."""
    moves = any(values(Task(Arm(asked, point, 1)).whole[:3]).ravel())
    yield Holds("description", not moves, "the point moves")
    for name in ("r_min", "r_max"):
        yield Same(name, 0)


def _triple(a: Array, b: Array, c: Array) -> Any:
    return a @ np.cross(b, c)


def _numbers(asked: Asked) -> Iterator[Test]:
    yield Holds("description", True, "")
    if "r_max" not in asked.results:
        return
    names = [
        link.variable for link in asked.subject.links
        if link.variable and sympy.Symbol(link.variable) in _letters(asked)
    ]  # fmt: skip
    f = _function(asked, names)
    count = GRID if len(names) < 3 else FEWER
    grid = np.meshgrid(*(np.linspace(*_limits(asked, name), count) for name in names), indexing="ij")
    rho, z = f(*grid)
    size = max(float(rho.max()), float(z.max() - z.min()))
    for name, met in zip(ENDS, (rho.min(), rho.max(), z.min(), z.max()), strict=True):
        near = TO_AXIS if name == "r_min" else NEAR
        for told in (name, f"evaluated {name}") if name in asked.results else ():
            value = float(asked.result(told))
            yield Holds(told, abs(value - float(met)) < near * size, f"a grid comes to {float(met):.6g}")
    for told in ("regions", "evaluated regions") if "regions" in asked.results else ():
        for row in asked.result(told):
            count = _count(f, [float(each) for each in row[:2]], [_limits(asked, name) for name in names])
            yield Holds(told, count == int(row[2]), f"Newton's method finds {count}")


def _letters(asked: Asked) -> set[sympy.Symbol]:
    told = (asked.result(name) for name in ("rho2", "z") if name in asked.results)
    return set().union(*(each.free_symbols for each in told))


def _limits(asked: Asked, name: str) -> tuple[float, float]:
    ends = asked.subject.ranges.get(name)
    if ends is None:
        return -np.pi, np.pi
    low, high = (float(asked.formula(each)) for each in ends)
    return low, high


def _function(asked: Asked, names: Sequence[str]) -> Callable[..., tuple[Any, Any]]:
    """(rho, z) of arrays, from our formulas with the author's values."""
    given = {sympy.Symbol(name): asked.formula(value) for name, value in (asked.evaluate or {}).items()}
    told = [asked.result("rho2"), asked.result("z") if "z" in asked.results else sympy.Integer(0)]
    parts = [each.subs(given) for each in told]
    made = sympy.lambdify([sympy.Symbol(name) for name in names], parts, "numpy")

    def found(*q: Any) -> tuple[Any, Any]:
        square, z = (np.broadcast_to(each, q[0].shape) for each in made(*q))
        return np.sqrt(np.maximum(square, 0.0)), z

    return found


def _count(f: Callable[..., Any], place: Sequence[float], limits: Sequence[tuple[float, float]]) -> int:
    """How many values of two joints lead to a place."""
    q = np.array([e.ravel() for e in np.meshgrid(*(np.linspace(*each, COARSE) for each in limits))])
    h = 1e-6
    for _ in range(STEPS):
        off = np.array(f(*q)) - np.array(place)[:, None]
        J = np.stack([(np.array(f(*(q + h * e))) - np.array(f(*(q - h * e)))) / (2 * h)
                      for e in np.eye(2)[:, :, None]], axis=1)  # fmt: skip
        det = J[0, 0] * J[1, 1] - J[0, 1] * J[1, 0]
        det = np.where(np.abs(det) < 1e-12, np.inf, det)
        step = np.array([J[1, 1] * off[0] - J[0, 1] * off[1], J[0, 0] * off[1] - J[1, 0] * off[0]]) / det
        q = q - step / np.maximum(1.0, np.abs(step).max(axis=0) / 0.3)
    near = np.abs(np.array(f(*q)) - np.array(place)[:, None]).max(axis=0) < 1e-8
    found: list[Any] = []
    for each in q[:, near].T:
        own = np.array([
            x - 2 * np.pi * np.floor((x - low) / (2 * np.pi)) if high - low > 6.28 else x
            for x, (low, high) in zip(each, limits, strict=True)
        ])  # fmt: skip
        inside = all(low <= x <= high for x, (low, high) in zip(own, limits, strict=True))
        apart = (np.abs((own - other + np.pi) % (2 * np.pi) - np.pi).max() > SAME for other in found)
        if inside and all(apart):
            found.append(own)
    return len(found)
