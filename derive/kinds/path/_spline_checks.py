"""A spline in space held to its conditions, exactly, and in numbers to one linear system for all of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point, completed, numbers
from derive.algebra.numbers.floats import number as value_of
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Result, Table
from derive.expression import Expr, Symbol
from derive.kinds.checks import close, lists, random_points, route
from derive.kinds.fields import TREES
from derive.kinds.path._splines import Solved
from derive.kinds.path._timing import T
from derive.kinds.profile._knots import Knots
from derive.kinds.profile._pieces import Span
from derive.kinds.work import Work
from derive.mechanics.paths import Via

POINTS, NEAR = 2, 1e-8
SHARES = (0.2, 0.7)  # of a piece
CHORDS = 400


@dataclass(frozen=True, slots=True)
class Told:
    """What is told of a spline: the name of the velocities, the points and pieces of each coordinate, the
    tables of the points and of the pieces, what is said of how it bends, and the results."""

    V: Symbol
    knots: Sequence[Knots]
    spans: Sequence[Sequence[Span]]
    points: Table
    pieces: Table
    bends: Phrase | None
    results: Mapping[str, Result]


def held(work: Work, shape: Via, told: Told) -> Work:
    """With the claims: through every point, smooth between the pieces, and as it is written."""
    through = (ok for one, of in zip(told.knots, told.spans, strict=True) for ok in _passes(work, one, of))
    smooth = (ok for of in told.spans for ok in _smooth(work, of))
    work = work.law("passes-every-point", through).law("is-smooth", smooth)
    drawn = random_points(work.problem.symbols, POINTS)
    known = (completed(at, work.problem.where) for at in drawn)
    written = (ok for at in known for ok in _as_written(work, shape, told, at))
    typed = ((time, *place) for time, place in zip(shape.times, shape.places, strict=True))
    work = work.law("all-conditions", lists(told.points, typed))
    return work.claim(route("all-conditions", written))


def _passes(work: Work, knots: Knots, spans: Sequence[Span]) -> Iterator[bool]:
    """Each point at its time; at the ends without velocity, or without acceleration."""
    places = knots.scalars(knots.places)
    for k, span in enumerate(spans):
        yield span.derivative(work, Scalar.of(0), 0) == places[k]
    last = work.scalar(spans[-1].end - spans[-1].start)
    yield spans[-1].derivative(work, last, 0) == places[-1]
    order = 1 if knots.ends == "clamped" else 2
    yield not spans[0].derivative(work, Scalar.of(0), order)
    yield not spans[-1].derivative(work, last, order)


def _smooth(work: Work, spans: Sequence[Span]) -> Iterator[bool]:
    """Place, velocity and acceleration are the same on both sides of a point."""
    for before, after in pairwise(spans):
        h = work.scalar(before.end - before.start)
        for order in range(3):
            yield before.derivative(work, h, order) == after.derivative(work, Scalar.of(0), order)


def _as_written(work: Work, shape: Via, told: Told, known: Point) -> Iterator[bool]:
    """The system and its solution, the table of the pieces, and the results by the time."""
    import numpy as np

    made, results = Solved(shape, known), told.results
    times, count = made.times, len(shape.places[0])
    laws = {step.name: step.chain for step in work.steps}
    velocities = made.velocities()
    (left, right), (_, shown) = laws["system"], laws["velocities"]
    yield close(arrays(left, {**known, told.V.name: velocities}), arrays(right, known), NEAR)
    yield close(arrays(shown, known), velocities, NEAR)
    for k, row in enumerate(told.pieces.rows):
        piece, axis = divmod(k, count)
        start, end, *coefficients = (value_of(_tree(cell), known) for cell in (*row[1:3], *row[4:]))
        yield close([start, end], times[piece : piece + 2])
        yield close(coefficients, made.coefficients[axis][4 * piece : 4 * piece + 4], NEAR)
        yield row[3] == Symbol("xyz"[axis])
    for low, high in pairwise(times):
        for share in SHARES:
            t = low + share * (high - low)
            at = {**known, T.name: t}
            p, v, a = (made.at(t, order) for order in range(3))
            for name, theirs in (("p", p), ("v", v), ("a", a), ("t", v / np.linalg.norm(v))):
                yield close(numbers(_tree(results[name]), at), theirs, NEAR)
            yield from _bends(results, told.bends, v, a, at)
    if "length" in results:
        places = np.array([made.at(t, 0) for t in np.linspace(times[0], times[-1], CHORDS * len(times))])
        chords = float(np.linalg.norm(np.diff(places, axis=0), axis=1).sum())
        yield close(value_of(_tree(results["length"]), known), chords, 1e-4)


def _bends(results: Mapping[str, Result], said: Phrase | None, v: Any, a: Any, at: Point) -> Iterator[bool]:
    """The curvature by the acceleration across the path; the unit vectors by what is left of it there."""
    import numpy as np

    t = v / np.linalg.norm(v)
    side = a - t * (t @ a)
    kappa = np.linalg.norm(side) / (v @ v)
    yield close(value_of(_tree(results["curvature"]), at), kappa, NEAR)
    if said is None:
        return
    if "n" not in results:
        yield said.key == "goes-straight"
        yield close(side, 0 * side, NEAR * max(1.0, float(np.linalg.norm(a))))
    elif np.linalg.norm(side) > NEAR * np.linalg.norm(a):
        yield said.key == ("bends-in-the-plane" if len(v) == 2 else "bends-in-space")
        n = side / np.linalg.norm(side)
        yield close(numbers(_tree(results["n"]), at), n, NEAR)
        if "b" in results:
            yield close(numbers(_tree(results["b"]), at), np.cross(t, n), NEAR)


def _tree(result: Any) -> Expr:
    if not isinstance(result, TREES):
        raise TypeError("it is no formula")
    tree: Expr = result
    return tree
