"""The partial derivatives of a vector function, a row for each component."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.function import Function
from derive.derivation import Derivation, Result, Step
from derive.errors import NotDerivable
from derive.expression import Call, Derivative, Expr, Matrix, Symbol
from derive.kinds.checks import links
from derive.kinds.fields import OptionsModel
from derive.kinds.function._naming import component_names
from derive.kinds.function._partials import agrees, partial
from derive.kinds.problem import Problem

RESULTS = {"J": "a row for each component, a column for each variable", "det": "of a square Jacobian"}
EXAMPLE = """\
title: The Jacobian of polar coordinates
problems:
- function: {variables: [r, phi], value: [r*cos(phi), r*sin(phi)]}
  find: jacobian
  determinant: true
"""
MOST_SQUARE = 5  # rows of a determinant worked out


class Options(OptionsModel):
    """`determinant: true` adds the determinant of a square Jacobian."""

    determinant: bool = False


def derive(function: Function, options: Options, problem: Problem) -> Derivation:
    """J_ij = dy_i/dx_j. Raises NotDerivable for the determinant of a Jacobian that is not square."""
    names, variables = component_names(function, problem), function.variables
    definitions: dict[Expr, Expr] = dict(zip(names, function.values, strict=True))
    derivatives = Matrix(tuple(tuple(Derivative(f, Symbol(x)) for x in variables) for f in names))
    J = Matrix(tuple(tuple(problem.readable(partial(f, x)) for x in variables) for f in function.values))
    name = Symbol("J")
    steps = (
        *(Step(f.name, (f, value), "component") for f, value in definitions.items() if isinstance(f, Symbol)),
        Step("J", (name, derivatives, J), "jacobian"),
        *_determinant(options, problem, J),
    )
    definitions[name] = J
    results: dict[str, Result] = {"J": problem.final(J)}
    if options.determinant:
        results["det"] = problem.final(steps[-1].result)
    pairs = [(f, x) for f in function.values for x in variables]
    entries = [entry for row in J.rows for entry in row]
    claims = (
        *links(steps, {**problem.names, **definitions}),
        agrees("differences", problem, entries, pairs),
    )
    return Derivation("jacobian", steps, results, claims, definitions)


def _determinant(options: Options, problem: Problem, J: Matrix) -> Iterator[Step]:
    if not options.determinant:
        return
    rows, columns = J.shape
    if rows != columns or rows > MOST_SQUARE:
        raise NotDerivable(
            f"this Jacobian is {rows} by {columns}: only a square one has a determinant"
            if rows != columns
            else f"a determinant of {rows} rows is not worked out here"
        )
    from derive.algebra.normal import normal

    det = Call("det", (Symbol("J"),))
    yield Step("det", (det, problem.readable(normal(Call("det", (J,))))), "determinant")
