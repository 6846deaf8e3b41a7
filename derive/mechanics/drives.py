"""What a joint adds to the mechanics of its links: the rotor of its motor, and friction."""

from __future__ import annotations

from dataclasses import dataclass

from derive.expression import ONE, ZERO, Call, Expr, Symbol, add, multiply


@dataclass(frozen=True, slots=True)
class Motor:
    """A rotor of `inertia` about its own axis (kg m^2) that turns `ratio` times as fast as its joint
    (for a prismatic joint: in rad/m).

    Its mass belongs to the link it sits on. Of its own spin only the part relative to its joint is
    counted, as for every large ratio (Spong et al., section 6.6; Siciliano et al., section 7.1.4, with
    the couplings of a rotor to the joints before it left out).
    """

    inertia: Expr
    ratio: Expr = ONE


@dataclass(frozen=True, slots=True)
class Friction:
    """B qdot + tau_c sign(qdot): viscous (N m s, or N s/m) and Coulomb friction (N m, or N)."""

    viscous: Expr = ZERO
    coulomb: Expr = ZERO


def reflected(motor: Motor | None) -> Expr:
    """G^2 J: the rotor as its joint feels it (kg m^2; kg for a prismatic joint)."""
    return ZERO if motor is None else multiply(_square(motor.ratio), motor.inertia)


def resistance(friction: Friction | None, variable: str) -> tuple[Expr, ...]:
    """The terms of friction in the equation of a joint."""
    if friction is None:
        return ()
    rate = Symbol(f"{variable}_dot")
    terms = multiply(friction.viscous, rate), multiply(friction.coulomb, Call("sign", (rate,)))
    return tuple(term for term in terms if term != ZERO)


def friction_force(friction: Friction | None, variable: str) -> Expr:
    """Their sum, zero without friction."""
    return add(*resistance(friction, variable))


def _square(ratio: Expr) -> Expr:
    return ONE if ratio == ONE else ratio**2
