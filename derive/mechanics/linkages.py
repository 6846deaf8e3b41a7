"""Linkages that close in a loop, by the lengths of their bars: what is known of each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from derive.expression import ZERO, Expr, Symbol

INPUT = Symbol("theta_2")


@dataclass(frozen=True, slots=True)
class FourBar:
    """A crank turns about the origin, a rocker about a point of the x axis, `ground` away; a coupler joins
    their ends (m). `angle` is that of the crank from the x axis; those of the coupler, from the crank on, and
    of the rocker, from its pivot on, are theta_3 and theta_4."""

    crank: Expr
    coupler: Expr
    rocker: Expr
    ground: Expr
    angle: Expr = INPUT


@dataclass(frozen=True, slots=True)
class SliderCrank:
    """A crank turns about the origin, and a rod joins its end to a slider at the place s along a line that is
    parallel to the x axis at the height `offset` (m). theta_3 is the angle of the rod, from the crank on."""

    crank: Expr
    rod: Expr
    offset: Expr = ZERO
    angle: Expr = INPUT


@dataclass(frozen=True, slots=True)
class FiveBar:
    """Two cranks turn about the origin and about the point of the x axis at the distance `ground`, with
    motors at both; two couplers join their ends in one point of the plane (m)."""

    cranks: tuple[Expr, Expr]
    couplers: tuple[Expr, Expr]
    ground: Expr


@dataclass(frozen=True, slots=True)
class Delta:
    """Three arms of length `arm` turn on a base, at its radius `base` and 120 degrees apart, the first in the
    plane of x and z; forearms of length `forearm`, each a parallelogram, hold a platform at its radius
    `platform`, which never turns (m). An arm stretched outwards has the angle 0, one that hangs down 90
    degrees."""

    base: Expr
    platform: Expr
    arm: Expr
    forearm: Expr


Point: TypeAlias = tuple[Expr, Expr, Expr]


@dataclass(frozen=True, slots=True)
class Stewart:
    """Legs of variable length, each from a point of the base, given in its frame, to a point of the platform,
    given in that of the platform (m), with ball or universal joints at both ends: six of them hold the
    platform in every pose."""

    base: tuple[Point, ...]
    platform: tuple[Point, ...]


Linkage: TypeAlias = FourBar | SliderCrank | FiveBar | Delta | Stewart
