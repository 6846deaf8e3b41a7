"""Motions that the equations hold but the transfer function does not show."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.control.linear import form_of
from derive.control.rational import Polynomial, Rational, polynomial, scalar, shared
from derive.control.signals import LAPLACE, signals, unknowns
from derive.control.system import Equation, System
from derive.expression import Symbol

MOST = 12  # equations whose determinant is taken


def hidden(system: System, den: Polynomial, decimals: bool) -> Polynomial:
    """What the determinant of the equations has beyond a denominator; (1,) where there is nothing.

    Equations with more than MOST unknown signals are not looked into.
    """
    found = signals(system)
    columns = unknowns(system, found)
    if len(columns) > MOST:
        return (Scalar.of(1),)
    rows = [_row(equation, found, decimals) for equation in system.equations]
    determinant = ScalarMatrix.of([row.get(signal, Scalar.of(0)) for signal in columns] for row in rows).det()
    rest = determinant / scalar(den)
    if not rest or _has_s_below(rest):
        return (Scalar.of(1),)
    beside = polynomial(Scalar(rest.ring, rest.numerator))
    return tuple(k / shared(beside) for k in beside) if len(beside) > 1 else (Scalar.of(1),)


def _row(equation: Equation, found: tuple[Symbol, ...], decimals: bool) -> dict[Symbol, Scalar]:
    """left - right, multiplied by every denominator with an s in it."""
    left, right = (form_of(side, found, decimals) for side in (equation.left, equation.right))
    values: dict[Symbol, Scalar] = {}
    for form, sign in ((left, 1), (right, -1)):
        for signal, ratio in form.items():
            values[signal] = values.get(signal, Scalar.of(0)) + Rational.of(ratio).value * sign
    below = Scalar.of(1)
    for value in values.values():
        rest = value * below
        if _has_s_below(rest) and rest.denominator is not None:
            below = below * Scalar(rest.ring, rest.denominator)
    return {signal: value * below for signal, value in values.items()}


def _has_s_below(value: Scalar) -> bool:
    if value.denominator is None:
        return False
    return LAPLACE.name in Scalar(value.ring, value.denominator).generators()
