"""Points, complex ones, on which equations hold: to see whether something else vanishes there too.

An equation that is the last to hold a joint variable is solved for it in numbers: over z = e^(i q) it is a
polynomial, its coefficients a discrete Fourier transform of its values.
"""

from __future__ import annotations

import cmath
import random
from collections.abc import Iterator, Sequence

from flint import fmpq_mpoly

from derive.algebra.generators import Opaque
from derive.algebra.numbers.floats import atom_number
from derive.algebra.rationals import as_fraction
from derive.algebra.ring import Ring
from derive.algebra.scalar import Scalar

SMALL = 1e-7  # what is left of zero, relative to the terms
DEGREE = 6  # of an equation in one variable, at most
Point = dict[str, complex]


def vanishes_on(
    value: Scalar, equations: Sequence[tuple[str, Scalar]], turning: frozenset[str]
) -> list[bool]:
    """At points where all equations hold, every branch of them: whether the value is zero. `equations` are
    given with the variable each is solved for, which those after it do not hold."""
    return [_is_zero(value, point) for point in points_on(equations, turning, 2)]


def points_on(
    equations: Sequence[tuple[str, Scalar]], turning: frozenset[str], count: int
) -> Iterator[Point]:
    """All branches over so many points of the rest; `turning` are the angles among the names."""
    draw = random.Random(" ".join(name for name, _ in equations))
    for _ in range(count):
        yield from _branches(list(reversed(equations)), _Drawn(draw), turning)


class _Drawn(dict[str, complex]):
    """A point whose other coordinates are drawn when they are asked for."""

    def __init__(self, draw: random.Random, *known: Point) -> None:
        super().__init__(*known)
        self.draw = draw

    def __missing__(self, name: str) -> complex:
        self[name] = complex(
            self.draw.choice((1, -1)) if name.startswith("sign(") else self.draw.uniform(0.2, 1.9)
        )
        return self[name]


def _branches(equations: list[tuple[str, Scalar]], at: _Drawn, turning: frozenset[str]) -> Iterator[Point]:
    if not equations:
        yield at
        return
    (name, equation), *rest = equations
    for root in _roots(equation, name, at, name in turning):
        yield from _branches(rest, _Drawn(at.draw, {**at, name: root}), turning)


def _roots(equation: Scalar, name: str, at: _Drawn, turns: bool) -> list[complex]:
    import numpy as np

    size = 2 * DEGREE + 1
    circle = [cmath.exp(2j * cmath.pi * k / size) for k in range(size)]
    values = []
    for z in circle:
        at[name] = -1j * cmath.log(z) if turns else z
        values.append(_value(equation.numerator, equation.ring, at)[0])
    del at[name]
    powers = np.fft.fft(values) / size  # of z^k, k modulo the size
    ordered = np.roll(powers, DEGREE) if turns else powers
    ordered[np.abs(ordered) < 1e-11 * np.abs(ordered).max()] = 0
    found = [complex(z) for z in np.roots(ordered[::-1]) if z != 0 or not turns]
    return [-1j * cmath.log(z) for z in found] if turns else found


def _is_zero(value: Scalar, at: Point) -> bool:
    total, size = _value(value.numerator, value.ring, at)
    return abs(total) <= SMALL * max(size, 1e-12)


def _value(polynomial: fmpq_mpoly, home: Ring, at: Point) -> tuple[complex, float]:
    """(the value, the sum of the sizes of its terms)."""
    degrees = [int(d) for d in polynomial.degrees()]
    generators = {i: _generator(home, i, at) for i, d in enumerate(degrees) if d > 0}
    total, size = 0j, 0.0
    for exponents, k in polynomial.terms():
        term = complex(float(as_fraction(k)))
        for i, value in generators.items():
            if exponents[i]:
                term *= value ** int(exponents[i])
        total, size = total + term, size + abs(term)
    return total, size


def _generator(home: Ring, place: int, at: Point) -> complex:
    name, roots, angles = home.names[place], len(home.roots), len(home.angles)
    if place < roots:
        if name.startswith("sign("):
            return at[name]
        return cmath.sqrt(_value(home.polynomial(home.roots[place].radicand), home, at)[0])
    if place < roots + 2 * angles:
        k = (place - roots) % angles
        angle = sum(float(n) * _atom(atom, at) for atom, n in home.angles[k].parts)
        return cmath.sin(angle) if place < roots + angles else cmath.cos(angle)
    return complex(atom_number(name, _Real(at))) if isinstance(name, Opaque) else at[name]


def _atom(atom: str, at: Point) -> complex:
    """A joint variable may be complex, the rest is not."""
    return at[atom] if atom in at else complex(atom_number(atom, _Real(at)))


class _Real(dict[str, float]):
    """The real parts of a point: no joint variable stands inside a function."""

    def __init__(self, at: Point) -> None:
        super().__init__()
        self.at = at

    def __missing__(self, name: str) -> float:
        return self.at[name].real
