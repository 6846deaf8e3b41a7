"""Regressors that would fill pages: their parameters in symbols, their columns in numbers alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil
from typing import Any

from derive.algebra.numbers.floats import Point, numbers, scalar_number
from derive.algebra.numbers.many_points import Polynomials
from derive.derivation import Derivation, as_matrix
from derive.expression import Expr
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import Place
from derive.kinds.meanings import column_of
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.regressor import Base, Standard
from derive.kinds.values_at import Here, values_at

MOST_PRINTED = 10_000  # terms of all columns; pages show none of a regressor that has so many
PARAMETERS = {"Y": "parameters", "Y_b": "base_parameters"}
INDEPENDENT = 1e-8  # the smallest singular value, relative to the largest


def terms_of(parameters: Sequence[Standard]) -> int:
    """How many all columns have together."""
    return sum(len(entry.numerator) for part in parameters for entry in part.column.entries)


@dataclass(frozen=True)
class Columns:
    """Those of a regressor (n by p) in numbers."""

    parts: Sequence[Standard | Base]

    @cached_property
    def _polynomials(self) -> Polynomials:
        return Polynomials.of([entry for part in self.parts for entry in part.column.entries])

    def at(self, point: Point) -> Any:
        """An array, n by p."""
        import numpy as np

        values = self._polynomials.at(point)
        size = self.parts[0].column.shape[0]
        Y = np.array(values, dtype=float).reshape(-1, size).T
        for j, part in enumerate(self.parts):
            for i, entry in enumerate(part.column.entries):
                if entry.denominator is not None:
                    Y[i, j] = scalar_number(entry, point)
        return Y

    def torques(self, theta: Expr, point: Point) -> list[float]:
        """Y theta (n)."""
        product: list[float] = (self.at(point) @ numbers(theta, point)).tolist()
        return product

    def by_name(self, names: Sequence[Expr], point: Point) -> Mapping[Expr, Any]:
        """Each column by what it is called."""
        return {name: column_of(each) for name, each in zip(names, self.at(point).T, strict=True)}

    def independent(self, arm: Arm) -> Iterator[bool]:
        """Whether no column is a combination of the others: the rows of enough motions of one arm have full
        rank."""
        import numpy as np

        n = len(arm.variables)
        points = [*random_points(arm.moving, 2 * ceil(len(self.parts) / n) + n)]
        varying = {f"{name}{dots}" for name in arm.variables for dots in ("", "_dot", "_ddot")}
        lengths = {name: value for name, value in points[0].items() if name not in varying}
        rows = np.vstack([self.at(arm.rubbing.at({**at, **lengths})) for at in points])
        values = np.linalg.svd(rows / np.abs(rows).max(axis=0), compute_uv=False)
        yield bool(values[-1] > INDEPENDENT * values[0])


def in_numbers(
    answer: Derivation, problem: Problem, place: Place, columns: Mapping[str, Columns]
) -> Derivation:
    """The answer at a point, with the `columns` that it does not give in symbols; these where every name has
    a value there."""
    here = Here.of(dict(place), problem.where, problem.style)
    found = values_at(answer, here)
    claims = answer.claims
    arm = Arm(problem)
    if arm.moving - problem.where.keys() <= {*here.point}:
        for name, each in columns.items():
            theta = as_matrix(answer.results[PARAMETERS[name]], name)
            found[name] = each.at(here.point).tolist()
            held = close(each.torques(theta, here.point), arm.rubbing.torques(here.point))
            claims = (*claims, route("numbers-there", held, Y=name))
    return replace(answer, evaluated=found, claims=claims)
