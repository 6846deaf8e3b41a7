"""The motor and the friction of a joint as an exercise gives them."""

from __future__ import annotations

from dataclasses import dataclass

from derive.expression import ONE, ZERO, Expr


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
