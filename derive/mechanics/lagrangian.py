"""A mechanical system by its coordinates and energies, and Lagrange's equations for it.

(Goldstein, Poole and Safko, Classical Mechanics, chapters 1 and 2; Rayleigh's dissipation function,
section 1.5; multipliers, section 2.4.)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from derive.algebra.function import Constraint
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal
from derive.algebra.scalar import Scalar
from derive.expression import ZERO, Expr

TIME = "t"


@dataclass(frozen=True, slots=True)
class MovingBody:
    """A mass at a position (2 or 3 coordinates in an inertial frame); in a plane, or about an axis of
    fixed direction, also a moment of inertia and the angle it turns by."""

    mass: Expr
    position: tuple[Expr, ...]
    inertia: Expr | None = None
    angle: Expr | None = None


@dataclass(frozen=True, slots=True)
class LagrangianSystem:
    """`kinetic` and `potential` come on top of those of the bodies. `forces` are generalised forces by
    coordinate; `dissipation` is Rayleigh's function; `constraints` hold for coordinates or for rates."""

    coordinates: tuple[str, ...]
    bodies: tuple[MovingBody, ...] = ()
    kinetic: Expr = ZERO
    potential: Expr = ZERO
    gravity: tuple[Expr, ...] = ()
    forces: tuple[tuple[str, Expr], ...] = ()
    dissipation: Expr = ZERO
    constraints: tuple[Constraint, ...] = ()

    @property
    def variables(self) -> tuple[str, ...]:
        """The coordinates, in the order in which they are written."""
        return self.coordinates

    @property
    def rates(self) -> tuple[str, ...]:
        """Their rates, `x_dot` of x."""
        return tuple(f"{name}_dot" for name in self.coordinates)

    @property
    def accelerations(self) -> tuple[str, ...]:
        """Their accelerations, `x_ddot` of x."""
        return tuple(f"{name}_ddot" for name in self.coordinates)


@dataclass(frozen=True, slots=True)
class Condition:
    """A constraint as it acts: sum a_j qdot_j + b = 0. "holonomic" ones hold for the coordinates
    (`vanishing` is zero), "velocity" ones for their rates."""

    sort: Literal["holonomic", "velocity"]
    vanishing: Scalar
    a: tuple[Scalar, ...]


def rate(value: Scalar, system: LagrangianSystem) -> Scalar:
    """d/dt by the chain rule: coordinates, rates and the time itself."""
    total = value.diff(TIME)
    pairs = zip((*system.coordinates, *system.rates), (*system.rates, *system.accelerations), strict=True)
    for name, along in pairs:
        if part := value.diff(name):
            total = total + part * Scalar.symbol(along)
    return total


def velocity(position: ScalarMatrix, system: LagrangianSystem) -> ScalarMatrix:
    """The rate of a position, a column as long as it."""
    return ScalarMatrix.column(rate(entry, system) for entry in position.entries)


def kinetic_energies(system: LagrangianSystem, names: Names) -> tuple[Scalar, ...]:
    """m v^2/2 + I omega^2/2 of each body."""
    found = []
    for body in system.bodies:
        v = velocity(ScalarMatrix.column(normal(entry, names) for entry in body.position), system)
        energy = normal(body.mass, names) * (v.T @ v)[0, 0] / 2
        if body.inertia is not None and body.angle is not None:
            spin = rate(normal(body.angle, names), system)
            energy = energy + normal(body.inertia, names) * spin * spin / 2
        found.append(energy)
    return tuple(found)


def potential_energies(system: LagrangianSystem, names: Names) -> tuple[Scalar, ...]:
    """-m g . r of each body."""
    g = [normal(entry, names) for entry in system.gravity]
    found = []
    for body in system.bodies:
        height = [a * normal(r, names) for a, r in zip(g, body.position, strict=True)]
        found.append(-normal(body.mass, names) * sum(height, Scalar.of(0)))
    return tuple(found)


def inertial_side(lagrangian: Scalar, system: LagrangianSystem) -> tuple[Scalar, ...]:
    """d/dt dL/dqdot - dL/dq for each coordinate."""
    pairs = zip(system.coordinates, system.rates, strict=True)
    return tuple(rate(lagrangian.diff(along), system) - lagrangian.diff(q) for q, along in pairs)


def mass_matrix(sides: Sequence[Scalar], system: LagrangianSystem) -> ScalarMatrix:
    """M (n by n): what multiplies the accelerations in the equations."""
    return ScalarMatrix.of([side.diff(name) for name in system.accelerations] for side in sides)


def without(value: Scalar, names: Sequence[str]) -> Scalar:
    """With these names zero."""
    return value.substitute({name: Scalar.of(0) for name in names})


def by_rates(value: Scalar, rates: Sequence[str]) -> list[tuple[dict[str, int], Scalar]]:
    """Grouped by products of rates: their powers and what multiplies them; the highest powers first."""
    home = value.ring
    bottom = 1 if value.denominator is None else Scalar(home, value.denominator)
    found = home.grouped(value.numerator, rates)
    ordered = sorted(found, key=lambda powers: (-sum(powers), tuple(-power for power in powers)))
    return [
        ({name: power for name, power in zip(rates, powers, strict=True) if power}, part / bottom)
        for powers in ordered
        if (part := Scalar(home, found[powers]))
    ]


def conditions(system: LagrangianSystem, names: Names) -> tuple[Condition, ...]:
    """The constraints, those for coordinates differentiated."""
    found = []
    for constraint in system.constraints:
        value = normal(constraint.left, names) - normal(constraint.right, names)
        used = set(value.generators())
        if used & set(system.rates):
            a = tuple(value.diff(name) for name in system.rates)
            found.append(Condition("velocity", value, a))
        else:
            found.append(
                Condition("holonomic", value, tuple(value.diff(name) for name in system.coordinates))
            )
    return tuple(found)


def on_accelerations(condition: Condition, system: LagrangianSystem) -> Scalar:
    """The constraint differentiated until the accelerations stand in it; it vanishes."""
    once = condition.vanishing if condition.sort == "velocity" else rate(condition.vanishing, system)
    return rate(once, system)


def energy(lagrangian: Scalar, system: LagrangianSystem) -> Scalar:
    """Jacobi's integral: sum qdot dL/dqdot - L."""
    total = -lagrangian
    for name in system.rates:
        total = total + Scalar.symbol(name) * lagrangian.diff(name)
    return total


def forces_of(system: LagrangianSystem) -> Mapping[str, Expr]:
    """By coordinate; zero where none is given."""
    return {name: dict(system.forces).get(name, ZERO) for name in system.coordinates}
