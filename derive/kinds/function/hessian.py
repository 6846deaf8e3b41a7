"""The second partial derivatives of a scalar function."""

from __future__ import annotations

from derive.algebra.function import Function
from derive.algebra.matrix import ScalarMatrix
from derive.derivation import Derivation
from derive.expression import Derivative, Matrix, Symbol
from derive.kinds.fields import NoOptions as Options
from derive.kinds.function._naming import function_name
from derive.kinds.function._partials import differences, partial
from derive.kinds.problem import Problem
from derive.kinds.work import Work

H = Symbol("H")
CLAIMS = ("symmetric", "differences")


def derive(function: Function, options: Options, problem: Problem) -> Derivation:
    """H_ij = d^2 f / dx_i dx_j, the Jacobian of the gradient. Raises NotDerivable for a vector function."""
    gradient = problem.ask("gradient")
    name, variables = function_name(problem), function.variables
    first = [step for step in gradient.steps if step.rule == "partial"]
    exact = [[partial(step.result, x) for x in variables] for step in first]
    derivatives = Matrix(
        tuple(tuple(Derivative(Derivative(name, Symbol(y)), Symbol(x)) for x in variables) for y in variables)
    )
    work = Work(problem).resting_on(gradient)
    work = work.line(H, derivatives, value=ScalarMatrix.of(exact), rule="hessian")
    work = work.law(
        "symmetric", (exact[i][j] == exact[j][i] for i in range(len(first)) for j in range(i + 1))
    )
    work = differences(work, work.entries(H), [(step.result, x) for step in first for x in variables])
    return work.answer("hessian", {"H": work.final(H)})
