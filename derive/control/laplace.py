"""The second route: the equations solved in complex numbers, and Laplace transforms inverted in numbers."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from derive.algebra.fold import Domain, fold
from derive.algebra.numbers.floats import FUNCTIONS
from derive.control.signals import signals, unknowns
from derive.control.system import Equation, System
from derive.expression import Expr, Symbol, free_symbols

EULER = 12  # terms averaged by Euler summation
DAMPING = 20.0  # e^-DAMPING is the error of the method


class _Complex(Domain[complex]):
    """Complex numbers; functions only of real ones."""

    def __init__(self, point: Mapping[str, complex]) -> None:
        self.point = point

    def number(self, value: Fraction) -> complex:
        return complex(float(value))

    def approximate(self, value: float) -> complex:
        return complex(value)

    def degrees(self, value: Fraction) -> complex:
        return complex(math.radians(float(value)))

    def symbol(self, name: str) -> complex:
        return complex(math.pi if name == "pi" else self.point[name])

    def call(self, function: str, arguments: list[complex]) -> complex:
        if any(each.imag for each in arguments):
            raise ValueError(f"{function} at complex numbers")
        known = function in FUNCTIONS
        return complex(
            FUNCTIONS[function](*(each.real for each in arguments)) if known else self.refuse(function)
        )


def value(expr: Expr, point: Mapping[str, complex]) -> complex:
    """A tree at complex values of some of its names. Raises ValueError for a function of what is not real."""
    return fold(expr, _Complex(point))


@dataclass(frozen=True, slots=True)
class Numeric:
    """The equations of a system at values of its parameters: output / source by solving them as typed."""

    system: System
    source: Symbol
    point: Mapping[str, float]
    found: tuple[Symbol, ...]  # its signals
    entries: tuple[tuple[int, int], ...]  # (equation, signal) where the one holds the other

    @staticmethod
    def of(system: System, source: Symbol, point: Mapping[str, float]) -> Numeric:
        """The equations at a point, driven by one of the inputs."""
        found = signals(system)
        columns = (*unknowns(system, found), source)
        entries = tuple(
            (row, column)
            for row, equation in enumerate(system.equations)
            for column, signal in enumerate(columns)
            if signal.name in free_symbols(equation.left) | free_symbols(equation.right)
        )
        return Numeric(system, source, point, found, entries)

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

    def matrix(self, s: complex) -> Any:
        """The coefficients of the unknowns at one s."""
        return self._equations(s)[0]

    def _equations(self, s: complex) -> tuple[Any, Any, int]:
        """(coefficients of the unknowns, of the source, place of the output among the unknowns)."""
        import numpy

        unknown = unknowns(self.system, self.found)
        quiet = {**self.point, "s": complex(s), **{each.name: 0j for each in self.found}}
        columns = (*unknown, self.source)
        whole = numpy.zeros((len(self.system.equations), len(columns)), dtype=complex)
        for row, column in self.entries:
            whole[row, column] = _coefficient(self.system.equations[row], columns[column], quiet)
        return whole[:, :-1], whole[:, -1], unknown.index(self.system.output)


def _coefficient(equation: Equation, signal: Symbol, quiet: Mapping[str, complex]) -> complex:
    """What left - right is with this signal one and all others zero."""
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
    """Whether two numbers agree to a relative tolerance."""
    return cmath.isclose(left, right, rel_tol=tolerance, abs_tol=tolerance**2)
