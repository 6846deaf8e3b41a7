"""The terms of the equation of each joint: in names, and written out."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import Literal

from derive.derivation import Derivation
from derive.expression import ZERO, Expr, Number, Product, Symbol, multiply, number, squared
from derive.kinds.naming import entry_symbol
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import matrix_of, scalar_of
from derive.kinds.robot._dynamics.drives import friction_terms

Sort = Literal["acceleration", "velocity", "gravity", "friction"]


@dataclass(frozen=True, slots=True)
class Term:
    """One term of tau_k, as `d_12 theta2_ddot` and with the value of d_12."""

    named: Expr
    written: Expr
    sort: Sort


def terms_of(
    problem: Problem, inertia: Derivation, speed: Derivation, weight: Derivation
) -> tuple[tuple[Term, ...], ...]:
    """For each joint the terms that do not vanish, accelerations first."""
    names = problem.subject.variables
    friction = friction_terms(problem.subject)
    return tuple(
        (
            *_accelerations(inertia, names, k),
            *_velocities(speed, names, k),
            *_gravity(weight, k),
            *(Term(term, problem.final(term), "friction") for term in friction[k - 1]),
        )
        for k in range(1, len(names) + 1)
    )


def _accelerations(inertia: Derivation, names: tuple[str, ...], k: int) -> list[Term]:
    row = matrix_of(inertia, "D").rows[k - 1]
    return [
        Term(
            _product(entry_symbol("d", min(j, k), max(j, k)), rise),
            _product(row[j - 1], rise),
            "acceleration",
        )
        for j, rise in enumerate(((Symbol(f"{name}_ddot"),) for name in names), 1)
        if row[j - 1] != ZERO
    ]


def _velocities(speed: Derivation, names: tuple[str, ...], k: int) -> list[Term]:
    """c_iik qdot_i^2, and 2 c_ijk qdot_i qdot_j for two equal symbols."""
    rate, found = [Symbol(f"{name}_dot") for name in names], []
    for i in range(len(rate)):
        for j in range(i, len(rate)):
            name = entry_symbol("c", i + 1, j + 1, k).name
            factors = (squared(rate[i]),) if i == j else (number(2), rate[i], rate[j])
            value = scalar_of(speed, name)
            if value != ZERO:
                found.append(Term(_product(Symbol(name), factors), _product(value, factors), "velocity"))
    return found


def _gravity(weight: Derivation, k: int) -> list[Term]:
    value = matrix_of(weight, "g").rows[k - 1][0]
    return [Term(Symbol(f"g_{k}"), value, "gravity")] if value != ZERO else []


def _product(value: Expr, factors: tuple[Expr, ...]) -> Expr:
    """Numbers gathered in front: 2 * (-1/2 m L) * x is -m L x."""
    parts = [
        part
        for expr in (value, *factors)
        for part in (expr.factors if isinstance(expr, Product) else (expr,))
    ]
    numbers = [part.value for part in parts if isinstance(part, Number)]
    rest = [part for part in parts if not isinstance(part, Number)]
    return multiply(Number(prod(numbers, start=Fraction(1))), *rest)
