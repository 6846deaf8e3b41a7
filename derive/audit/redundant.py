"""Joint rates of a redundant matrix in numbers: pseudo-inverses by its columns, priorities, limits."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import mpmath
import sympy

from derive.audit.asked import Asked, Holds, Test
from derive.audit.linear import Rows, eliminated, inverse, product, rank, solve, transposed
from derive.audit.points import ROUNDED, Point, floating

Columns = list[list[Any]]


def rates(
    asked: Asked, J: Rows, there: Point, names: tuple[str, ...], joints: tuple[str, ...], other: Rows
) -> Iterator[Test]:
    """qdot of the method that was asked for, and the matrices that give it. `names` are those of the wanted
    velocities, `joints` the variables, `other` is the matrix of a second task."""
    options = asked.options
    wanted = options.velocity
    v = [[there[name]] for name in names] if wanted is None else _column(asked, wanted, there)
    if options.method == "within-limits":
        yield from _within(asked, J, v, there)
        return
    if options.method == "extended":
        v_s = _rate(asked, other, there)
        whole = [*J, *other]
        yield _same(asked, there, "J_e", whole)
        yield _same(asked, there, "qdot", solve(whole, [*v, *v_s]))
        return
    X = _inverse(asked, J, there)
    yield _same(asked, there, "J_pinv", X)
    u = product(X, v)
    P = _less(_one(len(joints)), product(X, J))
    if options.method != "damped":
        yield _same(asked, there, "P", P)
    if options.method == "null-space":
        start = _start(asked, there, joints)
        u = _plus(u, product(P, start))
    if options.method == "task-priority":
        left = _less(_rate(asked, other, there), product(other, u))
        u = _plus(u, product(pseudo_inverse(product(other, P)), left))
    yield _same(asked, there, "qdot", u)


def pseudo_inverse(J: Rows) -> Columns:
    """J = C E with independent columns in C: E^T (E E^T)^-1 (C^T C)^-1 C^T."""
    _, pivots, _ = eliminated(J, len(J[0]))
    if not pivots:
        return [[0 for _ in J] for _ in J[0]]
    C = [[row[k] for k in pivots] for row in J]
    C_T = transposed(C)
    left = solve(product(C_T, C), C_T)
    E = product(left, J)
    return product(transposed(E), solve(product(E, transposed(E)), left))


def _inverse(asked: Asked, J: Rows, there: Point) -> Columns:
    options, J_T = asked.options, transposed(J)
    if options.method == "weighted":
        weights = [row[0] for row in _column(asked, options.weights, there)]
        back = [[entry / w for entry in row] for row, w in zip(J_T, weights, strict=True)]
        return product(back, inverse(product(J, back)))
    if options.method == "damped":
        damping = there.at(asked.formula(options.damping))
        square = product(J_T, J)
        for k, row in enumerate(square):
            row[k] = row[k] + damping * damping
        return solve(square, J_T)
    return pseudo_inverse(J)


def _start(asked: Asked, there: Point, joints: tuple[str, ...]) -> Columns:
    gradient = asked.options.gradient
    if isinstance(gradient, tuple):
        return _column(asked, gradient, there)
    function = asked.formula(gradient)
    return [[there.at(function.diff(sympy.Symbol(name)))] for name in joints]


def _rate(asked: Asked, other: Rows, there: Point) -> Columns:
    given = asked.options.second.rate
    return _column(asked, given, there) if given else [[there.number(0)] for _ in other]


def _within(asked: Asked, J: Rows, v: Columns, there: Point) -> Iterator[Test]:
    """Rates within their limits that give a share of the velocity, and all of it where the least rates do."""
    qdot, s = there.each(asked.result("qdot")), there.at(asked.result("s"))
    limits = [row[0] for row in _column(asked, asked.options.limits, there)]
    assert isinstance(qdot, list)
    sizes = zip(qdot, limits, strict=True)
    yield Holds("qdot", all(_most(abs(rate), limit) for rate, limit in sizes), "a rate is beyond its limit")
    gaps = zip(product(J, [[rate] for rate in qdot]), v, strict=True)
    met = all(_most(abs(a - s * b), 0) for (a,), (b,) in gaps)
    yield Holds("qdot", met and rank(J) == len(J), "not that share of the velocity")
    plus = pseudo_inverse(J)
    yield _same(asked, there, "J_pinv", plus)
    least = _flat(product(plus, v))
    easy = all(_most(abs(rate), limit) for rate, limit in zip(least, limits, strict=True))
    right = _most(abs(s - 1), 0) if easy else bool(s >= 0) and _most(s, 1)
    yield Holds("s", right, "not the share of the velocity that is possible")


def _same(asked: Asked, there: Point, name: str, theirs: Rows) -> Holds:
    """Whether a result is this matrix, or this column, in the configuration of the question."""
    ours: Any = there.each(asked.result(name))
    rows = [row if isinstance(row, list) else [row] for row in ours]
    pairs = [(a, b) for x, y in zip(rows, theirs, strict=True) for a, b in zip(x, y, strict=True)]
    same = all(_most(abs(floating(a) - floating(b)), 0) for a, b in pairs)
    return Holds(name, same, "SymPy finds other entries")


def _most(number: Any, limit: Any) -> bool:
    size = max(abs(floating(limit)), mpmath.mpf(1))
    return bool(floating(number) <= floating(limit) + ROUNDED * size)


def _column(asked: Asked, given: Any, there: Point) -> Columns:
    return [[there.at(asked.formula(each))] for each in given]


def _flat(column: Rows) -> list[Any]:
    return [entry for (entry,) in column]


def _one(size: int) -> Columns:
    return [[int(i == j) for j in range(size)] for i in range(size)]


def _plus(A: Rows, B: Rows) -> Columns:
    return [[a + b for a, b in zip(x, y, strict=True)] for x, y in zip(A, B, strict=True)]


def _less(A: Rows, B: Rows) -> Columns:
    return [[a - b for a, b in zip(x, y, strict=True)] for x, y in zip(A, B, strict=True)]
