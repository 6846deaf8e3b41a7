"""The case distinction as it is told, held to the points that it ends with: what is said of a case holds at
every point of it and of the cases within."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

from derive.algebra.numbers.floats import Point, completed, number
from derive.derivation import Claim, Phrase
from derive.expression import Relation, Symbol
from derive.kinds.checks import close, law, random_points, route
from derive.kinds.function._telling import CaseTold
from derive.kinds.problem import Problem

SAID = {  # what is said, by what is said of
    frozenset(("equation",)): ("squares", "last"), frozenset(("left",)): ("eliminate",),
    frozenset(("equation", "variable")): ("last-of", "last-too"), frozenset(("variable",)): ("square",),
    frozenset(("chain", "variable")): ("square-so",), frozenset(("chain",)): ("so", "that-is"),
    frozenset(("equation", "chain", "variable")): ("square-follows",),
    frozenset(("equation", "chain")): ("follows",),
}  # fmt: skip
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
    yield law("sentences", phrases_told(cases))


def _places(
    point: Sequence[Relation], variables: Sequence[str], problem: Problem
) -> Iterator[dict[str, float]]:
    """Where the point is real, with its coordinates as they are told; free ones are random."""
    for parameters in random_points(problem.symbols | {*variables}, TRIED):
        at = completed(parameters, problem.where)
        try:
            yield {
                **at,
                **{each.left.name: number(each.right, at) for each in point if isinstance(each.left, Symbol)},
            }
        except UNREAL:
            continue


def _within(case: CaseTold, outer: CaseTold) -> bool:
    return outer.label in ("", case.label) or case.label.startswith(f"{outer.label}.")


def _statements(case: CaseTold, at: Point) -> Iterator[bool]:
    """Every equation that is said to hold says something and does, and one of those that the case leaves."""
    for each in (*([case.given] if case.given else []), *_relations(case.moves)):
        yield each.left != each.right and _holds(each, at)
    if case.split:
        yield any(_holds(each, at) for each in case.split)
    if case.none:
        yield from (not _holds(each, at) for each in _relations((case.none,)))


def _relations(phrases: Sequence[Phrase]) -> Iterator[Relation]:
    for phrase in phrases:
        for said in phrase.about.values():
            yield from (
                part for part in (said if isinstance(said, tuple) else (said,)) if isinstance(part, Relation)
            )


def _holds(equation: Relation, at: Mapping[str, float]) -> bool:
    if equation.sign != "=" or isinstance(equation.left, Relation):
        return False
    return close(number(equation.left, at), number(equation.right, at), CLOSE)


def phrases_told(cases: Sequence[CaseTold]) -> Iterator[bool]:
    """Which sentence stands for what is said: by what it says."""
    labels = {case.label for case in cases}
    for case in cases:
        inner = case.label in labels and any(
            each.startswith(f"{case.label}." if case.label else "1") for each in labels
        )
        yield bool(case.split) == inner == (case.whole is not None)
        yield (case.none is not None) == (not case.split and not case.points)
        if case.none:
            yield case.none.key == ("impossible" if case.none.about else "no-real-solution")
        for phrase in case.moves:
            yield SAID.get(frozenset(phrase.about), ()) == () or phrase.key in SAID[frozenset(phrase.about)]
