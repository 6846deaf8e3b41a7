"""The loop closed by unity feedback: U = C (R - Y), Y = G U."""

from __future__ import annotations

from dataclasses import dataclass

from derive.control.rational import Rational, plus, times
from derive.errors import NotDerivable


@dataclass(frozen=True, slots=True)
class Loop:
    """T = C G / (1 + C G) = N_C N_G / (D_C D_G + N_C N_G), nothing cancelled."""

    controller: Rational
    plant: Rational

    @property
    def open(self) -> Rational:
        """C G."""
        return Rational(
            times(self.controller.num, self.plant.num), times(self.controller.den, self.plant.den)
        )

    @property
    def closed(self) -> Rational:
        """T. Raises NotDerivable where 1 + C G is zero."""
        den = plus(self.open.den, self.open.num)
        if not den:
            raise NotDerivable("1 + C G is zero: this loop has no response")
        return Rational(self.open.num, den)
