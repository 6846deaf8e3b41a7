"""A second route to the equations of motion: the energies as they were given, and nothing but differences.

A motion with the rates and accelerations of a point is followed: velocities are differences of
positions, momenta differences of the Lagrangian, and their rates differences of the momenta.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from flint import arb, ctx

from derive.algebra.ball_arithmetic import BITS, precise, slope
from derive.errors import NotReal
from derive.expression import ZERO, Expr, free_symbols
from derive.mechanics.lagrangian import TIME, LagrangianSystem

Numbers = dict[str, arb]


@dataclass(frozen=True, slots=True)
class Differences:
    """The Lagrangian of a system in numbers of many digits."""

    system: LagrangianSystem
    where: Mapping[str, Expr]

    def left_sides(self, at: Mapping[str, float]) -> list[float]:
        """d/dt dL/dqdot - dL/dq + dD/dqdot at a point that names coordinates, rates, accelerations,
        parameters and the time. Raises NotReal."""
        with ctx.workprec(BITS):
            point = {name: arb(value) for name, value in at.items()}
            found = [self._left_side(k, point) for k in range(len(self.system.coordinates))]
            if not all(value.is_finite() for value in found):
                raise NotReal("the Lagrangian is not real here")
            return [float(value.mid()) for value in found]

    def left_over(self, at: Mapping[str, float]) -> list[float]:
        """The left sides less the forces of the sheet."""
        forces = dict(self.system.forces)
        with ctx.workprec(BITS):
            known = self._completed({name: arb(value) for name, value in at.items()})
            pushes = [float(precise(forces.get(q, ZERO), known).mid()) for q in self.system.coordinates]
        return [left - push for left, push in zip(self.left_sides(at), pushes, strict=True)]

    def _left_side(self, k: int, at: Numbers) -> arb:
        q, along = self.system.coordinates[k], self.system.rates[k]
        momentum_rate = slope(lambda s: self._momentum(along, self._later(at, s)), arb(0))
        force = slope(lambda x: self.lagrangian({**at, q: x}), at[q])
        lost = slope(lambda x: precise(self.system.dissipation, self._completed({**at, along: x})), at[along])
        return momentum_rate - force + lost

    def _momentum(self, along: str, at: Numbers) -> arb:
        return slope(lambda x: self.lagrangian({**at, along: x}), at[along])

    def _later(self, at: Numbers, s: arb) -> Numbers:
        """The motion a little later: q + qdot s + qddot s^2/2."""
        later = {**at, TIME: at[TIME] + s}
        names = zip(self.system.coordinates, self.system.rates, self.system.accelerations, strict=True)
        for q, first, second in names:
            later[q] = at[q] + at[first] * s + at[second] * s * s / 2
            later[first] = at[first] + at[second] * s
        return later

    def lagrangian(self, at: Numbers) -> arb:
        """T - P from the trees of the sheet."""
        known = self._completed(at)
        total = precise(self.system.kinetic, known) - precise(self.system.potential, known)
        for body in self.system.bodies:
            mass = precise(body.mass, known)
            for k, entry in enumerate(body.position):
                speed = self._speed(entry, at)
                total = total + mass * speed * speed / 2
                total = total + mass * precise(self.system.gravity[k], known) * precise(entry, known)
            if body.inertia is not None and body.angle is not None:
                spin = self._speed(body.angle, at)
                total = total + precise(body.inertia, known) * spin * spin / 2
        return total

    def _speed(self, entry: Expr, at: Numbers) -> arb:
        """The rate of a coordinate of a body, from where it is a moment later."""

        def place(s: arb) -> arb:
            later = {**at, TIME: at[TIME] + s}
            for q, first in zip(self.system.coordinates, self.system.rates, strict=True):
                later[q] = at[q] + at[first] * s
            return precise(entry, self._completed(later))

        return slope(place, arb(0))

    def _completed(self, at: Numbers) -> Numbers:
        """With the values of `where`, those that rest on others after them."""
        found, pending = dict(at), dict(self.where)
        while ready := [name for name, value in pending.items() if free_symbols(value) <= found.keys()]:
            found.update({name: precise(pending.pop(name), found) for name in ready})
        return found
