"""Motions that the equations hold but the transfer function does not show."""

from __future__ import annotations

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.control.exact import divided
from derive.control.linear import cleared, one_side
from derive.control.rational import Polynomial, polynomial, scalar, shared
from derive.control.signals import signals, unknowns
from derive.control.system import System

MOST = 12  # equations whose determinant is taken


def hidden(system: System, den: Polynomial, decimals: bool) -> Polynomial:
    """What the determinant of the equations has beyond a denominator; (1,) where there is nothing.

    Equations with more than MOST unknown signals are not looked into.
    """
    found = signals(system)
    columns = unknowns(system, found)
    if len(columns) > MOST:
        return (Scalar.of(1),)
    rows = [cleared(one_side(equation, found, decimals)) for equation in system.equations]
    entries = ([scalar(row.get(signal, ())) for signal in columns] for row in rows)
    determinant = polynomial(ScalarMatrix.of(entries).det())
    beside, rest = divided(determinant, den)
    if rest or len(beside) < 2:
        return (Scalar.of(1),)
    return tuple(k / shared(beside) for k in beside)
