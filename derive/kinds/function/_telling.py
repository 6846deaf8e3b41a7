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
from derive.derivation import Phrase, Record, Said
from derive.expression import Expr, Relation, Symbol, multiply, number
from derive.kinds.function._writing import vanishing, written
from derive.kinds.problem import Problem

Equation: TypeAlias = tuple[Expr, Expr]


class CaseTold(Record):
    label: str  # "" for the whole, "1", "2.1"
    given: Relation | None  # what holds in the case
    moves: tuple[Phrase, ...]
    whole: Phrase | None  # what leaves the cases of a split
    split: tuple[Relation, ...]
    none: Phrase | None  # why there is no point
    points: tuple[tuple[Relation, ...], ...]


def told(case: Case, problem: Problem, order: Sequence[str]) -> tuple[CaseTold, ...]:
    """The cases, outermost first."""
    return tuple(_told(case, problem, order, ()))


def _told(case: Case, problem: Problem, order: Sequence[str], label: tuple[int, ...]) -> Iterator[CaseTold]:
    given = None if case.given is None else _equal(vanishing(case.given, problem))
    moves = (_move(move, problem, None if k else given) for k, move in enumerate(case.moves))
    told_moves = tuple(_in_turn([each for each in moves if each is not None]))
    split = tuple(_equal(vanishing(part, problem)) for part in case.split)
    leaves = Phrase("this-leaves" if label or case.moves else "the-equations-leave") if split else None
    points = tuple(_point(solution, problem, order) for solution in case.solutions)
    yield CaseTold(
        label=".".join(map(str, label)), given=given, moves=told_moves, whole=leaves, split=split,
        none=_none(case, problem) if not split and not points else None, points=points,
    )  # fmt: skip
    for k, inner in enumerate(case.cases, 1):
        yield from _told(inner, problem, order, (*label, k))


def _none(case: Case, problem: Problem) -> Phrase:
    """Why a case has no point."""
    if case.against is None:
        return Phrase("no-real-solution")
    return Phrase("impossible", {"against": _equal(vanishing(case.against, problem))})


def _equal(equation: Equation) -> Relation:
    return Relation(equation[0], "=", equation[1])


def _move(move: Move, problem: Problem, given: Relation | None) -> Phrase | None:
    """What is said of a move; nothing where the case says it already."""
    symbol: Expr = Symbol(move.variable) if move.variable else number(0)
    left = symbol**2 if move.rule == "square" else symbol
    pair = None if move.equation is None else vanishing(move.equation, problem)
    if move.rule == "last" and move.equation is not None:
        pair = _pure(move.equation, move.variable, problem) or pair
    equation: dict[str, Said] = {} if pair is None else {"equation": _equal(pair)}
    value = None if move.value is None else written(move.value, problem)
    match move.rule:
        case "squares":
            return Phrase("squares", equation)
        case "eliminate":
            return Phrase(
                "eliminate", {"left": tuple(_equal(vanishing(each, problem)) for each in move.left)}
            )
        case "last":
            return (
                Phrase("last-of", equation | {"variable": symbol})
                if move.variable
                else Phrase("last", equation)
            )
    if value is None:
        return None
    chain: dict[str, Said] = {"chain": Relation(left, "=", value)}
    own = (left, value) in (pair, pair[::-1]) if pair else False
    known = given is not None and equation.get("equation") == given
    if move.rule == "square":
        only = {"variable": symbol}
        if own and known:
            return Phrase("square", only)
        return Phrase("square-so", chain | only) if own else Phrase("square-follows", equation | chain | only)
    if own:
        return None if known else Phrase("so", chain)
    return Phrase("that-is", chain) if known else Phrase("follows", equation | chain)


def _in_turn(moves: Sequence[Phrase]) -> Iterator[Phrase]:
    """What one equation after the other leaves, told as going on where it does."""
    for before, each in zip((None, *moves), moves, strict=False):
        goes_on = before is not None and before.key == each.key == "last-of"
        yield Phrase("last-too", each.about) if goes_on else each


def _pure(equation: Scalar, name: str, problem: Problem) -> Equation | None:
    """(a^2 + b^2) x^2 = a^2 r^2: an equation in one power of its unknown alone."""
    k = coefficients(equation, name)
    if any(k[1:-1]) or k[-1].constant is not None:
        return None
    power = Symbol(name) if len(k) == 2 else Symbol(name) ** number(len(k) - 1)
    return multiply(problem.readable(k[-1]), power), problem.readable(-k[0])


def _point(solution: Solution, problem: Problem, order: Sequence[str]) -> tuple[Relation, ...]:
    known = [(name, solution.values[name]) for name in order if name in solution.values]
    return tuple(Relation(Symbol(name), "=", written(value, problem)) for name, value in known)


def divided_by(case: Case, problem: Problem) -> tuple[Expr, ...]:
    """The expressions in the parameters that must not vanish for the moves to be possible, but those of which
    the sheet says so."""
    found: dict[str, Expr] = {}
    for each in _all(case):
        for move in each.moves:
            if move.value is not None and move.value.denominator is not None:
                _put(found, Scalar(move.value.ring, move.value.denominator), problem)
        if each.against is not None and each.against.constant is None:
            _put(found, each.against, problem)
    sure = {Symbol(name) for name, said in problem.assumptions.items() if said in ("positive", "nonzero")}
    return tuple(tree for tree in found.values() if tree not in sure)


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
