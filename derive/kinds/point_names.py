"""The names that may stand under `evaluate:`: of a problem, of its answers, of what is to be reached."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from derive.derivation import Branch, Derivation
from derive.expression import Expr, free_symbols
from derive.kinds.problem import TREES, Problem, expressions

ALWAYS = frozenset({"t", "s"})  # the time, and the variable of Laplace
POSE = frozenset({"x", "y", "z", *(f"r{row}{column}" for row in (1, 2, 3) for column in (1, 2, 3))})


def point_names(problem: Problem, answers: Iterable[Derivation]) -> frozenset[str]:
    """Every name of the subject, of `where` and `symbols`, of the options, and of the answers with what they
    rest on; rates and accelerations of the variables; the elements of a pose that is asked to be reached."""
    found = {*ALWAYS, *problem.where, *problem.assumptions, *problem.symbols}
    found |= {f"{name}{dots}" for name in problem.symbols for dots in ("_dot", "_ddot")}
    if any("inverse-kinematics" in kind for kind, _ in problem.questions):
        found |= POSE
    for _, options in problem.questions:
        for value in (options.__dict__ or {}).values():
            found |= {value} if isinstance(value, str) else _names(value)
            found |= {each for each in value if isinstance(each, str)} if isinstance(value, tuple) else set()
    for answer in answers:
        found |= frozenset().union(*map(free_symbols, _trees(answer)))
    return frozenset(found)


def _names(value: Any) -> frozenset[str]:
    return frozenset().union(*map(free_symbols, expressions(value)))


def _trees(answer: Derivation) -> Iterator[Expr]:
    for step in answer.all_steps():
        yield from step.chain
    for name, value in answer.definitions.items():
        yield from (name, value)
    for result in answer.results.values():
        yield from _of_result(result)
    for used in answer.uses:
        yield from _trees(used)


def _of_result(result: Any) -> Iterator[Expr]:
    if isinstance(result, TREES):
        yield result
    elif isinstance(result, Branch):
        yield from (tree for tree in result.values.values() if isinstance(tree, TREES))
    elif isinstance(result, tuple):
        for part in result:
            yield from _of_result(part)
