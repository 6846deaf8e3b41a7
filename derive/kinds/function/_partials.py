"""Partial derivatives of a function, exactly and by differences."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from derive.algebra.normal import normal
from derive.algebra.numbers import floats as numeric
from derive.algebra.scalar import Scalar
from derive.derivation import Step
from derive.expression import Derivative, Expr, Symbol
from derive.kinds.problem import Problem
from derive.kinds.work import Work

STEP = 1e-4
DIFFERENCES = 1e-6  # what differences over that step leave


def partial(of: Expr, name: str) -> Scalar:
    """The partial derivative, names of `where` kept. Raises NotDerivable where no rule is known."""
    return normal(Derivative(of, Symbol(name)))


def partial_step(problem: Problem, symbol: Symbol, of: Expr, name: str) -> Step:
    """df/dx worked out."""
    by = Symbol(name)
    step_name = f"d{symbol.name}_d{name}"
    return Step(step_name, (Derivative(symbol, by), problem.readable(partial(of, name))), "partial")


def by_differences(of: Expr, name: str, at: Mapping[str, float]) -> float:
    """Five points of the function itself, no rule of differentiation."""

    def value(steps: int) -> float:
        return numeric.number(of, {**at, name: at[name] + steps * STEP})

    return (8 * (value(1) - value(-1)) - (value(2) - value(-2))) / (12 * STEP)


def differences(work: Work, found: Iterable[Expr], pairs: Sequence[tuple[Expr, str]]) -> Work:
    """With the claim that each derivative found agrees with the differences of its function."""
    ours = tuple(found)
    return work.agrees(
        "differences",
        work.problem.symbols,
        lambda at: [numeric.number(expr, at) for expr in ours],
        lambda at: [by_differences(of, name, at) for of, name in pairs],
        DIFFERENCES,
    )
