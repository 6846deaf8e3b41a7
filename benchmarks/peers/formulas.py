"""The textbook's formulas over any algebra with matrices, sines and `diff`: SymPy or symengine."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from benchmarks.cases import Asked
from benchmarks.peers import Point
from benchmarks.rows import Rows


@dataclass(frozen=True, slots=True)
class Row:
    """A row in symbols of the algebra; `q` is the joint variable."""

    theta: Any
    d: Any
    a: Any
    alpha: Any
    q: Any
    revolute: bool
    mass: Any
    com: Any
    inertia: Any


@dataclass(frozen=True, slots=True)
class Given:
    """`algebra` is the module: Matrix, eye, zeros, cos, sin, sympify, symbols."""

    algebra: Any
    rows: tuple[Row, ...]
    gravity: Any


@dataclass(frozen=True, slots=True)
class Answer:
    """D or J as a matrix, the Christoffel symbols and g."""

    matrix: Any
    c: dict[tuple[int, int, int], Any] = field(default_factory=dict)
    g: tuple[Any, ...] = ()


def read(rows: Rows, algebra: Any) -> Given:
    """Every name as a symbol, also those that mean something else in SymPy (gamma, I)."""

    def expr(text: str) -> Any:
        return algebra.sympify(text)

    def row(r: Any) -> Row:
        xx, yy, zz, xy, yz, xz = map(expr, r.weight.moments)
        inertia = algebra.Matrix([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        com = algebra.Matrix([[expr(x)] for x in r.weight.com])
        columns = map(expr, (r.theta, r.d, r.a, r.alpha, r.variable))
        return Row(*columns, r.joint == "revolute", expr(r.weight.mass), com, inertia)

    return Given(algebra, tuple(map(row, rows.rows)), algebra.Matrix([[expr(x)] for x in rows.gravity]))


def derive(given: Given, asked: Sequence[Asked], simplified: Callable[[Any], Any]) -> Answer:
    """Pose and Jacobian, or D, c_ijk, g (Spong et al., chapter 6); `simplified` meets every entry."""
    poses = poses_of(given)
    J = None
    if "jacobian" in asked:
        J = _jacobian(given, poses, poses[-1][:3, 3], len(given.rows)).applyfunc(simplified)
        pose = poses[-1].applyfunc(simplified)
        assert pose.shape == (4, 4)
    if "D" not in asked:
        return Answer(J)
    D, energy = _energies(given, poses)
    D = D.applyfunc(simplified)
    q = [row.q for row in given.rows]
    c = {ijk: simplified(value) for ijk, value in _christoffel(D, q).items()}
    return Answer(D, c, tuple(simplified(energy.diff(name)) for name in q))


def check(answer: Answer, point: Point, algebra: Any) -> float:
    """d_11 + d_1n, or the same entries of J."""
    entry = answer.matrix[0, 0] + answer.matrix[0, answer.matrix.shape[1] - 1]
    return float(algebra.sympify(entry).subs({algebra.Symbol(n): v for n, v in point.items()}))


def poses_of(given: Given) -> list[Any]:
    algebra = given.algebra
    poses = [algebra.eye(4)]
    for row in given.rows:
        c, s = algebra.cos(row.theta), algebra.sin(row.theta)
        ca, sa = algebra.cos(row.alpha), algebra.sin(row.alpha)
        local = [
            [c, -s * ca, s * sa, row.a * c],
            [s, c * ca, -c * sa, row.a * s],
            [0, sa, ca, row.d],
            [0, 0, 0, 1],
        ]
        poses.append(poses[-1] * algebra.Matrix(local))
    return poses


def _jacobian(given: Given, poses: list[Any], point: Any, last: int) -> Any:
    """6 by n of a point that moves with frame `last`."""
    columns = []
    for i, row in enumerate(given.rows):
        z, o = poses[i][:3, 2], poses[i][:3, 3]
        if i >= last:
            columns.append([0] * 6)
        elif row.revolute:
            columns.append([*_cross(z, point - o), *z])
        else:
            columns.append([*z, 0, 0, 0])
    return given.algebra.Matrix([list(entries) for entries in zip(*columns, strict=True)])


def _cross(u: Any, v: Any) -> list[Any]:
    return [u[j] * v[k] - u[k] * v[j] for j, k in ((1, 2), (2, 0), (0, 1))]


def _energies(given: Given, poses: list[Any]) -> tuple[Any, Any]:
    """(D, potential energy)."""
    n = len(given.rows)
    D, energy = given.algebra.zeros(n, n), given.algebra.sympify("0")
    for i, row in enumerate(given.rows, 1):
        R = poses[i][:3, :3]
        com = poses[i][:3, 3] + R * row.com
        J = _jacobian(given, poses, com, i)
        linear, angular = J[:3, :], J[3:, :]
        D = D + row.mass * linear.T * linear + angular.T * R * row.inertia * R.T * angular
        energy = energy - row.mass * (given.gravity.T * com)[0, 0]
    return D, energy


def _christoffel(D: Any, q: list[Any]) -> dict[tuple[int, int, int], Any]:
    n = len(q)
    d = [[[D[k, j].diff(q[i]) for j in range(n)] for k in range(n)] for i in range(n)]
    return {
        (i, j, k): (d[i][k][j] + d[j][k][i] - d[k][i][j]) / 2
        for i in range(n)
        for j in range(i, n)
        for k in range(n)
    }
