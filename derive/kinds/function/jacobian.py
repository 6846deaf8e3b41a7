"""The partial derivatives of a vector function, a row for each component."""

from __future__ import annotations

from derive.algebra.function import Function
from derive.algebra.matrix import ScalarMatrix
from derive.derivation import Derivation, Result, Step
from derive.errors import NotDerivable
from derive.expression import Call, Derivative, Matrix, Symbol
from derive.kinds.fields import OptionsModel
from derive.kinds.function._naming import component_names
from derive.kinds.function._partials import differences, partial
from derive.kinds.problem import Problem
from derive.kinds.work import Work

J = Symbol("J")
MOST_SQUARE = 5  # rows of a determinant worked out
CLAIMS = ("differences",)


class Options(OptionsModel):
    """What is wanted beside the Jacobian."""

    determinant: bool = False
    """Whether the determinant of a square Jacobian is wanted too."""


def derive(function: Function, options: Options, problem: Problem) -> Derivation:
    """J_ij = dy_i/dx_j. Raises NotDerivable for the determinant of a Jacobian that is not square."""
    names, variables = component_names(function, problem), function.variables
    work = Work(problem)
    for f, value in zip(names, function.values, strict=True):
        work = work.given(f, value, "component")
    derivatives = Matrix(tuple(tuple(Derivative(f, Symbol(x)) for x in variables) for f in names))
    exact = ScalarMatrix.of([partial(f, x) for x in variables] for f in function.values)
    work = work.line(J, derivatives, value=exact, rule="jacobian")
    results: dict[str, Result] = {"J": work.final(J)}
    if options.determinant:
        _require_square(exact)
        det = Step("det", (Call("det", (J,)), problem.readable(exact.det())), "determinant")
        work, results["det"] = work.showing(det), problem.final(det.result)
    work = differences(work, work.entries(J), [(f, x) for f in function.values for x in variables])
    return work.answer("jacobian", results)


def _require_square(J: ScalarMatrix) -> None:
    rows, columns = J.shape
    if rows != columns:
        raise NotDerivable(
            f"this Jacobian is {rows} by {columns}: only a square one has a determinant", "determinant"
        )
    if rows > MOST_SQUARE:
        raise NotDerivable(f"a determinant of {rows} rows is not worked out here", "determinant")
