"""The partial derivatives of a scalar function."""

from __future__ import annotations

from derive.algebra.function import Function
from derive.derivation import Derivation, PageFacts, Step
from derive.errors import NotDerivable
from derive.expression import Derivative, Expr, Matrix, Symbol, column
from derive.kinds.fields import NoOptions as Options
from derive.kinds.function._naming import function_name
from derive.kinds.function._partials import differences, partial_step
from derive.kinds.problem import Problem
from derive.kinds.work import Work

CLAIMS = ("differences",)


class Facts(PageFacts):
    nabla: Expr


def derive(function: Function, options: Options, problem: Problem) -> Derivation:
    """[df/dx_1 ... df/dx_n]. Raises NotDerivable for a vector function."""
    if function.vector:
        raise NotDerivable(
            "the gradient is that of a scalar function; of a list ask for the jacobian", "value"
        )
    name, value = function_name(problem), function.values[0]
    work = Work(problem).given(name, value)
    partials = tuple(partial_step(problem, name, value, each) for each in function.variables)
    row = Matrix((tuple(Derivative(name, Symbol(each)) for each in function.variables),))
    found = [step.result for step in partials]
    work = work.showing(*partials, Step("gradient", (row, column(found).T), "gradient"))
    work = differences(work, found, [(value, each) for each in function.variables])
    nabla = Symbol("nabla") * name
    facts = Facts(nabla=nabla, page_names={"gradient": nabla}, lying=("gradient",))
    return work.answer("gradient", {"gradient": problem.final(column(found))}, facts)
