"""A motor behind a gear as energy and power in numbers; no formula of an inertia seen through the gear."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Turning:
    """A rotor and a load, inertias in kg m^2, and the torques on them in N m; the rotor turns `gear` times
    while the load turns once."""

    rotor: float
    load: float
    gear: float
    push: float = 0.0
    pull: float = 0.0

    def energy(self, speed: float) -> float:
        """What both hold while the load turns at a speed [rad/s]."""
        return (self.rotor * (self.gear * speed) * (self.gear * speed) + self.load * speed * speed) / 2

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
        return Turning(self.rotor, self.load, gear, self.push, self.pull)
