"""A turn along a path in numbers: both orientations move by move, the turn between them by what it leaves in
place, and all rates by differences over time."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import pairwise
from math import pi
from typing import TYPE_CHECKING, Any

from derive.algebra.infix import text
from derive.algebra.numbers.floats import Point, completed, number, numbers
from derive.derivation import Result
from derive.expression import Expr, Indexed, Matrix, Symbol, multiply
from derive.expression import number as exact
from derive.kinds.checks import close, random_points
from derive.kinds.fields import TREES
from derive.kinds.meanings import column_of, farthest
from derive.kinds.path._meanings import made
from derive.kinds.path._meanings import meant as meant_of
from derive.kinds.path._timing import T as MOMENT
from derive.kinds.path._timing_checks import driven
from derive.kinds.path._turning.course import Course, Way
from derive.kinds.pose._meanings import entries_of, turn_of
from derive.kinds.work import Work
from derive.mechanics.course import at
from derive.mechanics.oracle import exponential, vee
from derive.mechanics.oracle import made as moved
from derive.mechanics.oracle.poses import crossing, in_sequence
from derive.mechanics.paths import Oriented

if TYPE_CHECKING:
    from numpy.typing import NDArray

POINTS, SHARES, SURE = 2, (0.23, 0.71), 1e-5
HALF = 1e-6  # of half a turn
STEP = 1e-3  # of the whole time


def turns(course: Course, way: Way, results: Mapping[str, Result], work: Work) -> Iterator[bool]:
    """Every line and every result, at random points of the symbols and moments of the motion."""
    problem, s = course.problem, course.found.along.s
    for drawn in random_points(problem.symbols - {s.name}, POINTS):
        known = dict(completed(drawn, problem.where))
        body = Body(course, way, known)
        for when in body.moments():
            names = body.names(when)
            yield farthest([step.chain for step in way.steps], names) < SURE
            there = {**known, s.name: names[s], MOMENT.name: when}
            yield from _said(body)
            for name, tree in results.items():
                if isinstance(tree, TREES):
                    yield close(numbers(tree, there), body.result(name, names), SURE)


def _said(body: Body) -> Iterator[bool]:
    """Whether the sentences are about what they mean, and half a turn is called one."""
    course, called = body.course, body.way.called
    known: dict[str, Any] = {**called, "I": Symbol("I"), "order": course.turned.convention}
    known |= {"u": called["share"], "k": called.get("axis"), "R": called.get("between")}
    known["twice"] = multiply(exact(2), called["arc"]) if "arc" in called else None
    for part in body.way.parts:
        yield all(known[key] == value for key, value in part.said.about.items())
    if course.turned.by == "axis-angle":
        keys = {part.said.key for part in body.way.parts}
        yield ("half-turn" in keys) == (pi - body.angle < HALF)


class Body:
    """A body that turns, in numbers."""

    def __init__(self, course: Course, way: Way, known: Point) -> None:
        problem = course.problem
        self.course, self.way, self.known = course, way, known
        self.path = made(problem.subject, course.found.along.s.name, known)
        timing = problem.subject.timing
        self.law = None if timing is None else driven(timing, self.path, problem.subject.along, known)
        self.first, self.last = (self._placed(end) for end in (course.turned.start, course.turned.end))
        between = self.first.T @ self.last
        like = way.results.get("axis")
        hint = numbers(like, known) if isinstance(like, Matrix) else None
        self.angle, self.axis = turn_of(between, hint)

    def moments(self) -> Iterator[float]:
        """Within each piece of the law; of a path alone values of its parameter."""
        low, high = self.path.ends or (0.0, 1.0)
        ends = [low, high] if self.law is None else [0.0, *(piece.end for piece in self.law)]
        for start, end in pairwise(ends):
            yield from (start + share * (end - start) for share in SHARES)

    def _placed(self, end: Oriented) -> NDArray[Any]:
        import numpy as np

        if end.matrix is not None:
            R: NDArray[Any] = np.array(numbers(end.matrix, self.known))
            return R
        placed: NDArray[Any] = moved(end.moves, self.known)[:3, :3]
        return placed

    def share(self, when: float) -> float:
        """Of the way, at a moment."""
        low, high = self.path.ends or (0.0, 1.0)
        s = when if self.law is None else at(self.law, when)
        return (s - low) / (high - low)

    def angles(self, share: float) -> NDArray[Any]:
        """Those of the convention."""
        import numpy as np

        ends = (self.course.turned.start.angles or (), self.course.turned.end.angles or ())
        a, b = (np.array([number(each, self.known) for each in end]) for end in ends)
        found: NDArray[Any] = a + share * (b - a)
        return found

    def turned(self, share: float) -> NDArray[Any]:
        """The orientation (3 by 3) at a share of the way."""
        if self.course.turned.by == "euler-angles":
            return in_sequence(self.course.turned.convention, self.angles(share))
        found: NDArray[Any] = self.first @ exponential(share * self.angle * crossing(self.axis))
        return found

    def names(self, when: float) -> dict[Expr, Any]:
        """What every name means at a moment."""
        import numpy as np

        u = self.share(when)
        R, along = self.turned(u), self.course.found.along
        low, high = self.path.ends or (0.0, 1.0)
        meant: dict[str, Any] = {
            "R_s": self.first, "R_f": self.last, "between": self.first.T @ self.last, "angle": self.angle,
            "axis": column_of(self.axis), "share": u, "turned": u * self.angle, "skew": crossing(self.axis),
            "R": R, "arc": self.angle / 2, "I": np.eye(3),
        }  # fmt: skip
        meant |= self._quaternions(u)
        called = self.way.called
        names: dict[Expr, Any] = {Symbol(name): value for name, value in self.known.items()}
        s = low + u * (high - low)
        there = {**self.known, along.s.name: s}
        names |= {**meant_of(self.course.problem, self.course.found, there), along.s: s}
        names |= {Symbol("I"): np.eye(3)}
        names |= entries_of(meant["between"])
        if self.course.turned.by == "euler-angles":
            meant |= self._of_angles(u)
        if self.law is not None and self.course.time is not None:
            rates = [at(self.law, when, order) for order in range(3)]
            names |= dict(zip(self.course.time.names, rates, strict=True))
            for name, rate in zip(("_dot", "_ddot"), rates[1:], strict=True):
                names[Symbol(f"{text(called['share'])}{name}")] = rate / (high - low)
            meant |= self._rates(when)
        return {**names, **{name: meant[key] for key, name in called.items() if key in meant}}

    def _rates(self, when: float) -> dict[str, Any]:
        """The angular velocity and acceleration, and those of the angles, by differences."""
        import numpy as np

        law = self.law or ()
        h = STEP * law[-1].end
        near = next(piece for piece in law if when <= piece.end)
        low, high = self.path.ends or (0.0, 1.0)

        def share(t: float) -> float:
            return (near.at(t) - low) / (high - low)

        def omega(t: float) -> NDArray[Any]:
            a, b, c, d = (self.turned(share(t + k * h)) for k in (-2, -1, 1, 2))
            turning = (a - 8 * b + 8 * c - d) / (12 * h) @ self.turned(share(t)).T
            return np.array(vee((turning - turning.T) / 2))

        found: dict[str, Any] = {
            "omega": column_of(omega(when)),
            "alpha": column_of((omega(when + h) - omega(when - h)) / (2 * h)),
        }
        if self.course.turned.by == "euler-angles":
            way = self.angles(1.0) - self.angles(0.0)
            per = high - low
            rates, rises = (near.at(when, order) / per * way for order in (1, 2))
            found |= {f"rate_{k}": value for k, value in enumerate(rates)}
            found |= {f"rise_{k}": value for k, value in enumerate(rises)}
            found |= {"T": self._axes(self.angles(share(when)))}
            ahead, behind = (self._axes(self.angles(share(when + by * h))) for by in (1, -1))
            found["T_dot"] = (ahead - behind) / (2 * h)
        return found

    def _axes(self, angles: NDArray[Any]) -> NDArray[Any]:
        """About which each angle turns (columns), by differences."""
        import numpy as np

        letters, h = self.course.turned.convention, 1e-5
        columns = []
        for k in range(3):
            ahead, behind = (in_sequence(letters, angles + by * h * np.eye(3)[k]) for by in (1, -1))
            columns.append(vee((ahead - behind) / (2 * h) @ in_sequence(letters, angles).T))
        return np.array(columns).T

    def _of_angles(self, u: float) -> dict[str, Any]:
        ends = {"a_s": column_of(self.angles(0.0)), "a_f": column_of(self.angles(1.0))}
        letters, angles = self.course.turned.convention, self.angles(u)
        ends |= {f"angle_{k}": float(value) for k, value in enumerate(angles)}
        order = list(enumerate(letters)) if letters.isupper() else list(enumerate(letters))[::-1]
        factors = (self._factor(at, k, letter, angles[k]) for at, (k, letter) in enumerate(order))
        return ends | {f"factor_{at}": factor for at, factor in enumerate(factors)}

    def _factor(self, at: int, k: int, letter: str, angle: float) -> Any:
        """The rotation at a place of the product, if it is called that about its own axis by its own angle:
        two angles may be equal all along."""
        called = self.way.called
        name = called[f"factor_{at}"]
        assert isinstance(name, Indexed)
        own = [text(name.lower[0]), name.lower[1]] == [letter.lower(), called[f"angle_{k}"]]
        return in_sequence(letter, [angle if own else math.nan])

    def _quaternions(self, u: float) -> dict[str, Any]:
        """That of the start with a scalar part that is not negative, and those turned on from it."""
        import numpy as np

        if self.course.turned.by != "slerp":
            return {}
        like = numbers(self.way.known[self.way.called["q_s"]], self.known)
        angle, axis = turn_of(self.first, like[1:])
        begin = np.array([np.cos(angle / 2), *(np.sin(angle / 2) * axis)])

        def on(share: float) -> Any:
            half = share * self.angle / 2
            c, v = np.cos(half), np.sin(half) * self.axis
            w, p = begin[0], begin[1:]
            return column_of(np.array([w * c - p @ v, *(w * v + c * p + np.cross(p, v))]))

        return {"q_s": on(0.0), "q_f": on(1.0), "q": on(u)}

    def result(self, name: str, names: Mapping[Expr, Any]) -> Any:
        """What a result should be."""
        if name == "angles":
            return self.angles(names[self.way.called["share"]])
        if name == "angle":
            return self.angle
        found = names[self.way.called[name]]
        return found if name == "R" else found.ravel()
