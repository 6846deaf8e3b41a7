"""The acceleration of a load by the gear in front of it, and how it changes with the gear."""

from __future__ import annotations

from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, add
from derive.mechanics.sensing import Drive


def only_ends(drive: Drive) -> None:
    """Raises NotDerivable where shafts between the motor and the load have inertias."""
    if any(stage.inertia is not None for stage in drive.stages):
        raise NotDerivable("the best ratio of stages whose shafts have inertias is not derived yet")


def slope_of(G: Symbol, J_m: Expr, J_l: Expr, tau_m: Expr, tau_l: Expr | None) -> tuple[Expr, Expr, Expr]:
    """The acceleration by G, its derivative, and the numerator of that."""
    whole = G**2 * J_m + J_l
    push = G * tau_m
    if tau_l is None:
        top = J_l - G**2 * J_m
        return push / whole, tau_m * top / whole**2, top
    terms = (
        tau_m * J_l,
        2 * G * J_m * tau_l,
        -1 * G**2 * J_m * tau_m,
    )
    top = add(*terms)
    return (push - tau_l) / whole, top / whole**2, top
