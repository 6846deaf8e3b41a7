"""State equations: C (s I - A)^-1 B + D is the transfer function."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from derive.audit.asked import EVALUATED, Asked, Holds, Test
from derive.audit.points import Point
from derive.audit.putting_back import put_back
from derive.audit.subjects.system.plant import Plant, S, sympified
from derive.audit.subjects.system.rationals import roots, same_roots

DIFFER = "C (s I - A)^-1 B + D is not the transfer function"


def state_space(asked: Asked, point: Point) -> Iterator[Test]:
    """At a point, s a number there."""
    plant = Plant(asked)
    A, B, C, D = (_numbers(asked.result(name), point) for name in "ABCD")
    x = (sympified(point, S) * sympy.eye(A.rows) - A).LUsolve(B)
    (ours,) = C * x + D
    theirs = plant.transfer(plant.at(point)).subs(S, sympified(point, S))
    for name in "ABCD":
        yield put_back(name, point, ours, theirs, DIFFER)
    if "poles" in asked.evaluated:
        at_rest = _numbers(asked.result("A"), asked.here)
        eigenvalues = roots(sympy.Poly(at_rest.charpoly(S).as_expr(), S))
        right = same_roots(asked.evaluated["poles"], eigenvalues)
        yield Holds(EVALUATED + "poles", right, "the eigenvalues of A are others")


def _numbers(entries: list[list[sympy.Expr]], point: Point) -> sympy.Matrix:
    return sympy.Matrix([[sympified(point, entry) for entry in row] for row in entries])
