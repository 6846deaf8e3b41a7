"""Names for a function and its components that stand for nothing else in the problem."""

from __future__ import annotations

from derive.algebra.function import Function
from derive.expression import Symbol
from derive.kinds.problem import Problem
from derive.names import free

LETTERS = ("f", "F", "h", "phi", "u")
MULTIPLIERS = ("lambda", "mu", "nu")


def function_name(problem: Problem) -> Symbol:
    """A letter for the function."""
    return Symbol(free(problem.taken, *LETTERS))


def component_names(function: Function, problem: Problem) -> tuple[Symbol, ...]:
    """f for a scalar function; f_1, f_2, ... for the components of a vector function."""
    if not function.vector:
        return (function_name(problem),)
    return _indexed(LETTERS, len(function.values), problem)


def multiplier_names(count: int, problem: Problem) -> tuple[Symbol, ...]:
    """lambda for one constraint; lambda_1, lambda_2, ... for several."""
    if count == 1:
        return (Symbol(free(problem.taken, *MULTIPLIERS)),)
    return _indexed(MULTIPLIERS, count, problem)


def _indexed(letters: tuple[str, ...], count: int, problem: Problem) -> tuple[Symbol, ...]:
    indices = [str(k) for k in range(1, count + 1)]
    letter = free(problem.taken, *letters, indices=("", *indices))
    return tuple(Symbol(f"{letter}_{k}") for k in indices)
