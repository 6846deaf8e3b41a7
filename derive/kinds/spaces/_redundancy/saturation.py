"""The lines of saturation in the null space."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.derivation import Record
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Relation, Symbol, add, multiply, negate
from derive.kinds.spaces._redundancy.board import Board, Seen, names_of
from derive.kinds.spaces._redundancy.by_numpy import np_column
from derive.kinds.spaces._redundancy.found import PLUS, RATES, Found, Told, V
from derive.kinds.spaces._redundancy.given import Given
from derive.kinds.spaces._redundancy.inverses import pinv, pseudo_inverse, value_of_inverse
from derive.kinds.spaces._redundancy.limits import Round, by_numpy, saturated
from derive.names import free


class Turn(Record):
    """One step: the names of what is held and of the columns that are left, but in the first; the joints
    beyond their limits, the one that is held from then on and at what value, and the share of the task at
    which it reaches that, none where no share keeps all within their limits."""

    held: Symbol | None
    B: Symbol | None
    plus: Symbol
    beyond: tuple[Expr, ...]
    joint: Symbol | None
    limit: Expr | None
    share: Expr | None


class Limited(Record):
    """The limits, the steps, and the share of the task that is done in the end, in which step."""

    limits: tuple[Relation, ...]
    turns: tuple[Turn, ...]
    whole: bool
    best: int
    s: Symbol


def within_limits(given: Given, board: Board) -> tuple[Found, Limited]:
    """qdot = h + B^+ (s v - J h): B is J without the columns of the joints that are held, h their rates.
    Raises NotDerivable for anything but numbers."""
    J = given.map.name
    if any(entry.constant is None for entry in (*board[J].entries, *board[V].entries)):
        raise NotDerivable(
            "rates within limits are found in numbers: give all values under evaluate", "evaluate"
        )
    limits = given.numbers(given.options.limits or (), "limits")
    if len(board.pivot_rows(board[J])) < given.size[0]:
        raise NotDerivable("the rows are dependent there, so no share of the task can be promised", "rows")
    board, inverse = pseudo_inverse(board, J, PLUS)
    found = saturated(board, board[J], board[V], limits)
    again = _Again(J, limits, len(found.rounds))
    turns: list[Turn] = []
    for k, turn in enumerate(found.rounds, 1):
        board, told = _turn(given, board, k, turn, again)
        turns.append(told)
    (s,) = names_of(board.problem, "s")
    board = board.line(s, value=ScalarMatrix.column([found.share]), again=again.share, label="s")
    formula: Expr = _named(given, "u", found.best + 1)
    if found.share != 1:
        formula = _formula(turns[found.best], J, multiply(s, V))
    board = board.line(RATES, formula, value=found.rates, again=again.rates(found.best, s), label="qdot")
    board = board.line(
        multiply(J, RATES),
        value=board[J] @ found.rates,
        again=lambda seen: seen[s] * seen[V],
        label="met",
    )
    whole = found.share == 1
    limited = Limited(
        limits=tuple(
            Relation(Call("abs", (rate,)), "<=", limit)
            for rate, limit in zip(given.map.rates, given.options.limits or (), strict=True)
        ),
        turns=tuple(turns),
        whole=whole,
        best=found.best + 1,
        s=s,
    )
    return Found(
        board, Told(J=J, inverse=inverse, met=whole), {"qdot": RATES, "J_pinv": PLUS, "s": s}
    ), limited


def _turn(given: Given, board: Board, k: int, turn: Round, again: _Again) -> tuple[Board, Turn]:
    J = given.map.name
    B, h, u = (_named(given, letter, k) for letter in "Bhu")
    held = None if k == 1 else h
    columns, plus = (J, PLUS) if held is None else (B, Symbol(f"{B.name}^+"))
    if held is not None:
        board = board.line(h, value=turn.held, again=again.of(1, k), label=f"h_{k}")
        board = board.line(B, value=turn.J, again=again.of(0, k), label=f"B_{k}")
        board = board.knowing(plus, value_of_inverse(board, turn.J), lambda seen: pinv(seen[columns]))
    limit: Expr | None = None
    share: Expr | None = None
    if turn.joint is not None:
        board, limit = board.saying(turn.limit, again.limit(turn.joint, k))
        board, largest = board.saying(turn.share, lambda seen: again.largest(seen, k - 1))
        share = largest if turn.share else None
    told = Turn(
        held=held,
        B=None if held is None else B,
        plus=plus,
        beyond=tuple(given.map.rates[j] for j in turn.beyond),
        joint=None if turn.joint is None else given.map.rates[turn.joint],
        limit=limit,
        share=share,
    )
    board = board.line(u, _formula(told, J, V), value=turn.rates, again=again.of(2, k), label=f"u_{k}")
    return board, told


def _named(given: Given, letter: str, k: int) -> Symbol:
    """u_1, u_2, ..."""
    indices = [f"_{i}" for i in range(1, given.size[1] + 2)]
    return Symbol(f"{free(given.problem.taken, letter, 2 * letter, indices=indices)}_{k}")


def _formula(turn: Turn, J: Symbol, v: Expr) -> Expr:
    if turn.held is None:
        return multiply(turn.plus, v)
    return add(turn.held, multiply(turn.plus, add(v, negate(multiply(J, turn.held)))))


class _Again:
    """The steps by NumPy."""

    def __init__(self, J: Symbol, limits: list[Fraction], rounds: int) -> None:
        self.J, self.limits, self.rounds = J, list(map(float, limits)), rounds

    def all(self, seen: Seen) -> tuple[list[Any], list[Any], list[Any]]:
        import numpy as np

        return by_numpy(seen[self.J], seen[V], np.array(self.limits), self.rounds)

    def of(self, what: int, k: int) -> Callable[[Seen], Any]:
        return lambda seen: self.all(seen)[what][k - 1]

    def limit(self, joint: int, k: int) -> Callable[[Seen], Any]:
        """That at which a joint is held after step k."""
        return lambda seen: math.copysign(self.limits[joint], self.all(seen)[2][k - 1][joint, 0])

    def largest(self, seen: Seen, k: int) -> float:
        """The largest share of the task in step k (from 0) with all joints within their limits, by
        bisection."""
        import numpy as np

        columns, held, _ = (each[k] for each in self.all(seen))
        limits, inverse = np_column(self.limits), pinv(columns)

        def fits(s: float) -> bool:
            rates = held + inverse @ (s * seen[V] - seen[self.J] @ held)
            return bool((np.abs(rates) <= limits * (1 + 1e-9)).all())

        ends = [s for s in np.linspace(0, 1, 2001)[::-1] if fits(float(s))][:1]
        low, high = (float(ends[0]), float(ends[0]) + 1 / 2000) if ends else (0.0, 0.0)
        for _ in range(50):
            middle = (low + high) / 2
            low, high = (middle, high) if fits(middle) else (low, middle)
        return min(low, 1.0)

    def share(self, seen: Seen) -> float:
        """The largest share of all steps; no number where one more could be made."""
        import numpy as np

        limits = np_column(self.limits)
        columns, _, rates = by_numpy(seen[self.J], seen[V], np.array(self.limits), self.rounds + 1)
        kept = bool((np.abs(rates[self.rounds - 1]) <= limits * (1 + 1e-9)).all())
        over = np.linalg.matrix_rank(columns[self.rounds], 1e-8) < len(seen[V])
        return max(self.largest(seen, k) for k in range(self.rounds)) if kept or over else math.nan

    def rates(self, best: int, s: Symbol) -> Callable[[Seen], Any]:
        def again(seen: Seen) -> Any:
            columns, held, _ = (each[best] for each in self.all(seen))
            return held + pinv(columns) @ (seen[s] * seen[V] - seen[self.J] @ held)

        return again
