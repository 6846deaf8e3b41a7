"""The cases of a solution as records, for the words to tell one after the other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeAlias

from flint import arb

from derive.algebra.multivariate import factored
from derive.algebra.scalar import Scalar
from derive.algebra.solving.elimination_rules import Move
from derive.algebra.solving.polynomial_systems import Case, Solution
from derive.algebra.solving.polynomials import coefficients
from derive.derivation import Record
from derive.expression import Expr, Symbol, multiply, number
from derive.kinds.function._writing import vanishing, written
from derive.kinds.problem import Problem

Equation: TypeAlias = tuple[Expr, Expr]


class MoveTold(Record):
    rule: str
    equation: Equation | None
    variable: Expr
    chain: Equation | None  # what follows
    left: tuple[Equation, ...]
    own: bool  # the equation is the chain already, so that there is nothing to say
    given: bool  # the equation is that of the case itself


class CaseTold(Record):
    label: str  # "" for the whole, "1", "2.1"
    given: Equation | None  # what holds in the case
    moves: tuple[MoveTold, ...]
    split: tuple[Equation, ...]
    against: Equation | None  # what cannot hold
    points: tuple[tuple[Equation, ...], ...]


def told(case: Case, problem: Problem, order: Sequence[str]) -> tuple[CaseTold, ...]:
    """The cases, outermost first."""
    return tuple(_told(case, problem, order, ()))


def _told(case: Case, problem: Problem, order: Sequence[str], label: tuple[int, ...]) -> Iterator[CaseTold]:
    given = None if case.given is None else vanishing(case.given, problem)
    yield CaseTold(
        label=".".join(map(str, label)),
        given=given,
        moves=tuple(_move(move, problem, None if k else given) for k, move in enumerate(case.moves)),
        split=tuple(vanishing(part, problem) for part in case.split),
        against=None if case.against is None else vanishing(case.against, problem),
        points=tuple(_point(solution, problem, order) for solution in case.solutions),
    )
    for k, inner in enumerate(case.cases, 1):
        yield from _told(inner, problem, order, (*label, k))


def _move(move: Move, problem: Problem, given: Equation | None) -> MoveTold:
    symbol: Expr = Symbol(move.variable) if move.variable else number(0)
    left = symbol**2 if move.rule == "square" else symbol
    value = None if move.value is None else written(move.value, problem)
    equation = None if move.equation is None else vanishing(move.equation, problem)
    if move.rule == "last" and move.equation is not None:
        equation = _pure(move.equation, move.variable, problem) or equation
    return MoveTold(
        rule=move.rule,
        equation=equation,
        variable=symbol,
        chain=None if value is None else (left, value),
        left=tuple(vanishing(each, problem) for each in move.left),
        own=(left, value) in (equation, equation[::-1]) if equation else False,
        given=given is not None and equation == given,
    )


def _pure(equation: Scalar, name: str, problem: Problem) -> Equation | None:
    """(a^2 + b^2) x^2 = a^2 r^2: an equation in one power of its unknown alone."""
    k = coefficients(equation, name)
    if any(k[1:-1]) or k[-1].constant is not None:
        return None
    power = Symbol(name) if len(k) == 2 else Symbol(name) ** number(len(k) - 1)
    return multiply(problem.readable(k[-1]), power), problem.readable(-k[0])


def _point(solution: Solution, problem: Problem, order: Sequence[str]) -> tuple[Equation, ...]:
    known = [(name, solution.values[name]) for name in order if name in solution.values]
    return tuple((Symbol(name), written(value, problem)) for name, value in known)


def divided_by(case: Case, problem: Problem) -> tuple[Expr, ...]:
    """The expressions in the parameters that must not vanish for the moves to be possible."""
    found: dict[str, Expr] = {}
    for each in _all(case):
        for move in each.moves:
            if move.value is not None and move.value.denominator is not None:
                _put(found, Scalar(move.value.ring, move.value.denominator), problem)
        if each.against is not None and each.against.constant is None:
            _put(found, each.against, problem)
    return tuple(found.values())


def _put(found: dict[str, Expr], value: Scalar, problem: Problem) -> None:
    _, parts = factored(value.numerator)
    for part, _power in parts:
        tree = problem.readable(Scalar(value.ring, part))
        found.setdefault(repr(tree), tree)


def _all(case: Case) -> Iterator[Case]:
    yield case
    for inner in case.cases:
        yield from _all(inner)


def is_enclosed(solutions: Sequence[Solution]) -> bool:
    """Whether any value is known only within a ball."""
    return any(isinstance(value, arb) for each in solutions for value in each.values.values())
