"""The one axis and the one angle that make a rotation in a single turn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, PageFacts, Result, Step
from derive.expression import (
    Expr,
    Matrix,
    Product,
    Quotient,
    Symbol,
    add,
    atan2,
    column,
    cos,
    number,
    sin,
    sqrt,
    squared,
    subtract,
    transpose,
)
from derive.kinds.checks import agreement, law, links
from derive.kinds.pose._angles import known_angle
from derive.kinds.pose._given import Given, PoseOptions, given_pose
from derive.kinds.pose._roots import over
from derive.kinds.pose._roots import size as length_of
from derive.kinds.pose._rotation import Rotation, rotation_of
from derive.kinds.problem import Problem
from derive.mechanics.motion import Move
from derive.names import free

SUBJECTS = ("motion", "frames", "robot")
RESULTS = {
    "angle": "the angle, from 0 to pi",
    "axis": "the unit vector along the axis; any where nothing is turned",
}
EXAMPLE = """\
title: In a single turn
problems:
- motion:
  - {rotate: x, by: 90 deg}
  - {rotate: z, by: 90 deg}
  find: axis-angle
"""
DIFFERENCES = (("r_32", "r_23"), ("r_13", "r_31"), ("r_21", "r_12"))


@dataclass(frozen=True, slots=True)
class _Names:
    """What the angle, the axis and the vector 2 sin(angle) axis are called here."""

    angle: Symbol
    axis: Symbol
    turn: Symbol

    def component(self, letter: str) -> Symbol:
        return Symbol(f"{self.turn.name}_{letter}")


def _names(problem: Problem) -> _Names:
    return _Names(
        Symbol(free(problem.taken, "theta", "phi", "alpha", "theta_k")),
        Symbol(free(problem.taken, "k", "u", "n", "k_r")),
        Symbol(free(problem.taken, "w", "v", "m", "w_r")),
    )


class Options(PoseOptions):
    """A subject of frames takes `from` and `to`."""


class Facts(PageFacts):
    rotation: Symbol
    angle: Symbol
    axis: Symbol
    zero: bool = False
    half: bool = False
    numeric: bool = False
    turned: Symbol
    twice: tuple[Expr, Expr]
    law: tuple[Expr, Expr]


def derive(subject: Any, options: Options, problem: Problem) -> Derivation:
    """The angle from the trace, the axis from what R lacks of symmetry; from R + 1 for half a turn
    (Siciliano et al., eqs. 2.27 and 2.28)."""
    given = given_pose(options, problem)
    R = rotation_of(given, problem)
    names = _names(problem)
    if R.matrix == ScalarMatrix.identity(3):
        return _nothing(given, names, _facts(given, names))
    half = R.matrix == R.matrix.T
    steps = _half_turn(R, names, problem) if half else _general(R, names, problem)
    told = len(steps[-1].chain) > 2 or half
    angle, axis = (steps[-2].result, _column(steps[-1])) if told else _long(R, problem)
    results: dict[str, Expr] = {"angle": angle, "axis": axis}
    facts = replace(
        _facts(given, names),
        zero=False,
        half=half,
        numeric=R.numeric,
        angle_results=("angle",),
        style=problem.style,
        page_names={"angle": names.angle, "axis": names.axis},
    )
    claims = (*_links(steps, R, names), *_laws(R, axis), _second_route(given, problem, results))
    definitions: dict[Expr, Expr] = {**R.entries, names.angle: angle, names.axis: axis}
    return Derivation("axis-angle", steps, results, claims, definitions, uses=given.uses, facts=facts)


def _facts(given: Given, names: _Names) -> Facts:
    return Facts(
        rotation=given.rotation,
        angle=names.angle,
        axis=names.axis,
        zero=True,
        turned=names.turn,
        twice=(names.turn, Product((number(2), sin(names.angle), names.axis))),
        law=(
            given.rotation,
            subtract(Product((number(2), names.axis, transpose(names.axis))), Symbol("I")),
        ),
    )


def _nothing(given: Given, names: _Names, facts: Facts) -> Derivation:
    """The identity: the angle is zero, and every axis is as good as another."""
    cosine = Quotient(add(*(Symbol(f"r_{i}{i}") for i in (1, 2, 3)), number(-1)), number(2))
    entries: dict[Expr, Expr] = {Symbol(f"r_{i}{i}"): number(1) for i in (1, 2, 3)}
    steps = (
        Step("cosine", (cos(names.angle), cosine, number(1))),
        Step("angle", (names.angle, number(0))),
    )
    claims = links(steps, {**entries, names.angle: number(0)})
    definitions: dict[Expr, Expr] = {**entries, names.angle: number(0)}
    results: dict[str, Result] = {"angle": number(0), "axis": "any"}
    return Derivation("axis-angle", steps, results, claims, definitions, uses=given.uses, facts=facts)


def _general(R: Rotation, names: _Names, problem: Problem) -> tuple[Step, ...]:
    """w = 2 sin(angle) k, the trace is 1 + 2 cos(angle)."""
    w = column(subtract(Symbol(plus), Symbol(minus)) for plus, minus in DIFFERENCES)
    size = sqrt(add(*(squared(names.component(axis)) for axis in "xyz")))
    cosine_of = add(*(Symbol(f"r_{i}{i}") for i in (1, 2, 3)), number(-1))
    angle: tuple[Expr, ...] = (names.angle, atan2(size, cosine_of))
    axis: tuple[Expr, ...] = (names.axis, Quotient(names.turn, size))
    value = _value(R, problem) if R.short else None
    if value is None or not R.shows(value.angle):
        return Step("w", (names.turn, w)), Step("angle", angle), Step("axis", axis)
    exact = known_angle(value.angle, problem) if R.numeric else value.angle
    angle = (*angle, value.angle, exact) if exact != value.angle else (*angle, value.angle)
    return (
        Step("w", (names.turn, w, problem.readable_matrix(value.turn))),
        Step("angle", angle),
        Step("axis", (*axis, value.axis)),
    )


class _Value(NamedTuple):
    """w in normal form, the angle and the axis as trees, in the symbols of R."""

    turn: ScalarMatrix
    angle: Expr
    axis: Matrix


def _value(R: Rotation, problem: Problem) -> _Value:
    turn = ScalarMatrix.column([R.value(plus) - R.value(minus) for plus, minus in DIFFERENCES])
    square = sum((part * part for part in turn.entries), Scalar.of(0))
    cosine = sum((R.matrix[i, i] for i in range(3)), Scalar.of(-1))
    angle = atan2(length_of(square, problem), problem.readable(cosine))
    return _Value(turn, angle, column(over(part, square, problem) for part in turn.entries))


def _long(R: Rotation, problem: Problem) -> tuple[Expr, Matrix]:
    """The angle and the axis of a rotation with long entries: w component by component, its length left
    as a root of squares."""
    w = [problem.readable(R.value(plus) - R.value(minus)) for plus, minus in DIFFERENCES]
    size = sqrt(add(*map(squared, w)))
    cosine = sum((R.matrix[i, i] for i in range(3)), Scalar.of(-1))
    return atan2(size, problem.readable(cosine)), column(Quotient(part, size) for part in w)


def _half_turn(R: Rotation, names: _Names, problem: Problem) -> tuple[Step, ...]:
    """R = 2 k k^T - 1: each column of (R + 1)/2 is a multiple of k."""
    outer = (R.matrix + ScalarMatrix.identity(3)).scaled(Scalar.of(1) / 2)
    j = next(j for j in range(3) if outer[j, j] != 0)
    axis = column(over(outer[i, j], outer[j, j], problem) for i in range(3))
    angle = known_angle(atan2(number(0), number(-1)), problem)
    written = Product((names.axis, transpose(names.axis)))
    return (
        Step("outer", (written, problem.readable_matrix(outer)), "given"),
        Step("angle", (names.angle, angle)),
        Step("axis", (names.axis, axis)),
    )


def _links(steps: tuple[Step, ...], R: Rotation, names: _Names) -> tuple[Claim, ...]:
    """The vector w entry by entry; the axis; an angle is checked by its second route."""
    pairs = zip("xyz", DIFFERENCES, strict=True)
    known: dict[Expr, Expr] = {
        names.component(axis): subtract(R.entries[Symbol(plus)], R.entries[Symbol(minus)])
        for axis, (plus, minus) in pairs
    }
    known |= {**R.entries, names.axis: steps[-1].result}
    known[names.turn] = column(known[names.component(axis)] for axis in "xyz")
    return links((step for step in steps if step.name in ("w", "axis") and len(step.chain) > 2), known)


def _column(step: Step) -> Matrix:
    """The vector a step ends in."""
    if not isinstance(step.result, Matrix):
        raise TypeError(f"{step.name} is no vector")
    return step.result


def _laws(R: Rotation, axis: Matrix) -> tuple[Claim, ...]:
    if not R.numeric:
        return ()
    k = ScalarMatrix.column([normal(entry) for (entry,) in axis.rows])
    return (
        law("unit-axis", (k.T @ k)[0, 0] == 1),
        law("axis-stays", R.matrix @ k == k),
    )


def _second_route(given: Given, problem: Problem, results: Mapping[str, Any]) -> Claim:
    """The turn made in numbers."""
    from derive.mechanics.oracle import elementary

    (x,), (y,), (z,) = results["axis"].rows
    turn = Move("rotate", (x, y, z), results["angle"])
    return agreement(
        "orientation-again",
        problem.symbols,
        lambda point: elementary(turn, point)[:3, :3],
        lambda point: given.oracle(point)[:3, :3],
        tolerance=1e-8,
    )
