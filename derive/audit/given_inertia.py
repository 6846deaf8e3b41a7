"""An inertia matrix without its arm: SymPy differentiates it, and Lagrange's equations judge the rest."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import sympy

from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.linear import rank
from derive.audit.points import Number, Point, agree, shown


@dataclass(frozen=True)
class Inertia:
    """The matrix of a sheet at a point."""

    asked: Asked
    point: Point

    @cached_property
    def D(self) -> sympy.Matrix:
        rows = self.asked.subject.value.rows
        return sympy.Matrix([[self.asked.formula(entry) for entry in row] for row in rows])

    @property
    def q(self) -> list[sympy.Symbol]:
        return [sympy.Symbol(name) for name in self.asked.subject.variables]

    def moving(self, dots: str) -> list[sympy.Symbol]:
        return [sympy.Symbol(f"{name}_{dots}") for name in self.asked.subject.variables]

    def rate(self, expr: sympy.Expr) -> sympy.Expr:
        """Its derivative by time."""
        known = [(name, rate) for name, rate in zip(self.q, self.moving("dot"), strict=True)]
        known += zip(self.moving("dot"), self.moving("ddot"), strict=True)
        return sympy.Add(*(expr.diff(name) * rate for name, rate in known))

    @cached_property
    def tau(self) -> list[sympy.Expr]:
        """d/dt dK/dqdot - dK/dq."""
        rates = sympy.Matrix(self.moving("dot"))
        K = (rates.T * self.D * rates)[0, 0] / 2
        return [self.rate(K.diff(rate)) - K.diff(name) for name, rate in zip(self.q, rates, strict=True)]

    def symbol(self, i: int, j: int, k: int) -> sympy.Expr:
        """c_ijk, indices from 0."""
        D, q = self.D, self.q
        return (D[k, j].diff(q[i]) + D[k, i].diff(q[j]) - D[i, j].diff(q[k])) / 2


def christoffel(asked: Asked, point: Point) -> Iterator[Test]:
    """Every c_ijk."""
    given = Inertia(asked, point)
    n = range(len(given.q))
    between = "," if len(n) > 9 else ""
    for i, j, k in ((i, j, k) for i in n for j in n for k in n):
        comma = between if max(i, j, k) > 8 else ""
        name = "c_" + comma.join(str(index + 1) for index in (i, j, k))
        yield Same(name, point.at(given.symbol(i, j, k)))


def properties(asked: Asked, point: Point) -> Iterator[Test]:
    """D_dot, C of Christoffel's symbols, D_dot - 2 C; the regressor."""
    given = Inertia(asked, point)
    n, rates = range(len(given.q)), given.moving("dot")
    D_dot = given.D.applyfunc(given.rate)
    C = sympy.Matrix([[sympy.Add(*(given.symbol(i, j, k) * rates[i] for i in n)) for j in n] for k in n])
    for name, value in (("D_dot", D_dot), ("C", C), ("N", D_dot - 2 * C)):
        yield Same(name, point.matrix(value.tolist()))
    if "Y" in asked.results:
        yield from _regressor(given)


def _regressor(given: Inertia) -> Iterator[Test]:
    """Y theta = tau, where the constants hold no joint variables and Y nothing else; no column is spare."""
    asked, point = given.asked, given.point
    Y, theta = sympy.Matrix(asked.result("Y")), asked.result("parameters")
    made = point.vector([*(Y * sympy.Matrix(theta))])
    right = all(agree(ours, other, other) for ours, other in zip(made, point.vector(given.tau), strict=True))
    moving = {*given.q, *given.moving("dot"), *given.moving("ddot")}
    apart = Y.free_symbols <= moving and not moving & set().union(*(each.free_symbols for each in theta))
    yield Holds("parameters", right and apart, f"Y parameters is {shown(made)}")
    yield Holds("Y", right and apart and _independent(given, Y), "a matrix with independent columns")


def _independent(given: Inertia, Y: sympy.Matrix) -> bool:
    rows: list[list[Number]] = []
    here = given.point
    for seed in range(100, 100 + Y.shape[1] + 2):
        rows += Point(seed, here.exact, here.angles, here.assumptions, here.fixed).matrix(Y.tolist())
    return bool(rank(rows) == Y.shape[1])
