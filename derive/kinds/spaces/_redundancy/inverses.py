"""The pseudo-inverse of a matrix of any rank, with the lines that lead to it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.algebra.solving.factors import TooLong
from derive.derivation import Record
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, multiply, transpose
from derive.kinds.spaces._redundancy.board import TOO_LONG, Board, names_of

MOST_SYMBOLIC = 3  # rows of a matrix with symbols whose inverse is written out
CUT = 1e-8  # singular values below it are zeros to NumPy


class Inverse(Record):
    """How the pseudo-inverse of a matrix was found: of a "square" one, a "wide" one of full row rank, a
    "tall" one of full column rank, or by "factors"; the names in the lines, and the end of their labels."""

    way: str
    rank: int
    of: Symbol
    plus: Symbol
    end: str = ""
    left: Symbol | None = None
    right: Symbol | None = None
    other: Symbol | None = None


def pseudo_inverse(board: Board, J: Symbol, plus: Symbol, end: str = "") -> tuple[Board, Inverse]:
    """With the lines of J^+ (n by m). Raises NotDerivable for a matrix of zeros, and for long formulas."""
    value = board[J]
    m, n = value.shape
    try:
        rows = board.pivot_rows(value)
    except TooLong as error:
        raise NotDerivable(TOO_LONG) from error
    r = len(rows)
    A, F, C, E = names_of(board.problem, *(f"{name}{end}" for name in ("A", "F", "C", "E")))
    if not r:
        raise NotDerivable("all entries of the matrix vanish there, so no rates give any velocity")
    told = Inverse(way="square", rank=r, of=J, plus=plus, end=end)
    over: Scalar | None = None
    if r == m == n:
        found, over = parted(board, value)
        formula: Expr = J**-1
    elif r == m:
        board = _gram(board, A, J, transpose(J), f"A{end}")
        inverse, over = parted(board, board[A])
        formula, found = multiply(transpose(J), A**-1), value.T @ inverse
        told = replace(told, way="wide")
    elif r == n:
        board = _gram(board, A, transpose(J), J, f"A{end}")
        inverse, over = parted(board, board[A])
        formula, found = multiply(A**-1, transpose(J)), inverse @ value.T
        told = replace(told, way="tall")
    else:
        board = _factored(board, J, rows, (C, E), end)
        board = _gram(board, A, transpose(C), C, f"A{end}")
        board = _gram(board, F, E, transpose(E), f"F{end}")
        formula = multiply(transpose(E), F**-1, A**-1, transpose(C))
        found = board[E].T @ inverted(board, board[F]) @ inverted(board, board[A]) @ board[C].T
        told = replace(told, way="factors", left=C, right=E, other=F)
    board = board.line(
        plus, formula, value=found, again=lambda seen: pinv(seen[J]), label=f"plus{end}", over=over
    )
    return board, told


def value_of_inverse(board: Board, value: ScalarMatrix) -> ScalarMatrix:
    """The pseudo-inverse by its rows alone, without lines."""
    rows = board.pivot_rows(value)
    if not rows:
        return ScalarMatrix.zeros(*value.T.shape)
    E = ScalarMatrix(tuple(value.rows[k] for k in rows))
    back = E.T @ inverted(board, E @ E.T)  # E^+
    C = value @ back
    return back @ inverted(board, C.T @ C) @ C.T


def parted(board: Board, value: ScalarMatrix) -> tuple[ScalarMatrix, Scalar | None]:
    """The adjugate and the determinant of a matrix with symbols and no fractions; else its inverse."""
    if all(entry.denominator is None for entry in value.entries) and not board.rounded:
        det = value.det()
        if det.constant is None:
            return value.adjugate(), det
    return inverted(board, value), None


def inverted(board: Board, value: ScalarMatrix) -> ScalarMatrix:
    """The inverse. Raises NotDerivable where it fills pages."""
    symbolic = any(entry.constant is None for entry in value.entries)
    if symbolic and not board.rounded and value.shape[0] > MOST_SYMBOLIC:
        raise NotDerivable(TOO_LONG)
    return value.inverse()


def inverse_line(board: Board, A: Symbol, label: str) -> Board:
    """A^-1 as a line of its own."""
    if board[A].shape == (1, 1):
        return board
    head: Expr = A**-1
    value, over = parted(board, board[A])
    return board.line(head, value=value, again=lambda seen: inv(seen[A]), label=label, over=over)


def _gram(board: Board, A: Symbol, left: Expr, right: Expr, label: str) -> Board:
    """The product of a matrix and its transpose, and its inverse."""
    name = next(each for each in (left, right) if isinstance(each, Symbol))
    turned = left != name
    value = board[name].T @ board[name] if turned else board[name] @ board[name].T
    board = board.line(
        A,
        multiply(left, right),
        value=value,
        again=lambda seen: seen[name].T @ seen[name] if turned else seen[name] @ seen[name].T,
        label=label,
    )
    return inverse_line(board, A, f"{label}_inv")


def _factored(
    board: Board, J: Symbol, rows: tuple[int, ...], names: tuple[Symbol, Symbol], end: str
) -> Board:
    """J = C E with independent rows of J in E (r by n), and in C (m by r) what all rows are of these."""
    C, E = names
    value = board[J]
    kept = ScalarMatrix(tuple(value.rows[k] for k in rows))
    share = value @ kept.T @ inverted(board, kept @ kept.T)
    board = board.line(E, value=kept, again=lambda seen: seen[J][list(rows)], label=f"E{end}")
    return board.line(C, value=share, again=lambda seen: seen[J] @ pinv(seen[E]), label=f"C{end}")


def pinv(value: Any) -> Any:
    """By the singular values."""
    import numpy as np

    return np.linalg.pinv(np.atleast_2d(value), rcond=CUT)


def inv(value: Any) -> Any:
    import numpy as np

    return np.linalg.inv(np.atleast_2d(value))
