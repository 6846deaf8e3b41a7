"""Lines with the sizes of names in them: what is positive, as a radius, is its own size."""

from __future__ import annotations

from typing import overload

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.readable.form import readable
from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.algebra.values import Value
from derive.expression import Call, Expr, Matrix, Symbol, column, negate, rebuild
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.paths import Arc


def told(work: Work, name: Symbol, formula: Expr, written: Expr | None = None) -> Work:
    """A line more, its value maybe `written` in a certain way.

    Where a size was settled by what is known to be positive, which the normal form does not know, the line is
    compared in numbers, where these are.
    """
    plain = work.value(formula)
    value = settled(plain, work.problem)
    return work.line(name, formula, value=written or value, rule="" if value == plain else "in-numbers")


@overload
def settled(value: Scalar, problem: Problem) -> Scalar: ...
@overload
def settled(value: Value, problem: Problem) -> Value: ...
def settled(value: Value, problem: Problem) -> Value:
    """With |r| as r where that is positive."""
    if isinstance(value, ScalarMatrix):
        rows = [[_settled(entry, problem) for entry in row] for row in value.rows]
        return ScalarMatrix.of(rows)
    return _settled(value, problem)


def _settled(value: Scalar, problem: Problem) -> Scalar:
    if not any(name.startswith("abs(") for name in value.generators()):
        return value
    positive = positive_names(problem)

    def sized(tree: Expr) -> Expr:
        if isinstance(tree, Call) and tree.function == "abs":
            (inner,) = tree.arguments
            sign = sign_of(normal(inner), positive)
            if sign is not None:
                return inner if sign >= 0 else negate(inner)
        return rebuild(tree, sized)

    return normal(sized(readable(value, problem.style)))


def slope(work: Work, name: Symbol, by: Symbol) -> Matrix:
    """The derivative of a column on the board as it is written, each entry by itself: sin(24 t) in one is no
    polynomial in the cosine of t because another holds that."""
    entries = (normal(entry).diff(by.name) for entry in work.entries(name))
    return column(work.readable(entry) for entry in entries)


def positive_names(problem: Problem) -> frozenset[str]:
    """Those that are said to be positive, and a radius."""
    said = {name for name, what in problem.assumptions.items() if what == "positive"}
    shape = problem.subject.shape
    if isinstance(shape, Arc) and isinstance(shape.radius, Symbol):
        said.add(shape.radius.name)
    return frozenset(said)
