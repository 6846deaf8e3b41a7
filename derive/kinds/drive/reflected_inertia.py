"""The inertia of rotor and load together, as the load feels it and as the motor feels it."""

from __future__ import annotations

from derive.derivation import Derivation
from derive.expression import ONE, Expr, add, symbols
from derive.kinds.checks import route
from derive.kinds.drive._facts import OMEGA, OMEGA_M
from derive.kinds.drive._facts import InertiaFacts as Facts
from derive.kinds.drive._inertia_checks import said, same_energy
from derive.kinds.drive._shafts import geared, shafts_between, typed_here
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive

NEEDS = ("rotor", "load", "gear")
USES = frozenset({"rotor", "load", "stages"})
UNITS = dict.fromkeys(symbols("J_eff_l J_eff_m"), "kg m^2")
CLAIMS = ("same-energy", "as-said")


def derive(drive: Drive, options: Options, problem: Problem) -> Derivation:
    """The kinetic energy in the speed of the one and of the other (Lynch and Park, section 8.9)."""
    work, (J_m, J_l) = Work(problem).naming(J_m=drive.rotor, J_l=drive.load)
    work, G, ratios = geared(work, drive)
    work, shafts = shafts_between(work, drive, G, ratios)
    at_load = add(G**2 * J_m, *(each.at_load for each in shafts), J_l)
    at_motor = add(J_m, *(each.at_motor for each in shafts), J_l / G**2)
    work = work.worked("J_eff_l", at_load).worked("J_eff_m", at_motor)
    results = {"J_load": work.final("J_eff_l"), "J_motor": work.final("J_eff_m")}
    work = work.claim(route("same-energy", same_energy(drive, problem, results)))
    facts = Facts(
        given=typed_here(work), G=G, speeds=(OMEGA, OMEGA_M), squares=(OMEGA**2, OMEGA_M**2),
        speed=(OMEGA_M, G * OMEGA), shafts=tuple((each.stage, each.at_speed(OMEGA)) for each in shafts),
        energy=_energy((J_m, OMEGA_M), *((each.inertia, each.speed) for each in shafts), (J_l, OMEGA)),
    )  # fmt: skip
    work = work.claim(route("as-said", said(drive, work, facts)))
    return work.answer("reflected-inertia", results, facts, units=UNITS if problem.style.units else {})


def _energy(*parts: tuple[Expr, Expr]) -> Expr:
    """By inertias and the speeds that they have."""
    return add(*(ONE / 2 * inertia * speed**2 for inertia, speed in parts))
