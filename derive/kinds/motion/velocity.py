"""The angular velocity of a motion or a rotation that changes in time, and the velocity of its origin."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import Point, number
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts
from derive.expression import (
    Call,
    Derivative,
    Expr,
    Symbol,
    symbols,
    transpose,
)
from derive.kinds.fields import Name, OptionsModel
from derive.kinds.meanings import Names, as_told, column_of
from derive.kinds.motion._turning import Turning, by_chain_rule, rate_of, turning_of
from derive.kinds.pose._numbers import size
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.lagrangian import TIME
from derive.mechanics.motion import Motion
from derive.mechanics.oracle import slope, vee
from derive.mechanics.poses import skew
from derive.mechanics.rotations import GivenRotation
from derive.names import free

DIFFERENCES = 1e-6
R, R_DOT, P, S, V = symbols("R R_dot p S v")
LONGEST_SPEED = 12  # operations above which the size of omega is left out
SUBJECTS = ("motion", "rotation")
CLAIMS = ("skew-symmetric", "differences")


def measures(subject: Motion | GivenRotation) -> dict[str, str]:
    """Of a motion in time."""
    return {"omega": "rad/s", "S": "rad/s"}


class Options(OptionsModel):
    """What changes in time."""

    rates: tuple[Name, ...] = ()
    """The names that change in time. If left out, those are all that it is by, and where the time t is among
    them the others are constants."""


class Facts(PageFacts):
    rates: tuple[Symbol, ...]
    in_time: bool  # the only one of them is the time
    shifted: bool


def derive(subject: Motion | GivenRotation, options: Options, problem: Problem) -> Derivation:
    """S(omega) = dR/dt R^T (3 by 3; Spong et al., eq. 4.18; Siciliano et al., eq. 3.6), and the omega and v
    (3 by 1 each) that go with it.

    Raises NotDerivable where nothing changes.
    """
    found = turning_of(subject, options.rates, problem)
    varying, turning, shifting = found.varying, found.turning, found.shifting
    work = Work(problem, uses=found.uses)
    work = work.knowing({R: problem.readable_matrix(found.R)})
    work = _rate(work, turning).line(S, R_DOT * transpose(R), rule="skew")
    turn, omega = work.value_matrix(S), spin_name(problem)
    spin = ScalarMatrix.column((turn[2, 1], turn[0, 2], turn[1, 0]))
    work = work.line(omega, value=spin, rule="read-off", label="omega")
    square = sum((part * part for (part,) in spin.rows), Scalar.of(0))
    speed = size(square, problem)
    if operations(speed) <= LONGEST_SPEED:
        work = work.line(Call("abs", (omega,)), value=speed, rule="speed", label="speed")
    work = work.linked(but=("speed",))
    results = {"omega": work.final(omega), "S": work.final(S)}
    if shifting:
        work = work.knowing({P: problem.readable_matrix(found.p)})
        work = work.line(V, by_chain_rule(P, shifting), rule="chain-rule")
        results["v"] = work.final(V)
    names = problem.symbols.union(f"{name}_dot" for name in varying if name != TIME)
    S_told, omega_told = normal_matrix(results["S"]), normal_matrix(results["omega"])
    work = work.law("skew-symmetric", S_told == skew(omega_told))
    means = partial(_meant, found, omega)
    as_printed = [
        (name, results[key]) for key, name in (("omega", omega), ("S", S), ("v", V)) if key in results
    ]
    work = as_told(work, means, as_printed, "differences", DIFFERENCES, names)
    in_time = tuple(turning) == (TIME,)
    facts = Facts(rates=tuple(map(Symbol, turning)), in_time=in_time, shifted=bool(shifting))
    turned = tuple(Symbol(name) for name in varying if normal_matrix(work[R]).diff(name))
    said = (facts.rates == turned, in_time == (turned == (Symbol(TIME),)), facts.shifted == ("v" in results))
    work = work.law("said", said)
    return work.answer("velocity", results, facts)


def spin_name(problem: Problem) -> Symbol:
    """What the angular velocity is called."""
    return Symbol(free(problem.taken, "omega", "w", "omega_R"))


def _rate(work: Work, turning: Sequence[str]) -> Work:
    """dR/dt, written out where the page has room for that."""
    formula = by_chain_rule(R, turning)
    value = work.problem.readable_matrix(work.value_matrix(formula))
    return work.line(R_DOT, formula, value=value, rule="chain-rule", spare=(value,))


def _meant(found: Turning, omega: Symbol, at: Point) -> Names:
    """Everything by differences of the pose made in numbers, where the names of `where` move along."""
    rates = {name: number(rate_of(name), at) for name in found.varying}
    T, change = found.pose(at), slope(found.pose, at, rates)
    names: dict[Expr, Any] = {R: T[:3, :3], R_DOT: change[:3, :3]}
    if found.shifting:
        names |= {P: T[:3, 3:], V: change[:3, 3:]}
    for name in found.varying:
        alone = slope(found.pose, at, {name: 1.0})
        names[Derivative(R, Symbol(name))] = alone[:3, :3]
        names[Derivative(P, Symbol(name))] = alone[:3, 3:]
    spin = change[:3, :3] @ T[:3, :3].T
    return {**names, S: spin, omega: column_of(vee(spin))}
