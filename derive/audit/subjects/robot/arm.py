"""An arm at one configuration: its poses as power series in the joint variables, and their derivatives."""

from __future__ import annotations

from functools import cache, cached_property

import numpy as np
import sympy

from derive.audit.asked import Asked
from derive.audit.points import Number, Point
from derive.audit.subjects.robot.displacements import fixed_pose, moved, row_matrix
from derive.audit.subjects.robot.series import Array, Monomial, Series, diff, values
from derive.expression import Expr
from derive.mechanics.robot import Robot

ORDER = 2


class Arm:
    """The robot of a question where its joints are as a point says."""

    def __init__(self, asked: Asked, point: Point, order: int = ORDER) -> None:
        self.asked, self.point, self.order = asked, point, order
        self.robot: Robot = asked.subject
        self.n = len(self.robot.variables)
        self.q = tuple(sympy.Symbol(name) for name in self.robot.variables)

    # -- formulas as series ------------------------------------------------------------------------

    def formula(self, tree: Expr) -> sympy.Expr:
        """A formula of the records."""
        return self.asked.formula(tree)

    def series(self, tree: Expr) -> Series:
        """A formula about this configuration."""
        return self.exact(self.formula(tree))

    def exact(self, expr: sympy.Expr) -> Series:
        """A SymPy expression about this configuration (Taylor)."""
        return self._changes(expr) + self.point.at(expr)

    def turn(self, tree: Expr) -> tuple[Series, Series]:
        """Cosine and sine of an angle."""
        return self.turned(self.formula(tree))

    def turned(self, angle: sympy.Expr) -> tuple[Series, Series]:
        """The same of an expression: c - s x - c x^2/2 and s + c x - s x^2/2 for the change x of it."""
        (c, s), x = self.point.turn(angle), self._changes(angle)
        return c + -s * x + -c * (x * x / 2), s + c * x + -s * (x * x / 2)

    def _changes(self, expr: sympy.Expr) -> Series:
        """The series without its constant."""
        terms = {powers: self.point.at(term) for powers, term in _changes(expr, self.q)}
        return Series(terms, self.order)

    # -- poses -------------------------------------------------------------------------------------

    @cached_property
    def local(self) -> list[Array]:
        """Frame i-1 to frame i, for each row; of screws e^{[S] q}."""
        return [self.row(i) for i in range(len(self.robot.links))]

    def row(self, i: int) -> Array:
        """The same for row i, counted from 0, alone."""
        return row_matrix(self.robot.links[i].row, self.robot.convention, self)

    @cached_property
    def base(self) -> Array:
        """Frame 0 in the base frame."""
        return moved(self.robot.base, self)

    @cached_property
    def poses(self) -> list[Array]:
        """Frame 0, 1, ..., n in the base frame."""
        found = [self.base]
        for T in self.local:
            found.append(found[-1] @ T)
        return found

    @cached_property
    def tool(self) -> Array:
        """The end-effector in the last frame."""
        tool = moved(self.robot.tool, self)
        return tool if self.robot.home is None else fixed_pose(self.robot.home, self) @ tool

    @cached_property
    def end(self) -> Array:
        """The end-effector in the base frame."""
        found: Array = self.poses[-1] @ self.tool
        return found

    def carried(self, p: Array, frame: int | None = None) -> Array:
        """A point of a frame, of the end-effector where none is given, in the base frame (3 series); from
        row to row, as no pose is needed for it."""
        ends = [self.tool] if frame is None else []
        for T in reversed([self.base, *self.local[:frame], *ends]):
            p = T[:3, :3] @ p + T[:3, 3]
        return p

    # -- velocities --------------------------------------------------------------------------------

    def linear(self, p: Array) -> Array:
        """J_v (3 by n) of a point: the derivatives of its place (3 series)."""
        return np.array([diff(p, i) for i in range(self.n)], dtype=object).T.reshape(3, self.n)

    def angular(self, R: Array) -> Array:
        """J_w (3 by n): w_i is read out of dR/dq_i R^T, which is [w_i]."""
        columns = []
        for i in range(self.n):
            S = diff(R, i) @ R.T
            columns.append([S[2, 1], S[0, 2], S[1, 0]])
        return np.array(columns, dtype=object).T.reshape(3, self.n)

    def jacobian(self, T: Array, p: Array | None = None) -> Array:
        """J (6 by n) of a body with pose T, and of a point p (base frame) of it, its origin if left out."""
        return np.vstack([self.linear(T[:3, 3] if p is None else p), self.angular(T[:3, :3])])


@cache
def _changes(expr: sympy.Expr, q: tuple[sympy.Symbol, ...]) -> tuple[tuple[Monomial, sympy.Expr], ...]:
    """The coefficients of its Taylor series in the joint variables, without the constant one."""
    found: list[tuple[Monomial, sympy.Expr]] = []
    moving = [i for i, each in enumerate(q) if expr.has(each)]
    for i in moving:
        slope = expr.diff(q[i])
        found.append(((i,), slope))
        for j in moving:
            if i <= j:
                found.append(((i, j), slope.diff(q[j]) / (2 if i == j else 1)))
    return tuple(found)


def numbers(matrix: Array) -> list[list[Number]]:
    """A matrix of series at the configuration itself, as rows."""
    found: list[list[Number]] = values(matrix).tolist()
    return found


def entries(vector: Array) -> list[Number]:
    """A vector of series at the configuration itself."""
    found: list[Number] = values(vector).tolist()
    return found
