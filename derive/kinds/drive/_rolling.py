"""Wheels in numbers: which speed a stage hands on, by the velocities of the points where its parts meet.

Positions and velocities in the plane are complex numbers; nothing here knows a ratio.
"""

from __future__ import annotations

from math import prod

from derive.mechanics.gearing import Form, Stage

UP = 1j


def driven(form: Form, *sizes: float) -> float:
    """The speed of the driven side [rad/s] while the driving one turns with 1 rad/s."""
    first, *others = sizes
    if form == "ratio":
        return 1 / first
    second = others[0]
    match form:
        case "gears":  # the second wheel lies to the right of the first
            return _speed(_rim(1, first), -second)
        case "ring":  # they meet on the right of both
            return _speed(_rim(1, first), second)
        case "belt":  # it runs along the tops of both
            return _speed(_rim(1, first * UP), second * UP)
        case "crossed":  # from the top of the first to the bottom of the second
            return _speed(_rim(1, first * UP), -second * UP)
        case "planetary":  # a planet rolls between the rim of the sun and the ring, which is at rest
            middle = (_rim(1, first) + 0) / 2
            return _speed(middle, (first + second) / 2)
    # Seen from the wave generator the circular spline turns backwards, and as many teeth of the other pass.
    return 1 + _speed(_rim(-1, second), first)


def _rim(speed: float, place: complex) -> complex:
    """The velocity of a point of a wheel that turns about its center."""
    return UP * speed * place


def _speed(velocity: complex, place: complex) -> float:
    """Of a wheel a point of which has this velocity."""
    return (velocity / (UP * place)).real


def through(stages: tuple[Stage, ...], sizes: list[tuple[float, ...]]) -> list[float]:
    """The speeds of the shafts behind the stages while the motor turns with 1 rad/s."""
    each = [driven(stage.form, *size) for stage, size in zip(stages, sizes, strict=True)]
    return [prod(each[: k + 1]) for k in range(len(each))]
