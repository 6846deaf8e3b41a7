"""The case distinction as it is told, held to the points that it ends with: what is said of a case holds at
every point of it and of the cases within."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

from derive.algebra.numbers.floats import Point, completed, number
from derive.derivation import Claim
from derive.expression import Symbol
from derive.kinds.checks import close, random_points, route
from derive.kinds.function._telling import CaseTold, Equation
from derive.kinds.problem import Problem

TRIED, EACH = 60, 2
CLOSE = 1e-6
UNREAL = (ValueError, ZeroDivisionError, OverflowError)


def cases_told(cases: Sequence[CaseTold], variables: Sequence[str], problem: Problem) -> Iterator[Claim]:
    """The claim, where there is a point to try it on."""
    held = [
        holds
        for case in cases
        for point in case.points
        for at in islice(_places(point, variables, problem), EACH)
        for outer in cases
        if _within(case, outer)
        for holds in _statements(outer, at)
    ]
    if held:
        yield route("cases", held)


def _places(
    point: Sequence[Equation], variables: Sequence[str], problem: Problem
) -> Iterator[dict[str, float]]:
    """Where the point is real, with its coordinates as they are told; free ones are random."""
    for parameters in random_points(problem.symbols | {*variables}, TRIED):
        at = completed(parameters, problem.where)
        try:
            yield {
                **at,
                **{name.name: number(value, at) for name, value in point if isinstance(name, Symbol)},
            }
        except UNREAL:
            continue


def _within(case: CaseTold, outer: CaseTold) -> bool:
    return outer.label in ("", case.label) or case.label.startswith(f"{outer.label}.")


def _statements(case: CaseTold, at: Point) -> Iterator[bool]:
    """Every equation that is said to hold, and one of those that the case leaves."""
    for equation in filter(None, (case.given, *(move.equation for move in case.moves))):
        yield _holds(equation, at)
    for move in case.moves:
        yield from (_holds(each, at) for each in (move.chain, *move.left) if each)
    if case.split:
        yield any(_holds(each, at) for each in case.split)
    if case.against:
        yield not _holds(case.against, at)


def _holds(equation: Equation, at: Mapping[str, float]) -> bool:
    left, right = equation
    return close(number(left, at), number(right, at), CLOSE)
