"""The best gear by energies, at drives in numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice
from math import copysign

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.errors import NotDerivable
from derive.expression import ONE, ZERO, Expr, Symbol, free_symbols, replace
from derive.kinds.checks import close, random_points
from derive.kinds.drive._facts import GearFacts, LoadFacts
from derive.kinds.drive._oracle import Turning
from derive.kinds.drive._shafts import typed_here
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive

NEAR = (0.9, 1.1)  # gears beside the best
GEARS_TRIED = (0.7, 2.3)
STEP, ROUGH = 1e-4, 1e-6  # of differences, and how closely they tell a slope
DRAWS = 200  # points among which some have positive inertias


def _points(drive: Drive, problem: Problem) -> Iterator[tuple[Point, Turning]]:
    """Numbers for the symbols, and the drive they make. Raises NotDerivable where none make both inertias
    positive and leave the motor a torque."""
    given = (drive.rotor, drive.load, ONE, drive.torque or Symbol("tau_m"), drive.load_torque or ZERO)
    trees = [problem.final(tree) for tree in given]
    symbols = sorted(frozenset().union(*map(free_symbols, trees)))
    drawn = (
        (point, _turning(*(at(tree, point) for tree in trees))) for point in random_points(symbols, DRAWS)
    )
    real = ((point, each) for point, each in drawn if each.rotor > 0 < each.load and each.push)
    points = list(islice(real, 3))
    if not points:
        raise NotDerivable("no values make both inertias positive and leave the motor a torque")
    yield from points


def _turning(rotor: float, load: float, gear: float, push: float, pull: float) -> Turning:
    return Turning(rotor, load, gear, push, pull)


def is_best(drive: Drive, problem: Problem, results: Mapping[str, Expr]) -> Iterator[bool]:
    """The acceleration there is what is claimed, and gears beside it give less, the way the motor pushes."""
    for point, turning in _points(drive, problem):
        best, alpha = (at(results[name], point) for name in ("G", "alpha"))
        found = turning.with_gear(best).acceleration
        yield close(found, alpha)
        forwards = copysign(1, turning.push * best)
        yield from (forwards * (found - turning.with_gear(k * best).acceleration) > 0 for k in NEAR)


def as_written(drive: Drive, work: Work, told: GearFacts, best: Expr) -> Iterator[bool]:
    """The acceleration by energies, its slope by differences, where that is zero, and what is equal there."""
    problem = work.problem
    (_, alpha), (_, slope) = (step.chain for step in work.steps[:2])
    for point, turning in _points(drive, problem):

        def worth(tree: Expr, gear: float, here: Point = point) -> float:
            return at(problem.final(replace(tree, work.definitions)), {**here, told.G.name: gear})

        for gear in GEARS_TRIED:
            near = [turning.with_gear(gear * (1 + side * STEP)).acceleration for side in (1, -1)]
            yield close(worth(alpha, gear), turning.with_gear(gear).acceleration)
            yield close(worth(slope, gear), (near[0] - near[1]) / (2 * STEP * gear), ROUGH)
        top = at(best, point)
        below, above = (worth(told.top, k * top) for k in NEAR)
        rises = 1.0 if told.tau_l is None else copysign(1, turning.push)
        yield rises * below > 0 > rises * above
        yield (told.balance is None) == (told.tau_l is not None)
        yield told.balance is None or close(*(worth(side, top) for side in told.balance))
        yield close(worth(told.tau_m, top), turning.push) and told.given == work.typed
        yield told.tau_l is None or close(worth(told.tau_l, top), turning.pull)


def in_energies(drive: Drive, work: Work, told: LoadFacts) -> Iterator[bool]:
    """The acceleration by the gear and its slope, of a load that was found, by energies and by differences;
    and what is said beside them."""
    problem = work.problem
    (_, alpha), (_, slope) = (step.chain for step in work.steps[:2])
    names = {name: value for name, value in work.definitions.items() if name not in (told.G, told.load)}
    for point, turning in _points(drive, problem):

        def worth(tree: Expr, gear: float, here: Point = point, load: float = turning.load) -> float:
            return at(problem.final(replace(tree, names)), {**here, told.G.name: gear, told.load.name: load})

        best = abs(at(problem.final(work[told.G]), point))
        for gear in GEARS_TRIED:
            near = [turning.with_gear(gear * (1 + side * STEP)).acceleration for side in (1, -1)]
            yield close(worth(alpha, gear), turning.with_gear(gear).acceleration)
            yield close(worth(slope, gear), (near[0] - near[1]) / (2 * STEP * gear), ROUGH)
        below, above = (worth(told.top, k * best) for k in NEAR)
        yield below * above < 0 and told.given == typed_here(work)
        yield close(worth(told.tau_m, best), turning.push)
        yield told.tau_l is None or close(worth(told.tau_l, best), turning.pull)
