"""The terms of the equation of each joint: in names, and written out."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from typing import Literal

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.rationals import as_fraction
from derive.algebra.readable.form import common_factor, readable
from derive.algebra.readable.terms import Style, terminates
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, Step
from derive.expression import ZERO, Expr, Number, Product, Symbol, add, multiply, number, terms_of
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.drives import friction_terms
from derive.names import entry_symbol

MOST_PARTS = 4  # of one that a coefficient may have by itself
Sort = Literal["acceleration", "velocity", "gravity", "friction"]


@dataclass(frozen=True, slots=True)
class Term:
    """One term of tau_k, as `d_12 theta2_ddot` and with the value of d_12: a coefficient times numbers, rates
    and accelerations."""

    named: Expr
    value: Expr
    factors: tuple[Expr, ...]
    sort: Sort

    @property
    def written(self) -> Expr:
        """The coefficient with its factors."""
        return _product(self.value, self.factors)


def equations(problem: Problem) -> tuple[tuple[Term, ...], ...]:
    """For each joint the terms that do not vanish, accelerations first (Spong et al., eq. 6.39)."""
    arm, friction = Arm(problem), friction_terms(problem.subject)
    speed, weight = problem.ask("christoffel"), problem.ask("gravity")
    return tuple(
        (
            *_accelerations(arm, k),
            *_velocities(speed, arm, k),
            *_gravity(weight, k),
            *(Term(term, problem.final(term), (), "friction") for term in friction[k - 1]),
        )
        for k in range(1, len(arm.variables) + 1)
    )


def equation(name: str, terms: Iterable[Term], rule: str, style: Style) -> Step:
    """`name` in the names of its terms, and written out where the page has room for that."""
    terms = tuple(terms)
    named, written = add(*(term.named for term in terms)), written_out(terms, style)
    spare = () if written == named else (written,)
    return Step(name, (Symbol(name), named, *spare), rule, spare=spare)


def written_out(terms: Iterable[Term], style: Style) -> Expr:
    """The sum of the terms; small parts of one in the coefficients of what moves stand in front."""
    terms = tuple(terms)
    moving = [term for term in terms if term.factors]
    still = [term for term in terms if not term.factors]
    return add(*_over_common(moving, style), *(part for term in still for part in terms_of(term.written)))


def _parts(factor: Scalar) -> int:
    """Of how many parts of one a monomial is a multiple."""
    return as_fraction(next(iter(factor.numerator.coeffs()))).denominator


def _that_share(terms: list[Term]) -> ScalarMatrix | None:
    """The values of the terms; None as soon as two have no factor in common, for then all have none."""
    values: list[Scalar] = []
    before: Scalar | None = None
    for term in terms:
        values.append(value := normal(term.value))
        if value and before is not None and common_factor(ScalarMatrix.of([[before], [value]])) is None:
            return None
        before = value if value else before
    return ScalarMatrix.of([[value] for value in values])


def _over_common(terms: list[Term], style: Style) -> list[Expr]:
    """m L^2/1200 ((2002 + 1200 c_2) theta1_ddot + ...), where there are so many parts of one."""
    values = _that_share(terms)
    factor = None if values is None else common_factor(values)
    if values is None or factor is None or _parts(factor) <= MOST_PARTS:
        return [term.written for term in terms]
    rest = [readable(value / factor, style) for value in values.entries]
    inner = [_product(value, term.factors) for value, term in zip(rest, terms, strict=True)]
    return [Product((readable(factor, style), add(*inner)))]


def _accelerations(arm: Arm, k: int) -> list[Term]:
    row = arm.inertia.matrix("D").rows[k - 1]
    named = ((entry_symbol("d", min(j, k), max(j, k)), entry) for j, entry in enumerate(row, 1))
    return [
        Term(_product(name, (rise,)), entry, (rise,), "acceleration")
        for (name, entry), rise in zip(named, arm.accelerations, strict=True)
        if entry != ZERO
    ]


def _velocities(speed: Derivation, arm: Arm, k: int) -> list[Term]:
    """c_iik qdot_i^2, and 2 c_ijk qdot_i qdot_j for two equal symbols."""
    found = []
    for i, p in enumerate(arm.rates, 1):
        for j, q in enumerate(arm.rates[i - 1 :], i):
            name = entry_symbol("c", i, j, k)
            factors = (p**2,) if i == j else (number(2), p, q)
            value = speed.scalar(name.name)
            if value != ZERO:
                found.append(Term(_product(name, factors), value, factors, "velocity"))
    return found


def _gravity(weight: Derivation, k: int) -> list[Term]:
    value = weight.matrix("g").rows[k - 1][0]
    return [Term(Symbol(f"g_{k}"), value, (), "gravity")] if value != ZERO else []


def _product(value: Expr, factors: tuple[Expr, ...]) -> Expr:
    """Numbers gathered in front: 2 * (-1/2 m L) * x is -m L x; decimals stay decimals."""
    parts = [
        part
        for expr in (value, *factors)
        for part in (expr.factors if isinstance(expr, Product) else (expr,))
    ]
    numbers = [part for part in parts if isinstance(part, Number)]
    rest = [part for part in parts if not isinstance(part, Number)]
    size = prod((part.value for part in numbers), start=Fraction(1))
    decimal = any(part.decimal for part in numbers) and terminates(size)
    return multiply(Number(size, decimal), *rest)
