"""A motion that is scaled in time: the torques at moments, by the energies of the arm."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import mpmath
import sympy

from derive.audit.algebra import expanded
from derive.audit.asked import Asked, Holds, Test
from derive.audit.points import ROUNDED, Point, agree
from derive.audit.subjects.robot.arm import entries
from derive.audit.subjects.robot.bodies import Mechanics

GRID = 12  # moments beside those that are told
ENDS = ("", "_dot", "_ddot")
ORDERS = {"cubic": 2, "quintic": 3}  # conditions at each end


def time_scaling(asked: Asked, point: Point) -> Iterator[Test]:
    """No joint needs a greater factor at any moment than is told, and just that at its own."""
    here = asked.here.in_digits() if asked.evaluate else point.in_digits()
    whole = here.at(asked.formula(asked.options.time))
    factors, moments = (
        list(map(here.at, asked.read(asked.results[name]))) for name in ("factors", "moments")
    )
    k, time = (here.at(asked.result(name)) for name in ("k", "time"))
    yield Holds("k", agree(k, max(factors), near=ROUNDED), "it is the greatest factor")
    yield Holds("time", agree(time, k * whole, near=ROUNDED), f"it is {mpmath.nstr(k * whole, 10)}")
    limits = [here.at(asked.formula(each)) for each in asked.options.torque_max]
    grid = [whole * step / GRID for step in range(GRID + 1)]
    wanted = {moment: _needed(asked, here, moment, limits) for moment in (*grid, *moments)}
    for i, (factor, moment) in enumerate(zip(factors, moments, strict=True)):
        yield Holds("factors", agree(wanted[moment][i], factor, near=ROUNDED), "it needs another factor then")
        most = max(each[i] for each in wanted.values())
        yield Holds("moments", most <= factor * (1 + ROUNDED), "it needs more at another time")
    slowest = max(range(len(factors)), key=lambda place: factors[place])
    active = f"joint {slowest + 1}"
    yield Holds("active", asked.results["active"] == active, f"it is {active}")


def _needed(asked: Asked, here: Point, moment: Any, limits: Sequence[Any]) -> list[Any]:
    arm = Mechanics(asked, here.where(**_joints(asked, here, moment)))
    found = []
    for tau, g, most in zip(arm.tau.tolist(), entries(arm.g), limits, strict=True):
        beyond = tau - g
        left = most - g if beyond >= 0 else most + g
        found.append(mpmath.sqrt(abs(beyond) / left))
    return found


def _joints(asked: Asked, here: Point, moment: Any) -> dict[str, Any]:
    """Joint variables, rates and accelerations then."""
    t, options = sympy.Symbol("t"), asked.options
    names = asked.subject.variables
    if options.joints:
        functions = [asked.formula(each) for each in options.joints]
    else:
        T = asked.formula(options.time)
        share = _share(ORDERS[options.law or "cubic"]).subs(sympy.Symbol("x"), t / T)
        start, end = (
            {name: asked.formula(value) for name, value in each} for each in (options.start, options.end)
        )
        functions = [start[name] + (end[name] - start[name]) * share for name in names]
    now = here.where(t=moment)
    return {
        f"{name}{suffix}": now.at(function.diff(t, order) if order else function)
        for name, function in zip(names, functions, strict=True)
        for order, suffix in enumerate(ENDS)
    }


def _share(order: int) -> sympy.Expr:
    """The polynomial from 0 to 1 with as many derivatives zero at both ends: the integral of (x - x^2)^n."""
    x = sympy.Symbol("x")
    whole = sympy.integrate(expanded((x - x**2) ** (order - 1)), x)
    return whole / whole.subs(x, 1)
