"""The inertia of a load whose gear is known to be the best, the one that accelerates it the most."""

from __future__ import annotations

from dataclasses import replace as replace_fields

from derive.derivation import Derivation, Step
from derive.errors import NotDerivable
from derive.expression import Derivative, Quotient, Symbol, subtract
from derive.kinds.checks import route
from derive.kinds.drive._facts import ALPHA
from derive.kinds.drive._facts import LoadFacts as Facts
from derive.kinds.drive._gear_checks import in_energies, is_best
from derive.kinds.drive._shafts import geared, typed_here
from derive.kinds.drive._slope import only_ends, slope_of
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive
from derive.names import free

NEEDS = ("rotor", "gear")
USES = frozenset({"rotor", "stages"})
CLAIMS = ("gears-beside", "as-written")


def derive(drive: Drive, options: Options, problem: Problem) -> Derivation:
    """J_l = G^2 J_m - 2 G J_m tau_l/tau_m: at the gear that is given the derivative of the acceleration by G
    is zero.

    Raises NotDerivable where shafts in between have inertias, where the load turns backwards against a load
    torque, and where no load has this gear as its best.
    """
    only_ends(drive)
    work, (J_m, tau_m) = Work(problem).naming(J_m=drive.rotor, tau_m=drive.torque or Symbol("tau_m"))
    work, G, _ = geared(work, drive)
    J_l, tau_l = Symbol(free(problem.taken, "J_l", "J_load")), None
    if drive.load_torque is not None:
        if work.sign(G) == -1:
            raise NotDerivable("a load torque against a load that turns backwards is not derived yet")
        work, (tau_l,) = work.naming(tau_l=drive.load_torque)
    law, slope, top = slope_of(G, J_m, J_l, tau_m, tau_l)
    work = work.showing(
        Step("alpha", (ALPHA, law), "in-numbers"),
        Step("slope", (Derivative(ALPHA, G), slope), "in-numbers"),
    )
    found = G**2 * J_m if tau_l is None else subtract(G**2 * J_m, Quotient(2 * G * J_m * tau_l, tau_m))
    work = work.worked(J_l.name, found)
    if work.sign(J_l) in (0, -1):
        raise NotDerivable("there is no load whose best gear this is: its inertia would not be positive")
    work = work.worked("alpha_max", law)
    results = {"J_l": work.final(J_l), "alpha": work.final("alpha_max")}
    facts = Facts(
        given=typed_here(work), G=G, load=J_l, tau_m=tau_m, tau_l=tau_l, top=top,
        page_names={"J_l": J_l.name, "alpha": "alpha_max"},
    )  # fmt: skip
    units = {J_l: "kg m^2", Symbol("alpha_max"): "rad/s^2"} if problem.style.units else {}
    loaded = replace_fields(drive, load=results["J_l"])
    work = work.claim(route("gears-beside", is_best(loaded, problem, {**results, "G": work.final(G)})))
    work = work.claim(route("as-written", in_energies(loaded, work, facts)))
    return work.answer("load-inertia", results, facts, units=units)
