"""A point carried along a path: its place and its rates over time, on the board of another subject."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import Point, completed
from derive.derivation import Phrase, Record, as_matrix
from derive.errors import NotDerivable
from derive.expression import ZERO, Derivative, Expr, Matrix, Symbol, free_symbols
from derive.kinds.meanings import as_told, column_of
from derive.kinds.path._frenet import Bent, differentiated
from derive.kinds.path._length import measured
from derive.kinds.path._meanings import Made, made, meant
from derive.kinds.path._motion import Motion, in_motion
from derive.kinds.path._shapes import along
from derive.kinds.path._sizes import slope
from derive.kinds.path._spline import SplineTold, splined
from derive.kinds.path._timing import T
from derive.kinds.path._timing_checks import driven
from derive.kinds.path._told import given_names, shape_told
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.course import Course, at
from derive.mechanics.paths import Carried, Curve, Via

if TYPE_CHECKING:
    from numpy.typing import NDArray

DIFFERENCES = 1e-6
UNTIMED = "how it goes along the path in time is not given: add timing: {law, time}, or give functions of t"


class Way(Record):
    """What is said of the path and of the motion along it; names of steps."""

    spline: SplineTold | None = None
    shape: Phrase | None
    typed: bool = True
    given: tuple[tuple[Expr, Expr], ...]
    before: tuple[str, ...]
    place: str
    s: Symbol
    derivatives: tuple[str, ...] = ()
    speed: tuple[str, ...] = ()  # where a law needs it
    length: tuple[str, ...] = ()
    motion: Motion | None = None
    rates: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Moving:
    """The board with the place and its rates; `by_time` are these by the time t alone, from `start` to `end`
    where these are given."""

    work: Work
    way: Way
    names: tuple[Symbol, Symbol, Symbol]
    by_time: tuple[Matrix, Matrix, Matrix]
    ends: tuple[Expr, Expr] | None

    def numbers(self, point: Point) -> Driven:
        """The same made from the sheet alone, at a point of the symbols."""
        problem = self.work.problem
        known = completed(point, problem.where)
        path = made(problem.subject, self.way.s.name, known)
        timing = problem.subject.timing
        course = None if timing is None else driven(timing, path, problem.subject.along, known)
        return Driven(path, course)


@dataclass(frozen=True, slots=True)
class Driven:
    """A place by the time, in numbers."""

    path: Made
    course: Course | None  # of the parameter; None where this is the time

    @property
    def ends(self) -> tuple[float, float] | None:
        """When it begins and ends."""
        return self.path.ends if self.course is None else (0.0, self.course[-1].end)

    def place(self, t: float) -> NDArray[Any]:
        """Where it is."""
        return self.path.place(t if self.course is None else at(self.course, t))

    @property
    def joints(self) -> tuple[float, ...]:
        """Where one law follows another."""
        return tuple(piece.end for piece in (self.course or ())[:-1])


def moving(problem: Problem) -> Moving:
    """The lines of a path that is carried.

    Raises NotDerivable where nothing says how it goes in time.
    """
    path: Carried = problem.subject
    if isinstance(path.shape, Via):
        return _through_points(problem)
    typed = isinstance(path.shape, Curve)
    timeless = path.timing is None
    if timeless and not (isinstance(path.shape, Curve) and path.shape.parameter == T.name):
        raise NotDerivable(UNTIMED, "path")
    track = along(path.path, problem)
    return _by_the_time(problem, typed) if timeless else _timed(problem, differentiated(track), typed)


def _by_the_time(problem: Problem, typed: bool) -> Moving:
    """Functions of the time itself."""
    track = along(problem.subject.path, problem)
    p = track.p
    v, a = Symbol(f"{p.name}_dot"), Symbol(f"{p.name}_ddot")
    work = track.work.line(v, Derivative(p, T), value=slope(track.work, p, T))
    work = work.line(a, Derivative(v, T), value=slope(work, v, T))

    def meanings(point: Point) -> dict[Expr, Any]:
        known = completed(point, problem.where)
        path, t = made(problem.subject, T.name, known), known[T.name]
        first, second = map(column_of, path.derivatives(t))
        return {
            p: column_of(path.place(t)), v: first, a: second,
            Derivative(p, T): first, Derivative(v, T): second,
        }  # fmt: skip

    work = as_told(work, meanings, (), "differences", DIFFERENCES, problem.symbols | {T.name})
    way = Way(
        shape=shape_told(problem.subject.path, T), typed=typed, given=(), before=(), place=p.name, s=T,
        derivatives=(), rates=(v.name, a.name),
    )  # fmt: skip
    by_time = tuple(as_matrix(work.final(name), name.name) for name in (p, v, a))
    return Moving(work, way, (p, v, a), (by_time[0], by_time[1], by_time[2]), track.between)


def _through_points(problem: Problem) -> Moving:
    """By the cubic spline of each coordinate."""
    spline = splined(problem, bent=False)
    work = spline.proved(spline.results())
    p, *_ = spline.names
    way = Way(spline=spline.told, shape=None, given=(), before=(), place=p.name, s=T, rates=())
    by_time = (spline.by_time(0), spline.by_time(1), spline.by_time(2))
    times = spline.shape.times
    return Moving(work.knowing({p: by_time[0]}), way, spline.names, by_time, (times[0], times[-1]))


def _timed(problem: Problem, found: Bent, typed: bool) -> Moving:
    """By a law of the parameter in time."""
    found = replace(found, straight=True)  # its frame is not asked for
    work, track, timing = found.work, found.along, problem.subject.timing
    if timing.law == "trapezoidal" and problem.subject.along:
        work = measured(found).work
    given = given_names(work, track)
    symbols = problem.symbols | {track.s.name}
    work = as_told(work, partial(meant, problem, found), given, "differences", DIFFERENCES, symbols)
    moved = in_motion(work, found, timing, {"p": track.p.name})
    work = moved.work
    lines = {step.name: step for step in work.steps}
    length = (track.L.name,) if track.L.name in lines and track.L.name not in track.lines else ()
    spoken = [
        *(step.result for piece in moved.laws for step in piece),
        *(lines[each].chain[1] for each in length),
    ]
    speed = tuple(name for name in (found.speed.name,) if any(name in free_symbols(tree) for tree in spoken))
    kept = tuple(step for step in work.steps if speed or step.name != found.speed.name)
    names = (track.p, *moved.rates)
    by_parameter = {key: work.final(name) for key, name in zip("pva", names, strict=True)}
    work, results, motion = replace(moved, work=replace(work, steps=kept)).finished(by_parameter)
    way = Way(
        shape=shape_told(problem.subject.path, track.s), typed=typed, given=given, before=track.lines,
        place=track.p.name, s=track.s, derivatives=(found.first.name, found.second.name), speed=speed,
        length=length, motion=motion, rates=motion.rates,
    )  # fmt: skip
    p, v, a = (as_matrix(results[key], key) for key in "pva")
    return Moving(work, way, names, (p, v, a), (ZERO, work.final(moved.time.time)))
