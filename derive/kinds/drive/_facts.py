"""What the words read of a motor behind a gear."""

from __future__ import annotations

from derive.derivation import PageFacts
from derive.expression import Expr, Symbol, symbols

ALPHA = Symbol("alpha")
OMEGA, OMEGA_M = symbols("omega omega_m")


class GearFacts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    tau_m: Symbol
    tau_l: Symbol | None
    top: Expr  # the numerator of the slope
    G: Symbol
    balance: tuple[Expr, Expr] | None  # of the inertias, where no load holds against it


class LoadFacts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    G: Symbol
    load: Symbol
    tau_m: Symbol
    tau_l: Symbol | None
    top: Expr  # the numerator of the slope


class InertiaFacts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    G: Symbol
    speeds: tuple[Symbol, Symbol]  # of the load and of the motor
    squares: tuple[Expr, Expr]
    speed: tuple[Expr, Expr]  # that of the motor by that of the load
    shafts: tuple[tuple[Expr, tuple[Expr, Expr]], ...]  # their stages; their speeds by that of the load
    energy: Expr  # of the whole drive
