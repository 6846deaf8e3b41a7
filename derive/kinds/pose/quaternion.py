"""A rotation as a unit quaternion, scalar part first."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, PageFacts, Step
from derive.expression import (
    ONE,
    Expr,
    Matrix,
    Product,
    Quotient,
    Symbol,
    add,
    column,
    multiply,
    number,
    sqrt,
    subtract,
)
from derive.kinds.checks import agreement
from derive.kinds.pose._given import Given, PoseOptions, given_pose
from derive.kinds.pose._roots import over, size
from derive.kinds.pose._rotation import Rotation, rotation_of
from derive.kinds.problem import Problem
from derive.names import free

SUBJECTS = ("motion", "frames", "robot")
RESULTS = {"q": "the unit quaternion (q_0, q_x, q_y, q_z), its scalar part not negative"}
EXAMPLE = """\
title: A rotation as a quaternion
problems:
- motion:
  - {rotate: x, by: 90 deg}
  - {rotate: z, by: 90 deg}
  find: quaternion
"""
DIFFERENCES = (("r_32", "r_23"), ("r_13", "r_31"), ("r_21", "r_12"))


class Options(PoseOptions):
    """A subject of frames takes `from` and `to`."""


class Facts(PageFacts):
    rotation: Symbol
    half: bool
    scalar: Symbol


def derive(subject: Any, options: Options, problem: Problem) -> Derivation:
    """q_0 from the trace, the rest from what R lacks of symmetry (Siciliano et al., eqs. 2.34 and 2.35);
    from the diagonal for half a turn."""
    given = given_pose(options, problem)
    R = rotation_of(given, problem)
    square = sum((R.matrix[i, i] for i in range(3)), Scalar.of(1)) / 4
    half = square == 0
    name = Symbol(free(problem.taken, "q", "h", "q_r"))
    scalar = Symbol(f"{name.name}_0")
    steps = _half_turn(R, name, scalar, problem) if half else _general(R, square, name, scalar, problem)
    q = steps[-1].result if half else _value(R, square, problem)
    claim = _second_route(given, problem, {"q": q})
    facts = Facts(rotation=given.rotation, half=half, scalar=scalar)
    definitions: dict[Expr, Expr] = {**R.entries, name: q}
    return Derivation("quaternion", steps, {"q": q}, (claim,), definitions, uses=given.uses, facts=facts)


def _general(R: Rotation, square: Scalar, name: Symbol, scalar: Symbol, problem: Problem) -> tuple[Step, ...]:
    trace = add(ONE, *(Symbol(f"r_{i}{i}") for i in (1, 2, 3)))
    root_of: tuple[Expr, ...] = (scalar, multiply(number("1/2"), sqrt(trace)))
    differences = [subtract(Symbol(plus), Symbol(minus)) for plus, minus in DIFFERENCES]
    quotients = [Quotient(each, Product((number(4), scalar))) for each in differences]
    formula = column((scalar, *quotients))
    value = _value(R, square, problem)
    if not all(R.shows(entry) for (entry,) in value.rows):
        return Step("q_0", root_of), Step("q", (name, formula))
    return Step("q_0", (*root_of, value.rows[0][0])), Step("q", (name, formula, value))


def _value(R: Rotation, square: Scalar, problem: Problem) -> Matrix:
    """The quaternion in the symbols of R, `square` that of its scalar part."""
    parts = [(R.value(plus) - R.value(minus)) / 4 for plus, minus in DIFFERENCES]
    return column((size(square, problem), *(over(part, square, problem) for part in parts)))


def _half_turn(R: Rotation, name: Symbol, scalar: Symbol, problem: Problem) -> tuple[Step, ...]:
    """q_0 = 0; (R + 1)/2 is the product of the rest with its transpose."""
    outer = (R.matrix + ScalarMatrix.identity(3)).scaled(Scalar.of(1) / 2)
    j = next(j for j in range(3) if outer[j, j] != 0)
    rest = [over(outer[i, j], outer[j, j], problem) for i in range(3)]
    return Step("q_0", (scalar, number(0))), Step("q", (name, column((number(0), *rest))))


def _second_route(given: Given, problem: Problem, results: Mapping[str, Any]) -> Claim:
    """The quaternion turns the axes as the pose does: v -> q v q*."""
    entries = results["q"].rows if isinstance(results["q"], Matrix) else ()

    def turned(point: Mapping[str, float]) -> Any:
        import numpy as np

        from derive.algebra.numbers.floats import number as value

        w, *v = (value(entry, point) for (entry,) in entries)
        vector = np.array(v)
        return np.array([e + 2 * np.cross(vector, np.cross(vector, e) + w * e) for e in np.eye(3)]).T

    return agreement(
        "turns-the-axes",
        problem.symbols,
        turned,
        lambda point: given.oracle(point)[:3, :3],
        tolerance=1e-8,
    )
