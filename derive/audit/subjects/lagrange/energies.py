"""A system in SymPy: its energies, and d/dt dL/dqdot - dL/dq + dD/dqdot.

(Goldstein, Poole and Safko, Classical Mechanics, chapters 1 and 2.)
"""

from __future__ import annotations

from functools import cached_property

import sympy

from derive.audit.asked import Asked
from derive.audit.points import Point
from derive.expression import ZERO, Symbol
from derive.mechanics.lagrangian import LagrangianSystem

TIME = sympy.Symbol("t")


class Energies:
    """The energies of the system of a question."""

    def __init__(self, asked: Asked) -> None:
        self.asked, self.system = asked, asked.subject
        system: LagrangianSystem = asked.subject
        self.q = [sympy.Symbol(name) for name in system.coordinates]
        self.rates = [sympy.Symbol(f"{name}_dot") for name in system.coordinates]
        self.accelerations = [sympy.Symbol(f"{name}_ddot") for name in system.coordinates]

    def rate(self, expr: sympy.Expr) -> sympy.Expr:
        """d/dt along the motion."""
        pairs = zip((*self.q, *self.rates), (*self.rates, *self.accelerations), strict=True)
        return expr.diff(TIME) + sum(expr.diff(name) * along for name, along in pairs)

    @cached_property
    def kinetic(self) -> sympy.Expr:
        """m v.v/2 + I omega^2/2 of every body, and what is given as such."""
        total = self.asked.formula(self.system.kinetic)
        for body in self.system.bodies:
            v = [self.rate(self.asked.formula(part)) for part in body.position]
            total += self.asked.formula(body.mass) * sum(part**2 for part in v) / 2
            if body.inertia is not None and body.angle is not None:
                spin = self.rate(self.asked.formula(body.angle))
                total += self.asked.formula(body.inertia) * spin**2 / 2
        return total

    @cached_property
    def potential(self) -> sympy.Expr:
        """The work done against gravity, and what is given as such."""
        total = self.asked.formula(self.system.potential)
        for body in self.system.bodies:
            pairs = zip(self.system.gravity, body.position, strict=True)
            work = sum(self.asked.formula(g) * self.asked.formula(r) for g, r in pairs)
            total -= self.asked.formula(body.mass) * work
        return total

    @cached_property
    def lagrangian(self) -> sympy.Expr:
        return self.kinetic - self.potential

    @cached_property
    def lefts(self) -> list[sympy.Expr]:
        """What the generalised forces are equal to, but for constraints."""
        lost = self.asked.formula(self.system.dissipation)
        return [
            self.rate(self.lagrangian.diff(rate)) - self.lagrangian.diff(q) + lost.diff(rate)
            for q, rate in zip(self.q, self.rates, strict=True)
        ]

    @cached_property
    def forces(self) -> list[sympy.Expr]:
        """By coordinate."""
        given = dict(self.system.forces)
        return [self.asked.formula(given.get(q, ZERO)) for q in self.system.coordinates]

    @cached_property
    def mass(self) -> sympy.Matrix:
        """M (n by n)."""
        return sympy.hessian(self.kinetic, self.rates)

    @cached_property
    def constraints(self) -> list[sympy.Expr]:
        """What vanishes."""
        return [self.asked.formula(c.left) - self.asked.formula(c.right) for c in self.system.constraints]

    def directions(self, constraint: sympy.Expr) -> list[sympy.Expr]:
        """Along which a constraint acts: its derivatives by the rates where it holds them, else by the
        coordinates."""
        by = self.rates if constraint.free_symbols & set(self.rates) else self.q
        return [constraint.diff(name) for name in by]

    def on_accelerations(self, constraint: sympy.Expr) -> sympy.Expr:
        """Differentiated until accelerations are in it."""
        once = constraint if constraint.free_symbols & set(self.rates) else self.rate(constraint)
        return self.rate(once)

    def multipliers(self) -> list[sympy.Symbol]:
        """lambda, or lambda_1, lambda_2, ...; another letter where the sheet has that."""
        count = len(self.constraints)
        formulas = sympy.Matrix([*self.lefts, *self.forces, *self.constraints])
        taken = {each.name for each in formulas.free_symbols} | set(self.asked.where)
        for letter in ("lambda", "mu", "nu"):
            names = [letter] if count == 1 else [f"{letter}_{k}" for k in range(1, count + 1)]
            if not taken & {letter, *names}:
                break
        return [sympy.Symbol(name) for name in names]


def as_bodies_are(system: Energies, point: Point) -> Point:
    """The point with masses, moments of inertia, g and coefficients of friction positive."""
    given: LagrangianSystem = system.system
    sizes = (each for body in given.bodies for each in (body.mass, body.inertia))
    names = {each.name for each in sizes if isinstance(each, Symbol)} | {"g"}
    slowed = [force.diff(rate) for force in system.forces for rate in system.rates]
    slowed.append(system.asked.formula(given.dissipation))
    names |= {each.name for each in sympy.Matrix(slowed).free_symbols}
    assumptions = {**point.assumptions, **dict.fromkeys(names, "positive")}
    return Point(point.seed, point.exact, point.angles, assumptions, point.fixed)
