"""State equations: C (s I - A)^-1 B + D is the transfer function."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from derive.audit.algebra import determinant
from derive.audit.asked import EVALUATED, Asked, Holds, Test
from derive.audit.linear import product, solve
from derive.audit.points import Point
from derive.audit.putting_back import put_back
from derive.audit.subjects.system.plant import Plant, S, sympified
from derive.audit.subjects.system.rationals import roots, same_roots

DIFFER = "C (s I - A)^-1 B + D is not the transfer function"


def state_space(asked: Asked, point: Point) -> Iterator[Test]:
    """At a point, s a number there."""
    plant = Plant(asked)
    A, B, C, D = (point.matrix(asked.result(name)) for name in "ABCD")
    s = point.at(S)
    x = solve([[s * (i == j) - a for j, a in enumerate(row)] for i, row in enumerate(A)], B)
    ours = product(C, x)[0][0] + D[0][0]
    theirs = plant.transfer(point).subs(S, sympified(point, S))
    for name in "ABCD":
        yield put_back(name, point, ours, theirs, DIFFER)
    if "poles" in asked.evaluated:
        A = sympy.Matrix(asked.result("A")).applyfunc(lambda entry: sympified(asked.here, entry))
        eigenvalues = roots(sympy.Poly(determinant(S * sympy.eye(A.rows) - A, S), S))
        right = same_roots(asked.evaluated["poles"], eigenvalues)
        yield Holds(EVALUATED + "poles", right, "the eigenvalues of A are others")
