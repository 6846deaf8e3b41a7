"""The motion along a path held to one in numbers: laws of time from their conditions or by search, velocities
by differences of the place over time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise
from math import factorial, perm
from typing import Any

from derive.algebra.numbers.floats import Point, completed, number
from derive.expression import Expr, Symbol
from derive.kinds.checks import random_points
from derive.kinds.meanings import Chain, Names, column_of, farthest
from derive.kinds.path._frenet import Bent
from derive.kinds.path._meanings import Made, made, meant
from derive.kinds.path._timing import T_1, T_2, A, T, Timed
from derive.kinds.problem import Problem
from derive.mechanics import trapezoid
from derive.mechanics.course import Course, Piece, at
from derive.mechanics.paths import Timing

POINTS, SHARES, SURE = 2, (0.23, 0.71), 1e-5
STEP = 1e-3  # of the whole time
Chains = Callable[[int], list[Chain]]  # of the piece with this number


def agrees(problem: Problem, found: Bent, timed: Timed, chains: Chains) -> Iterator[bool]:
    """Whether the chains of each piece hold at times within it, at random points of the symbols."""
    for drawn in random_points(problem.symbols - {found.along.s.name}, POINTS):
        known = completed(drawn, problem.where)
        path = made(problem.subject, found.along.s.name, known)
        course = driven(problem.subject.timing, path, problem.subject.along, known)
        if len(course) != len(timed.pieces):
            yield False
            return
        joints = [course[0].start, *(piece.end for piece in course)]
        for k, (start, end) in enumerate(pairwise(joints)):
            for share in SHARES:
                names = _names(problem, found, timed, path, course, start + share * (end - start), known)
                yield farthest(chains(k), names) < SURE


def driven(timing: Timing, path: Made, steady: bool, known: Point) -> Course:
    """The parameter over time, in as many pieces as its law has."""
    low, high = path.ends or (0.0, 1.0)
    sizes = {
        key: None if value is None else number(value, known)
        for key, value in (("time", timing.time), ("v_max", timing.v_max), ("a_max", timing.a_max))
    }
    if timing.law != "trapezoidal":
        return _polynomial(low, high, sizes["time"] or 1.0, 2 if timing.law == "cubic" else 3)
    d = path.length(low, high) if steady else high - low
    pieces = trapezoid.course(_switching(d, **sizes))
    per = (high - low) / d
    moved = []
    for piece in pieces:
        if piece.end - piece.start < trapezoid.FLAT * pieces[-1].end:
            continue
        first, *others = (each * per for each in piece.coefficients)
        moved.append(Piece(piece.start, piece.end, (low + first, *others)))
    return tuple(moved)


def _polynomial(low: float, high: float, time: float, order: int) -> Course:
    """By the conditions at both ends, solved in numbers."""
    import numpy as np

    size = range(2 * order)
    start = [[float(factorial(rate)) * (k == rate) for k in size] for rate in range(order)]
    end = [[perm(k, rate) * time ** max(k - rate, 0) for k in size] for rate in range(order)]
    right = [low, *[0.0] * (order - 1), high, *[0.0] * (order - 1)]
    solved: list[float] = np.linalg.solve(np.array(start + end), np.array(right)).tolist()
    return (Piece(0.0, time, tuple(solved)),)


def _switching(d: float, time: float | None, v_max: float | None, a_max: float | None) -> trapezoid.Switching:
    """By search, or with the area under the velocity found by halving."""
    if time is None:
        return trapezoid.searched(d, v_max or 0.0, a_max or 0.0)
    whole = time

    def area(t_1: float) -> float:
        v = (a_max or 0.0) * t_1 if v_max is None else v_max
        return v * (whole - t_1)

    low, high = 0.0, whole / 2
    rising = area(low) < area(high)
    for _ in range(80):
        middle = (low + high) / 2
        if (area(middle) < d) == rising:
            low = middle
        else:
            high = middle
    v = (a_max or 0.0) * low if v_max is None else v_max
    return trapezoid.Switching("trapezoidal", low, whole - low, whole, v, v / low)


def _names(
    problem: Problem, found: Bent, timed: Timed, path: Made, course: Course, time: float, known: Point
) -> Names:
    """What every name means at a time."""
    import numpy as np

    s, s_dot, s_ddot = (at(course, time, order) for order in range(3))
    h = STEP * course[-1].end
    near = next(piece for piece in course if time <= piece.end)
    a, b, c, d, e = (np.array(path.place(near.at(time + k * h))) for k in (-2, -1, 0, 1, 2))
    velocity, change = (a - 8 * b + 8 * d - e) / (12 * h), (-a + 16 * b - 30 * c + 16 * d - e) / (12 * h * h)
    there = {**known, found.along.s.name: s}
    letters: dict[Expr, Any] = {Symbol(name): value for name, value in there.items()}
    told, p = meant(problem, found, there), found.along.p.name
    names: dict[Expr, Any] = {
        **letters, **told, T: time,
        **dict(zip(timed.names, (s, s_dot, s_ddot), strict=True)),
        timed.time: course[-1].end, T_1: course[0].end, T_2: course[-1].start,
        Symbol(f"{p}_dot"): column_of(velocity), Symbol(f"{p}_ddot"): column_of(change),
    }  # fmt: skip
    first = abs(at(course, course[0].end / 2, 2))
    low, high = path.ends or (0.0, 1.0)
    names[A] = first * (told[found.along.L] / (high - low) if problem.subject.along else 1.0)
    for key, name in timed.given.items():
        names[name] = number(getattr(problem.subject.timing, key), known)
    return names
