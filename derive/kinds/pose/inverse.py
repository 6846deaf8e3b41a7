"""The inverse of a pose: the old frame as seen from the new one."""

from __future__ import annotations

import re
from functools import partial
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import Point
from derive.derivation import Derivation, PageFacts
from derive.expression import ONE, ZERO, Call, Matrix, Symbol, multiply, symbols, transpose
from derive.kinds.meanings import Names, as_told
from derive.kinds.pose._given import Given, given_pose
from derive.kinds.pose._given import PoseOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.poses import inverse_pose, position_part, rotation_part

R, O, NO_ROW = symbols("R o 0")  # the last are three zeros side by side
POSE = re.compile(r"T_(\d+)\^(\d+)")
SUBJECTS = ("motion", "frames", "robot")
CLAIMS = ("inverse", "in-numbers", "as-told")
CLAIMED = {"T": "inverse"}


class Facts(PageFacts):
    pose: Symbol
    back: Symbol | None  # the pose of the one frame in the other, where both have numbers


def derive(subject: Any, options: Options, problem: Problem) -> Derivation:
    """T^-1 (4 by 4): R^T and -R^T o (Spong et al., eq. 2.67; Siciliano et al., eq. 2.45)."""
    given = given_pose(options, problem, rotation_only=False)
    known = {given.name: given.T, R: rotation_part(given.T), O: position_part(given.T)}
    work = Work(problem, uses=given.uses).knowing({NO_ROW: Matrix(((ZERO, ZERO, ZERO),))})
    work = work.knowing({name: problem.readable_matrix(value) for name, value in known.items()})
    turned, inverse = transpose(R), Call("inverse", (given.name,))
    blocks = Matrix(((turned, -multiply(turned, O)), (NO_ROW, ONE)))
    back_name = _back(given.name)
    name = inverse if back_name is None else back_name  # of which the product then shows what it is
    value = inverse_pose(given.T)
    work = work.line(name, blocks, value=value, rule="inverse", label="T").closed(name)
    exact = work.steps[-1].result
    if back_name is not None:
        one = problem.readable_matrix(ScalarMatrix.identity(4))
        work = work.line(given.name * back_name, value=one, label="product")
    back = normal_matrix(exact, problem.names)
    work = work.law("inverse", problem.exact(given.T) @ back == ScalarMatrix.identity(4))
    work = work.agrees("in-numbers", problem.symbols, exact, lambda at: _inverted(given.oracle(at)))
    facts = Facts(pose=given.name, back=back_name)
    work = as_told(work, partial(_meant, given, back_name), ((given.name, facts.pose),))
    return work.answer("inverse", {"T": exact}, facts)


def _back(pose: Symbol) -> Symbol | None:
    """T_0^1 for T_1^0."""
    found = POSE.fullmatch(pose.name)
    return Symbol(f"T_{found[2]}^{found[1]}") if found else None


def _meant(given: Given, back: Symbol | None, at: Point) -> Names:
    import numpy as np

    T = given.oracle(at)
    names: Names = {given.name: T, R: T[:3, :3], O: T[:3, 3:], NO_ROW: np.zeros((1, 3))}
    return names if back is None else {**names, back: _inverted(T)}


def _inverted(T: Any) -> Any:
    import numpy as np

    return np.linalg.inv(T)
