"""The partial derivatives of a scalar function."""

from __future__ import annotations

from derive.algebra.function import Function
from derive.derivation import Claim, Derivation, PageFacts, Step
from derive.errors import NotDerivable
from derive.expression import Derivative, Expr, Matrix, Product, Symbol, column
from derive.kinds.checks import links
from derive.kinds.fields import OptionsModel
from derive.kinds.function._naming import function_name
from derive.kinds.function._partials import agrees, partial_step
from derive.kinds.problem import Problem

RESULTS = {"gradient": "the partial derivatives, in the order of the variables"}
EXAMPLE = """\
title: A gradient
problems:
- function: {variables: [x, y], value: x^2*y}
  find: gradient
"""


class Options(OptionsModel):
    """None."""


class Facts(PageFacts):
    nabla: Expr


def derive(function: Function, options: Options, problem: Problem) -> Derivation:
    """[df/dx_1 ... df/dx_n]. Raises NotDerivable for a vector function."""
    if function.vector:
        raise NotDerivable("the gradient is that of a scalar function; of a list ask for the jacobian")
    name, value = function_name(problem), function.values[0]
    partials = tuple(partial_step(problem, name, value, each) for each in function.variables)
    row = Matrix((tuple(Derivative(name, Symbol(each)) for each in function.variables),))
    steps = (
        Step(name.name, (name, value), "given"),
        *partials,
        Step("gradient", (row, Matrix((tuple(step.result for step in partials),))), "gradient"),
    )
    result = problem.final(column(step.result for step in partials))
    definitions: dict[Expr, Expr] = {name: value}
    claims = (*links(steps, {**problem.names, **definitions}), _second_route(function, problem, steps))
    nabla = Product((Symbol("nabla"), name))
    facts = Facts(nabla=nabla, page_names={"gradient": nabla})
    return Derivation("gradient", steps, {"gradient": result}, claims, definitions, facts=facts)


def _second_route(function: Function, problem: Problem, steps: tuple[Step, ...]) -> Claim:
    found = [step.result for step in steps if step.rule == "partial"]
    pairs = [(function.values[0], each) for each in function.variables]
    return agrees("differences", problem, found, pairs)
