"""Linkages that close in a loop, by the lengths of their bars: what is known of each."""

from __future__ import annotations

from dataclasses import dataclass

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
