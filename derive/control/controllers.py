"""The controllers of a course, P, PI, PD and PID, in parallel form; and the loop they close by unity
feedback: U = C (R - Y), Y = G U."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

from derive.algebra.readable.terms import Style
from derive.control.rational import Rational, plus, times
from derive.control.ratios import PLAIN, Ratio, total
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, add, factors_of, multiply

S = Symbol("s")
Family: TypeAlias = Literal["P", "PI", "PD", "PID"]
FAMILIES: tuple[Family, ...] = get_args(Family)
GAINS = {"P": "K_p", "I": "K_i", "D": "K_d"}


@dataclass(frozen=True, slots=True)
class Controller:
    """K_p + K_i/s + K_d s, of which a family has some; `gains` in the order of its letters."""

    family: Family
    gains: tuple[Expr, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The usual names of its gains: K_p, K_i, K_d."""
        return tuple(GAINS[letter] for letter in self.family)

    @property
    def terms(self) -> tuple[Expr, ...]:
        """K_p, K_i/s, K_d s: what is added up."""
        return tuple(_term(letter, gain) for letter, gain in zip(self.family, self.gains, strict=True))

    @property
    def sum(self) -> Expr:
        """C(s) = K_p + K_i/s + K_d s, as far as the family has them."""
        return add(*self.terms)

    def ratio(self, style: Style = PLAIN) -> Ratio:
        """Over one denominator."""
        return total((Ratio.of(part) for part in self.terms), style)

    @property
    def integrates(self) -> bool:
        """Whether it has a term K_i/s."""
        return "I" in self.family

    @property
    def differentiates(self) -> bool:
        """Whether it has a term K_d s."""
        return "D" in self.family


def _term(letter: str, gain: Expr) -> Expr:
    match letter:
        case "I":
            return gain / S
        case "D":
            return multiply(*factors_of(gain), S)
        case _:
            return gain


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
