"""The sub-problems: the forms in which equations can be solved for one joint variable.

a cos q + b sin q = c, alone and in pairs (Siciliano et al., section 2.12; Craig, chapter 4); the law of
cosines at an elbow, and the length of a sliding joint, by squaring and adding coordinates, for a sum of
squares holds fewer joint variables than each of them (the third sub-problem of Paden and Kahan; Murray, Li
and Sastry, section 3.3); and what is linear in a displacement.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import combinations
from operator import add
from typing import Literal, TypeAlias

from derive.algebra.angles import Form
from derive.algebra.scalar import Scalar
from derive.mechanics.inverse.paul import Equation

Method: TypeAlias = Literal["direction", "difference", "determinant"]


@dataclass(frozen=True, slots=True)
class TrigEquation:
    """a cos q + b sin q = c, and the equation that says so."""

    a: Scalar
    b: Scalar
    c: Scalar
    equation: Equation

    def negated(self) -> TrigEquation:
        """The same equation with its signs turned."""
        return TrigEquation(-self.a, -self.b, -self.c, self.equation)

    @property
    def terms(self) -> int:
        """How many terms it has."""
        return sum(len(part.numerator) for part in (self.a, self.b, self.c))


@dataclass(frozen=True, slots=True)
class Coordinate:
    """known = unknown: an equation with everything that is known on one side."""

    equation: Equation
    known: Scalar
    unknown: Scalar


@dataclass(frozen=True, slots=True)
class OneEquation:
    """Two angles satisfy one equation where a^2 + b^2 > c^2, one where they are equal, else none."""

    unknown: Form
    row: TrigEquation


@dataclass(frozen=True, slots=True)
class TwoEquations:
    """One angle satisfies two equations, where the determinant of their coefficients is not zero.

    direction: cos and sin each stand alone; difference: the coefficients are (k1, -k2) and (k2, k1), so
    that the angle is a difference of two directions; determinant: by Cramer's rule.
    """

    unknown: Form
    first: TrigEquation
    second: TrigEquation
    method: Method

    @property
    def determinant(self) -> Scalar:
        """That of the coefficients."""
        return self.first.a * self.second.b - self.first.b * self.second.a

    @property
    def shared(self) -> bool:
        """Whether cosine and sine, each alone, have the same factor up to a number."""
        ratio = self.second.b / self.first.a if self.first.a and self.second.b else None
        return ratio is not None and ratio.constant is not None


@dataclass(frozen=True, slots=True)
class Joined(TwoEquations):
    """Two equations that hold another angle too, and were joined to find that."""


TrigPolynomial: TypeAlias = Mapping[tuple[int, int], Scalar]  # by powers of cosine and sine


@dataclass(frozen=True, slots=True)
class Quartic:
    """A distance, from `coordinates`, and a `height` as a c + b s = c_1 (`distance`) and -b c + a s = c_2
    (`turned`) in another angle: their squares hold the unknown alone, as a polynomial in its cosine and sine
    (`trig`), and with the tangent of its half, `root`, as a product of `factors`, each by its coefficients
    with the highest power first."""

    unknown: Form
    second: Form
    first: str
    coordinates: tuple[Coordinate, ...]
    height: Equation
    distance: TrigEquation
    turned: TrigEquation
    trig: TrigPolynomial
    root: str
    factors: tuple[tuple[Scalar, ...], ...]


@dataclass(frozen=True, slots=True)
class Elbow:
    """The law of cosines: the sum of the squares of the known sides is a cos q + b sin q + constant. `row`
    holds a, b, and the negative of the constant alone, without the squares. The known sides may hold other
    unknowns that leave the sum of their squares, which is `across` then: the distance between two points on
    either side of the joints in which they are."""

    unknown: Form
    coordinates: tuple[Coordinate, ...]
    row: TrigEquation
    across: Scalar | None = None


@dataclass(frozen=True, slots=True)
class Reach:
    """The sum of the squares of the known sides is square d^2 + linear d + constant."""

    unknown: str
    coordinates: tuple[Coordinate, ...]
    square: Scalar
    linear: Scalar
    constant: Scalar


@dataclass(frozen=True, slots=True)
class Slide:
    """slope d = value."""

    unknown: str
    slope: Scalar
    value: Scalar
    equation: Equation


@dataclass(frozen=True, slots=True)
class Quadratic:
    """The squares of `coordinates` hold two displacements and no angle, the `height` gives one of them by the
    other, linearly: put in, a d^2 + b d + c = 0 of the other, with these `coefficients`. The first may be
    zero."""

    unknown: str
    height: Slide
    coordinates: tuple[Equation, ...]
    coefficients: tuple[Scalar, Scalar, Scalar]


@dataclass(frozen=True, slots=True)
class DoubleAngle:
    """The product of the `first` pair is `ratio` times that of the `second`: of the known sides, in an angle,
    as of the others. So a cos 2q + b sin 2q = c, with these `coefficients`; 2q is the unknown."""

    unknown: str
    angle: Form
    first: tuple[Coordinate, Coordinate]
    second: tuple[Coordinate, Coordinate]
    ratio: Scalar
    coefficients: tuple[Scalar, Scalar, Scalar]


@dataclass(frozen=True, slots=True)
class HalfAngle:
    """An angle of which twice is known by a name."""

    unknown: Form
    double: str


SubProblem: TypeAlias = (
    OneEquation | TwoEquations | Elbow | Reach | Slide | Quadratic | Quartic | DoubleAngle | HalfAngle
)


def equations_of(found: SubProblem) -> tuple[Equation, ...]:
    """The equations a sub-problem rests on."""
    match found:
        case OneEquation(_, row):
            return (row.equation,)
        case Joined() | HalfAngle():
            return ()
        case DoubleAngle():
            return tuple(each.equation for each in (*found.first, *found.second))
        case TwoEquations(_, first, second):
            return first.equation, second.equation
        case Quartic():
            parts = tuple(each.equation for each in found.coordinates)
            return parts if found.height in parts else (*parts, found.height)
        case Slide():
            return (found.equation,)
        case Quadratic(height=height, coordinates=coordinates):
            among = any(each.place == height.equation.place for each in coordinates)
            return coordinates if among else (*coordinates, height.equation)
        case Elbow() | Reach():
            return tuple(each.equation for each in found.coordinates)


def trig_equation(value: Scalar, angle: Form, equation: Equation) -> TrigEquation | None:
    """The coefficients where an expression is a cos q + b sin q - c; None where it is not of that form."""
    found = _coefficients(value, (f"cos({angle})", f"sin({angle})"), ((1, 0), (0, 1), (0, 0)))
    if found is None or not (found[0] or found[1]):
        return None
    a, b, c = found
    return TrigEquation(a, b, -c, equation)


def double_angle(value: Scalar, angle: Form) -> tuple[Scalar, Scalar, Scalar] | None:
    """(a, b, c) where an expression is a cos 2q + b sin 2q - c; None where it is not of that form."""
    powers = ((2, 0), (1, 1), (0, 2), (0, 0))
    found = _coefficients(value, (f"cos({angle})", f"sin({angle})"), powers)
    if found is None or not any(found[:3]):
        return None
    cosines, products, sines, rest = found
    return (cosines - sines) / 2, products / 2, -(rest + (cosines + sines) / 2)


def two_equations(angle: Form, one: TrigEquation, other: TrigEquation) -> TwoEquations:
    """Two equations in the order and with the signs in which they are solved most plainly."""
    first, second = (other, one) if one.a == 0 or other.b == 0 else (one, other)
    if first.b == 0 and second.a == 0:
        return TwoEquations(angle, first, second, "direction")
    for row, partner in ((first, second), (second, first)):
        for turned in (partner, partner.negated()):
            if turned.a == -row.b and turned.b == row.a:
                return TwoEquations(angle, row, turned, "difference")
    return TwoEquations(angle, first, second, "determinant")


def slide(difference: Scalar, name: str, equation: Equation) -> Slide | None:
    """From slope d - value; None where it is not of that form."""
    found = _coefficients(difference, (name,), ((1,), (0,)))
    return Slide(name, found[0], -found[1], equation) if found and found[0] else None


def split(equation: Equation, value: Scalar, unknown: frozenset[str]) -> Coordinate:
    """right - left, sorted into what holds unknown generators and what does not."""
    home = value.ring
    outer = home.without(value.numerator, unknown)
    return Coordinate(equation, -Scalar(home, outer), Scalar(home, value.numerator - outer))


def subsets(coordinates: Sequence[Coordinate]) -> Iterator[tuple[Coordinate, ...]]:
    """All three coordinates, then two of them; those without unknowns apart."""
    moving = [each for each in coordinates if each.unknown]
    for size in (3, 2):
        yield from combinations(moving, size)


def elbow(angle: Form, coordinates: tuple[Coordinate, ...], unknown: frozenset[str]) -> Elbow | None:
    """The sum of squares as an equation in one angle."""
    total = _sum_of_squares(coordinates)
    if set(total.generators()) & (unknown - {f"cos({angle})", f"sin({angle})"}):
        return None
    row = trig_equation(total, angle, coordinates[0].equation)
    return Elbow(angle, coordinates, row) if row else None


def across(
    angle: Form, group: Sequence[tuple[Equation, Scalar, Scalar]], unknown: frozenset[str]
) -> Elbow | None:
    """From the two sides of each of three coordinates, of which the left holds the angle and the right others
    that are `unknown`, but not its sum of squares once what it has of known terms is on the left."""
    own = {f"cos({angle})", f"sin({angle})"}
    coordinates = []
    for equation, left, right in group:
        if set(left.generators()) & (unknown - own) or set(right.generators()) & own:
            return None
        constant = split(equation, -right, unknown).known
        coordinates.append(Coordinate(equation, right - constant, left - constant))
    square = reduce(add, (each.known * each.known for each in coordinates))
    if not square or set(square.generators()) & unknown:
        return None
    row = trig_equation(_sum_of_squares(tuple(coordinates)), angle, coordinates[0].equation)
    return Elbow(angle, tuple(coordinates), row, square) if row else None


def reach(name: str, coordinates: tuple[Coordinate, ...], unknown: frozenset[str]) -> Reach | None:
    """The sum of squares as an equation in one displacement."""
    total = _sum_of_squares(coordinates)
    if set(total.generators()) & (unknown - {name}):
        return None
    found = _coefficients(total, (name,), ((2,), (1,), (0,)))
    return Reach(name, coordinates, *found) if found and found[0] else None


def _sum_of_squares(coordinates: tuple[Coordinate, ...]) -> Scalar:
    return reduce(add, (each.unknown * each.unknown for each in coordinates))


def _coefficients(
    value: Scalar, names: tuple[str, ...], powers: tuple[tuple[int, ...], ...]
) -> list[Scalar] | None:
    """Those of the given powers of some generators; None where others occur."""
    home = value.ring
    found = home.grouped(value.numerator, names)
    if not found.keys() <= set(powers):
        return None
    return [Scalar(home, found.get(key, home.zero)) for key in powers]
