"""Joint rates within their limits: saturation in the null space, step by step (Flacco, De Luca and Khatib,
"Motion control of redundant robots under joint constraints: Saturation in the null space", ICRA 2012)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.kinds.spaces._redundancy.board import Board
from derive.kinds.spaces._redundancy.inverses import value_of_inverse

SLACK = Fraction(1, 10**11)  # by which a rounded rate may pass its limit


@dataclass(frozen=True, slots=True)
class Round:
    """One step: the columns of the joints that are free (the others are zero), the rates of those that are
    held (n by 1), all rates (n by 1); the joint that is held next, from 0, its limit with its sign, and the
    share of the task at which it reaches that."""

    J: ScalarMatrix
    held: ScalarMatrix
    rates: ScalarMatrix
    beyond: tuple[int, ...] = ()
    joint: int | None = None
    limit: Fraction = Fraction(0)
    share: Fraction = Fraction(1)


@dataclass(frozen=True, slots=True)
class Saturated:
    """The steps; the share of the task that is done, in the step `best` (from 0), and the rates."""

    rounds: tuple[Round, ...]
    share: Fraction
    best: int
    rates: ScalarMatrix


def saturated(board: Board, J: ScalarMatrix, v: ScalarMatrix, limits: Sequence[Fraction]) -> Saturated:
    """The algorithm with one task, in fractions; `limits` bound the size of each rate (n)."""
    m, n = J.shape
    free = J
    held = ScalarMatrix.zeros(n, 1)
    rounds: list[Round] = []
    best, most = 0, Fraction(0)
    while True:
        plus = value_of_inverse(board, free)
        rates = held + plus @ (v - J @ held)
        now = [_number(entry) for entry in rates.entries]
        beyond = tuple(k for k, rate in enumerate(now) if abs(rate) > limits[k] + SLACK)
        if not beyond:
            rounds.append(Round(free, held, rates))
            return Saturated(tuple(rounds), Fraction(1), len(rounds) - 1, rates)
        for_task = [_number(entry) for entry in (plus @ v).entries]
        joint, share = critical(for_task, now, limits)
        limit = limits[joint] if now[joint] > 0 else -limits[joint]
        rounds.append(Round(free, held, rates, beyond, joint, limit, share))
        if share > most:
            best, most = len(rounds) - 1, share
        held = _with(held, joint, limit)
        free = ScalarMatrix.of(
            [Scalar.of(0) if k == joint else entry for k, entry in enumerate(row)] for row in free.rows
        )
        if len(board.pivot_rows(free)) < m:
            return _scaled(board, rounds, best, most, J, v)


def _scaled(
    board: Board, rounds: list[Round], best: int, share: Fraction, J: ScalarMatrix, v: ScalarMatrix
) -> Saturated:
    """Not all of the task can be done: the step that does most of it, with this share."""
    there = rounds[best]
    plus = value_of_inverse(board, there.J)
    rates = there.held + plus @ (v.scaled(share) - J @ there.held)
    return Saturated(tuple(rounds), share, best, rates)


def critical(
    for_task: Sequence[Fraction], now: Sequence[Fraction], limits: Sequence[Fraction]
) -> tuple[int, Fraction]:
    """The joint that reaches its limit first as the share s of the task grows, s a + b, and the largest share
    with which all stay within theirs; zero where there is none (n each)."""
    highest: list[tuple[Fraction, int]] = []
    lowest = Fraction(0)
    nowhere = False
    for k, (a, rate, limit) in enumerate(zip(for_task, now, limits, strict=True)):
        b = rate - a
        if abs(a) <= SLACK:  # moves with no share of the task
            nowhere |= abs(b) > limit + SLACK
            continue
        low, high = sorted(((-limit - b) / a, (limit - b) / a))
        highest.append((high, k))
        lowest = max(lowest, low)
    share, joint = min(highest)
    return joint, Fraction(0) if nowhere or share < lowest or share < 0 else share


def _with(held: ScalarMatrix, joint: int, limit: Fraction) -> ScalarMatrix:
    return ScalarMatrix.column(limit if k == joint else entry for k, entry in enumerate(held.entries))


def _number(entry: Scalar) -> Fraction:
    value = entry.constant
    assert value is not None
    return Fraction(int(value.numerator), int(value.denominator))


def by_numpy(J: Any, v: Any, limits: Any, rounds: int) -> tuple[list[Any], list[Any], list[Any]]:
    """The same algorithm in floats: the free columns, the held rates and all rates of each step."""
    import numpy as np

    n = J.shape[1]
    W, held = np.eye(n), np.zeros((n, 1))
    found: tuple[list[Any], list[Any], list[Any]] = ([], [], [])
    for _ in range(rounds):
        plus = np.linalg.pinv(J @ W, rcond=1e-8)
        rates = held + plus @ (v - J @ held)
        for kept, value in zip(found, (J @ W, held.copy(), rates), strict=True):
            kept.append(value)
        a = (plus @ v)[:, 0]
        b = rates[:, 0] - a
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = np.where(np.abs(a) > 1e-11, np.maximum((limits - b) / a, (-limits - b) / a), np.inf)
        joint = int(np.argmin(ends))
        held[joint, 0] = np.sign(rates[joint, 0]) * limits[joint]
        W[joint, joint] = 0
    return found
