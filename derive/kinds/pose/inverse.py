"""The inverse of a pose: the old frame as seen from the new one."""

from __future__ import annotations

from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import numbers
from derive.derivation import Derivation, PageFacts, Step
from derive.expression import ONE, ZERO, Call, Expr, Matrix, Symbol, column, multiply, negate, transpose
from derive.kinds.checks import agreement, law, links
from derive.kinds.pose._given import PoseOptions, given_pose
from derive.kinds.problem import Problem
from derive.kinds.values_at import completed
from derive.mechanics.poses import inverse_pose, position_part

NO_ROW = Symbol("0")  # three zeros side by side
SUBJECTS = ("motion", "frames", "robot")
RESULTS = {"T": "the inverse transform (4 by 4)"}
EXAMPLE = """\
title: The way back
problems:
- motion:
  - {rotate: z, by: theta}
  - {translate: x, by: a}
  find: inverse
"""


class Options(PoseOptions):
    """A subject of frames takes `from` and `to`."""


class Facts(PageFacts):
    pose: Symbol


def derive(subject: Any, options: Options, problem: Problem) -> Derivation:
    """R^T and -R^T p (Spong et al., eq. 2.67; Siciliano et al., eq. 2.45)."""
    given = given_pose(options, problem, rotation_only=False)
    R, p = Symbol("R"), Symbol("p")
    inverse = Call("inverse", (given.name,))
    turned = transpose(R)
    blocks = Matrix(((turned, negate(multiply(turned, p))), (NO_ROW, ONE)))
    written = problem.readable_matrix(inverse_pose(given.T))
    exact = problem.final(written)
    last = () if exact == written else (exact,)
    definitions: dict[Expr, Expr] = {
        given.name: problem.readable_matrix(given.T),
        R: problem.readable_matrix(given.R),
        NO_ROW: Matrix(((ZERO, ZERO, ZERO),)),
        p: column(map(problem.readable, position_part(given.T).entries)),
    }
    step = Step("T", (inverse, blocks, written, *last), "inverse")
    T = normal_matrix(definitions[given.name], problem.names)
    back = normal_matrix(exact, problem.names)
    claims = (
        *links((step,), {**problem.names, **definitions}),
        law("inverse", T @ back == ScalarMatrix.identity(4)),
        agreement(
            "in-numbers",
            problem.symbols,
            lambda point: numbers(exact, completed(point, problem.where)),
            lambda point: _inverted(given.oracle(point)),
        ),
    )
    facts = Facts(pose=given.name)
    return Derivation("inverse", (step,), {"T": exact}, claims, definitions, uses=given.uses, facts=facts)


def _inverted(T: Any) -> Any:
    import numpy as np

    return np.linalg.inv(T)
