"""The gear that lets a motor accelerate its load the most."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice
from math import copysign

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.derivation import Derivation, PageFacts, Step
from derive.errors import NotDerivable
from derive.expression import ONE, ZERO, Derivative, Expr, Symbol, add, free_symbols, replace, sqrt, symbols
from derive.kinds.checks import close, random_points, route
from derive.kinds.drive._oracle import Turning
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive
from derive.names import free

ALPHA, BEST = symbols("alpha G_opt")
GEARS = ("G", "r", "n", "G_r")  # what it is called, the first that means nothing else
NEAR = (0.9, 1.1)  # gears beside the best
GEARS_TRIED = (0.7, 2.3)
STEP, ROUGH = 1e-4, 1e-6  # of differences, and how closely they tell a slope
DRAWS = 200  # points among which some have positive inertias


CLAIMS = ("gears-beside", "as-written")
CLAIMED = ("alpha",)


class Options(OptionsModel):
    """A gear that the drive has is left out of account."""


class Facts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    tau_m: Symbol
    tau_l: Symbol | None
    top: Expr  # the numerator of the slope
    G: Symbol
    balance: tuple[Expr, Expr]


def derive(drive: Drive, options: Options, problem: Problem) -> Derivation:
    """alpha = (G tau_m - tau_l)/(G^2 J_m + J_l) is greatest where its derivative by G vanishes; without a
    torque at the load that is G = sqrt(J_l/J_m)."""
    torque = drive.torque or Symbol("tau_m")
    work, (J_m, J_l, tau_m) = Work(problem).naming(J_m=drive.rotor, J_l=drive.load, tau_m=torque)
    tau_l = None
    if drive.load_torque is not None:
        work, (tau_l,) = work.naming(tau_l=drive.load_torque)
    G = _gear(drive, problem)
    law, slope, top = _slope(G, J_m, J_l, tau_m, tau_l)
    laws = (Step("alpha", (ALPHA, law)), Step("slope", (Derivative(ALPHA, G), slope)))
    work = _best(Work(problem, work.known, aside={ALPHA: law}, steps=laws), J_m, J_l, tau_m, tau_l)
    fastest = problem.final(replace(work["alpha_max"], {BEST: work[BEST]}))
    results = {"G": work.final(BEST), "alpha": fastest}
    facts = Facts(
        given=work.typed, tau_m=tau_m, tau_l=tau_l, top=top, G=G,
        balance=(BEST ** 2 * J_m, J_l),
    )  # fmt: skip
    work = work.claim(route("gears-beside", _is_best(drive, problem, results)))
    work = work.claim(route("as-written", _as_written(drive, work, facts, results["G"])))
    return work.answer("gear-ratio", results, facts)


def _gear(drive: Drive, problem: Problem) -> Symbol:
    trees = [drive.rotor, drive.load, drive.torque or ONE, drive.load_torque or ONE, *problem.where.values()]
    return Symbol(free(frozenset(problem.where).union(*map(free_symbols, trees)), *GEARS))


def _slope(G: Symbol, J_m: Expr, J_l: Expr, tau_m: Expr, tau_l: Expr | None) -> tuple[Expr, Expr, Expr]:
    """The acceleration by G, its derivative, and the numerator of that."""
    whole = G**2 * J_m + J_l
    push = G * tau_m
    if tau_l is None:
        top = J_l - G**2 * J_m
        return push / whole, tau_m * top / whole**2, top
    terms = (
        tau_m * J_l,
        2 * G * J_m * tau_l,
        -1 * G**2 * J_m * tau_m,
    )
    top = add(*terms)
    return (push - tau_l) / whole, top / whole**2, top


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
    return work.worked("alpha_max", force, put_in(force) if open_ else None)


def _points(drive: Drive, problem: Problem) -> Iterator[tuple[Point, Turning]]:
    """Numbers for the symbols, and the drive they make. Raises NotDerivable where none make both inertias
    positive and leave the motor a torque."""
    given = (drive.rotor, drive.load, ONE, drive.torque or Symbol("tau_m"), drive.load_torque or ZERO)
    trees = [problem.final(tree) for tree in given]
    symbols = sorted(frozenset().union(*map(free_symbols, trees)))
    drawn = (
        (point, Turning(*(at(tree, point) for tree in trees))) for point in random_points(symbols, DRAWS)
    )
    real = ((point, each) for point, each in drawn if each.rotor > 0 < each.load and each.push)
    points = list(islice(real, 3))
    if not points:
        raise NotDerivable("no values make both inertias positive and leave the motor a torque")
    yield from points


def _is_best(drive: Drive, problem: Problem, results: Mapping[str, Expr]) -> Iterator[bool]:
    """The acceleration there is what is claimed, and gears beside it give less, the way the motor pushes."""
    for point, turning in _points(drive, problem):
        best, alpha = (at(results[name], point) for name in ("G", "alpha"))
        found = turning.with_gear(best).acceleration
        yield close(found, alpha)
        yield from (
            copysign(1, turning.push) * (found - turning.with_gear(k * best).acceleration) > 0 for k in NEAR
        )


def _as_written(drive: Drive, work: Work, told: Facts, best: Expr) -> Iterator[bool]:
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
        yield told.tau_l is not None or close(*(worth(side, top) for side in told.balance))
        yield close(worth(told.tau_m, top), turning.push) and told.given == work.typed
        yield told.tau_l is None or close(worth(told.tau_l, top), turning.pull)
