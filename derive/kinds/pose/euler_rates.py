"""How the rates of three angles and the angular velocity belong together, and where they do not."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import partial
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field

from derive.algebra.normal import Names, normal, normal_matrix
from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Branch, Derivation, PageFacts, Phrase, Result, Step
from derive.expression import (
    ZERO,
    Call,
    Expr,
    Matrix,
    Relation,
    Symbol,
    column,
    free_symbols,
    multiply,
    number,
    symbols,
    transpose,
)
from derive.kinds.checks import random_points, route
from derive.kinds.fields import Name, OptionsModel
from derive.kinds.meanings import as_told, column_of
from derive.kinds.pose._euler_checks import rotation_at
from derive.kinds.pose._euler_steps import factors_of
from derive.kinds.pose._numbers import fixed_angle, turns_of
from derive.kinds.pose.euler_angles import known_convention, three, usual_angles
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.euler import SIGNS, Convention, Euler
from derive.mechanics.motion import Motion
from derive.mechanics.oracle import made, slope, vee
from derive.mechanics.poses import UNIT, skew

SUBJECTS = ("motion", "frames", "robot")
E, OMEGA = symbols("E omega")  # E of Craig, for T is a pose
AXES = symbols("omega_x omega_y omega_z")
DIFFERENCES = 1e-6
NEAR = 1e-3  # a singular angle (rad)
GREAT = 100.0  # rates for an angular velocity of size one
CLAIMS = ("angular-velocities", "inverse", "singular", "grow", "differences")
CLAIMED = {"singular": "singular"}


class Options(OptionsModel):
    """Which angles turn the body, and the axes of its angular velocity."""

    convention: Annotated[str, AfterValidator(known_convention)] = "ZYX"
    """The order in which the rotations are made: ZYX about current axes, xyz about world axes, as in
    SciPy."""
    angles: tuple[Name, Name, Name] | None = None
    """Names for the three angles, in the order of the convention."""
    frame: Literal["base", "body"] = Field("base", alias="in")
    """The axes of omega: those of the base (the world) or of the body."""


class Facts(PageFacts):
    body: bool
    axes: tuple[str, ...]  # steps
    zeros: tuple[tuple[Symbol, Expr], ...]  # values of the middle angle
    outer: tuple[Symbol, Symbol]


def derive(subject: Any, options: Options, problem: Problem) -> Derivation:
    """E (3 by 3), each column of which is the axis about which its angle turns, and the rates E^-1 omega
    (Siciliano et al., section 3.6; Craig, eq. 5.42)."""
    euler, body = Euler(Convention.of(options.convention), _names(options, problem)), options.frame == "body"
    axes = tuple(Symbol(f"e_{name}") for name in euler.names)
    work = Work(problem.ordered(euler.names), factors_of(euler))
    for axis, name in zip(axes, euler.names, strict=True):
        work = work.line(axis, _axis(euler, name, body), rule="axis")
    work = work.line(E, Matrix((axes,)), rule="rate-matrix", label="T")
    det, inverse = Call("det", (E,)), Call("inverse", (E,))
    rates = column(Symbol(f"{name}_dot") for name in euler.names)
    filled = work[E] * rates
    work = work.step(Step("omega", (OMEGA, E * rates, filled), "in-numbers"))
    work = work.line(det, rule="determinant", label="det")
    work = work.line(rates, inverse * column(AXES), rule="in-numbers", label="rates")
    middle, singular = euler.outer[1], [euler.singular(sign).middle for sign in SIGNS]
    det_T = Call("det", (Symbol("T"),))  # as the result is called
    where = Phrase("singular-where", {"zero": Relation(det_T, "=", ZERO)})
    results: dict[str, Result] = {
        "T": work[E],
        "det": work.steps[-2].result,
        "rates": work.steps[-1].result,
        "singular": tuple(Branch({middle: value}, (where,)) for value in singular),
    }
    facts = Facts(
        body=body,
        axes=tuple(axis.name for axis in axes),
        zeros=tuple((Symbol(middle), fixed_angle(turns_of(value), problem)) for value in singular),
        outer=(Symbol(euler.outer[0]), Symbol(euler.outer[2])),
        short_names=euler.names,
        page_names={"T": E},
    )
    work = _proved(work, euler, facts)
    if options.angles is None and _of_motion(subject, euler.convention) is not None:
        routes = (lambda at: rotation_at(euler, at)), (lambda at: made(subject.moves, at)[:3, :3])
        work = work.agrees("angles-of-the-motion", problem.symbols, *routes)
    return work.answer("euler-rates", results, facts)


def _axis(euler: Euler, name: str, body: bool) -> Expr:
    """That of one rotation, carried by those before it in the product; in the body turned back by those
    after it."""
    place, factors = euler.outer.index(name), tuple(factors_of(euler))
    unit = column(map(number, UNIT[str(euler.factors[place].axis)]))
    return multiply(*(map(transpose, factors[:place:-1]) if body else factors[:place]), unit)


def _proved(work: Work, euler: Euler, facts: Facts) -> Work:
    """S(e_i) = dR/dangle R^T for each angle, E E^-1 = 1, det zero where it is said to be; and omega by
    differences of rotations composed in numbers."""
    E_now, R, body = work.value_matrix(E), euler.matrix, facts.body
    turning = (R.T @ R.diff(name) if body else R.diff(name) @ R.T for name in euler.names)
    work = work.law("angular-velocities", (skew(E_now.columns(k)) == S for k, S in enumerate(turning)))
    rates = normal_matrix(work.steps[-1].result)
    work = work.law("inverse", E_now @ rates == normal_matrix(column(AXES)))
    det = work.problem.readable(E_now.det())
    zeros = [normal(det, {name: value}) == 0 for name, value in facts.zeros]
    work = work.law(
        "singular", (*zeros, len(set(facts.zeros)) == 2)
    )  # twice in each turn of the middle angle
    ends = zip(map(Symbol, (euler.outer[0], euler.outer[2])), facts.outer, strict=True)
    symbols = {*euler.names, *(f"{name}_dot" for name in euler.names)}
    grow = route("grow", _grow(euler, facts, symbols), outer=facts.outer, middle=facts.zeros[0][0])
    work = work.claim(grow)
    return as_told(work, partial(_meant, euler, body), ends, "differences", DIFFERENCES, symbols)


def _grow(euler: Euler, facts: Facts, symbols: Collection[str]) -> Iterator[bool]:
    """Whether near each singular angle those rates, and no others, are great for some angular velocity."""
    import numpy as np

    for (name, value), at in zip(facts.zeros, random_points(symbols, len(facts.zeros)), strict=False):
        near = {**at, name.name: value_of(value, {}) + NEAR}
        rates = np.linalg.inv(np.array(_meant(euler, facts.body, near)[E], dtype=float))
        great = np.linalg.norm(rates, axis=1) > GREAT
        yield [each in {angle.name for angle in facts.outer} for each in euler.names] == great.tolist()


def _meant(euler: Euler, body: bool, at: Point) -> Names:
    """By differences of rotations composed in numbers: the axis of each angle, and omega for the rates of the
    point."""
    import numpy as np

    R, axes = rotation_at(euler, at), []
    for name in euler.names:
        rate = slope(lambda moved: rotation_at(euler, moved), at, {name: 1})
        axes.append(vee(R.T @ rate if body else rate @ R.T))
    rates = np.array([at[f"{name}_dot"] for name in euler.names])
    E_now = np.array(axes).T
    names: dict[Expr, Any] = {
        Symbol(f"e_{name}"): column_of(axis) for name, axis in zip(euler.names, axes, strict=True)
    }
    names |= dict(zip(AXES, E_now @ rates, strict=True))
    factors = zip(factors_of(euler), euler.factors, strict=True)
    names |= {factor: made((move,), at)[:3, :3] for factor, move in factors}
    return {**names, E: E_now, OMEGA: column_of(E_now @ rates)}


def _names(options: Options, problem: Problem) -> tuple[str, str, str]:
    """The angles as the author names them, or as a motion of the same sequence does; else free names.

    Raises NotDerivable where two of them are called alike.
    """
    if options.angles is not None:
        return three(options.angles)
    return _of_motion(problem.subject, Convention.of(options.convention)) or usual_angles(problem)


def _of_motion(subject: Any, convention: Convention) -> tuple[str, str, str] | None:
    """The angles of a motion that makes just the rotations of a convention."""
    if not isinstance(subject, Motion) or len(subject.moves) != 3:
        return None
    axes = tuple(move.axis for move in subject.moves)
    about = {move.about for move in subject.moves[1:]}
    turns = [move.by for move in subject.moves if move.kind == "rotate"]
    names = [angle.name for angle in turns if isinstance(angle, Symbol) and free_symbols(angle)]  # pi is none
    if axes != convention.axes or about != {convention.about} or len(set(names)) < 3:
        return None
    return names[0], names[1], names[2]
