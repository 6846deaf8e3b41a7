"""Rates and accelerations of an arm's joints, and the second route for what depends on them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import combinations
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Claim
from derive.expression import Expr, Matrix, Product, Symbol, column, squared
from derive.kinds.checks import agreement
from derive.kinds.problem import Problem
from derive.kinds.robot import inertia_matrix
from derive.kinds.robot._dynamics.drives import rigid
from derive.mechanics.dynamics import christoffel
from derive.mechanics.oracle import Oracle

Christoffel = Mapping[tuple[int, int, int], Scalar]
LONGEST_MATRIX = 200  # operations of D, all entries together


def rates(variables: Sequence[str]) -> list[Expr]:
    """theta1_dot, ..."""
    return [Symbol(f"{name}_dot") for name in variables]


def rises(variables: Sequence[str]) -> list[Expr]:
    """theta1_ddot, ..."""
    return [Symbol(f"{name}_ddot") for name in variables]


def rate_column(variables: Sequence[str]) -> ScalarMatrix:
    """qdot (n by 1)."""
    return ScalarMatrix.column([Scalar.symbol(f"{name}_dot") for name in variables])


def squares(variables: Sequence[str]) -> Matrix:
    """[qdot^2]: the squares of the rates (n by 1)."""
    return column(map(squared, rates(variables)))


def pairs(variables: Sequence[str]) -> Matrix | None:
    """[qdot qdot]: the products of two rates, in the order 12, 13, ..., 23, ... (n(n-1)/2 by 1)."""
    found = [Product(pair) for pair in combinations(rates(variables), 2)]
    return column(found) if found else None


def velocity_terms(symbols: Christoffel, variables: Sequence[str]) -> ScalarMatrix:
    """v (n by 1): the sums c_ijk qdot_i qdot_j."""
    rate = rate_column(variables).entries
    totals = []
    for k in range(1, len(rate) + 1):
        total = Scalar.of(0)
        for (i, j, l), symbol in symbols.items():
            if l == k and symbol:
                total = total + symbol * rate[i - 1] * rate[j - 1]
        totals.append(total)
    return ScalarMatrix.column(totals)


def velocity_agreement(problem: Problem, name: str, ours: ScalarMatrix) -> Claim:
    """`ours` (n by 1) against the torques at those rates less the torques at rest, by Newton and Euler."""
    return agreement(
        "rates-alone",
        rated(problem),
        lambda at: numeric.matrix_numbers(ours, oracle(problem).at(at)),
        lambda at: of_rates(problem, at),
        name=name,
    )


def of_rates(problem: Problem, at: Mapping[str, float]) -> list[float]:
    """The torques of the rates alone, in numbers."""
    names, arm = problem.subject.variables, oracle(problem)
    even = {f"{name}_ddot": 0.0 for name in names}
    still = {f"{name}_dot": 0.0 for name in names}
    found: Any = arm.torques({**at, **even}) - arm.torques({**at, **even, **still})
    return [float(entry) for entry in found]


def oracle(problem: Problem) -> Oracle:
    """The arm in numbers, without friction."""
    return Oracle(rigid(problem.subject), problem.where)


def rated(problem: Problem) -> frozenset[str]:
    """Every name that a point needs: those of the arm, g, rates and accelerations."""
    names = problem.subject.variables
    return problem.symbols | {"g"} | {f"{name}_{dots}" for name in names for dots in ("dot", "ddot")}


def symbols_of(problem: Problem) -> Christoffel:
    """The Christoffel symbols of the arm, names of shapes' moments kept."""
    D = problem.ask("inertia-matrix").definitions[Symbol("D")]
    return christoffel(normal_matrix(D), problem.subject.variables)


def is_long(problem: Problem) -> bool:
    """Whether what follows from D would fill pages: it is then left in its names."""
    inertia = problem.ask("inertia-matrix")
    return (
        inertia.told(inertia_matrix.Facts).big
        or operations(inertia.definitions[Symbol("D")]) > LONGEST_MATRIX
    )
