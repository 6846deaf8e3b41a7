"""The equations of motion as a system of first order, and its linearisation about an equilibrium."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from derive.algebra.numbers.floats import Point, numbers
from derive.derivation import Derivation, LinearSystem, PageFacts, Phrase, Result, Said, Step, as_matrix
from derive.expression import Expr, Symbol, children, column
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.linear_systems import solution_at
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.drives import friction_sorts
from derive.kinds.robot._dynamics.linearisation import linear_at, linearised
from derive.kinds.robot._dynamics.solving import first_order
from derive.kinds.robot._efforts import effort
from derive.kinds.work import Work
from derive.mechanics.robot import Robot

POINTS = 2  # at which joint forces are compared
CLAIMED = {"A": "differences", "B": "differences"}

NEEDS = ("bodies",)


class Options(OptionsModel):
    """Whether the equations are linearised, and where."""

    at: Evaluation = None
    """The equilibrium, values of joint variables; one left out stays as it is. Without it nothing is
    linearised."""


class Facts(PageFacts):
    at: tuple[tuple[Symbol, Expr], ...]
    linear: bool
    long: bool
    viscous: bool
    rest: Phrase | None  # what becomes of the terms with rates
    coulomb: Phrase | None
    idle: Phrase | None  # what no joint needs there
    blocks: bool  # whether A and B are made of more than four and two entries


def claims_of(robot: Robot, options: Options) -> tuple[str, ...]:
    """With `at` those of the linearisation too."""
    return ("accelerations", *(() if options.at is None else ("adjugate", "differences")))


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """x = (q, qdot), and A, B about rest at `at` (Spong et al., section 8.1; Siciliano et al., 8.4)."""
    arm, forward = Arm(problem), problem.ask("forward-dynamics")
    x = column([*map(Symbol, robot.variables), *arm.rates])
    moved = forward.results["qddot"]
    f = first_order(moved, arm) if isinstance(moved, LinearSystem) else _with_rates(forward, arm)
    state = Step("x", (Symbol("x"), x), "state")
    derivative = Step("f", (Symbol("x_dot"), column([*arm.rates, *arm.accelerations])), "state")
    work = Work(problem).resting_on(forward).showing(state, derivative)
    results: dict[str, Result] = {"x": x, "f": f}
    linear = None if options.at is None else linear_at(problem, dict(options.at))
    if linear:
        work = linearised(work, linear)
        results |= {"tau_0": work["tau_0"], "A": linear.A, "B": linear.B}
    work = _moves_so(work, arm, results)
    facts = Facts(
        at=tuple((Symbol(name), value) for name, value in (options.at or ())),
        linear=linear is not None,
        long=bool(linear and linear.long),
        viscous=bool(linear and linear.friction),
        rest=(rest := _rest(arm, bool(linear.friction)) if linear else None),
        coulomb=Phrase("coulomb-left-out") if linear and friction_sorts(robot)[1] else None,
        idle=effort(robot) if linear and not linear.torques else None,
        blocks=len(robot.variables) > 1,
    )
    if linear:
        work = work.claim(route("rest", _seen_at_rest(arm, rest)))
    return work.answer("state-space", results, facts, matrices=frozenset({"A", "B"}))


def _rest(arm: Arm, viscous: bool) -> Phrase | None:
    """What becomes of the terms with rates; nothing where there are none."""
    quadratic = any(value for _, value in arm.christoffel.items())
    about: dict[str, Said] = {"F": Symbol("F_v")} if viscous else {}
    match quadratic, viscous:
        case True, _:
            return Phrase("quadratic-and-friction" if viscous else "quadratic", about)
        case _, True:
            return Phrase("friction", about)
    return None


def _seen_at_rest(arm: Arm, told: Phrase | None) -> Iterator[bool]:
    """Whether terms quadratic in the rates, and viscous friction, are told of just where joint forces have
    such: without friction they are even in the rates."""
    key, slow = told.key if told else "", [name + "_dot" for name in arm.variables]
    points = list(random_points(arm.moving, POINTS))

    def forces(at: Point, by: float) -> list[float]:
        return list(arm.rigid.torques({**at, **{name: by * at[name] for name in slow}}))

    turned = [(forces(at, 0.0), forces(at, 1.0), forces(at, 2.0)) for at in points]
    yield any(not close(still, once) for still, once, _ in turned) == key.startswith("quadratic")
    for still, once, twice in turned:
        yield all(close(c - a, 4 * (b - a)) for a, b, c in zip(still, once, twice, strict=True))
    yield (told is not None and told.about.get("F") == Symbol("F_v")) == key.endswith("friction")


def _with_rates(forward: Derivation, arm: Arm) -> Expr:
    return column([*arm.rates, *children(forward.matrix("qddot"))])


def _at(found: Result, at: Point) -> list[float]:
    """x or f in numbers (2n)."""
    return solution_at(found, at) if isinstance(found, LinearSystem) else numbers(as_matrix(found, "f"), at)


def _moves_so(work: Work, arm: Arm, results: Mapping[str, Result]) -> Work:
    """x and f, of the results and of the printed lines, against a motion: the joint forces it needs bring
    about its accelerations."""
    names, lines = arm.variables, {step.name: step.result for step in work.steps if step.rule == "state"}

    def ours(at: Point) -> list[Any]:
        forces = {f"tau_{k}": force for k, force in enumerate(arm.rubbing.torques(at), 1)}
        wholly = {**at, **forces}
        return [_at(found[name], wholly) for found in (results, lines) for name in ("x", "f")]

    def moving(at: Point) -> list[Any]:
        q, rates, rises = ([at[name + dots] for name in names] for dots in ("", "_dot", "_ddot"))
        return [q, rates, rates, rises] * 2

    return work.agrees("accelerations", arm.moving, ours, moving)
