"""What every method begins and ends with: map and velocity, the projector, the rates, what they give."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.derivation import Record
from derive.errors import NotDerivable
from derive.expression import (
    Expr,
    Symbol,
    add,
    column,
    multiply,
    negate,
)
from derive.kinds.robot._velocity.functions import functions_given
from derive.kinds.spaces._linear_map import LinearMap
from derive.kinds.spaces._redundancy.board import Board, Seen, names_of, one
from derive.kinds.spaces._redundancy.by_numpy import np_null, np_one
from derive.kinds.spaces._redundancy.denominators import denominators
from derive.kinds.spaces._redundancy.given import Given
from derive.kinds.spaces._redundancy.inverses import Inverse
from derive.names import free

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
    board = map_begun(board, given.map, given.map.name, "")
    velocity = given.velocity
    return board.begin(V, given.exact(velocity), lambda seen: seen.of(velocity), "v", "given")


def map_begun(board: Board, found: LinearMap, name: Symbol, end: str) -> Board:
    if found.functions:
        functions = found.functions
        second = functions[0] if len(functions) == 1 else column(functions)
        work = board.work.given(Symbol("r_s"), second) if end else functions_given(board.work, functions)
        board = replace(board, work=work)
    return board.begin(name, found.J, lambda seen: found.numbers(seen.point), f"J{end}", found.sort)


def P_of(told: Told) -> Symbol:
    assert told.P is not None
    return told.P


def plain_inverse(J: Symbol, plus: Symbol, rank: int) -> Inverse:
    return Inverse(way="wide", rank=rank, of=J, plus=plus)


def require_rows(board: Board, J: Symbol, m: int, what: str) -> None:
    if len(board.pivot_rows(board[J])) < m:
        raise NotDerivable(DEPENDENT.format(what), "method")


def with_one(board: Board, I: Symbol, size: int) -> Board:
    """With the identity matrix by its name."""
    return board.knowing(I, one(size), lambda _: np_one(size))


def projector(board: Board, told: Told, plus: Symbol, given: Given) -> tuple[Board, Told]:
    """P = 1 - J^+ J (n by n)."""
    J, n = told.J, given.size[1]
    board, fails = denominators(given, board, plus)
    I, P = names_of(board.problem, "I", "P")
    board = with_one(board, I, n)
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


def rates(
    board: Board, formula: Expr, value: ScalarMatrix, again: Callable[[Seen], Any], over: Scalar | None = None
) -> Board:
    indices = [f"_{k}1" for k, _ in enumerate(value.rows, 1)]
    letter = free(board.problem.taken, "w", "x", indices=indices)
    names = tuple(Symbol(letter + index) for index in indices)
    return board.line(RATES, formula, value=value, again=again, label="qdot", entries=names, over=over)


def checked(board: Board, told: Told, results: dict[str, Symbol]) -> Found:
    """J qdot beside the velocity that is wanted, and what is left of it."""
    board, met, errs = compared(board, told.J, V, "")
    return Found(board, replace(told, met=met, errs=errs), {"qdot": RATES, **results})


def compared(board: Board, J: Symbol, v: Symbol, end: str) -> tuple[Board, bool, Symbol | None]:
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
