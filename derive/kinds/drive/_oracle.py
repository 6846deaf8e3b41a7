"""A motor behind a gear as energy and power in numbers; no formula of an inertia seen through the gear."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from derive.expression import ONE, Expr
from derive.kinds.drive._rolling import through
from derive.mechanics.sensing import Drive


@dataclass(frozen=True, slots=True)
class Turning:
    """A rotor and a load, inertias in kg m^2, and the torques on them in N m; the rotor turns `gear` times
    while the load turns once. `shafts` between them have inertias and turn so often meanwhile."""

    rotor: float
    load: float
    gear: float
    push: float = 0.0
    pull: float = 0.0
    shafts: tuple[tuple[float, float], ...] = ()

    def energy(self, speed: float) -> float:
        """What all hold while the load turns at a speed [rad/s]."""
        parts = ((self.rotor, self.gear), (self.load, 1.0), *self.shafts)
        return sum(inertia * (turns * speed) * (turns * speed) / 2 for inertia, turns in parts)

    def power(self, speed: float) -> float:
        """What the motor gives, less what the load takes."""
        return self.push * (self.gear * speed) - self.pull * speed

    @property
    def acceleration(self) -> float:
        """Of the load: the power is the rate of the energy; by differences, which are exact here."""
        speed, apart = 1.0, 0.5
        slope = (self.energy(speed + apart) - self.energy(speed - apart)) / (2 * apart)
        return self.power(speed) / slope

    def with_gear(self, gear: float) -> Turning:
        """The same behind another gear."""
        return replace(self, gear=gear)


def built(drive: Drive, at: Callable[[Expr], float]) -> Turning:
    """A drive in numbers, its stages rolling on each other."""
    rotor, load = at(drive.rotor), at(drive.load)
    if not drive.stages:
        return Turning(rotor, load, at(drive.gear or ONE))
    speeds = through(drive.stages, [tuple(map(at, stage.sizes)) for stage in drive.stages])
    parts = [(stage.inertia, speed) for stage, speed in zip(drive.stages, speeds, strict=True)]
    shafts = tuple((at(inertia), speed / speeds[-1]) for inertia, speed in parts if inertia is not None)
    return Turning(rotor, load, 1 / speeds[-1], shafts=shafts)
