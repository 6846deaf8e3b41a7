"""The lines of each method: least rates, weights, damping, null-space motion, priority, extension."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import prod
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.algebra.solving.factors import primitive
from derive.derivation import Record
from derive.errors import NotDerivable
from derive.expression import (
    Expr,
    Matrix,
    Symbol,
    add,
    column,
    is_negative,
    multiply,
    negate,
    squared,
    transpose,
)
from derive.kinds.robot._velocity.functions import functions_given
from derive.kinds.spaces._linear_map import LinearMap
from derive.kinds.spaces._redundancy.board import Board, Seen, diagonal, names_of, one
from derive.kinds.spaces._redundancy.given import Given
from derive.kinds.spaces._redundancy.inverses import Inverse, inverse_line, inverted, pinv, pseudo_inverse
from derive.mechanics.minors import minors
from derive.names import free, named

MOST_ENTRIES = 24  # of a matrix whose minors are looked at together
V, RATES, PLUS = Symbol("v"), Symbol("qdot"), Symbol("J^+")
DEPENDENT = "the rows are dependent there, and {} needs independent ones; ask for the least-norm solution"


class Told(Record):
    """What the words read of a method: the names in its lines, and of J^+ how it was found."""

    inverse: Inverse | None = None
    fails: tuple[Expr, ...] = ()  # where one of them vanishes J has a lower rank
    second: Inverse | None = None
    J: Symbol
    J_2: Symbol | None = None
    one: Symbol | None = None
    P: Symbol | None = None
    damping: Symbol | None = None
    u: Symbol | None = None
    b: Symbol | None = None
    v_2: Symbol | None = None
    start: Symbol | None = None
    function: bool = False
    sort_2: str = ""
    met: bool = True
    met_2: bool | None = None
    errs: Symbol | None = None
    errs_2: Symbol | None = None
    least: bool = False  # of the error that is left


@dataclass(frozen=True)
class Found:
    """The board with the line of qdot, what is told, and the results."""

    board: Board
    told: Told
    results: dict[str, Symbol]


def begun(given: Given, board: Board) -> Board:
    """With the matrix and the velocity."""
    board = _map(board, given.map, given.map.name, "")
    velocity = given.velocity
    return board.begin(V, given.exact(velocity), lambda seen: seen.of(velocity), "v", "given")


def _map(board: Board, found: LinearMap, name: Symbol, end: str) -> Board:
    if found.functions:
        functions = found.functions
        second = functions[0] if len(functions) == 1 else column(functions)
        work = board.work.given(Symbol("r_s"), second) if end else functions_given(board.work, functions)
        board = replace(board, work=work)
    return board.begin(name, found.J, lambda seen: found.numbers(seen.point), f"J{end}", found.sort)


def least_norm(given: Given, board: Board) -> Found:
    """qdot = J^+ v."""
    J = given.map.name
    board, inverse = pseudo_inverse(board, J, PLUS)
    board, told = _projector(board, Told(J=J, inverse=inverse), PLUS, given)
    whole, below = board.fractions[PLUS]
    board = _rates(board, PLUS * V, whole @ board[V], again=lambda seen: seen[PLUS] @ seen[V], over=below)
    least = inverse.rank < given.size[0]
    return _checked(board, replace(told, least=least), {"J_pinv": PLUS, "P": _P(told)})


def weighted(given: Given, board: Board) -> Found:
    """qdot = W^-1 J^T (J W^-1 J^T)^-1 v, the least of qdot^T W qdot."""
    J, m = given.map.name, given.size[0]
    _require_rows(board, J, m, "the weighted solution")
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
        again=lambda seen: seen[J] @ _solved(seen[W], seen[J].T),
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
    board, told = _projector(board, Told(J=J, inverse=_plain(J, plus, m)), plus, given)
    board = _rates(board, plus * V, value=board[plus] @ board[V], again=lambda seen: seen[plus] @ seen[V])
    return _checked(board, told, {"J_pinv": plus, "P": _P(told)})


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
    board = _with_one(board, I, m)
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
    told = Told(J=J, one=I, damping=damping, inverse=_plain(J, plus, m))
    board = _rates(board, plus * V, value=board[plus] @ board[V], again=lambda seen: seen[plus] @ seen[V])
    return _checked(board, told, {"J_pinv": plus})


def null_space(given: Given, board: Board) -> Found:
    """qdot = J^+ v + (1 - J^+ J) qdot_0."""
    J = given.map.name
    function, typed = given.gradient
    start = Symbol("q0_dot")
    board, inverse = pseudo_inverse(board, J, PLUS)
    board, told = _projector(board, Told(J=J, inverse=inverse), PLUS, given)
    P = _P(told)
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
    board = _rates(
        board,
        add(u, inner),
        value=board[u] + board[P] @ board[start],
        again=lambda seen: seen[start] + seen[PLUS] @ (seen[V] - seen[J] @ seen[start]),
    )
    least = inverse.rank < given.size[0]
    told = replace(told, start=start, u=u, function=function is not None, least=least)
    return _checked(board, told, {"J_pinv": PLUS, "P": P})


def _fails(given: Given, board: Board, plus: Symbol) -> tuple[Board, tuple[Expr, ...]]:
    """The denominators of J^+ that may vanish, with the claim that it has no others."""
    J = board[given.map.name]
    if prod(J.shape) <= MOST_ENTRIES and any(
        each.value and not _may_vanish(each.value, given.nonzero) for each in minors(J)
    ):
        return board, ()
    found: dict[str, Scalar] = {}
    whole, over = board.fractions[plus]
    below = [Scalar(each.ring, each.denominator) for each in whole.entries if each.denominator is not None]
    for each in map(primitive, [over] if over is not None else below):
        found.setdefault(str(each), each)
    readable = board.problem.readable
    told = {_unsigned(readable(each)): each for each in found.values() if _may_vanish(each, given.nonzero)}
    if not told:
        return board, ()
    law = (normal(tree) in (value, -value) for tree, value in told.items())
    return replace(board, work=board.work.law("denominators", law)), tuple(told)


def _unsigned(tree: Expr) -> Expr:
    return -tree if is_negative(tree) else tree


def _may_vanish(value: Scalar, nonzero: frozenset[str]) -> bool:
    """Whether its sign is not known, or all its terms may be zero."""
    constant = any(not any(powers) for powers in value.numerator.to_dict())
    return sign_of(value, nonzero) is None or not (constant or value.letters() <= nonzero)


def task_priority(given: Given, board: Board) -> Found:
    """qdot = J^+ v + (J_s P)^+ (v_s - J_s J^+ v), P = 1 - J^+ J."""
    J, second = given.map.name, _second(given)
    B, u, b, v_2 = names_of(board.problem, "B", "u", "b", "v_s")
    J_2, plus_2 = Symbol("J_s"), Symbol(f"{B.name}^+")
    board, inverse = pseudo_inverse(board, J, PLUS)
    board, told = _projector(board, Told(J=J, inverse=inverse), PLUS, given)
    P = _P(told)
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
    board = _rates(
        board,
        formula,
        value=value,
        again=lambda seen: seen[u] + _within(np_null(seen[J]), seen[J_2], seen[b]),
    )
    least = inverse.rank < given.size[0]
    told = replace(told, second=other, u=u, b=b, v_2=v_2, J_2=J_2, sort_2=second.sort, least=least)
    found = _checked(board, told, {"J_pinv": PLUS, "P": P})
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
    board = _rates(
        board,
        multiply(J_e**-1, v_e),
        value=found @ board[v_e],
        again=lambda seen: _solved(seen[J_e], seen[v_e]),
    )
    told = Told(J=J, J_2=J_2, v_2=v_2, sort_2=second.sort)
    return Found(board, told, {"qdot": RATES, "J_e": J_e})


METHODS: dict[str, Callable[[Given, Board], Found]] = {
    "least-norm": least_norm,
    "weighted": weighted,
    "damped": damped,
    "null-space": null_space,
    "task-priority": task_priority,
    "extended": extended,
}


# -- parts of them ------------------------------------------------------------------------------------


def _P(told: Told) -> Symbol:
    assert told.P is not None
    return told.P


def _plain(J: Symbol, plus: Symbol, rank: int) -> Inverse:
    return Inverse(way="wide", rank=rank, of=J, plus=plus)


def _second(given: Given) -> LinearMap:
    assert given.second is not None
    return given.second


def _require_rows(board: Board, J: Symbol, m: int, what: str) -> None:
    if len(board.pivot_rows(board[J])) < m:
        raise NotDerivable(DEPENDENT.format(what), "method")


def _with_one(board: Board, I: Symbol, size: int) -> Board:
    """With the identity matrix by its name."""
    return board.knowing(I, one(size), lambda _: np_one(size))


def _projector(board: Board, told: Told, plus: Symbol, given: Given) -> tuple[Board, Told]:
    """P = 1 - J^+ J (n by n)."""
    J, n = told.J, given.size[1]
    board, fails = _fails(given, board, plus)
    I, P = names_of(board.problem, "I", "P")
    board = _with_one(board, I, n)
    whole, below = board.fractions[plus]
    board = board.line(
        P,
        add(I, negate(multiply(plus, J))),
        value=one(n) - whole @ board[J] if below is None else one(n).scaled(below) - whole @ board[J],
        over=below,
        again=(lambda seen: np_null(seen[J]) @ np_null(seen[J]).T)
        if plus == PLUS
        else lambda seen: np_one(n) - seen[plus] @ seen[J],
        label="P",
    )
    return board, replace(told, one=I, P=P, fails=fails)


def _rates(
    board: Board, formula: Expr, value: ScalarMatrix, again: Callable[[Seen], Any], over: Scalar | None = None
) -> Board:
    indices = [f"_{k}1" for k, _ in enumerate(value.rows, 1)]
    letter = free(board.problem.taken, "w", "x", indices=indices)
    names = tuple(Symbol(letter + index) for index in indices)
    return board.line(RATES, formula, value=value, again=again, label="qdot", entries=names, over=over)


def _second_begun(board: Board, given: Given, second: LinearMap, J_2: Symbol, v_2: Symbol) -> Board:
    board = _map(board, second, J_2, "_2")
    rate = given.rate
    assert isinstance(rate, Matrix)
    return board.begin(v_2, given.exact(rate), lambda seen: seen.of(rate), "v_2", "given")


def _checked(board: Board, told: Told, results: dict[str, Symbol]) -> Found:
    """J qdot beside the velocity that is wanted, and what is left of it."""
    board, met, errs = _compared(board, told.J, V, "")
    return Found(board, replace(told, met=met, errs=errs), {"qdot": RATES, **results})


def _second_checked(found: Found, J_2: Symbol, v_2: Symbol) -> Found:
    board, met, errs = _compared(found.board, J_2, v_2, "_2")
    return replace(found, board=board, told=replace(found.told, met_2=met, errs_2=errs))


def _compared(board: Board, J: Symbol, v: Symbol, end: str) -> tuple[Board, bool, Symbol | None]:
    there = board[J] @ board[RATES]
    board = board.line(
        multiply(J, RATES), value=there, again=lambda seen: seen[J] @ seen[RATES], label=f"met{end}"
    )
    error = board[v] - there
    if not any(map(board.counts, error.entries)):
        return board, True, None
    (e,) = names_of(board.problem, f"e{end}")
    board = board.line(
        e,
        add(v, negate(multiply(J, RATES))),
        value=error,
        again=lambda seen: seen[v] - seen[J] @ seen[RATES],
        label=f"e{end}",
    )
    return board, False, e


# -- by NumPy -----------------------------------------------------------------------------------------


def np_one(size: int) -> Any:
    import numpy as np

    return np.eye(size)


def np_column(entries: Any) -> Any:
    import numpy as np

    return np.reshape(entries, (-1, 1))


def np_null(J: Any) -> Any:
    """An orthonormal basis of the null space, as columns."""
    import numpy as np

    J = np.atleast_2d(J)
    _, sizes, turned = np.linalg.svd(J)
    rank = int((sizes > 1e-8 * max(1.0, *sizes)).sum())
    return turned[rank:].T


def _diagonal(entries: Any) -> Any:
    import numpy as np

    return np.diag(entries)


def _solved(A: Any, b: Any) -> Any:
    import numpy as np

    return np.linalg.solve(A, b)


def _stack(*parts: Symbol) -> Callable[[Seen], Any]:
    def again(seen: Seen) -> Any:
        import numpy as np

        return np.vstack([np.atleast_2d(seen[part]) for part in parts])

    return again


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


def _within(N: Any, J: Any, b: Any) -> Any:
    """Of the motions N c that come nearest to J N c = b the least."""
    return N @ (pinv(J @ N) @ b)
