"""The ratio of a transmission by its stages: gears, belts, harmonic drives, planetary gears."""

from __future__ import annotations

from math import prod

from derive.algebra.formulas.with_units import unit_of
from derive.derivation import Derivation, Phrase
from derive.expression import Expr, Product, Symbol, number
from derive.kinds.checks import route
from derive.kinds.drive._stages import described, ratio, with_sizes
from derive.kinds.drive._train_checks import TrainFacts as Facts
from derive.kinds.drive._train_checks import as_said, rolled
from derive.kinds.fields import AngularSpeed, OptionsModel, Torque
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive
from derive.names import free

NEEDS = ("stages",)
USES = frozenset({"stages", "rotor", "load"})  # inertias do not change a ratio
CLAIMS = ("rolled", "as-said")
SI = {"omega": "rad/s", "tau": "N m"}
LETTERS = ("G", "n", "i", "N")  # of a ratio, the first that means nothing else
TURNED_BACK = ("gears", "crossed", "harmonic")


class Options(OptionsModel):
    """What the motor does, where the speed and the torque of the load are asked."""

    speed: AngularSpeed | None = None
    """The speed of the motor."""
    torque: Torque | None = None
    """The torque of the motor."""


def derive(drive: Drive, options: Options, problem: Problem) -> Derivation:
    """The product of the ratios of the stages (Norton, Design of Machinery, sections 9.8 to 9.10; Siciliano
    et al., section 5.1.1)."""
    G = Symbol(free(problem.taken, *LETTERS, indices=("", *_numbers(drive))))
    work, sizes = with_sizes(Work(problem), drive.stages, problem, G)
    ratios, stages = list[Expr](), list[tuple[Expr | None, Phrase, str]]()
    for index, (stage, names) in enumerate(zip(drive.stages, sizes, strict=True), 1):
        formula, line = ratio(stage, names), ""
        if len(sizes) > 1 and stage.form != "ratio":
            line = f"{G.name}_{index}"
            work = work.worked(line, formula)
            formula = Symbol(line)
        ratios.append(formula)
        stages.append((number(index) if len(sizes) > 1 else None, described(stage, names), line))
    work = work.worked(G.name, Product(tuple(ratios)) if len(ratios) > 1 else ratios[0])
    found = {f"G_{k}": line for k, (_, _, line) in enumerate(stages, 1) if line}
    results = {"G": work.final(G)} | {name: work.final(line) for name, line in found.items()}
    given, pages, speeds, torques = dict[str, Expr](), {"G": G.name, **found}, None, None
    if options.speed is not None:
        work, (motor,) = work.naming(omega_m=options.speed)
        omega = Symbol(free(problem.taken, "omega", "omega_l"))
        work = work.worked(omega.name, motor / G)
        results["omega"], given["omega"] = work.final(omega), options.speed
        speeds, pages["omega"] = (motor, omega), omega.name
    if options.torque is not None:
        work, (push,) = work.naming(tau_m=options.torque)
        tau = Symbol(free(problem.taken, "tau", "tau_l"))
        work = work.worked(tau.name, G * push)
        results["tau"], given["tau"] = work.final(tau), options.torque
        torques, pages["tau"] = (push, tau), tau.name
    about = {"stages": tuple(said for _, said, _ in stages), "sizes": _sizes(drive)}
    facts = Facts(
        given=work.typed, stages=tuple(stages), whole=Phrase("whole", about), several=len(sizes) > 1, G=G,
        direction=_direction(drive, work), speeds=speeds, torques=torques,
        page_names=pages,
    )  # fmt: skip
    work = work.claim(route("rolled", rolled(drive, problem, results, given)))
    work = work.claim(route("as-said", as_said(drive, work, facts)))
    return work.answer("gear-train", results, facts, units=_units(options, pages))


def _units(options: Options, pages: dict[str, str]) -> dict[Expr | Phrase, str]:
    """Those of the load, where the motor's were typed."""
    typed = {"omega": options.speed, "tau": options.torque}
    return {Symbol(pages[name]): SI[name] for name, value in typed.items() if value and unit_of(value)}


def _sizes(drive: Drive) -> tuple[Expr, ...]:
    return tuple(size for stage in drive.stages for size in stage.sizes)


def _numbers(drive: Drive) -> list[str]:
    return [f"_{k}" for k in range(1, len(drive.stages) + 1)]


def _direction(drive: Drive, work: Work) -> Phrase | None:
    """That of the load; None where the sign of a ratio is open."""
    signs = [
        work.sign(stage.sizes[0]) if stage.form == "ratio" else -1 if stage.form in TURNED_BACK else 1
        for stage in drive.stages
    ]
    if None in signs:
        return None
    return Phrase("with-motor" if prod(sign or 0 for sign in signs) > 0 else "against-motor")


def measures(drive: Drive) -> dict[str, str]:
    """A ratio, and what becomes of the speed and the torque."""
    return {"G": ""} | SI
