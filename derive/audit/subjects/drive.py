"""A drive: a rotor that moves a load through a gear, by its kinetic energy and its power."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.points import Point, floating
from derive.audit.putting_back import put_back
from derive.expression import ONE
from derive.mechanics.sensing import Drive

OMEGA, GEAR = sympy.symbols("_omega _G")  # of the load; of any gear
BESIDE = (sympy.Rational(9, 10), sympy.Rational(11, 10))


def reflected_inertia(asked: Asked, point: Point) -> Iterator[Test]:
    """The inertia that has the same energy, turning like the load or like the rotor."""
    drive: Drive = asked.subject
    gear = asked.formula(drive.gear or ONE)
    energy = _energy(asked, OMEGA, gear * OMEGA)
    yield Same("J_load", point.at(sympy.diff(energy, OMEGA, 2)))
    energy = _energy(asked, OMEGA / gear, OMEGA)
    yield Same("J_motor", point.at(sympy.diff(energy, OMEGA, 2)))


def gear_ratio(asked: Asked, point: Point) -> Iterator[Test]:
    """Power goes into energy: (G tau_m - tau_l) omega = dE/dt; the acceleration is greatest."""
    drive: Drive = asked.subject
    push = sympy.Symbol("tau_m") if drive.torque is None else asked.formula(drive.torque)
    pull = sympy.Integer(0) if drive.load_torque is None else asked.formula(drive.load_torque)
    inertia = sympy.diff(_energy(asked, OMEGA, GEAR * OMEGA), OMEGA, 2)
    alpha = (GEAR * push - pull) / inertia
    best, there = asked.result("G"), _positive(point, alpha)
    slope = sympy.diff(alpha, GEAR).subs(GEAR, best)
    yield put_back("G", there, slope, sympy.Integer(0), "the acceleration has no extreme value there")
    yield put_back("alpha", there, asked.result("alpha"), alpha.subs(GEAR, best), "the acceleration there")
    forwards = alpha * sympy.sign(push)
    most = floating(there.at(forwards.subs(GEAR, best)))
    others = (floating(there.at(forwards.subs(GEAR, best * factor))) for factor in BESIDE)
    yield Holds("G", all(other < most for other in others), "a gear beside it gives more")


def _energy(asked: Asked, load: sympy.Expr, rotor: sympy.Expr) -> sympy.Expr:
    drive: Drive = asked.subject
    return asked.formula(drive.load) * load**2 / 2 + asked.formula(drive.rotor) * rotor**2 / 2


def _positive(point: Point, expr: sympy.Expr) -> Point:
    """The point with everything positive: sizes of a machine that there is."""
    sizes = {symbol.name: "positive" for symbol in expr.free_symbols}
    return Point(point.seed, point.exact, point.angles, {**point.assumptions, **sizes}, point.fixed)


KINDS = {"reflected-inertia": reflected_inertia, "gear-ratio": gear_ratio}
