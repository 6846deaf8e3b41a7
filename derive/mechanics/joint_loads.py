"""What the motor and the friction of a joint add to the mechanics of its links."""

from __future__ import annotations

from derive.expression import ONE, ZERO, Call, Expr, Symbol, multiply
from derive.mechanics.drives import Friction, Motor


def reflected(motor: Motor | None) -> Expr:
    """J G^2: the rotor as its joint feels it (kg m^2; kg for a prismatic joint)."""
    return ZERO if motor is None else multiply(motor.inertia, _square(motor.ratio))


def resistance(friction: Friction | None, variable: str) -> tuple[Expr, ...]:
    """The terms of friction in the equation of a joint."""
    if friction is None:
        return ()
    rate = Symbol(f"{variable}_dot")
    terms = multiply(friction.viscous, rate), multiply(friction.coulomb, Call("sign", (rate,)))
    return tuple(term for term in terms if term != ZERO)


def _square(ratio: Expr) -> Expr:
    return ONE if ratio == ONE else ratio**2
