"""The second partial derivatives of a scalar function."""

from __future__ import annotations

from derive.algebra.function import Function
from derive.derivation import Derivation, Step
from derive.expression import Derivative, Expr, Matrix, Symbol
from derive.kinds.checks import law, links
from derive.kinds.fields import OptionsModel
from derive.kinds.function._naming import function_name
from derive.kinds.function._partials import agrees, partial
from derive.kinds.problem import Problem

RESULTS = {"H": "n by n, symmetric"}
EXAMPLE = """\
title: A Hessian
problems:
- function: {variables: [x, y], value: x^3*y - y^2}
  find: hessian
"""


class Options(OptionsModel):
    """None."""


def derive(function: Function, options: Options, problem: Problem) -> Derivation:
    """H_ij = d^2 f / dx_i dx_j, the Jacobian of the gradient. Raises NotDerivable for a vector function."""
    gradient = problem.ask("gradient")
    name, variables = function_name(problem), function.variables
    first = [step for step in gradient.steps if step.rule == "partial"]
    exact = [[partial(step.result, x) for x in variables] for step in first]
    H = Matrix(tuple(tuple(map(problem.readable, row)) for row in exact))
    derivatives = Matrix(
        tuple(tuple(Derivative(Derivative(name, Symbol(y)), Symbol(x)) for x in variables) for y in variables)
    )
    steps = (Step("H", (Symbol("H"), derivatives, H), "hessian"),)
    symmetric = all(exact[i][j] == exact[j][i] for i in range(len(first)) for j in range(i))
    pairs = [(step.result, x) for step in first for x in variables]
    definitions: dict[Expr, Expr] = {**gradient.definitions, Symbol("H"): H}
    claims = (
        *links(steps, {**problem.names, **definitions}),
        law("symmetric", symmetric),
        agrees("differences", problem, [e for r in H.rows for e in r], pairs),
    )
    return Derivation("hessian", steps, {"H": problem.final(H)}, claims, definitions, uses=(gradient,))
