"""The extreme values of a function under constraints, by Lagrange multipliers: every stationary point."""

from __future__ import annotations

from derive.algebra.function import Function
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.kinds.fields import NoOptions as Options
from derive.kinds.function._worked import Facts as Facts
from derive.kinds.function._worked import worked
from derive.kinds.problem import Problem

USES = frozenset({"subject_to"})
CLAIMS = ("as-told", "satisfies|on-the-constraints|newtons-method")
CLAIMED = {"solutions": "as-told"}


def derive(function: Function, options: Options, problem: Problem) -> Derivation:
    """The gradient of f - lambda (g - c) vanishes; the bordered Hessian tells maxima from minima
    (Magnus and Neudecker, Matrix Differential Calculus, chapter 7).

    Raises NotDerivable without a constraint, and where the equations have no exact or isolated roots.
    """
    if not function.constraints:
        raise NotDerivable("there is no constraint: give one under subject_to, or ask for stationary-points")
    if len(function.constraints) > len(function.variables):
        raise NotDerivable("there are more constraints than variables", "subject_to")
    return worked("lagrange-multipliers", function, problem)
