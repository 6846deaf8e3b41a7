"""The angular acceleration of a motion or a rotation that changes in time, and that of its origin."""

from __future__ import annotations

from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import Point, number, numbers
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts, Result
from derive.expression import Symbol
from derive.kinds.motion._turning import Turning, rate_of, turning_of
from derive.kinds.motion.velocity import Options as Options
from derive.kinds.motion.velocity import spin_name
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.lagrangian import TIME
from derive.mechanics.motion import Motion
from derive.mechanics.oracle import vee
from derive.mechanics.poses import skew
from derive.mechanics.rotations import GivenRotation
from derive.names import free

SUBJECTS = ("motion", "rotation")
CLAIMS = ("second-derivative", "bend")
STEP = 1e-3  # of second differences by five places: their error is about 1e-8
NEAR = 1e-6


def measures(subject: Motion | GivenRotation) -> dict[str, str]:
    """Of a motion in time."""
    return {"omega": "rad/s", "alpha": "rad/s^2"}


class Facts(PageFacts):
    omega: Symbol
    rises: tuple[Symbol, ...]  # how the rates change; none where the time itself is what changes
    shifted: bool


def derive(subject: Motion | GivenRotation, options: Options, problem: Problem) -> Derivation:
    """alpha = d omega/dt (3 by 1; Siciliano et al., section 7.3.1), from S(alpha) + S(omega)^2 = R_ddot R^T.

    Raises NotDerivable where nothing turns.
    """
    found = turning_of(subject, options.rates, problem)
    base = problem.ask("velocity", rates=options.rates)
    work = Work(problem).resting_on(base)
    alpha = Symbol(free(problem.taken, "alpha", "alpha_R", "alpha_e"))
    a = Symbol(free(problem.taken, "a", "a_o", "a_e"))
    omega = normal_matrix(base.matrix("omega"))
    work = work.line(alpha, value=_rise(omega, found), rule="derivative", label="alpha")
    results: dict[str, Result] = {"alpha": work[alpha], "omega": base.results["omega"]}
    turned = problem.exact(found.R)
    bent = _rise(_rise(turned, found), found) @ turned.T
    told = skew(normal_matrix(work[alpha])) + skew(omega) @ skew(omega)
    work = work.law("second-derivative", told == bent)
    if found.shifting:
        moved = _rise(_rise(problem.exact(found.p), found), found)
        work = work.line(a, value=moved, rule="derivative", label="a")
        results |= {"a": work[a], "v": base.results["v"]}
    heads = (alpha, a) if found.shifting else (alpha,)
    rises = tuple(f"{name}_ddot" for name in found.varying if name != TIME)
    rates = {f"{name}_dot" for name in found.varying if name != TIME}
    work = work.agrees(
        "bend",
        problem.symbols.union(rises, rates),
        lambda at: [numbers(work[head], at) for head in heads],
        lambda at: _bend(found, at)[: len(heads)],
        NEAR,
    )
    facts = Facts(omega=spin_name(problem), rises=tuple(map(Symbol, rises)), shifted=bool(found.shifting))
    return work.answer("acceleration", results, facts)


def _rise(value: ScalarMatrix, found: Turning) -> ScalarMatrix:
    """How fast a matrix of names and their rates changes."""
    total = ScalarMatrix.zeros(*value.shape)
    for name in found.varying:
        if name == TIME:
            total = total + value.diff(name)
            continue
        rate, rise = (Scalar.symbol(f"{name}_{end}") for end in ("dot", "ddot"))
        total = total + value.diff(name).scaled(rate) + value.diff(f"{name}_dot").scaled(rise)
    return total


def _bend(found: Turning, at: Point) -> list[list[float]]:
    """alpha and a (3 each) by second differences of the pose, on the way that rates and accelerations say:
    of S(alpha) + S(omega)^2 the skew-symmetric part is S(alpha)."""
    rates = {name: number(rate_of(name), at) for name in found.varying}
    rises = {name: 0.0 if name == TIME else at[f"{name}_ddot"] for name in found.varying}

    def pose(h: float) -> Any:
        there = {name: at[name] + h * rates[name] + h * h / 2 * rises[name] for name in found.varying}
        return found.pose({**at, **there})

    places = ((-1, -2), (16, -1), (-30, 0), (16, 1), (-1, 2))
    change = sum(weight * pose(k * STEP) for weight, k in places) / (12 * STEP**2)
    spin = change[:3, :3] @ pose(0.0)[:3, :3].T
    return [vee((spin - spin.T) / 2), list(change[:3, 3])]
