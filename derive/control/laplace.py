"""The second route: the equations solved in complex numbers, and Laplace transforms inverted in numbers."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from derive.algebra.numeric import number
from derive.control.signals import signals, unknowns
from derive.control.system import Equation, System
from derive.expression import Expr, Power, Product, Quotient, Sum, Symbol, free_symbols

EULER = 12  # terms averaged by Euler summation
DAMPING = 20.0  # e^-DAMPING is the error of the method


def value(expr: Expr, point: Mapping[str, complex]) -> complex:
    """A tree at complex values of some of its names."""
    if not any(isinstance(point[name], complex) for name in free_symbols(expr)):
        return complex(number(expr, {name: point[name].real for name in free_symbols(expr)}))
    match expr:
        case Symbol(name):
            return complex(point[name])
        case Sum(terms):
            return sum((value(term, point) for term in terms), 0j)
        case Product(factors):
            return math.prod((value(factor, point) for factor in factors), start=1 + 0j)
        case Quotient(top, bottom):
            return value(top, point) / value(bottom, point)
        case Power(base, exponent):
            return complex(value(base, point) ** value(exponent, point))
    raise ValueError(f"{type(expr).__name__} at complex numbers")


@dataclass(frozen=True, slots=True)
class Numeric:
    """The equations of a system at values of its parameters: output / source by solving them as typed."""

    system: System
    source: Symbol
    point: Mapping[str, float]
    found: tuple[Symbol, ...]  # its signals

    @staticmethod
    def of(system: System, source: Symbol, point: Mapping[str, float]) -> Numeric:
        return Numeric(system, source, point, signals(system))

    def gain(self, s: complex) -> complex:
        """output / source at one s, all other inputs zero."""
        import numpy

        matrix, drive, place = self._equations(s)
        return complex(numpy.linalg.solve(matrix, -drive)[place])

    def closed(self, s: complex, controller: Expr) -> complex:
        """output / reference of the loop: the input is one more unknown, u = C (r - y)."""
        import numpy

        matrix, drive, place = self._equations(s)
        strength = value(controller, {**self.point, "s": complex(s)})
        law = numpy.zeros(len(matrix) + 1, dtype=complex)
        law[place], law[-1] = strength, 1.0
        loop = numpy.vstack((numpy.column_stack((matrix, drive)), law))
        return complex(numpy.linalg.solve(loop, numpy.append(numpy.zeros(len(matrix)), strength))[place])

    def _equations(self, s: complex) -> tuple[Any, Any, int]:
        """(coefficients of the unknowns, of the source, place of the output among the unknowns)."""
        import numpy

        unknown = unknowns(self.system, self.found)
        quiet = {**self.point, "s": complex(s), **{each.name: 0j for each in self.found}}
        rows = [
            [_coefficient(equation, signal, quiet) for signal in (*unknown, self.source)]
            for equation in self.system.equations
        ]
        whole = numpy.array(rows, dtype=complex)
        return whole[:, :-1], whole[:, -1], unknown.index(self.system.output)


def _coefficient(equation: Equation, signal: Symbol, quiet: Mapping[str, complex]) -> complex:
    """What left - right is with this signal one and all others zero."""
    sides = (equation.left, equation.right)
    if not any(signal.name in free_symbols(side) for side in sides):
        return 0j
    at = {**quiet, signal.name: 1 + 0j}
    return value(equation.left, at) - value(equation.right, at)


def inverted(transform: Callable[[complex], complex], time: float, terms: int) -> float:
    """f(time) from its Laplace transform (Abate and Whitt, ORSA J. Computing 7, 1995: EULER).

    `terms` should exceed the fastest frequency of f times the time; the poles must lie left of
    DAMPING / (2 time).
    """
    partial = 0.5 * transform(complex(DAMPING / (2 * time))).real
    sums: list[float] = []
    for k in range(1, terms + EULER + 1):
        partial += (-1.0) ** k * transform(complex(DAMPING, 2 * math.pi * k) / (2 * time)).real
        if k >= terms:
            sums.append(partial)
    weighted = math.fsum(math.comb(EULER, k) * each for k, each in enumerate(sums)) / 2**EULER
    return float(math.exp(DAMPING / 2) / time * weighted)


def quotient(num: Sequence[float], den: Sequence[float], s: complex) -> complex:
    """num/den at s, coefficients highest power first."""
    return _horner(num, s) / _horner(den, s)


def _horner(coefficients: Sequence[float], s: complex) -> complex:
    total = 0j
    for coefficient in coefficients:
        total = total * s + coefficient
    return total


def is_close(left: complex, right: complex, tolerance: float = 1e-8) -> bool:
    return cmath.isclose(left, right, rel_tol=tolerance, abs_tol=tolerance)
