"""Joint variables, rates and accelerations as functions of the time alone, where these are short."""

from __future__ import annotations

from collections.abc import Sequence

from derive.algebra.normal import normal
from derive.algebra.readable.operation_count import operations
from derive.derivation import Step
from derive.errors import NotDerivable
from derive.expression import Expr, Matrix, Symbol, column, free_symbols
from derive.kinds.problem import Problem
from derive.kinds.robot._carried.followed import entries

LONG, LONGEST = 200, 30  # operations of a formula before it is simplified, and after
DOTS = ("", "_dot", "_ddot")
Closed = tuple[Matrix, Matrix, Matrix]


def in_time(problem: Problem, variables: Sequence[str], closed: Closed) -> Closed | None:
    """The same, simplified; None where one of them is long, or rests on others."""
    if any(operations(tree) > LONG for part in closed for tree in entries(part)):
        return None
    joints = {name + dots for name in variables for dots in DOTS}
    try:
        q, qdot, qddot = (
            column(problem.readable(normal(tree, problem.names)) for tree in entries(part)) for part in closed
        )
    except NotDerivable:
        return None
    found = [tree for part in (q, qdot, qddot) for tree in entries(part)]
    if any(operations(tree) > LONGEST or free_symbols(tree) & joints for tree in found):
        return None
    return q, qdot, qddot


def lines(variables: Sequence[str], closed: Closed) -> tuple[tuple[Step, ...], ...]:
    """Of the joint variables, of their rates and of their accelerations."""
    return tuple(
        tuple(_line(name + dots, tree) for name, tree in zip(variables, entries(part), strict=True))
        for dots, part in zip(DOTS, closed, strict=True)
    )


def _line(name: str, tree: Expr) -> Step:
    return Step(f"{name}_in_time", (Symbol(name), tree), "branch")
