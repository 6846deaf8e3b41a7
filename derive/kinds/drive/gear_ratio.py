"""The gear that lets a motor accelerate its load the most."""

from __future__ import annotations

from derive.derivation import Derivation, Step
from derive.expression import ONE, Derivative, Expr, Symbol, free_symbols, replace, sqrt
from derive.kinds.checks import route
from derive.kinds.drive._facts import ALPHA
from derive.kinds.drive._facts import GearFacts as Facts
from derive.kinds.drive._gear_checks import as_written, is_best
from derive.kinds.drive._slope import only_ends, slope_of
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive
from derive.names import free

BEST = Symbol("G_opt")
GEARS = ("G", "r", "n", "G_r")  # what it is called, the first that means nothing else


NEEDS = ("rotor", "load")
USES = frozenset({"rotor", "load", "stages"})
CLAIMS = ("gears-beside", "as-written")
CLAIMED = {"alpha": "gears-beside"}


class Options(OptionsModel):
    """A gear that the drive has, or its stages, are left out of account."""


def derive(drive: Drive, options: Options, problem: Problem) -> Derivation:
    """alpha = (G tau_m - tau_l)/(G^2 J_m + J_l) is greatest where its derivative by G vanishes; without a
    torque at the load that is G = sqrt(J_l/J_m).

    Raises NotDerivable where shafts in between have inertias.
    """
    only_ends(drive)
    torque = drive.torque or Symbol("tau_m")
    work, (J_m, J_l, tau_m) = Work(problem).naming(J_m=drive.rotor, J_l=drive.load, tau_m=torque)
    tau_l = None
    if drive.load_torque is not None:
        work, (tau_l,) = work.naming(tau_l=drive.load_torque)
    G = _gear(drive, problem)
    law, slope, top = slope_of(G, J_m, J_l, tau_m, tau_l)
    laws = (Step("alpha", (ALPHA, law)), Step("slope", (Derivative(ALPHA, G), slope)))
    work = _best(Work(problem, work.known, aside={ALPHA: law}, steps=laws), J_m, J_l, tau_m, tau_l)
    fastest = problem.final(replace(replace(work["alpha_max"], {BEST: work[BEST]}), work.definitions))
    results = {"G": work.final(BEST), "alpha": fastest}
    facts = Facts(
        given=work.typed, tau_m=tau_m, tau_l=tau_l, top=top, G=G,
        balance=None if tau_l else (BEST ** 2 * J_m, J_l),
    )  # fmt: skip
    work = work.claim(route("gears-beside", is_best(drive, problem, results)))
    work = work.claim(route("as-written", as_written(drive, work, facts, results["G"])))
    return work.answer("gear-ratio", results, facts)


def _gear(drive: Drive, problem: Problem) -> Symbol:
    trees = [drive.rotor, drive.load, drive.torque or ONE, drive.load_torque or ONE, *problem.where.values()]
    return Symbol(free(frozenset(problem.where).union(*map(free_symbols, trees)), *GEARS))


def _best(work: Work, J_m: Expr, J_l: Expr, tau_m: Expr, tau_l: Expr | None) -> Work:
    """The positive root, and the acceleration there; roots of symbols stay as a person writes them."""
    open_ = bool(free_symbols(work.problem.final(work.shown(J_l / J_m))))
    ratio = work.shown(J_l / J_m)

    def put_in(tree: Expr) -> Expr:
        return replace(tree, work.definitions)

    if tau_l is None:
        work = work.worked("G_opt", sqrt(J_l / J_m), sqrt(ratio) if open_ else None)
        force = tau_m / (2 * sqrt(J_m * J_l))
        return work.worked("alpha_max", force, put_in(force) if open_ else None)
    pull = tau_l / tau_m
    root = pull + sqrt(pull**2 + J_l / J_m)
    open_ = open_ or bool(free_symbols(work.problem.final(work.shown(pull))))
    work = work.worked("G_opt", root, put_in(root) if open_ else None)
    force = tau_m / (2 * BEST * J_m)
    return work.worked("alpha_max", force, force if open_ else None)  # with the root put in it is longer


def measures(drive: Drive) -> dict[str, str]:
    """A ratio, and the acceleration of what turns."""
    return {"G": "", "alpha": "rad/s^2"}
