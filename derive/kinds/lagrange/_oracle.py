"""A second route to the equations of motion: the energies as they were given, and nothing but differences.

A motion with the rates and accelerations of a point is followed: velocities are differences of
positions, momenta differences of the Lagrangian, and their rates differences of the momenta.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass

from flint import arb, ctx

from derive.algebra.ball_arithmetic import BITS, precise, slope
from derive.errors import NotReal
from derive.expression import ZERO, Expr, free_symbols
from derive.mechanics.lagrangian import TIME, LagrangianSystem, MovingBody

Numbers = dict[str, arb]


@dataclass(frozen=True, slots=True)
class Differences:
    """The Lagrangian of a system in numbers of many digits."""

    system: LagrangianSystem
    where: Mapping[str, Expr]

    @contextmanager
    def digits(self, at: Mapping[str, float]) -> Iterator[Numbers]:
        """The point in numbers of many digits; the names of `where` are found from the others."""
        with ctx.workprec(BITS):
            yield {name: arb(value) for name, value in at.items() if name not in self.where}

    def left_sides(self, at: Mapping[str, float]) -> list[float]:
        """d/dt dL/dqdot - dL/dq + dD/dqdot at a point that names coordinates, rates, accelerations,
        parameters and the time. Raises NotReal."""
        with self.digits(at) as point:
            found = [self._left_side(k, point) for k in range(len(self.system.coordinates))]
            if not all(value.is_finite() for value in found):
                raise NotReal("the Lagrangian is not real here")
            return [float(value.mid()) for value in found]

    def forces(self, at: Mapping[str, float]) -> list[float]:
        """Those of the sheet, by coordinate."""
        forces = dict(self.system.forces)
        with self.digits(at) as point:
            known = self.completed(point)
            return [float(precise(forces.get(q, ZERO), known).mid()) for q in self.system.coordinates]

    def left_over(self, at: Mapping[str, float]) -> list[float]:
        """The left sides less the forces of the sheet."""
        return [left - push for left, push in zip(self.left_sides(at), self.forces(at), strict=True)]

    def _left_side(self, k: int, at: Numbers) -> arb:
        along = self.system.rates[k]
        lost = slope(lambda x: precise(self.system.dissipation, self.completed({**at, along: x})), at[along])
        return self.momentum_rate(k, at) - self.force(k, at) + lost

    def momentum(self, k: int, at: Numbers) -> arb:
        """dL/dqdot_k."""
        along = self.system.rates[k]
        return slope(lambda x: self.lagrangian({**at, along: x}), at[along])

    def momentum_rate(self, k: int, at: Numbers) -> arb:
        """d/dt dL/dqdot_k along the motion."""
        return slope(lambda s: self.momentum(k, self.later(at, s)), arb(0))

    def force(self, k: int, at: Numbers) -> arb:
        """dL/dq_k."""
        q = self.system.coordinates[k]
        return slope(lambda x: self.lagrangian({**at, q: x}), at[q])

    def later(self, at: Numbers, s: arb) -> Numbers:
        """The motion a little later: q + qdot s + qddot s^2/2."""
        later = {**at, TIME: at[TIME] + s}
        names = zip(self.system.coordinates, self.system.rates, self.system.accelerations, strict=True)
        for q, first, second in names:
            later[q] = at[q] + at[first] * s + at[second] * s * s / 2
            later[first] = at[first] + at[second] * s
        return later

    def lagrangian_at(self, at: Mapping[str, float]) -> float:
        """T - P at a point."""
        with self.digits(at) as point:
            return float(self.lagrangian(point).mid())

    def lagrangian(self, at: Numbers) -> arb:
        """T - P from the trees of the sheet."""
        kinetic = sum((self.kinetic(body, at) for body in self.system.bodies), arb(0))
        return kinetic + precise(self.system.kinetic, self.completed(at)) - self.potential(at)

    def kinetic(self, body: MovingBody, at: Numbers) -> arb:
        """m v^2/2 + I omega^2/2 of one body."""
        known = self.completed(at)
        speeds = [self.speed(entry, at) for entry in body.position]
        total = precise(body.mass, known) * sum((speed * speed for speed in speeds), arb(0)) / 2
        if body.inertia is not None and body.angle is not None:
            spin = self.speed(body.angle, at)
            total = total + precise(body.inertia, known) * spin * spin / 2
        return total

    def potential(self, at: Numbers) -> arb:
        """That of gravity, and what was given besides."""
        known = self.completed(at)
        total = precise(self.system.potential, known)
        for body in self.system.bodies:
            for g, entry in zip(self.system.gravity, body.position, strict=True):
                total = total - precise(body.mass, known) * precise(g, known) * precise(entry, known)
        return total

    def speed(self, entry: Expr, at: Numbers) -> arb:
        """The rate of a coordinate of a body, from where it is a moment later."""

        def place(s: arb) -> arb:
            later = {**at, TIME: at[TIME] + s}
            for q, first in zip(self.system.coordinates, self.system.rates, strict=True):
                later[q] = at[q] + at[first] * s
            return precise(entry, self.completed(later))

        return slope(place, arb(0))

    def completed(self, at: Numbers) -> Numbers:
        """With the values of `where`, those that rest on others after them."""
        found, pending = dict(at), dict(self.where)
        while ready := [name for name, value in pending.items() if free_symbols(value) <= found.keys()]:
            found.update({name: precise(pending.pop(name), found) for name in ready})
        return found
