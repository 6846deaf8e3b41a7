"""The momentum observer of an arm: residuals that follow the joint torques of contacts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Annotated, Any

from pydantic import Field

from derive.algebra.formulas.quantities import rational
from derive.algebra.numbers.floats import Point, completed, numbers
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Claim, Derivation, PageFacts, Phrase, Result, Step
from derive.errors import NotDerivable
from derive.expression import (
    ONE,
    Derivative,
    Expr,
    Matrix,
    Measured,
    Number,
    Symbol,
    add,
    column,
    free_symbols,
    multiply,
    number,
    symbols,
    transpose,
)
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import Frequency, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.drives import friction_terms
from derive.kinds.robot._efforts import effort
from derive.kinds.robot._units import of_joints
from derive.kinds.work import Work
from derive.mechanics.dynamics import kinetic_energy, rate_column
from derive.mechanics.robot import Robot
from derive.names import free

NEEDS = ("bodies",)
CLAIMS = ("momentum", "observed", "felt")
CLAIMED = {"r_dot": "observed"}
INTRODUCED = r"tau_ext_\d+"  # torques of contacts
measures = of_joints("alpha", effort=True)
HALF = ONE / number(2)
K, D, Q_DOT = symbols("K D q_dot")
POINTS, NEAR, STEP = 3, 1e-5, 1e-5


class Options(OptionsModel):
    """The observer."""

    gain: Frequency | Annotated[tuple[Frequency, ...], Field(min_length=1)] | None = None
    """The gain of all joints, or a list with one for each; a letter if left out."""


class Facts(PageFacts):
    momenta: tuple[str, ...]  # steps, as the next three
    known: tuple[str, ...]
    rates: tuple[str, ...]
    residuals: tuple[str, ...]
    gains: tuple[tuple[Expr, Expr], ...]  # those that are given by a value
    chosen: tuple[Symbol, ...]  # those of which nothing is given
    geared: bool  # a motor turns faster than its joint
    slowest: tuple[Expr, ...]  # time constants
    rubbing: bool
    drive: Symbol  # what joint 1 gets, as the next
    contact: Symbol
    effort: Phrase  # of a joint
    felt: Phrase | None  # by which joints; None where there is one


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """r_k_dot = k_k (p_k_dot - tau_k + alpha_k - r_k) with p = D qdot (De Luca, Albu-Schaeffer, Haddadin,
    Hirzinger, Collision detection and safe reaction with the DLR-III lightweight manipulator arm, 2006).

    Raises NotDerivable where the momentum of the arm would fill pages.
    """
    arm = Arm(problem)
    if arm.long:
        raise NotDerivable("the momentum of this arm would fill pages; it is not derived yet for such arms")
    names = _names(options, arm)
    for joint in names:
        if (value := rational(problem.final(joint.gain))) is not None and value <= 0:
            raise NotDerivable("a gain is positive: else the residual does not follow the contact", "gain")
    rubbing = friction_terms(robot)
    work = Work(problem).resting_on(arm.inertia, problem.ask("gravity"))
    energy = arm.final(kinetic_energy(arm.D, rate_column(arm.variables)))
    work = work.knowing({Q_DOT: column(arm.rates)})
    work = work.line(K, multiply(HALF, transpose(Q_DOT), D, Q_DOT), value=energy, rule="energy")
    for joint, rate in zip(names, arm.rates, strict=True):
        work = work.line(joint.p, Derivative(K, rate), rule="momentum")
    for k, (joint, variable) in enumerate(zip(names, arm.variables, strict=True)):
        formula = add(Symbol(f"g_{k + 1}"), -Derivative(K, Symbol(variable)), *rubbing[k])
        work = work.line(joint.alpha, formula, rule="known")
    rates, observers = [each.rate() for each in names], [each.observer() for each in names]
    work = work.showing(*rates, *observers)
    results: dict[str, Result] = {
        "p": column(work.final(each.p) for each in names),
        "alpha": column(work.final(each.alpha) for each in names),
        "r_dot": column(each.followed(final=True) for each in names),
    }
    work = work.claim(*_claims(work, arm, names, results))
    facts = Facts(
        momenta=tuple(each.p.name for each in names),
        known=tuple(each.alpha.name for each in names),
        rates=tuple(step.name for step in rates),
        residuals=tuple(step.name for step in observers),
        gains=tuple(dict.fromkeys((each.k, _per_second(each.gain)) for each in names if each.k != each.gain)),
        chosen=tuple(each.k for each in names if options.gain is None),
        geared=any(link.motor is not None and link.motor.ratio != ONE for link in robot.links),
        slowest=tuple(dict.fromkeys(ONE / each.k for each in names)),
        rubbing=any(rubbing),
        drive=names[0].tau,
        contact=names[0].ext,
        effort=effort(robot),
        felt=None if len(names) == 1 else Phrase("felt-by-coupled" if robot.coupled else "felt-by-chain"),
    )
    return work.answer("residual", results, facts)


@dataclass(frozen=True, slots=True)
class Joint:
    """What the quantities of a joint are called; `gain` is what its gain k stands for."""

    p: Symbol
    alpha: Symbol
    r: Symbol
    tau: Symbol
    ext: Symbol
    k: Symbol
    gain: Expr

    @property
    def p_dot(self) -> Symbol:
        """The rate of the momentum."""
        return Symbol(f"{self.p.name}_dot")

    def rate(self) -> Step:
        """By the equations of motion."""
        chain = (self.p_dot, self.tau + self.ext - self.alpha)
        return Step(self.p_dot.name, chain, "in-numbers")

    def observer(self) -> Step:
        """The rate of the residual, by what is measured and by what it shows."""
        measured = multiply(self.k, self.p_dot - self.tau + self.alpha - self.r)
        name = f"{self.r.name}_dot"
        return Step(name, (Symbol(name), measured, self.followed()), "in-numbers")

    def followed(self, final: bool = False) -> Expr:
        """A filter of the first order."""
        return multiply(self.gain if final else self.k, self.ext - self.r)


def _per_second(gain: Expr) -> Expr:
    """With its unit, where it is a number."""
    return Measured(gain, "1/s") if isinstance(gain, Number) else gain


def _names(options: Options, arm: Arm) -> tuple[Joint, ...]:
    """The letters of each joint. Raises NotDerivable for as many gains as there are not joints."""
    n, taken = len(arm.variables), arm.problem.taken
    given = options.gain
    if isinstance(given, tuple) and len(given) != n:
        joints = f"{n} joints: give one, or one for each" if n > 1 else "one joint"
        raise NotDerivable(f"{len(given)} gains for {joints}", "gain")
    ends = tuple(f"_{k}" for k in range(1, n + 1))
    taken |= {name.name for name in arm.inertia.definitions if isinstance(name, Symbol)}  # axes beside frames
    p, alpha, r, tau, ext = (
        free(taken, *letters, indices=ends)
        for letters in (("p", "h", "P"), ("alpha", "beta"), ("r", "rho"), ("tau", "Q"), ("tau_ext", "Q_ext"))
    )
    letter = free(taken, "k", "kappa", indices=ends)
    found = []
    for k, end in enumerate(ends):
        alone = None if given is None else given[k] if isinstance(given, tuple) else given
        name = Symbol(letter + end) if given is None or isinstance(given, tuple) else Symbol(f"{letter}_r")
        gain = Symbol(letter + end) if alone is None else alone
        name = gain if isinstance(gain, Symbol) else name
        found.append(
            Joint(
                p=Symbol(p + end),
                alpha=Symbol(alpha + end),
                r=Symbol(r + end),
                tau=Symbol(tau + end),
                ext=Symbol(ext + end),
                k=name,
                gain=gain,
            )
        )
    return tuple(found)


# -- what holds it -----------------------------------------------------------------------------------


def _claims(work: Work, arm: Arm, names: Sequence[Joint], results: Mapping[str, Result]) -> Iterator[Claim]:
    symbols = arm.moving | {each.name for joint in names for each in (joint.ext, joint.r)}
    symbols |= {name for joint in names for name in free_symbols(joint.gain)}
    places = [completed(at, arm.problem.where) for at in islice(random_points(symbols, POINTS), POINTS)]
    yield route("momentum", (ok for at in places for ok in _moves(work, arm, names, results, at)))
    yield route("observed", (ok for at in places for ok in _observes(work, arm, names, results, at)))
    yield route("felt", _felt(arm, places[0]))


def _moves(
    work: Work, arm: Arm, names: Sequence[Joint], results: Mapping[str, Result], at: Point
) -> Iterator[bool]:
    """The momentum is that of the arm in numbers, which changes by the torques of its motion less what is
    known."""
    inertia, rates = arm.rubbing.inertia_matrix(at), [at[each.name] for each in arm.rates]
    yield close(numbers(_matrix(results["p"]), at), inertia @ rates, NEAR)
    yield close(numbers(_matrix(results["alpha"]), at), arm.rubbing.torques(at) - _change(arm, at), NEAR)
    told = (numbers(_matrix(results[key]), at) for key in ("p", "alpha"))
    for joint, *its in zip(names, *told, strict=True):
        yield close([value_of(work.final(name), at) for name in (joint.p, joint.alpha)], its)


def _change(arm: Arm, at: Point) -> Any:
    """The rate of the momentum along the motion, by differences."""

    def momentum(by: float) -> Any:
        there = dict(at)
        for name in arm.variables:
            there[name] += by * at[f"{name}_dot"] + by * by / 2 * at[f"{name}_ddot"]
            there[f"{name}_dot"] += by * at[f"{name}_ddot"]
        return arm.rubbing.inertia_matrix(there) @ [there[each.name] for each in arm.rates]

    return (momentum(STEP) - momentum(-STEP)) / (2 * STEP)


def _observes(
    work: Work, arm: Arm, names: Sequence[Joint], results: Mapping[str, Result], at: Point
) -> Iterator[bool]:
    """With torques of contacts beside those of the motors, every line of the residual as it is written."""
    told, change = arm.rubbing.torques(at), _change(arm, at)
    steps = {step.name: step.chain for step in work.steps}
    for k, joint in enumerate(names):
        outside = at[joint.ext.name]
        known = {
            **at, joint.p_dot.name: float(change[k]), joint.tau.name: float(told[k]) - outside,
            joint.alpha.name: float(told[k] - change[k]), joint.k.name: value_of(joint.gain, at),
        }  # fmt: skip
        head, rate = steps[joint.p_dot.name]
        yield close(value_of(head, known), value_of(rate, known), NEAR)
        _, *forms = steps[f"{joint.r.name}_dot"]
        wanted = value_of(joint.gain, at) * (outside - at[joint.r.name])
        yield all(close(value_of(form, known), wanted, NEAR) for form in forms)
        yield close(value_of(_matrix(results["r_dot"]).rows[k][0], known), wanted)


def _felt(arm: Arm, at: Point) -> Iterator[bool]:
    """No joint after a link moves it, in a chain without couplings."""
    import numpy as np

    robot = arm.problem.subject
    here = arm.rubbing.poses(at)
    joints = [(k, link.variable) for k, link in enumerate(robot.links) if link.variable]
    for k, name in joints:
        moved = arm.rubbing.poses({**at, name: at[name] + 0.1})
        before = all(np.allclose(a, b) for a, b in zip(moved[: k + 1], here[: k + 1], strict=True))
        yield before or robot.coupled


def _matrix(result: Result) -> Matrix:
    if not isinstance(result, Matrix):
        raise TypeError("a column is wanted")
    return result
