"""A direct-current motor by what it does with power: impedances on either side of its air gap.

The circuit is R + L s, the shaft J s + b. Through the torque K_m i and the back electromotive force K_b
omega each side feels the other as an impedance K_m K_b over its own, which resists: that no equation need
be signed for."""

from __future__ import annotations

from collections.abc import Mapping

Point = Mapping[str, float]


def gain(control: str, output: str, disturbed: bool, point: Point, s: complex) -> complex:
    """Output over the voltage, or over a torque that brakes the shaft."""
    circuit, shaft = sides(control, point, s)
    coupling = point["K_m"] * point["K_b"] if control == "armature" else 0.0
    if disturbed:
        speed = -1 / (shaft + coupling / circuit)
    else:
        current = 1 / (circuit + coupling / shaft)
        speed = point["K_m"] * current / shaft
    return speed if output == "speed" else speed / s


def sides(control: str, point: Point, s: complex) -> tuple[complex, complex]:
    """The impedances of the circuit and of the shaft."""
    side = control[0]
    return point[f"R_{side}"] + point[f"L_{side}"] * s, point["J"] * s + point["b"]


def balance(
    control: str, output: str, point: Point, s: complex, found: Mapping[str, complex]
) -> tuple[complex, complex]:
    """Power at an imaginary s, given and spent: what the terminals take in is stored, heats the winding and
    the bearing, or drives the load on. An armature turns all that its circuit does not keep into mechanical
    power, where K_b = K_m; a field takes none from the shaft, which the field only lets be driven."""
    side = control[0]
    circuit, shaft = sides(control, point, s)
    voltage, current, brake = found[f"V_{side}"], found[f"I_{side}"], found["T_d"]
    speed = found["omega"] if output == "speed" else s * found["theta"]
    through = voltage * current.conjugate() - circuit * abs(current) ** 2
    driven = (shaft * speed + brake).conjugate() * speed
    if control == "armature":
        return through, driven
    return through + point["K_m"] * current.conjugate() * speed, driven
