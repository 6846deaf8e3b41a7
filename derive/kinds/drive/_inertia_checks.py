"""Inertias by the energy that they hold."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.expression import ONE, Expr, replace
from derive.kinds.checks import close, random_points
from derive.kinds.drive._facts import OMEGA, OMEGA_M, InertiaFacts
from derive.kinds.drive._oracle import Turning
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive


def same_energy(drive: Drive, problem: Problem, results: dict[str, Expr]) -> Iterator[bool]:
    """Turning as fast as the load, and as fast as the motor, what is found holds what both hold together."""
    trees = [problem.final(tree) for tree in (drive.rotor, drive.load, drive.gear or ONE)]
    for point in random_points(problem.symbols | {"omega"}, 3):
        turning, omega = Turning(*(at(tree, point) for tree in trees)), point["omega"]
        energy, motor = turning.energy(omega), turning.gear * omega
        yield close(at(results["J_load"], point) * omega**2 / 2, energy)
        yield close(at(results["J_motor"], point) * motor**2 / 2, energy)


def said(drive: Drive, work: Work, told: InertiaFacts) -> Iterator[bool]:
    """The energy and the speed of the motor, as the sentence has them."""
    problem = work.problem
    for point in random_points(problem.symbols | {"omega"}, 3):

        def worth(tree: Expr, here: Point = point) -> float:
            return at(problem.final(replace(tree, work.definitions)), here)

        turning = Turning(worth(drive.rotor), worth(drive.load), worth(told.G))
        yield close(turning.gear, worth(drive.gear or ONE)) and told.given == work.typed
        _, motor = told.speed
        omega = point["omega"]
        yield told.speeds == (OMEGA, OMEGA_M) and told.speed[0] == OMEGA_M
        yield close(worth(told.squares[0]), omega**2)
        yield close(worth(replace(told.squares[1], {OMEGA_M: motor})), worth(motor) ** 2)
        yield close(worth(motor), worth(drive.gear or ONE) * omega)
        yield close(worth(replace(told.energy, {OMEGA_M: motor})), turning.energy(omega))
