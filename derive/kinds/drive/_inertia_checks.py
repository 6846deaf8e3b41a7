"""Inertias by the energy that they hold."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.expression import Expr, Symbol, number, replace
from derive.kinds.checks import close, random_points
from derive.kinds.drive._facts import OMEGA, OMEGA_M, InertiaFacts
from derive.kinds.drive._oracle import built
from derive.kinds.drive._shafts import typed_here
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive


def same_energy(drive: Drive, problem: Problem, results: dict[str, Expr]) -> Iterator[bool]:
    """Turning as fast as the load, and as fast as the motor, what is found holds what all hold together."""
    for point in random_points(problem.symbols | {"omega"}, 3):

        def worth(tree: Expr, here: Point = point) -> float:
            return at(problem.final(tree), here)

        turning, omega = built(drive, worth), point["omega"]
        energy, motor = turning.energy(omega), turning.gear * omega
        yield close(at(results["J_load"], point) * omega**2 / 2, energy)
        yield close(at(results["J_motor"], point) * motor**2 / 2, energy)


def said(drive: Drive, work: Work, told: InertiaFacts) -> Iterator[bool]:
    """The energy, the speed of the motor and those of the shafts, as the sentences have them."""
    problem = work.problem
    for point in random_points(problem.symbols | {"omega"}, 3):

        def worth(tree: Expr, here: Point = point) -> float:
            return at(problem.final(replace(tree, work.definitions)), here)

        turning = built(drive, worth)
        yield close(turning.gear, worth(told.G)) and told.given == typed_here(work)
        _, motor = told.speed
        omega = point["omega"]
        yield told.speeds == (OMEGA, OMEGA_M) and told.speed[0] == OMEGA_M
        yield close(worth(told.squares[0]), omega**2)
        yield close(worth(replace(told.squares[1], {OMEGA_M: motor})), worth(motor) ** 2)
        yield close(worth(motor), turning.gear * omega)
        behind = [k for k, stage in enumerate(drive.stages, 1) if stage.inertia is not None]
        shafts = dict(speeds for _, speeds in told.shafts)
        yield [(stage, speed) for stage, (speed, _) in told.shafts] == [
            (number(k), Symbol(f"omega_{k}")) for k in behind
        ]
        yield close([*map(worth, shafts.values())], [turns * omega for _, turns in turning.shafts])
        moving: dict[Expr, Expr] = {OMEGA_M: motor, **shafts}
        yield close(worth(replace(told.energy, moving)), turning.energy(omega))
