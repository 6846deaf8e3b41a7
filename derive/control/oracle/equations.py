"""The equations of a system solved as they are typed, in complex numbers."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

from derive.algebra.fold import Domain, fold
from derive.algebra.numbers.floats import FUNCTIONS
from derive.control.signals import signals, unknowns
from derive.control.system import Equation, System
from derive.expression import Expr, Number, Power, Quotient, Symbol, free_symbols, walk


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
        return complex(math.pi) if name == "pi" else self.point[name]

    def power(self, base: complex, exponent: complex) -> complex:
        whole = exponent.imag == 0 and exponent.real.is_integer()
        return base ** (int(exponent.real) if whole else exponent)

    def call(self, function: str, arguments: list[complex]) -> complex:
        if any(each.imag for each in arguments):
            raise ValueError(f"{function} at complex numbers")
        known = function in FUNCTIONS
        return complex(
            FUNCTIONS[function](*(each.real for each in arguments)) if known else self.refuse(function)
        )


def pid(family: str, gains: Sequence[complex], s: complex) -> complex:
    """A controller at one s, the letters of its family in order: it multiplies, integrates,
    differentiates."""
    works = {"P": 1.0 + 0j, "I": 1 / s, "D": s}
    return sum((gain * works[letter] for letter, gain in zip(family, gains, strict=True)), 0j)


def value(expr: Expr, point: Mapping[str, complex]) -> complex:
    """A tree at complex values of some of its names. Raises ValueError for a function of what is not real."""
    return fold(expr, _Complex(point))


def value_over(expr: Expr, s: Any) -> Any:
    """A function of s without other symbols, at each place of an array."""
    return fold(expr, _Complex({"s": s})) + 0 * s  # of a constant an array too


@dataclass(frozen=True, slots=True)
class Numeric:
    """The equations of a system at values of its parameters: output / source by solving them as typed."""

    system: System
    source: Symbol
    point: Mapping[str, float]
    unknown: tuple[Symbol, ...]  # its signals but the inputs
    inputs: tuple[Symbol, ...]
    entries: tuple[tuple[int, int], ...]  # (equation, signal) where the one holds the other

    @staticmethod
    def of(system: System, source: Symbol, point: Mapping[str, float]) -> Numeric:
        """The equations at a point, driven by one of the inputs."""
        return Numeric(system, source, point, *_places(system))

    def gain(self, s: complex) -> complex:
        """output / source at one s, all other inputs zero."""
        return self.signals(s, {self.source: 1.0})[self.system.output.name]

    def signals(self, s: complex, driven: Mapping[Symbol, complex]) -> dict[str, complex]:
        """Every signal at one s, by name, for values of the inputs; inputs without one are zero."""
        import numpy

        matrix, drives = self._equations(s)
        drive = numpy.array([complex(driven.get(each, 0.0)) for each in self.inputs])
        found = numpy.linalg.solve(matrix, -drives @ drive)
        names = (each.name for each in (*self.unknown, *self.inputs))
        return {name: complex(x) for name, x in zip(names, (*found, *drive), strict=True)}

    def closed(self, s: complex, controller: complex) -> complex:
        """output / reference of the loop: the input is one more unknown, u = C (r - y)."""
        import numpy

        loop = self.loop(s, controller)
        wanted = numpy.append(numpy.zeros(len(loop) - 1), controller)
        return complex(numpy.linalg.solve(loop, wanted)[self.unknown.index(self.system.output)])

    def disturbed(self, s: complex, controller: complex) -> dict[str, complex]:
        """Every unknown of the loop at one s, by name, for a disturbance of 1 and no reference."""
        import numpy

        drives = self._equations(s)[1]
        found = numpy.linalg.solve(self.loop(s, controller), numpy.append(-drives[:, 1], 0.0))
        return {each.name: complex(x) for each, x in zip(self.unknown, found, strict=False)}

    def loop(self, s: complex, controller: complex) -> Any:
        """The coefficients of the unknowns and of the input at one s, the law of the controller below."""
        import numpy

        matrix, drives = self._equations(s)
        law = numpy.zeros(len(matrix) + 1, dtype=complex)
        law[self.unknown.index(self.system.output)], law[-1] = controller, 1.0
        return numpy.vstack((numpy.column_stack((matrix, drives[:, 0])), law))

    def matrix(self, s: complex) -> Any:
        """The coefficients of the unknowns at one s."""
        return self._equations(s)[0]

    def _equations(self, s: complex) -> tuple[Any, Any]:
        """The coefficients of the unknowns and of the inputs, a row for each equation."""
        import numpy

        columns = (*self.unknown, *self.inputs)
        quiet = {**self.point, "s": complex(s), **{each.name: 0j for each in columns}}
        whole = numpy.zeros((len(self.system.equations), len(columns)), dtype=complex)
        for row, column in self.entries:
            whole[row, column] = _coefficient(self.system.equations[row], columns[column], quiet)
        return whole[:, : len(self.unknown)], whole[:, len(self.unknown) :]


@lru_cache(maxsize=16)
def _places(system: System) -> tuple[tuple[Symbol, ...], tuple[Symbol, ...], tuple[tuple[int, int], ...]]:
    """The unknowns and the inputs, and which equation holds which of them."""
    unknown = unknowns(system, signals(system))
    inputs = tuple(each for each in (system.input, system.disturbance) if each is not None)
    inside = [free_symbols(each.left) | free_symbols(each.right) for each in system.equations]
    entries = tuple(
        (row, column)
        for row, names in enumerate(inside)
        for column, signal in enumerate((*unknown, *inputs))
        if signal.name in names
    )
    return unknown, inputs, entries


def divides_by_s(system: System) -> bool:
    """Whether an equation has s below a bar."""
    sides = (side for equation in system.equations for side in (equation.left, equation.right))
    return any(
        (isinstance(node, Quotient) and "s" in free_symbols(node.denominator))
        or (isinstance(node, Power) and "s" in free_symbols(node.base) and not _counts_up(node.exponent))
        for side in sides
        for node in walk(side)
    )


def _counts_up(exponent: Expr) -> bool:
    return isinstance(exponent, Number) and exponent.value >= 0 and exponent.value.denominator == 1


def _coefficient(equation: Equation, signal: Symbol, quiet: Mapping[str, complex]) -> complex:
    """What left - right is with this signal one and all others zero."""
    at = {**quiet, signal.name: 1 + 0j}
    return value(equation.left, at) - value(equation.right, at)


def quotient(num: Sequence[complex], den: Sequence[complex], s: complex) -> complex:
    """num/den at s, coefficients highest power first."""
    return _horner(num, s) / _horner(den, s)


def _horner(coefficients: Sequence[complex], s: complex) -> complex:
    total = 0j
    for coefficient in coefficients:
        total = total * s + coefficient
    return total


def is_close(left: complex, right: complex, tolerance: float = 1e-8) -> bool:
    """Whether two numbers agree to a relative tolerance."""
    return cmath.isclose(left, right, rel_tol=tolerance, abs_tol=tolerance**2)
