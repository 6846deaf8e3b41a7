"""The equations of motion, term by term; what they were solved for is put back."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.points import Point
from derive.audit.putting_back import put_back, told
from derive.audit.subjects.lagrange.energies import Energies

ZERO = sympy.Integer(0)


def equations_of_motion(asked: Asked, point: Point) -> Iterator[Test]:
    """Energies, mass matrix, both sides; accelerations and multipliers in the equations and constraints."""
    system = Energies(asked)
    for name, energy in (("T", system.kinetic), ("P", system.potential), ("L", system.lagrangian)):
        yield Same(name, point.at(energy))
    yield Same("M", told(system.mass, point))
    yield Same("tau", point.each(system.lefts))
    reactions = [ZERO] * len(system.q)
    for multiplier, constraint in zip(system.multipliers(), system.constraints, strict=True):
        along = system.directions(constraint)
        reactions = [sum_ + multiplier * a for sum_, a in zip(reactions, along, strict=True)]
    sides = zip(system.lefts, system.forces, reactions, strict=True)
    equations = [left - force - reaction for left, force, reaction in sides]
    yield Same("equations", point.each(equations))
    if "E" in asked.results:
        yield from _energy(system, asked, point)
    if "accelerations" in asked.results:
        yield from _solved(system, equations, asked, point)


def _energy(system: Energies, asked: Asked, point: Point) -> Iterator[Test]:
    """Jacobi's integral, which nothing drives and nothing brakes."""
    momenta = (rate * system.lagrangian.diff(rate) for rate in system.rates)
    yield Same("E", point.at(sum(momenta) - system.lagrangian))
    work = [*system.forces, asked.formula(asked.subject.dissipation), system.lagrangian.diff("t")]
    yield put_back("E", point, work, [ZERO] * len(work), "the energy is not conserved")


def _solved(system: Energies, equations: list[sympy.Expr], asked: Asked, point: Point) -> Iterator[Test]:
    """The equations and the constraints, differentiated, with what they were solved for."""
    found = dict(zip(system.accelerations, asked.result("accelerations"), strict=True))
    if system.constraints:
        pairs = zip(system.multipliers(), asked.result("multipliers"), strict=True)
        found |= dict(pairs)
        yield Holds("multipliers", True, "")
    across = [system.on_accelerations(constraint) for constraint in system.constraints]
    for equation in (*equations, *across):
        left = equation.subs(found)
        yield put_back("accelerations", point, left, ZERO, f"{equation} = 0 is not fulfilled")
