"""Everything that follows from a mechanical system before its equations are written down."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.expression import Expr, Symbol, free_symbols
from derive.kinds.lagrange._letters import Letters
from derive.kinds.problem import Problem
from derive.mechanics.lagrangian import (
    TIME,
    Condition,
    LagrangianSystem,
    conditions,
    forces_of,
    inertial_side,
    kinetic_energies,
    mass_matrix,
    potential_energies,
    without,
)


@dataclass(frozen=True)
class Model:
    """A system in normal form; names of `where` are kept unless they move."""

    system: LagrangianSystem
    problem: Problem

    @cached_property
    def letters(self) -> Letters:
        return Letters.of(self.system, self.problem)

    @cached_property
    def moving(self) -> dict[Expr, Expr]:
        """Names of `where` that depend on coordinates, rates or the time."""
        where = self.problem.where
        found = {*self.system.coordinates, *self.system.rates, TIME}
        while more := {name for name, v in where.items() if name not in found and free_symbols(v) & found}:
            found |= more
        return {Symbol(name): value for name, value in where.items() if name in found}

    def scalar(self, expr: Expr) -> Scalar:
        """The normal form of a tree."""
        return normal(expr, self.moving)

    @cached_property
    def kinetic(self) -> tuple[Scalar, ...]:
        """Of each body, then what was given besides."""
        return (*kinetic_energies(self.system, self.moving), self.scalar(self.system.kinetic))

    @cached_property
    def potential(self) -> tuple[Scalar, ...]:
        """Of each body, then what was given besides."""
        return (*potential_energies(self.system, self.moving), self.scalar(self.system.potential))

    @cached_property
    def lagrangian(self) -> Scalar:
        zero = Scalar.of(0)
        return sum(self.kinetic, zero) - sum(self.potential, zero)

    @cached_property
    def sides(self) -> tuple[Scalar, ...]:
        """d/dt dL/dqdot - dL/dq, for each coordinate."""
        return inertial_side(self.lagrangian, self.system)

    @cached_property
    def lefts(self) -> tuple[Scalar, ...]:
        """The same with what friction takes."""
        lost = self.scalar(self.system.dissipation)
        pairs = zip(self.sides, self.system.rates, strict=True)
        return tuple(side + lost.diff(along) for side, along in pairs)

    @cached_property
    def mass(self) -> ScalarMatrix:
        return mass_matrix(self.sides, self.system)

    @cached_property
    def rest(self) -> tuple[Scalar, ...]:
        """The left sides without their accelerations."""
        return tuple(without(left, self.system.accelerations) for left in self.lefts)

    @cached_property
    def forces(self) -> Mapping[str, Scalar]:
        return {name: self.scalar(value) for name, value in forces_of(self.system).items()}

    @cached_property
    def conditions(self) -> tuple[Condition, ...]:
        return conditions(self.system, self.moving)

    @cached_property
    def multipliers(self) -> tuple[Symbol, ...]:
        return self.letters.multipliers(len(self.conditions)) if self.conditions else ()

    def reaction(self, k: int) -> Scalar:
        """What the constraints add to the force along coordinate k: sum lambda_i a_ik."""
        total = Scalar.of(0)
        for name, condition in zip(self.multipliers, self.conditions, strict=True):
            total = total + Scalar.symbol(name.name) * condition.a[k]
        return total
