"""A motion worked out: its factors one by one, and their product in the order that the axes command."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import numbers
from derive.derivation import Claim, Derivation, PageFacts, Phrase, Result, Step
from derive.expression import Expr, Matrix, Symbol
from derive.kinds.checks import agreement, is_rotation, law, links
from derive.kinds.motion._factors import Factors, Placed, factors_of, rounded_matrix, value_of
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed
from derive.mechanics.motion import Move
from derive.mechanics.poses import homogeneous, position_part, rotation_part
from derive.mechanics.sequences import mode, order


class Facts(PageFacts):
    mode: str
    placed: tuple[Placed, ...]
    vectors: tuple[str, ...]  # steps
    rodrigues: tuple[str, ...]  # steps
    elementary: tuple[str, ...]  # steps
    noun: str


def composed(
    kind: str, moves: Sequence[Move], problem: Problem, size: Literal[3, 4], evaluate: bool
) -> Derivation:
    """R (3 by 3) or T (4 by 4) of moves, as a derivation. `evaluate` writes it in decimals where nothing
    is left to give; the results stay exact."""
    name = Symbol("R" if size == 3 else "T")
    numeric = evaluate and all(value_of(move.by, problem) is not None for move in moves)
    factors = factors_of(moves, problem, size, numeric)
    value = factors.product(order(moves))
    written = problem.readable_matrix(value)
    exact = problem.final(written)
    product = _step(name, factors, written, exact, problem, numeric)
    steps = (*factors.steps, product)
    definitions: dict[Expr, Expr] = {**factors.definitions, name: written}
    claims = (
        *links(steps, {**problem.names, **definitions}),
        *_laws(value, problem, name.name),
        second_route(name.name, moves, exact, problem),
    )
    results: dict[str, Result] = {name.name: exact, **_factor_results(factors, problem)}
    facts = _facts(factors, numeric, name)
    return Derivation(
        kind, steps, results, claims, definitions, _evaluated(results, problem, numeric), facts=facts
    )


def _step(
    name: Symbol, factors: Factors, written: Matrix, exact: Expr, problem: Problem, numeric: bool
) -> Step:
    named = (factors.named(order(factors.moves)),) if factors.factors else ()
    if numeric:
        return Step(name.name, (name, *named, rounded_matrix(written, problem)), "product")
    last = () if exact == written else (exact,)
    return Step(name.name, (name, *named, written, *last), "product")


def _facts(factors: Factors, numeric: bool, name: Symbol) -> Facts:
    return Facts(
        mode=mode(factors.moves),
        placed=factors.placed(),
        vectors=factors.told("unit-vector"),
        rodrigues=factors.told("rodrigues"),
        elementary=factors.told("elementary"),
        noun="rotation" if factors.size == 3 else "move",
        numbers=() if numeric else (name.name,),
    )


def _factor_results(factors: Factors, problem: Problem) -> dict[str, Result]:
    """R_1, R_2, ... or A_1, A_2, ..., exact, in the order of the motion."""
    letter = "R" if factors.size == 3 else "A"
    return {
        f"{letter}_{factor.index}": problem.final(problem.readable_matrix(factor.value))
        for factor in factors.factors
    }


def _evaluated(results: dict[str, Result], problem: Problem, numeric: bool) -> dict[str, Any]:
    """The results in floats, where the page shows them so already."""
    if not numeric:
        return {}
    point = completed({}, problem.where)
    return {name: numbers(result, point) for name, result in results.items() if isinstance(result, Matrix)}


def _laws(value: ScalarMatrix, problem: Problem, name: str) -> tuple[Claim, ...]:
    R = normal_matrix(problem.readable_matrix(value), problem.names)
    if value.shape == (3, 3):
        return is_rotation(R, name)
    inverse = homogeneous(rotation_part(R).T, (-(rotation_part(R).T @ position_part(R))).entries)
    return (*is_rotation(rotation_part(R)), law("inverse-of", inverse @ R == ScalarMatrix.identity(4)))


def second_route(name: str | Phrase, moves: Sequence[Move], exact: Expr, problem: Problem) -> Claim:
    """The motion made in numbers, every move as it is told, on the axes themselves."""
    from derive.mechanics.oracle import elementary

    def other(point: dict[str, float]) -> Any:
        import numpy as np

        at, T = completed(point, problem.where), np.eye(4)
        for move in moves:
            made = elementary(move, at)
            T = made @ T if move.about == "world" else T @ made
        return T[:3, :3] if isinstance(exact, Matrix) and exact.shape == (3, 3) else T

    return agreement(
        "motion-made",
        problem.symbols,
        lambda point: numbers(exact, completed(point, problem.where)),
        lambda point: other(dict(point)),
        name=name,
    )
