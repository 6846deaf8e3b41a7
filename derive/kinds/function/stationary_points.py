"""The points where the gradient of a function vanishes: maxima, minima and saddles."""

from __future__ import annotations

from derive.algebra.function import Function
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.kinds.fields import NoOptions as Options
from derive.kinds.function._worked import Facts as Facts
from derive.kinds.function._worked import worked
from derive.kinds.problem import Problem

USES = frozenset({"subject_to"})  # and refuses it, saying what to ask
CLAIMS = ("as-told", "satisfies|newtons-method")
CLAIMED = {"solutions": "as-told"}


def derive(function: Function, options: Options, problem: Problem) -> Derivation:
    """Where every partial derivative vanishes; the Hessian tells maxima from minima.

    Raises NotDerivable under constraints, and where the equations have no exact or isolated roots.
    """
    if function.constraints:
        raise NotDerivable("under a constraint ask for lagrange-multipliers")
    return worked("stationary-points", function, problem)
