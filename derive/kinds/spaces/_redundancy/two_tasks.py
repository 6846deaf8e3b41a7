"""The methods for a second task: below the first, or beside it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.errors import NotDerivable
from derive.expression import (
    Expr,
    Matrix,
    Symbol,
    add,
    multiply,
    negate,
)
from derive.kinds.spaces._linear_map import LinearMap
from derive.kinds.spaces._redundancy.board import Board, Seen, names_of
from derive.kinds.spaces._redundancy.by_numpy import np_null, solved
from derive.kinds.spaces._redundancy.found import (
    PLUS,
    RATES,
    Found,
    P_of,
    Told,
    V,
    checked,
    compared,
    map_begun,
    projector,
    rates,
)
from derive.kinds.spaces._redundancy.given import Given
from derive.kinds.spaces._redundancy.inverses import inverted, pinv, pseudo_inverse


def task_priority(given: Given, board: Board) -> Found:
    """qdot = J^+ v + (J_s P)^+ (v_s - J_s J^+ v), P = 1 - J^+ J."""
    J, second = given.map.name, _second(given)
    B, u, b, v_2 = names_of(board.problem, "B", "u", "b", "v_s")
    J_2, plus_2 = Symbol("J_s"), Symbol(f"{B.name}^+")
    board, inverse = pseudo_inverse(board, J, PLUS)
    board, told = projector(board, Told(J=J, inverse=inverse), PLUS, given)
    P = P_of(told)
    board = _second_begun(board, given, second, J_2, v_2)
    board = board.line(
        u, PLUS * V, value=board[PLUS] @ board[V], again=lambda seen: seen[PLUS] @ seen[V], label="u"
    )
    board = board.line(
        b,
        add(v_2, negate(multiply(J_2, u))),
        value=board[v_2] - board[J_2] @ board[u],
        again=lambda seen: seen[v_2] - seen[J_2] @ seen[u],
        label="b",
    )
    board = board.line(
        B,
        multiply(J_2, P),
        value=board[J_2] @ board[P],
        again=lambda seen: seen[J_2] @ np_null(seen[J]) @ np_null(seen[J]).T,
        label="B",
    )
    formula: Expr = u
    value, other = board[u], None
    if board.pivot_rows(board[B]):
        board, other = pseudo_inverse(board, B, plus_2, "_2")
        formula, value = add(u, multiply(plus_2, b)), board[u] + board[plus_2] @ board[b]
    board = rates(
        board,
        formula,
        value=value,
        again=lambda seen: seen[u] + _within(np_null(seen[J]), seen[J_2], seen[b]),
    )
    least = inverse.rank < given.size[0]
    told = replace(told, second=other, u=u, b=b, v_2=v_2, J_2=J_2, sort_2=second.sort, least=least)
    found = checked(board, told, {"J_pinv": PLUS, "P": P})
    return _second_checked(found, J_2, v_2)


def extended(given: Given, board: Board) -> Found:
    """qdot = J_e^-1 v_e, with the rows of the second task below those of the first."""
    J, second = given.map.name, _second(given)
    J_2, J_e, (v_2, v_e) = Symbol("J_s"), Symbol("J_e"), names_of(board.problem, "v_s", "v_e")
    m, n = given.size
    if m + second.J.shape[0] != n:
        raise NotDerivable(
            f"{n} joints need {n} rows in both tasks together, not {m + second.J.shape[0]}", "second"
        )
    board = _second_begun(board, given, second, J_2, v_2)
    for name, parts, label in ((J_e, (J, J_2), "J_e"), (v_e, (V, v_2), "v_e")):
        board = board.line(
            name,
            value=ScalarMatrix.stacked([board[part] for part in parts]),
            again=_stack(*parts),
            label=label,
        )
    try:
        found = inverted(board, board[J_e])
    except ZeroDivisionError as error:
        raise NotDerivable("the extended Jacobian is singular there", "second") from error
    if len(board.pivot_rows(board[J_e])) < n:
        raise NotDerivable("the extended Jacobian is singular there", "second")
    board = board.line(
        J_e**-1, value=found, again=lambda seen: pinv(seen[J_e]), label="J_e_inv"
    )  # fmt: skip
    board = rates(
        board,
        multiply(J_e**-1, v_e),
        value=found @ board[v_e],
        again=lambda seen: solved(seen[J_e], seen[v_e]),
    )
    told = Told(J=J, J_2=J_2, v_2=v_2, sort_2=second.sort)
    return Found(board, told, {"qdot": RATES, "J_e": J_e})


def _second(given: Given) -> LinearMap:
    assert given.second is not None
    return given.second


def _second_begun(board: Board, given: Given, second: LinearMap, J_2: Symbol, v_2: Symbol) -> Board:
    board = map_begun(board, second, J_2, "_2")
    rate = given.rate
    assert isinstance(rate, Matrix)
    return board.begin(v_2, given.exact(rate), lambda seen: seen.of(rate), "v_2", "given")


def _second_checked(found: Found, J_2: Symbol, v_2: Symbol) -> Found:
    board, met, errs = compared(found.board, J_2, v_2, "_2")
    return replace(found, board=board, told=replace(found.told, met_2=met, errs_2=errs))


def _stack(*parts: Symbol) -> Callable[[Seen], Any]:
    def again(seen: Seen) -> Any:
        import numpy as np

        return np.vstack([np.atleast_2d(seen[part]) for part in parts])

    return again


def _within(N: Any, J: Any, b: Any) -> Any:
    """Of the motions N c that come nearest to J N c = b the least."""
    return N @ (pinv(J @ N) @ b)
