"""Why D is positive definite: its minors from the last row on, where no term of them can be negative."""

from __future__ import annotations

from collections.abc import Collection

from derive.algebra.readable.order import MASSES
from derive.expression import (
    ZERO,
    Call,
    Expr,
    Matrix,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
    children,
    free_symbols,
)
from derive.kinds.work import Work
from derive.names import entry_symbol

DET = Call("det", (Symbol("D"),))


def is_diagonal(D: Matrix) -> bool:
    """Whether all entries beside the diagonal vanish."""
    return all(entry == ZERO for i, row in enumerate(D.rows) for j, entry in enumerate(row) if i != j)


def minors(work: Work, D: Matrix) -> Work:
    """The entries on the diagonal of a diagonal matrix; d_22 and det D of one that is 2 by 2; of others no
    lines."""
    n = len(D.rows)
    if is_diagonal(D):
        for k in range(1, n + 1):
            work = work.line(entry_symbol("d", k, k), value=D.rows[k - 1][k - 1], rule="minor")
    elif n == 2:
        first, beside, last = (entry_symbol("d", *at) for at in ((1, 1), (1, 2), (2, 2)))
        work = work.line(last, value=D.rows[1][1], rule="minor")
        work = work.line(DET, first * last - beside**2, label="det", rule="minor")
    return work


def is_positive(tree: Expr, moving: Collection[str]) -> bool:
    """Whether no term is negative and one is positive, for any joint variables (`moving`): masses and
    moments of inertia are positive, and of lengths there are squares."""
    return _sign(tree, moving) == 1


def _sign(tree: Expr, moving: Collection[str]) -> int | None:
    """1 where it is positive, 0 where it may vanish and is not negative, else None."""
    match tree:
        case Number(value):
            return None if value < 0 else int(value > 0)
        case Symbol(name):
            return 1 if MASSES.match(name) and name not in moving else None
        case Power(base, Number(value)) if value % 2 == 0:
            return int(isinstance(base, Symbol) and free_symbols(base).isdisjoint(moving))
        case Sum(terms):
            signs = [_sign(term, moving) for term in terms]
            return None if None in signs else int(1 in signs)
        case Product() | Quotient():
            signs = [_sign(part, moving) for part in children(tree)]
            return None if None in signs else int(0 not in signs)
    return None
