"""Names for a function and its components that stand for nothing else in the problem."""

from __future__ import annotations

from derive.algebra.function import Function
from derive.errors import NotDerivable
from derive.expression import Symbol
from derive.kinds.problem import Problem

LETTERS = ("f", "F", "h", "phi", "u")
MULTIPLIERS = ("lambda", "mu", "nu")


def function_name(problem: Problem) -> Symbol:
    """A letter for the function."""
    return Symbol(_free(problem, LETTERS))


def component_names(function: Function, problem: Problem) -> tuple[Symbol, ...]:
    """f for a scalar function; f_1, f_2, ... for the components of a vector function."""
    if not function.vector:
        return (function_name(problem),)
    letter = _free(problem, LETTERS, len(function.values))
    return tuple(Symbol(f"{letter}_{k}") for k in range(1, len(function.values) + 1))


def multiplier_names(count: int, problem: Problem) -> tuple[Symbol, ...]:
    """lambda for one constraint; lambda_1, lambda_2, ... for several."""
    if count == 1:
        return (Symbol(_free(problem, MULTIPLIERS)),)
    letter = _free(problem, MULTIPLIERS, count)
    return tuple(Symbol(f"{letter}_{k}") for k in range(1, count + 1))


def _free(problem: Problem, letters: tuple[str, ...], indices: int = 0) -> str:
    taken = problem.symbols | set(problem.where)
    for letter in letters:
        if not {letter, *(f"{letter}{mark}{k}" for k in range(1, indices + 1) for mark in ("_", ""))} & taken:
            return letter
    raise NotDerivable(f"every one of the names {', '.join(letters)} is taken; rename one of yours")
