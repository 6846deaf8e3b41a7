"""The inertia of rotor and load together, as the load feels it and as the motor feels it."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.derivation import Derivation, PageFacts
from derive.expression import ONE, Expr, Symbol, replace
from derive.kinds.checks import close, random_points, route
from derive.kinds.drive._oracle import Turning
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive

NEEDS = ("gear",)
CLAIMS = ("same-energy", "as-said")


class Facts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    G: Symbol
    energy: tuple[Expr, Expr]  # of the whole drive, and the speed of the motor


def derive(drive: Drive, options: Options, problem: Problem) -> Derivation:
    """The kinetic energy in the speed of the one and of the other (Lynch and Park, section 8.9)."""
    gear = drive.gear or ONE
    work, (J_m, J_l, G) = Work(problem).naming(J_m=drive.rotor, J_l=drive.load, G=gear)
    work = work.worked("J_load", G**2 * J_m + J_l)
    work = work.worked("J_motor", J_m + J_l / G**2)
    results = {name: work.final(name) for name in ("J_load", "J_motor")}
    work = work.claim(route("same-energy", _same_energy(drive, problem, results)))
    facts = Facts(given=work.typed, G=G, energy=_energy(J_m, J_l, G))
    work = work.claim(route("as-said", _said(drive, work, facts)))
    return work.answer("reflected-inertia", results, facts)


def _energy(J_m: Expr, J_l: Expr, G: Expr) -> tuple[Expr, Expr]:
    """By the speeds of the motor and the load; with omega_m = G omega."""
    omega, motor = Symbol("omega"), Symbol("omega_m")
    half = ONE / 2
    both = half * J_m * motor**2 + half * J_l * omega**2
    return both, G * omega


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
        total, motor = told.energy
        omega = point["omega"]
        yield close(worth(motor), worth(drive.gear or ONE) * omega)
        yield close(worth(replace(total, {Symbol("omega_m"): motor})), turning.energy(omega))
