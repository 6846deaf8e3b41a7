"""A transmission whose wheels roll on each other in numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.derivation import PageFacts, Phrase
from derive.expression import Expr, Symbol, free_symbols, replace
from derive.kinds.checks import close, random_points
from derive.kinds.drive._rolling import driven, through
from derive.kinds.fields import TREES
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive

POINTS = 3


class TrainFacts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    stages: tuple[tuple[Expr | None, Phrase, str], ...]  # number, parts, step of the ratio or ""
    whole: Phrase  # all stages with their sizes
    several: bool
    G: Symbol
    direction: Phrase | None  # in which the load turns
    speeds: tuple[Symbol, Symbol] | None  # of the motor and of the load
    torques: tuple[Symbol, Symbol] | None


def sizes_at(drive: Drive, problem: Problem, point: Point) -> list[tuple[float, ...]]:
    """Those of the stages in numbers."""
    return [tuple(at(problem.final(size), point) for size in stage.sizes) for stage in drive.stages]


def rolled(
    drive: Drive, problem: Problem, results: Mapping[str, Expr], given: Mapping[str, Expr]
) -> Iterator[bool]:
    """Each ratio, and what the motor's speed and torque become: the load turns so fast, and as much power
    leaves the train as enters it."""
    symbols = problem.symbols.union(*map(free_symbols, map(problem.final, given.values())))
    for point in random_points(symbols, POINTS):
        sizes = sizes_at(drive, problem, point)
        speeds = [1.0, *through(drive.stages, sizes)]
        yield close(at(results["G"], point) * speeds[-1], 1.0)
        for k in range(1, len(speeds)):
            if f"G_{k}" in results:
                yield close(at(results[f"G_{k}"], point) * speeds[k], speeds[k - 1])
        if "omega" in results:
            yield close(at(results["omega"], point), speeds[-1] * at(problem.final(given["omega"]), point))
        if "tau" in results:
            yield close(at(results["tau"], point) * speeds[-1], at(problem.final(given["tau"]), point))


def as_said(drive: Drive, work: Work, told: TrainFacts) -> Iterator[bool]:
    """What each stage is said to be, its sizes, and the direction in which the load turns."""
    problem = work.problem
    yield told.given == work.typed
    yield told.several == (len(drive.stages) > 1) and len(told.stages) == len(drive.stages)
    for point in random_points(problem.symbols, POINTS):
        way = 1.0
        for (_, said, _), stage, sizes in zip(
            told.stages, drive.stages, sizes_at(drive, problem, point), strict=True
        ):
            yield said.key == stage.form
            yield all(part.key == stage.measured for part in said.about.values() if isinstance(part, Phrase))
            names = [problem.final(replace(each, work.definitions)) for each in _names(said)]
            yield close([at(each, point) for each in names], sizes)
            ordered = sorted(sizes) if stage.form == "harmonic" else sizes  # the flexspline has less teeth
            way *= driven(stage.form, *ordered)
        yield told.direction is None or told.direction.key == ("with-motor" if way > 0 else "against-motor")


def _names(said: Phrase) -> Iterator[Expr]:
    """Those of the sizes, in the order in which they are told."""
    for part in said.about.values():
        if isinstance(part, Phrase):
            yield from _names(part)
        elif isinstance(part, TREES):
            yield part
