"""A turn along a path on the board: its lines, its results by the parameter or the time, what holds them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from derive.algebra.normal import normal
from derive.derivation import Result
from derive.errors import NotDerivable
from derive.expression import Approximate, Call, Expr, Matrix, replace_all, walk
from derive.expression import replace as put_in
from derive.kinds.checks import route
from derive.kinds.path._frenet import Bent
from derive.kinds.path._timing import Timed, in_time
from derive.kinds.path._turning.angles import by_angles
from derive.kinds.path._turning.checks import turns
from derive.kinds.path._turning.course import Course, Way
from derive.kinds.path._turning.one_axis import about_one_axis
from derive.kinds.path._turning.quaternions import by_quaternions
from derive.kinds.work import Work
from derive.mechanics.paths import Turned

WAYS: Mapping[str, Callable[[Course], Way]] = {
    "axis-angle": about_one_axis,
    "slerp": by_quaternions,
    "euler-angles": by_angles,
}


@dataclass(frozen=True, slots=True)
class Oriented:
    """The board with all of it, and the results."""

    work: Work
    way: Way
    results: Mapping[str, Result]


def turning(work: Work, turned: Turned, found: Bent, time: Timed | None) -> Oriented:
    """Raises NotDerivable where nothing turns."""
    course = Course(turned, found, time)
    way = WAYS[turned.by](course)
    lines = {step.name: step for step in way.steps}
    work = work.showing(*(lines[name] for part in way.parts for name in part.lines))
    known = _finals(way, work, time)
    results = {name: _tidy(put_in(tree, known), work) for name, tree in way.results.items()}
    work = work.claim(route("turns", turns(course, way, results, work)))
    return Oriented(work, way, results)


def _finals(way: Way, work: Work, time: Timed | None) -> dict[Expr, Expr]:
    """What each name comes to by the time, or by the parameter where there is none."""
    found: dict[Expr, Expr] = {}
    for name in way.known:
        tree = replace_all(name, way.known)
        found[name] = tree if isinstance(tree, Matrix) else _final(tree, work, time)
    return found


def _tidy(tree: Expr, work: Work) -> Expr:
    """As a person writes it, where there are no functions in it that would be taken apart."""
    if isinstance(tree, Matrix):
        return Matrix(tuple(tuple(_tidy(entry, work) for entry in row) for row in tree.rows))
    nodes = tuple(walk(tree))
    if any(
        isinstance(node, Approximate) or (isinstance(node, Call) and node.function != "sqrt")
        for node in nodes
    ):
        return tree
    return work.problem.readable(normal(tree))


def _final(tree: Expr, work: Work, time: Timed | None) -> Expr:
    if time is not None:
        return in_time(tree, time)
    try:
        return work.problem.readable(work.scalar(tree))
    except NotDerivable:
        return work.problem.final(put_in(tree, work.definitions))
