"""roboticstoolbox-python with symbols: its recursive Newton-Euler at unit accelerations and rates."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Any

import numpy
import sympy
from roboticstoolbox import DHRobot, PrismaticDH, RevoluteDH

from benchmarks.cases import Asked
from benchmarks.peers import Point, formulas
from benchmarks.rows import Row, rows_of
from derive.mechanics.robot import Robot

Given = tuple[Any, list[Any]]


def given(robot: Robot) -> Given:
    """(its robot, joint variables). Its gravity is the acceleration of free fall with the sign reversed."""
    rows = rows_of(robot)
    links = [_link(row) for row in rows.rows]
    gravity = [sympy.sympify(x) for x in rows.gravity]
    return DHRobot(links, gravity=numpy.array(gravity)), [sympy.Symbol(name) for name in rows.variables]


def derive(given: Given, asked: Sequence[Asked]) -> formulas.Answer:
    """D from unit accelerations, c_ijk from single and paired unit rates, g from rest."""
    robot, q = given
    J = None
    if "jacobian" in asked:
        pose = robot.fkine(q)
        J = robot.jacob0(q)
        assert pose.A.shape == (4, 4)
    if "D" not in asked:
        return formulas.Answer(J)
    n, none, still = len(q), numpy.zeros(3), [sympy.Integer(0)] * len(q)
    unit = [[sympy.Integer(int(i == j)) for j in range(n)] for i in range(n)]
    D = numpy.array([robot.rne_python(q, still, unit[i], gravity=none) for i in range(n)])
    squares = [robot.rne_python(q, unit[i], still, gravity=none) for i in range(n)]
    c = {(i, i): squares[i] for i in range(n)}
    for i, j in combinations(range(n), 2):
        both = [a + b for a, b in zip(unit[i], unit[j], strict=True)]
        c[i, j] = (robot.rne_python(q, both, still, gravity=none) - squares[i] - squares[j]) / 2
    symbols = {(i, j, k): tau for (i, j), torques in c.items() for k, tau in enumerate(torques)}
    return formulas.Answer(D, symbols, tuple(robot.rne_python(q, still, still)))


def check(answer: formulas.Answer, point: Point) -> float:
    return formulas.check(answer, point, sympy)


def _link(row: Row) -> Any:
    expr = sympy.sympify
    xx, yy, zz, xy, yz, xz = map(expr, row.weight.moments)
    body = {
        "m": expr(row.weight.mass),
        "r": [expr(x) for x in row.weight.com],
        "I": [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
    }
    a, alpha = expr(row.a), expr(row.alpha)
    if row.joint == "revolute":
        return RevoluteDH(d=expr(row.d), a=a, alpha=alpha, **body)
    return PrismaticDH(theta=expr(row.theta), a=a, alpha=alpha, **body)
