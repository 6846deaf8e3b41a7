"""The inertia of rotor and load together, as the load feels it and as the motor feels it."""

from __future__ import annotations

from derive.algebra.numbers.floats import number as at
from derive.derivation import Claim, Derivation, PageFacts
from derive.expression import ONE, Expr, Symbol
from derive.kinds.checks import SECOND_ROUTE, close, random_points
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive

NEEDS = ("gear",)


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
    work = work.claim(Claim("same-energy", SECOND_ROUTE, _same_energy(drive, problem, results)))
    facts = Facts(given=work.typed, G=G, energy=_energy(J_m, J_l, G))
    return work.answer("reflected-inertia", results, facts)


def _energy(J_m: Expr, J_l: Expr, G: Expr) -> tuple[Expr, Expr]:
    """By the speeds of the motor and the load; with omega_m = G omega."""
    omega, motor = Symbol("omega"), Symbol("omega_m")
    half = ONE / 2
    both = half * J_m * motor**2 + half * J_l * omega**2
    return both, G * omega


def _same_energy(drive: Drive, problem: Problem, results: dict[str, Expr]) -> bool:
    trees = [problem.final(tree) for tree in (drive.rotor, drive.load, drive.gear or ONE)]
    for point in random_points(problem.symbols | {"omega"}, 3):
        rotor, load, gear = (at(tree, point) for tree in trees)
        omega = point["omega"]
        energy = (rotor * (gear * omega) ** 2 + load * omega**2) / 2
        as_load = at(results["J_load"], point) * omega**2 / 2
        as_motor = at(results["J_motor"], point) * (gear * omega) ** 2 / 2
        if not close([as_load, as_motor], [energy, energy]):
            return False
    return True
