"""The methods for one velocity: least rates, weights, damping, a motion in the null space."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.errors import NotDerivable
from derive.expression import (
    Symbol,
    add,
    multiply,
    squared,
    transpose,
)
from derive.kinds.spaces._redundancy.board import Board, Seen, diagonal, names_of, one
from derive.kinds.spaces._redundancy.by_numpy import np_column, np_one, solved
from derive.kinds.spaces._redundancy.found import (
    PLUS,
    Found,
    P_of,
    Told,
    V,
    checked,
    plain_inverse,
    projector,
    rates,
    require_rows,
    with_one,
)
from derive.kinds.spaces._redundancy.given import Given
from derive.kinds.spaces._redundancy.inverses import inverse_line, inverted, pseudo_inverse
from derive.names import named


def least_norm(given: Given, board: Board) -> Found:
    """qdot = J^+ v."""
    J = given.map.name
    board, inverse = pseudo_inverse(board, J, PLUS)
    board, told = projector(board, Told(J=J, inverse=inverse), PLUS, given)
    whole, below = board.fractions[PLUS]
    board = rates(board, PLUS * V, whole @ board[V], again=lambda seen: seen[PLUS] @ seen[V], over=below)
    least = inverse.rank < given.size[0]
    return checked(board, replace(told, least=least), {"J_pinv": PLUS, "P": P_of(told)})


def weighted(given: Given, board: Board) -> Found:
    """qdot = W^-1 J^T (J W^-1 J^T)^-1 v, the least of qdot^T W qdot."""
    J, m = given.map.name, given.size[0]
    require_rows(board, J, m, "the weighted solution")
    (W, A), plus = names_of(board.problem, "W", "A"), Symbol("J_W^+")
    typed = given.options.weights or ()
    weights = tuple(normal(each, given.map.values) for each in typed)
    if any(sign_of(each) in (0, -1) for each in weights):
        raise NotDerivable("weights are positive", "weights")
    board = board.begin(
        W, diagonal(weights), lambda seen: _diagonal([seen.of(each) for each in typed]), "W", "given"
    )
    turned = ScalarMatrix.of(
        [Scalar.of(1) / entry if i == j else 0 for j, entry in enumerate(board[W].rows[i])]
        for i in range(len(weights))
    )
    J_T, back = transpose(J), W**-1
    board = board.line(
        A,
        multiply(J, back, J_T),
        value=board[J] @ turned @ board[J].T,
        again=lambda seen: seen[J] @ solved(seen[W], seen[J].T),
        label="A",
    )
    board = inverse_line(board, A, "A_inv")
    board = board.line(
        plus,
        multiply(back, J_T, A**-1),
        value=turned @ board[J].T @ inverted(board, board[A]),
        again=_by_multipliers(J, W),
        label="plus",
    )
    board, told = projector(board, Told(J=J, inverse=plain_inverse(J, plus, m)), plus, given)
    board = rates(board, plus * V, value=board[plus] @ board[V], again=lambda seen: seen[plus] @ seen[V])
    return checked(board, told, {"J_pinv": plus, "P": P_of(told)})


def damped(given: Given, board: Board) -> Found:
    """qdot = J^T (J J^T + lambda^2 1)^-1 v, the least of |v - J qdot|^2 + lambda^2 |qdot|^2."""
    J, m = given.map.name, given.size[0]
    (A, I), plus = names_of(board.problem, "A", "I"), Symbol("J_d^+")
    typed = given.options.damping
    assert typed is not None
    damping = named("lambda", typed, board.problem.taken)
    if typed != damping:
        board = board.begin(
            damping,
            ScalarMatrix.column([normal(typed, given.map.values)]),
            lambda seen: float(seen.of(typed)),
            "damping",
            "given",
        )
    squares = board.near(ScalarMatrix.column([normal(typed, given.map.values)]))[0, 0] ** 2
    board = with_one(board, I, m)
    turned = transpose(J)
    factor = squared(damping)
    board = board.line(
        A,
        add(multiply(J, turned), multiply(factor, I)),
        value=board[J] @ board[J].T + one(m).scaled(squares),
        again=lambda seen: seen[J] @ seen[J].T + np_one(m) * seen.of(squared(typed)),
        label="A",
    )
    board = inverse_line(board, A, "A_inv")
    board = board.line(
        plus,
        multiply(turned, A**-1),
        value=board[J].T @ inverted(board, board[A]),
        again=lambda seen: _damped(seen[J], seen.of(typed)),
        label="plus",
    )
    told = Told(J=J, one=I, damping=damping, inverse=plain_inverse(J, plus, m))
    board = rates(board, plus * V, value=board[plus] @ board[V], again=lambda seen: seen[plus] @ seen[V])
    return checked(board, told, {"J_pinv": plus})


def null_space(given: Given, board: Board) -> Found:
    """qdot = J^+ v + (1 - J^+ J) qdot_0."""
    J = given.map.name
    function, typed = given.gradient
    start = Symbol("q0_dot")
    board, inverse = pseudo_inverse(board, J, PLUS)
    board, told = projector(board, Told(J=J, inverse=inverse), PLUS, given)
    P = P_of(told)
    if function is not None:
        board = replace(board, work=board.work.given(Symbol("H"), function))
    board = board.begin(
        start,
        given.exact(typed),
        (lambda seen: seen.of(typed))
        if function is None
        else lambda seen: np_column(given.slope(given.problem.final(function), seen.point)),
        "start",
        "given",
    )
    board = board.line(
        (u := names_of(board.problem, "u")[0]),
        PLUS * V,
        value=board[PLUS] @ board[V],
        again=lambda seen: seen[PLUS] @ seen[V],
        label="u",
    )
    inner = multiply(P, start)
    board = board.line(
        inner,
        value=board[P] @ board[start],
        again=lambda seen: seen[start] - seen[PLUS] @ (seen[J] @ seen[start]),
        label="inner",
    )
    board = rates(
        board,
        add(u, inner),
        value=board[u] + board[P] @ board[start],
        again=lambda seen: seen[start] + seen[PLUS] @ (seen[V] - seen[J] @ seen[start]),
    )
    least = inverse.rank < given.size[0]
    told = replace(told, start=start, u=u, function=function is not None, least=least)
    return checked(board, told, {"J_pinv": PLUS, "P": P})


def _diagonal(entries: Any) -> Any:
    import numpy as np

    return np.diag(entries)


def _by_multipliers(J: Symbol, W: Symbol) -> Callable[[Seen], Any]:
    """The inverse from the conditions of Lagrange, W x = J^T l and J x = v for each unit velocity v."""

    def again(seen: Seen) -> Any:
        import numpy as np

        m, n = seen[J].shape
        whole = np.block([[seen[W], -seen[J].T], [seen[J], np.zeros((m, m))]])
        return np.linalg.solve(whole, np.vstack([np.zeros((n, m)), np.eye(m)]))[:n]

    return again


def _damped(J: Any, damping: float) -> Any:
    """Least squares of J x = v and lambda x = 0 together, for each unit velocity v."""
    import numpy as np

    m, n = J.shape
    whole = np.vstack([J, damping * np.eye(n)])
    return np.linalg.lstsq(whole, np.vstack([np.eye(m), np.zeros((n, m))]), rcond=None)[0]
