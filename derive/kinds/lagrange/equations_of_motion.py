"""The equations of motion of a system by the method of Lagrange, with its constraints."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, PageFacts, Phrase, Result, Step
from derive.expression import ZERO, Derivative, Expr, Symbol, add, column, free_symbols, negate
from derive.kinds.checks import law
from derive.kinds.fields import OptionsModel
from derive.kinds.lagrange._as_told import Conserved, as_told
from derive.kinds.lagrange._energies import energy_steps
from derive.kinds.lagrange._equations import difference, written_motion, written_side
from derive.kinds.lagrange._meanings import slope_of
from derive.kinds.lagrange._model import Model
from derive.kinds.lagrange._solved import Solved, satisfies, solved
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.lagrangian import (
    TIME,
    Condition,
    LagrangianSystem,
    energy,
    on_accelerations,
    rate,
    without,
)

CLAIMED = {"M": "along-a-motion", "equations": "along-a-motion"}


class Options(OptionsModel):
    """The form of the equations."""

    solve: bool = False
    """Whether they are solved for the accelerations; under constraints that is done anyway."""


class Facts(PageFacts):
    coordinates: tuple[Symbol, ...]
    L: str
    P: str
    several: bool  # bodies
    turning: bool
    gravity: Expr | None
    dissipation: tuple[Expr, Expr] | None
    forces: tuple[tuple[Expr, Expr], ...]
    constraints: tuple[tuple[Expr, Expr], ...]
    velocity: bool  # a constraint of velocities is among them
    derivatives: tuple[Symbol, ...]  # of the constraints
    slopes: tuple[tuple[Symbol, Expr], ...]  # those that are not zero
    multipliers: tuple[Symbol, ...]
    equations: tuple[str, ...]  # steps
    across: tuple[str, ...]  # steps
    cyclic: tuple[tuple[Symbol, Expr], ...]
    reactions: tuple[tuple[Symbol, tuple[Expr, ...]], ...]  # of the constraints, along the coordinates


def claims_of(system: LagrangianSystem, options: Options) -> tuple[str, ...]:
    """The keys of what is claimed."""
    solved_for = ("solved-for", "solved-again") if options.solve or system.constraints else ()
    return ("symmetric", "power", "along-a-motion", *solved_for)


def derive(system: LagrangianSystem, options: Options, problem: Problem) -> Derivation:
    """d/dt dL/dqdot_k - dL/dq_k + dD/dqdot_k = Q_k + sum lambda_i a_ik (Goldstein et al., sections 1.4,
    1.5 and 2.4). Raises NotDerivable where solving was asked for and is out of reach."""
    model = Model(system, problem)
    solution = solved(model) if options.solve or system.constraints else None
    lefts = [written_side(left, system, problem) for left in model.lefts]
    rights = [problem.readable(model.forces[q] + model.reaction(k)) for k, q in enumerate(system.coordinates)]
    steps = (
        *energy_steps(model),
        _general(model),
        *_partials(model),
        *_equations(model, lefts, rights),
        *_solution_steps(model, solution),
        *_conserved(model),
    )
    work = Work(problem, _definitions(steps), steps=steps).claim(*_laws(model, solution))
    equations = [problem.final(difference(*sides)) for sides in zip(lefts, rights, strict=True)]
    results, facts = _results(model, lefts, equations, solution), _facts(model, lefts, solution)
    forces = facts.forces if system.forces else ()  # Q_q = 0 is of any coordinate
    work = work.claim(*as_told(model, work, results, (*forces, *facts.slopes), facts.cyclic, facts.reactions))
    work = work.law("said", _said(system, work, facts))
    return work.answer("equations-of-motion", results, facts)


def _said(system: LagrangianSystem, work: Work, facts: Facts) -> Iterator[bool]:
    """What the words call one or several, and what they take from the sheet."""
    rules = [step.rule for step in work.steps]
    yield facts.several == (rules.count("position") > 1) and facts.turning == ("spin" in rules)
    yield tuple(name.name for name in facts.coordinates) == system.coordinates
    given = dict(system.forces)
    told = {Symbol(f"Q_{q}"): given.get(q, ZERO) for q in system.coordinates}
    yield dict(facts.forces) == (told if given else {Symbol("Q_q"): ZERO})
    yield facts.constraints == tuple((each.left, each.right) for each in system.constraints)
    rates = {*system.rates}
    holding = [free_symbols(side) & rates for pair in facts.constraints for side in pair]
    yield facts.velocity == any(holding)
    yield len(facts.multipliers) == len(facts.constraints) == len(facts.derivatives)
    said = [step.facts.said.key for step in work.steps if isinstance(step.facts, Conserved)]
    yield all(key == "jacobi" or (key == "conserved-held") == bool(system.constraints) for key in said)
    yield facts.gravity is None or facts.gravity == column(system.gravity)
    yield (facts.dissipation is None) == (system.dissipation == ZERO)
    yield facts.dissipation is None or facts.dissipation[1] == system.dissipation


def _general(model: Model) -> Step:
    """Lagrange's equation of a coordinate q."""
    letters, along = model.letters, Symbol("q_dot")
    L, D = Symbol(letters.lagrangian), Symbol(letters.dissipation)
    lost = () if model.system.dissipation == ZERO else (Derivative(D, along),)
    left = Derivative(Derivative(L, along), Symbol(TIME)), negate(Derivative(L, Symbol("q")))
    held = (name * slope for name, slope in zip(model.multipliers, slopes_of(model), strict=True))
    return Step("lagrange", (add(*left, *lost), add(Symbol("Q_q"), *held)), "in-numbers")


def slopes_of(model: Model) -> tuple[Symbol, ...]:
    """The derivatives of the constraints by any coordinate."""
    return tuple(slope_of(k, "q", model.multipliers) for k in range(1, len(model.conditions) + 1))


def _slopes(model: Model) -> Iterator[tuple[Symbol, Expr]]:
    """Those that are not zero, each with its value."""
    for i, condition in enumerate(model.conditions, 1):
        for q, slope in zip(model.system.coordinates, condition.a, strict=True):
            if slope:
                yield slope_of(i, q, model.multipliers), model.problem.readable(slope)


def _reactions(model: Model, found: Solved | None) -> Iterator[tuple[Symbol, tuple[Expr, ...]]]:
    """What the constraints add to the force along each coordinate; in the end of a single one its value."""
    for k, q in enumerate(model.system.coordinates):
        force = model.reaction(k)
        if force and found is not None:
            value = written_motion(force.substitute(found.multipliers), model.system, model.problem)
            chain = (model.problem.readable(force), value)
            yield Symbol(q), chain if len(model.multipliers) == 1 else chain[:1]


def _partials(model: Model) -> Iterator[Step]:
    """For each coordinate dL/dqdot, its rate, and dL/dq."""
    system, problem, L = model.system, model.problem, Symbol(model.letters.lagrangian)
    for q, along in zip(system.coordinates, system.rates, strict=True):
        momentum = model.lagrangian.diff(along)
        outer = Derivative(L, Symbol(along))
        yield Step(f"momentum_{q}", (outer, written_side(momentum, system, problem)), "momentum")
        change = written_side(rate(momentum, system), system, problem)
        yield Step(f"rate_{q}", (Derivative(outer, Symbol(TIME)), change), "in-numbers")
        force = written_side(model.lagrangian.diff(q), system, problem)
        yield Step(f"force_{q}", (Derivative(L, Symbol(q)), force), "force")


def _equations(model: Model, lefts: list[Expr], rights: list[Expr]) -> Iterator[Step]:
    for k, (left, right) in enumerate(zip(lefts, rights, strict=True), 1):
        yield Step(f"equation_{k}", (left, right), "in-numbers")


def _conserved(model: Model) -> Iterator[Step]:
    """The energy (Jacobi's integral), where nothing drives the system and nothing brakes it."""
    system = model.system
    driven = any(model.forces.values()) or bool(model.lagrangian.diff(TIME))
    braked = system.dissipation != ZERO
    if not (driven or braked) and all(map(_does_no_work, model.conditions)):
        total = energy(model.lagrangian, system)
        whole = sum((*model.kinetic, *model.potential), Scalar.of(0))
        name = Symbol(model.letters.energy if total == whole else model.letters.jacobi)
        kept = "conserved-held" if system.constraints else "conserved"
        facts = Conserved(said=Phrase(kept if total == whole else "jacobi"))
        yield Step(name.name, (name, written_side(total, system, model.problem)), "energy", facts)


def _does_no_work(condition: Condition) -> bool:
    """Whether a constraint stays where it is: none that holds the time, none that drives the rates."""
    if condition.vanishing.diff(TIME):
        return False
    if condition.sort == "holonomic":
        return True
    rates = [name for name in condition.vanishing.ring.symbols if name.endswith("_dot")]
    return not without(condition.vanishing, rates)


def _solution_steps(model: Model, found: Solved | None) -> Iterator[Step]:
    """The constraints on the accelerations, then what comes out."""
    if found is None:
        return
    for k, condition in enumerate(model.conditions, 1):
        across = written_side(on_accelerations(condition, model.system), model.system, model.problem)
        yield Step(f"constraint_{k}", (across, ZERO), "in-numbers")
    for name, value in found.accelerations.items():
        yield Step(name, (Symbol(name), written_motion(value, model.system, model.problem)), "acceleration")
    for name, value in found.multipliers.items():
        yield Step(name, (Symbol(name), written_motion(value, model.system, model.problem)), "multiplier")


def _definitions(steps: tuple[Step, ...]) -> dict[Expr, Expr]:
    """The names of positions, velocities and energies."""
    rules = ("position", "velocity", "spin", "kinetic", "kinetic-of-body", "potential", "lagrangian")
    return {Symbol(step.name): step.result for step in steps if step.rule in rules}


def _results(
    model: Model, lefts: list[Expr], equations: list[Expr], found: Solved | None
) -> Mapping[str, Result]:
    problem, zero = model.problem, Scalar.of(0)
    scalars = {
        "T": sum(model.kinetic, zero), "P": sum(model.potential, zero), "L": model.lagrangian,
    }  # fmt: skip
    results: dict[str, Result] = {name: problem.final(problem.readable(v)) for name, v in scalars.items()}
    results["M"] = problem.final(problem.readable_matrix(model.mass))
    results["tau"] = _columns(problem, lefts)
    results["equations"] = column(equations)
    for step in _conserved(model):
        results["E"] = problem.final(step.result)
    if found is not None:
        results["accelerations"] = _solution(model, found.accelerations)
        if found.multipliers:
            results["multipliers"] = _solution(model, found.multipliers)
    return results


def _columns(problem: Problem, entries: list[Expr]) -> Expr:
    return column(problem.final(entry) for entry in entries)


def _solution(model: Model, found: Mapping[str, Scalar]) -> Expr:
    written = [written_motion(value, model.system, model.problem) for value in found.values()]
    return _columns(model.problem, written)


def _facts(model: Model, lefts: list[Expr], found: Solved | None) -> Facts:
    system, letters = model.system, model.letters
    lost = None if system.dissipation == ZERO else (Symbol(letters.dissipation), system.dissipation)
    return Facts(
        coordinates=tuple(map(Symbol, system.coordinates)),
        L=letters.lagrangian, P=letters.potential,
        several=letters.indexed,
        turning=any(body.inertia is not None for body in system.bodies),
        gravity=column(system.gravity) if any(map(model.scalar, system.gravity)) else None,
        dissipation=lost,
        forces=tuple(_forces(system)),
        constraints=tuple((c.left, c.right) for c in system.constraints),
        velocity=any(condition.sort == "velocity" for condition in model.conditions),
        derivatives=slopes_of(model), slopes=tuple(_slopes(model)), multipliers=model.multipliers,
        equations=tuple(f"equation_{k}" for k in range(1, len(lefts) + 1)),
        across=tuple(f"constraint_{k}" for k in range(1, len(model.conditions) + 1)),
        cyclic=tuple(_cyclic(model)),
        reactions=tuple(_reactions(model, found)),
    )  # fmt: skip


def _forces(system: LagrangianSystem) -> Iterator[tuple[Symbol, Expr]]:
    """The force along each coordinate; Q_q = 0 for all of them where none is given."""
    if not system.forces:
        yield Symbol("Q_q"), ZERO
        return
    given = dict(system.forces)
    for q in system.coordinates:
        yield Symbol(f"Q_{q}"), given.get(q, ZERO)


def _cyclic(model: Model) -> Iterator[tuple[Symbol, Expr]]:
    """Coordinates that neither L nor any force holds, with what is conserved for each."""
    lost = model.scalar(model.system.dissipation)
    for k, (q, along) in enumerate(zip(model.system.coordinates, model.system.rates, strict=True)):
        free = not model.forces[q] and not model.reaction(k) and not lost.diff(along)
        if free and not model.lagrangian.diff(q):
            yield Symbol(q), model.problem.readable(model.lagrangian.diff(along))


# -- what it is held to ----------------------------------------------------------------------------------


def _laws(model: Model, found: Solved | None) -> Iterator[Claim]:
    system, mass = model.system, model.mass
    yield law("symmetric", mass == mass.T)
    power = Scalar.of(0)
    for name, side in zip(system.rates, model.sides, strict=True):
        power = power + Scalar.symbol(name) * side
    balance = rate(energy(model.lagrangian, system), system) == power - model.lagrangian.diff(TIME)
    yield law("power", balance)
    if found is not None:
        yield law("solved-for", satisfies(model, found))
