"""The inertia of rotor and load together, as the load feels it and as the motor feels it."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.derivation import Derivation, PageFacts
from derive.expression import ONE, Expr, Symbol, replace, symbols
from derive.kinds.checks import close, random_points, route
from derive.kinds.drive._oracle import Turning
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive

NEEDS = ("gear",)
CLAIMS = ("same-energy", "as-said")
OMEGA, OMEGA_M = symbols("omega omega_m")


class Facts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    G: Symbol
    speeds: tuple[Symbol, Symbol]  # of the load and of the motor
    squares: tuple[Expr, Expr]
    speed: tuple[Expr, Expr]  # that of the motor by that of the load
    energy: Expr  # of the whole drive


def derive(drive: Drive, options: Options, problem: Problem) -> Derivation:
    """The kinetic energy in the speed of the one and of the other (Lynch and Park, section 8.9)."""
    gear = drive.gear or ONE
    work, (J_m, J_l, G) = Work(problem).naming(J_m=drive.rotor, J_l=drive.load, G=gear)
    work = work.worked("J_load", G**2 * J_m + J_l)
    work = work.worked("J_motor", J_m + J_l / G**2)
    results = {name: work.final(name) for name in ("J_load", "J_motor")}
    work = work.claim(route("same-energy", _same_energy(drive, problem, results)))
    speeds = (OMEGA, OMEGA_M)
    facts = Facts(
        given=work.typed, G=G, speeds=speeds, squares=(OMEGA**2, OMEGA_M**2), speed=(OMEGA_M, G * OMEGA),
        energy=_energy(J_m, J_l),
    )  # fmt: skip
    work = work.claim(route("as-said", _said(drive, work, facts)))
    return work.answer("reflected-inertia", results, facts)


def _energy(J_m: Expr, J_l: Expr) -> Expr:
    """By the speeds of the motor and the load."""
    half = ONE / 2
    return half * J_m * OMEGA_M**2 + half * J_l * OMEGA**2


def _same_energy(drive: Drive, problem: Problem, results: dict[str, Expr]) -> Iterator[bool]:
    """Turning as fast as the load, and as fast as the motor, what is found holds what both hold together."""
    trees = [problem.final(tree) for tree in (drive.rotor, drive.load, drive.gear or ONE)]
    for point in random_points(problem.symbols | {"omega"}, 3):
        turning, omega = Turning(*(at(tree, point) for tree in trees)), point["omega"]
        energy, motor = turning.energy(omega), turning.gear * omega
        yield close(at(results["J_load"], point) * omega**2 / 2, energy)
        yield close(at(results["J_motor"], point) * motor**2 / 2, energy)


def _said(drive: Drive, work: Work, told: Facts) -> Iterator[bool]:
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
