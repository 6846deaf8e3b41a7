"""What is told of a motion that is scaled: the laws, the table, the factor, and how the limits are kept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isclose
from typing import Any

from derive.derivation import Cell, Label, Panels, Phrase, Plot, Step, Table
from derive.expression import (
    Approximate,
    Call,
    Expr,
    Measured,
    Symbol,
    add,
    free_symbols,
    multiply,
    number,
    sqrt,
    squared,
)
from derive.figures.axes import IN_TIME, short
from derive.kinds.path._timing import T as MOMENT
from derive.kinds.problem import Problem
from derive.kinds.robot._scaled.demands import Demands, Peak
from derive.kinds.robot._units import of_variables
from derive.names import free

JUST = 1e-9  # of a factor that is 1
DRAWN = 160  # places of a curve
BY_LAW = {"cubic": ("by-cubic", "by-cubic-one"), "quintic": ("by-quintic", "by-quintic-one")}
LIMITS: dict[Label, float] = {Phrase("limit"): 1.0, Phrase("limit-back"): -1.0}


@dataclass(frozen=True, slots=True)
class Names:
    """The factor and the new time; of one joint the torque, that of gravity, the limit, the torque of the
    slower motion, and the factor that it needs."""

    k: Symbol
    T_k: Symbol
    tau: Symbol
    g: Symbol
    most: Symbol
    new: Symbol
    k_i: Symbol


@dataclass(frozen=True, slots=True)
class Told:
    """`active` is the joint that needs most, `again` says when else one needs as much, `verdict` whether
    limits are kept."""

    names: Names
    law: Phrase
    slower: Phrase
    limit: Phrase
    steps: tuple[Step, ...]
    table: Table
    active: Phrase
    greatest: Phrase
    needs: Phrase
    again: tuple[Phrase, ...]
    verdict: Phrase
    picture: Panels


def told_of(demands: Demands) -> Told:
    """All of it, from the peaks."""
    problem = demands.plan.problem
    names = _names(problem, demands.plan.T)
    peaks = demands.peaks
    k = max(each.k for each in peaks)
    joint = max(range(len(peaks)), key=lambda place: peaks[place].k)
    key = "just-kept" if isclose(k, 1, rel_tol=JUST) else "not-kept" if k > 1 else "kept"
    law, one = demands.plan.law, len(peaks) == 1
    return Told(
        names,
        Phrase(BY_LAW[law][one], {"s": demands.plan.shares[0].chain[0]}) if law else Phrase("by-functions"),
        Phrase("slower", {"k": names.k, "square": squared(names.k)}),
        Phrase("limit-of", {"most": names.most}),
        tuple(_steps(names, demands, k)),
        _table(names, demands),
        Phrase("active", {"joint": joint + 1}),
        Phrase("greatest-one") if one else Phrase("greatest", {"joint": joint + 1}),
        Phrase("needs-one" if one else "needs"),
        tuple(_again(i, peak) for i, peak in enumerate(peaks, 1) if peak.again),
        Phrase(key, {"k": names.k}),
        _picture(demands, k),
    )


def _names(problem: Problem, T: Symbol) -> Names:
    taken = {*problem.taken, T.name}
    candidates = (
        ("lambda", "kappa"), ("T_lambda", "T_kappa"), ("tau_i", "Q_i"), ("g_i", "G_i"), ("tau_Mi", "Q_Mi"),
        ("tau_new_i", "Q_new_i"), ("lambda_i", "kappa_i"),
    )  # fmt: skip
    return Names(*(Symbol(free(taken, *each)) for each in candidates))


def _steps(names: Names, demands: Demands, k: float) -> tuple[Step, ...]:
    """The torque in k times the time, the factor that a joint needs at a time, the greatest, the new time."""
    beyond = names.tau - names.g
    slower = add(names.g, beyond / squared(names.k))
    left = names.most - multiply(Call("sign", (beyond,)), names.g)
    return (
        Step("scaled", (names.new, slower), "in-numbers"),
        Step("needed", (names.k_i, sqrt(Call("abs", (beyond,)) / left)), "in-numbers"),
        Step("factor", (names.k, Approximate(k)), "in-numbers"),
        Step(
            "time",
            (names.T_k, multiply(names.k, demands.plan.T), Approximate(k * demands.whole)),
            "in-numbers",
        ),
    )


def _again(joint: int, peak: Peak) -> Phrase:
    """When else it needs as much."""
    times = tuple(Measured(Approximate(t), "s") for t in peak.again)
    return Phrase("again", {"joint": joint, "times": times})


def _table(names: Names, demands: Demands) -> Table:
    """Of each joint the moment at which it needs most; every torque with its unit where these differ."""
    headings: tuple[Cell, ...] = (
        Phrase("joint"), MOMENT, names.tau, names.g, names.most, names.k_i,
    )  # fmt: skip
    units = _efforts(demands) if len({*_efforts(demands)}) > 1 else ("",) * len(demands.peaks)
    rows = tuple(
        (
            number(i),
            Approximate(peak.t),
            *(_said(each, unit) for each in (Approximate(peak.tau), Approximate(peak.g), most)),
            Approximate(peak.k),
        )
        for i, (peak, most, unit) in enumerate(zip(demands.peaks, _limits(demands), units, strict=True), 1)
    )
    return Table(headings, rows)


def _said(value: Expr, unit: str) -> Expr:
    return Measured(value, unit) if unit else value


def _efforts(demands: Demands) -> tuple[str, ...]:
    """The unit of what each joint exerts."""
    units = of_variables(demands.plan.problem.subject)
    return tuple(units[f"tau_{i}"] for i in range(1, len(demands.most) + 1))


def _limits(demands: Demands) -> tuple[Expr, ...]:
    """As they were typed, numbers where they were names."""
    exact = zip(demands.limits, demands.most, strict=True)
    return tuple(Approximate(value) if free_symbols(tree) else tree for tree, value in exact)


def units_of(names: Names, demands: Demands) -> dict[Expr | Phrase, str]:
    """Of times, and of torques where all joints turn, or all slide."""
    sorts = {*_efforts(demands)}
    unit = sorts.pop() if len(sorts) == 1 else ""
    forces: dict[Expr | Phrase, str] = {}
    if unit:
        forces = dict.fromkeys((names.tau, names.g, names.most), unit)
    return {demands.plan.T: "s", names.T_k: "s", MOMENT: "s", **forces}


def _picture(demands: Demands, k: float) -> Panels:
    """The torques as shares of their limits, in the given time and in the new one."""
    plots = []
    for name, factor in (("before", 1.0), ("after", k)):
        shares = share_curves(demands, factor)
        series: Mapping[Label, Any] = {Symbol(f"tau_{i}"): curve for i, curve in enumerate(shares, 1)}
        plots.append(Plot(name, IN_TIME, Phrase(name), series, LIMITS))
    said = {"whole": short(demands.whole), "new": short(k * demands.whole)}
    return Panels("torques", tuple(plots), caption=Phrase("drawn"), alt=Phrase("seen", {**said}))


def share_curves(demands: Demands, k: float) -> list[tuple[tuple[float, ...], tuple[float, ...]]]:
    """Of each joint the times and the shares of its limit."""
    times = [demands.whole * place / DRAWN for place in range(DRAWN + 1)]
    torques = demands.torques(times, k)
    return [
        (tuple(k * t for t in times), tuple(map(float, column / most)))
        for column, most in zip(torques.T, demands.most, strict=True)
    ]
