"""A drive: a rotor that moves a load through a gear, by its kinetic energy and its power."""

from __future__ import annotations

from collections.abc import Iterator

import sympy

from derive.audit.algebra import solution
from derive.audit.asked import Asked, Holds, Same, Test
from derive.audit.points import Point, floating
from derive.audit.putting_back import put_back
from derive.expression import ONE, ZERO
from derive.mechanics.gearing import Form
from derive.mechanics.sensing import Drive

OMEGA, GEAR = sympy.symbols("_omega _G")  # of the load or the motor; of any gear
DRIVEN, PLANET = sympy.symbols("_driven _planet")
BESIDE = (sympy.Rational(9, 10), sympy.Rational(11, 10))


def reflected_inertia(asked: Asked, point: Point) -> Iterator[Test]:
    """The inertia that has the same energy, turning like the load or like the rotor."""
    drive: Drive = asked.subject
    gear = _gear(asked)
    energy = _energy(asked, OMEGA / gear, OMEGA)
    for stage, turns in zip(drive.stages, _speeds(asked), strict=True):
        energy += asked.formula(stage.inertia or ZERO) * (turns * OMEGA) ** 2 / 2
    yield Same("J_motor", point.at(sympy.diff(energy, OMEGA, 2)))
    yield Same("J_load", point.at(sympy.diff(energy.subs(OMEGA, gear * OMEGA), OMEGA, 2)))


def gear_train(asked: Asked, point: Point) -> Iterator[Test]:
    """The speeds of all shafts from the wheels that roll on each other, and the power that goes through."""
    speeds = [sympy.Integer(1), *_speeds(asked)]
    yield Same("G", point.at(1 / speeds[-1]))
    for k in range(1, len(speeds)):
        if asked.answered(f"G_{k}"):
            yield Same(f"G_{k}", point.at(speeds[k - 1] / speeds[k]))
    if asked.options.speed is not None:
        yield Same("omega", point.at(speeds[-1] * asked.formula(asked.options.speed)))
    if asked.options.torque is not None:
        yield Same("tau", point.at(asked.formula(asked.options.torque) / speeds[-1]))


def load_inertia(asked: Asked, point: Point) -> Iterator[Test]:
    """With this load the acceleration is stationary at the gear that is given."""
    drive: Drive = asked.subject
    gear = _gear(asked)
    push = sympy.Symbol("tau_m") if drive.torque is None else asked.formula(drive.torque)
    pull = asked.formula(drive.load_torque or ZERO)
    load = asked.result("J_l")
    alpha = (GEAR * push - pull) / (asked.formula(drive.rotor) * GEAR**2 + load)
    slope = sympy.diff(alpha, GEAR).subs(GEAR, gear)
    yield put_back("J_l", point, slope, sympy.Integer(0), "the gear is not the best for this load")
    yield Same("alpha", point.at(alpha.subs(GEAR, gear)))


def _gear(asked: Asked) -> sympy.Expr:
    """That is given, or that of the stages."""
    drive: Drive = asked.subject
    return 1 / _speeds(asked)[-1] if drive.stages else asked.formula(drive.gear or ONE)


def _speeds(asked: Asked) -> list[sympy.Expr]:
    """Those of the shafts behind the stages, where that of the motor is one."""
    found = list[sympy.Expr]()
    for stage in asked.subject.stages:
        first, *others = map(asked.formula, stage.sizes)
        before = found[-1] if found else sympy.Integer(1)
        (speed,) = solution([*_rolling(stage.form, before, first, *others)], [DRIVEN, PLANET])[:1]
        found.append(speed)
    return found


def _rolling(form: Form, before: sympy.Expr, first: sympy.Expr, *others: sympy.Expr) -> list[sympy.Expr]:
    """What vanishes where wheels roll on each other: seen from the arm that carries their axes the same
    length of rim passes. The speed of a planet is asked only where there is one."""
    if form == "ratio":
        return [before - first * DRIVEN, PLANET]
    (second,) = others
    match form:
        case "gears" | "crossed":
            return [before * first + DRIVEN * second, PLANET]
        case "ring" | "belt":
            return [before * first - DRIVEN * second, PLANET]
        case "harmonic":
            return [(DRIVEN - before) * first - (0 - before) * second, PLANET]
    planet = (second - first) / 2
    return [
        (before - DRIVEN) * first + (PLANET - DRIVEN) * planet,
        (PLANET - DRIVEN) * planet - (0 - DRIVEN) * second,
    ]


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


KINDS = {
    "gear-train": gear_train,
    "load-inertia": load_inertia,
    "reflected-inertia": reflected_inertia,
    "gear-ratio": gear_ratio,
}
