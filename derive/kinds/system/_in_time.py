"""A step response as it is written: the sum of its modes, in fractions where all of its numbers are some."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import factorial

from flint import acb, arb, ctx, fmpq

from derive.algebra.normal import normal
from derive.algebra.readable.form import readable
from derive.algebra.readable.terms import Style
from derive.control.modes import Curve, Mode
from derive.control.rational import Rational, S
from derive.expression import (
    ONE,
    ZERO,
    Approximate,
    Call,
    Expr,
    Symbol,
    add,
    cos,
    is_negative,
    multiply,
    negate,
    number,
    sin,
    sqrt,
)

T = Symbol("t")
MOST_TERMS = 5  # that a person reads
LARGEST = 1000  # of a denominator
NOTHING = 1e-9  # of the largest coefficient
SURE = 2.0**-60  # how closely a number is a fraction, of which a proof follows


@dataclass(frozen=True, slots=True)
class Term:
    """t^power e^(rate t) (cosine cos(swing t) + sine sin(swing t)); without a swing the cosine alone."""

    power: int
    rate: Expr
    cosine: Expr
    swing: Expr = ZERO
    sine: Expr = ZERO

    def in_time(self) -> Expr:
        """As a function of t, a minus sign in front of all."""
        angle = _times(self.swing, T)
        waves = [(self.cosine, ONE if self.swing == ZERO else cos(angle)), (self.sine, sin(angle))]
        waves = [(k, wave) for k, wave in waves if k != ZERO]
        back = is_negative(waves[0][0])
        waves = [(negate(k) if back else k, wave) for k, wave in waves]
        power = T if self.power == 1 else T ** number(self.power) if self.power else ONE
        decay = ONE if self.rate == ZERO else Call("exp", (_times(self.rate, T),))
        (first, wave), *others = waves
        order: tuple[Expr, ...] = (first, power, decay, wave)
        if others:
            order = (power, decay, add(*(_times(k, each) for k, each in waves)))
        kept = [each for each in order if each != ONE] or [ONE]
        return negate(multiply(*kept)) if back else multiply(*kept)

    def transform(self) -> Expr:
        """Its Laplace transform, of a swing for the power 0 alone."""
        apart = S - self.rate
        if self.swing == ZERO:
            return self.cosine * number(factorial(self.power)) / apart ** number(self.power + 1)
        return (self.cosine * apart + self.sine * self.swing) / (apart ** number(2) + self.swing ** number(2))


def response_in_time(curve: Curve, numeric: Rational, style: Style) -> Expr | None:
    """The response of a function of s as a function of t; None where it has more terms than are read."""
    with ctx.workprec(curve.bits):
        if sum(max(mode.factor.degree(), 0) + 1 for mode in curve.modes) > MOST_TERMS:
            return None
        exact = [*_exactly(curve, style)]
        terms = [each for each in exact if each]
        if len(terms) < len(exact) or not is_transform(terms, numeric):
            terms = [*_rounded(curve)]
    return add(*(term.in_time() for term in terms)) if terms else None


def is_transform(terms: Sequence[Term], numeric: Rational) -> bool:
    """Whether the transforms of exact terms make up that of the response."""
    whole = add(*(term.transform() for term in terms)) if terms else ZERO
    return normal(whole) == normal(numeric.expr() / S)


def _times(k: Expr, by: Expr) -> Expr:
    return by if k == ONE else k if by == ONE else multiply(k, by)


def _exactly(curve: Curve, style: Style) -> Iterator[Term | None]:
    """The terms in fractions and roots of fractions; None for one that is written otherwise."""

    def written(value: Fraction, under: Fraction = Fraction(1)) -> Expr:
        return readable(normal(number(value) / sqrt(number(under))), style)

    for mode in curve.modes:
        rate, square = _fraction(mode.pole.real), _fraction(mode.pole.imag**2)
        for power, k in enumerate(mode.coefficients):
            parts = _fraction(k.real), _fraction(-k.imag * mode.pole.imag)
            if None in (rate, square, *parts) or (square and power):
                yield None
                continue
            cosine, sine = (part or Fraction(0) for part in parts)
            if cosine or sine:
                swing = readable(normal(sqrt(number(square or Fraction(0)))), style)
                wave = written(sine, square) if square and sine else ZERO
                yield Term(power, written(rate or Fraction(0)), written(cosine), swing, wave)


def _fraction(ball: arb) -> Fraction | None:
    """The fraction that the ball holds, if there is a short one."""
    found = Fraction(float(ball.mid())).limit_denominator(LARGEST)
    close = abs(ball - arb(fmpq(found.numerator, found.denominator))) < SURE
    return found if close else None


def _rounded(curve: Curve) -> Iterator[Term]:
    largest = max((abs(complex(k)) for mode in curve.modes for k in mode.coefficients), default=0.0)
    for mode in curve.modes:
        for power, k in enumerate(mode.coefficients):
            yield from _rounded_term(mode, power, k, NOTHING * largest)


def _rounded_term(mode: Mode, power: int, k: acb, least: float) -> Iterator[Term]:
    rate, swing = complex(mode.pole).real, complex(mode.pole).imag
    cosine, sine = complex(k).real, -complex(k).imag if swing else 0.0
    parts = [_number(part) if abs(part) > least else ZERO for part in (cosine, sine)]
    if parts != [ZERO, ZERO]:
        yield Term(power, _number(rate), parts[0], _number(swing), parts[1])


def _number(value: float) -> Expr:
    """A whole number stays what it is, one that is hardly none too."""
    whole = round(value)
    return number(whole) if abs(value - whole) < NOTHING else Approximate(value)
