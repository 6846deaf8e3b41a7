"""Encoders and pulse-width modulation: what is known of them."""

from __future__ import annotations

from dataclasses import dataclass

from derive.expression import ZERO, Expr
from derive.mechanics.gearing import Stage


@dataclass(frozen=True, slots=True)
class Incremental:
    """A disc with `lines` (zero where their number is asked), of which `edges` are counted each (1, 2, or 4
    with two tracks)."""

    lines: Expr
    edges: Expr


@dataclass(frozen=True, slots=True)
class Absolute:
    """A disc that reads out its angle in `bits` (zero where their number is asked); `turn_bits` more count
    its turns."""

    bits: Expr
    turn_bits: Expr = ZERO


@dataclass(frozen=True, slots=True)
class Encoder:
    """A disc on the motor; `gear` is how often the motor turns for one turn of the link."""

    disc: Incremental | Absolute
    gear: Expr | None = None


@dataclass(frozen=True, slots=True)
class PulseWidth:
    """`high` volts for the share `duty` of each period and `low` volts for the rest, or such a duty that
    the mean is `mean`; `frequency` in 1/s where it is given."""

    high: Expr
    low: Expr
    duty: Expr | None = None
    mean: Expr | None = None
    frequency: Expr | None = None


@dataclass(frozen=True, slots=True)
class Drive:
    """A motor that moves a load through a gear: inertias in kg m^2 (zero where none is given), torques in
    N m; `gear` is how often the motor turns for one turn of the load, or `stages` say it, from the motor."""

    rotor: Expr = ZERO
    load: Expr = ZERO
    gear: Expr | None = None
    torque: Expr | None = None
    load_torque: Expr | None = None
    stages: tuple[Stage, ...] = ()
