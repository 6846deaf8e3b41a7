"""The second route: the equations solved in complex numbers, and Laplace transforms inverted in numbers."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence

from derive.algebra.numeric import number
from derive.control.signals import signals, unknowns
from derive.control.system import System
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


def gain(
    system: System,
    source: Symbol,
    point: Mapping[str, float],
    s: complex,
    controller: Callable[[complex], complex] | None = None,
) -> complex:
    """output / source at one s, all other inputs zero, by solving the equations as they were typed.

    With a controller, output / reference of the loop: the input is one more unknown, u = C (r - y).
    """
    import numpy

    unknown = list(unknowns(system, signals(system)))
    columns = [*unknown, source]
    rows = [
        [_coefficient(system, k, column, point, s) for column in columns]
        for k in range(len(system.equations))
    ]
    matrix = numpy.array([row[:-1] for row in rows], dtype=complex)
    drive = numpy.array([row[-1] for row in rows], dtype=complex)
    place = unknown.index(system.output)
    if controller is None:
        return complex(numpy.linalg.solve(matrix, -drive)[place])
    law = numpy.zeros(len(unknown) + 1, dtype=complex)
    law[place], law[-1] = controller(s), 1.0
    loop = numpy.vstack((numpy.column_stack((matrix, drive)), law))
    return complex(numpy.linalg.solve(loop, numpy.append(numpy.zeros(len(rows)), controller(s)))[place])


def _coefficient(system: System, row: int, signal: Symbol, point: Mapping[str, float], s: complex) -> complex:
    """What left - right is with this signal one and all others zero."""
    quiet: dict[str, complex] = {each.name: 0j for each in signals(system)}
    at = {**point, **quiet, "s": complex(s), signal.name: 1 + 0j}
    equation = system.equations[row]
    return value(equation.left, at) - value(equation.right, at)


def inverted(transform: Callable[[complex], complex], time: float, terms: int) -> float:
    """f(time) from its Laplace transform (Abate and Whitt, ORSA J. Computing 7, 1995: EULER).

    `terms` should exceed the fastest frequency of f times the time; the poles must lie left of
    DAMPING / (2 time).
    """
    partial = 0.5 * transform(complex(DAMPING / (2 * time))).real
    sums: list[float] = []
    for k in range(1, terms + EULER + 1):
        partial += (-1) ** k * transform(complex(DAMPING, 2 * math.pi * k) / (2 * time)).real
        if k >= terms:
            sums.append(partial)
    weighted = math.fsum(math.comb(EULER, k) * each for k, each in enumerate(sums)) / 2**EULER
    return math.exp(DAMPING / 2) / time * weighted


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
