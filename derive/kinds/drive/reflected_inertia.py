"""The inertia of rotor and load together, as the load feels it and as the motor feels it."""

from __future__ import annotations

from derive.derivation import Derivation
from derive.expression import ONE, Expr
from derive.kinds.checks import route
from derive.kinds.drive._facts import OMEGA, OMEGA_M
from derive.kinds.drive._facts import InertiaFacts as Facts
from derive.kinds.drive._inertia_checks import said, same_energy
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive

NEEDS = ("gear",)
CLAIMS = ("same-energy", "as-said")


def derive(drive: Drive, options: Options, problem: Problem) -> Derivation:
    """The kinetic energy in the speed of the one and of the other (Lynch and Park, section 8.9)."""
    gear = drive.gear or ONE
    work, (J_m, J_l, G) = Work(problem).naming(J_m=drive.rotor, J_l=drive.load, G=gear)
    work = work.worked("J_eff_l", G**2 * J_m + J_l).worked("J_eff_m", J_m + J_l / G**2)
    results = {"J_load": work.final("J_eff_l"), "J_motor": work.final("J_eff_m")}
    work = work.claim(route("same-energy", same_energy(drive, problem, results)))
    speeds = (OMEGA, OMEGA_M)
    facts = Facts(
        given=work.typed, G=G, speeds=speeds, squares=(OMEGA**2, OMEGA_M**2), speed=(OMEGA_M, G * OMEGA),
        energy=_energy(J_m, J_l),
    )  # fmt: skip
    work = work.claim(route("as-said", said(drive, work, facts)))
    return work.answer("reflected-inertia", results, facts)


def _energy(J_m: Expr, J_l: Expr) -> Expr:
    """By the speeds of the motor and the load."""
    half = ONE / 2
    return half * J_m * OMEGA_M**2 + half * J_l * OMEGA**2
