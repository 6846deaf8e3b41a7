"""Three angles for a rotation: any of the twelve sequences, about current or world axes.

Nothing is tabulated: the entries from which the angles are read off are found in the symbolic matrix of
the sequence (Siciliano et al., section 2.4; Spong et al., section 2.5). In the product R_1 R_2 R_3 of a
sequence one entry holds the middle angle alone, two entries hold the first and two the last angle, each
times the same function g of the middle angle. Where g vanishes only a sum or difference of the outer two
angles is determined.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, reduce
from itertools import product
from typing import Literal, TypeAlias

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import trig_of
from derive.algebra.scalar import Scalar
from derive.expression import Expr, Number, Symbol, add, atan2, multiply, number, sqrt
from derive.mechanics.motion import Move
from derive.mechanics.poses import UNIT, rotation

Sign: TypeAlias = Literal[1, -1]
SIGNS: tuple[Sign, Sign] = (1, -1)
COMBINATIONS: tuple[tuple[Sign, Sign], ...] = ((1, 1), (1, -1), (-1, 1))


@dataclass(frozen=True, slots=True)
class Convention:
    """Three axes in the order in which the rotations are made, about current or world axes."""

    axes: tuple[str, str, str]
    about: Literal["current", "world"]
    letters: str  # as it was typed

    @staticmethod
    def of(text: str) -> Convention:
        """From `ZYX` (current axes) or `xyz` (world axes), as SciPy writes them. Raises ValueError."""
        if len(text) != 3 or set(text.lower()) - set("xyz") or not (text.isupper() or text.islower()):
            raise ValueError("write three axes: ZYX about current axes, xyz about world axes")
        first, middle, last = tuple(text.lower())
        if middle in (first, last):
            raise ValueError("two rotations in a row about the same axis are one: only two angles remain")
        return Convention((first, middle, last), "current" if text.isupper() else "world", text)

    @property
    def proper(self) -> bool:
        """Whether the first axis comes again, as in ZYZ."""
        return self.axes[0] == self.axes[2]


@dataclass(frozen=True, slots=True)
class Entry:
    """An entry of the rotation matrix with a sign: `sign` times r_ij, indices from 0."""

    row: int
    col: int
    sign: Sign

    @property
    def name(self) -> Symbol:
        """How it is written: r_13."""
        return Symbol(f"r_{self.row + 1}{self.col + 1}")

    def signed(self, sign: Sign = 1) -> Expr:
        """The entry with its own sign times another."""
        return self.name if sign * self.sign > 0 else -self.name


@dataclass(frozen=True, slots=True)
class Direction:
    """The entries that are, up to their signs and a common factor, the sine and cosine of an angle."""

    sine: Entry
    cosine: Entry

    def angle(self, sign: Sign = 1) -> Expr:
        """The angle, the common factor being positive or negative."""
        return atan2(self.sine.signed(sign), self.cosine.signed(sign))


@dataclass(frozen=True, slots=True)
class Singular:
    """A value of the middle angle at which g vanishes. There the middle entry is `entry` (1 or -1), the
    matrix depends on signs[0] * first + signs[1] * last alone, and `direction` reads off that angle."""

    middle: Expr
    entry: Sign
    matrix: ScalarMatrix
    signs: tuple[Sign, Sign]
    direction: Direction


@dataclass(frozen=True)
class Euler:
    """The angles of a convention, named in the order in which the rotations are made."""

    convention: Convention
    names: tuple[str, str, str]

    @property
    def moves(self) -> tuple[Move, ...]:
        """The rotations in the order in which they are made."""
        about = self.convention.about
        pairs = zip(self.convention.axes, self.names, strict=True)
        return tuple(Move("rotate", _axis(axis), Symbol(name), about) for axis, name in pairs)

    @property
    def factors(self) -> tuple[Move, ...]:
        """The rotations as they stand in the product, from left to right."""
        return self.moves if self.convention.about == "current" else self.moves[::-1]

    @cached_property
    def outer(self) -> tuple[str, str, str]:
        """The names of the angles as they stand in the product."""
        return self.names if self.convention.about == "current" else self.names[::-1]

    @cached_property
    def matrix(self) -> ScalarMatrix:
        """R (3 by 3) of the three angles."""
        return self._matrix(*(trig_of(Scalar.symbol(name)) for name in self.outer))

    @property
    def even(self) -> bool:
        """Whether the middle entry is a cosine (ZYZ and the like), else a sine."""
        return self.convention.proper

    @cached_property
    def middle(self) -> Entry:
        """The entry that holds the middle angle alone: its cosine or its sine."""
        return _find(self.matrix, self._middle_pair[0 if self.even else 1])

    @cached_property
    def first(self) -> Direction:
        """The entries that hold the angle of the first factor of the product."""
        return self._direction(0)

    @cached_property
    def last(self) -> Direction:
        """The entries that hold the angle of the last factor."""
        return self._direction(2)

    @property
    def g(self) -> Expr:
        """The size of the common factor, from the entries of the first angle, in reading order."""
        entries = sorted((self.first.sine, self.first.cosine), key=lambda entry: (entry.row, entry.col))
        return sqrt(add(*(entry.name**2 for entry in entries)))

    def regular(self, sign: Sign) -> dict[str, Expr]:
        """The angles by their names where g has this sign."""
        size = self.g if sign > 0 else -self.g
        here = self.middle.signed()
        middle = atan2(size, here) if self.even else atan2(here, size)
        first, centre, last = self.outer
        found = {first: self.first.angle(sign), centre: middle, last: self.last.angle(sign)}
        return {name: found[name] for name in self.names}

    def singular(self, entry: Sign) -> Singular:
        """What is left where the middle entry, without its own sign, is 1 or -1."""
        fixed = _quarter(self.even, entry)
        matrix = self._matrix(
            trig_of(Scalar.symbol(self.outer[0])),
            trig_of(Scalar.symbol("pi") * fixed.value),
            trig_of(Scalar.symbol(self.outer[2])),
        )
        signs, direction = self._combination(matrix)
        value: Sign = 1 if entry * self.middle.sign > 0 else -1
        return Singular(multiply(fixed, Symbol("pi")), value, matrix, signs, direction)

    def singular_angles(self, case: Singular) -> dict[str, Expr]:
        """The angles of a singular case; the last of the product is free and stands for itself."""
        first, centre, last = self.outer
        sign, of_last = case.signs
        angle = case.direction.angle() if sign > 0 else -case.direction.angle()
        other = Symbol(last) if sign * of_last < 0 else -Symbol(last)
        terms = (angle, other) if sign > 0 else (other, angle)
        found = {first: add(*terms), centre: case.middle, last: Symbol(last)}
        return {name: found[name] for name in self.names}

    def _combination(self, matrix: ScalarMatrix) -> tuple[tuple[Sign, Sign], Direction]:
        """Which sum or difference of the outer angles a singular matrix holds, and the first column that
        has both its sine and its cosine; the difference is taken so that its sine stands there bare."""
        first, last = map(Scalar.symbol, (self.outer[0], self.outer[2]))
        found = []
        for col, signs in product(range(3), COMBINATIONS):
            c, s = trig_of(signs[0] * first + signs[1] * last)
            sine, cosine = _search(matrix, s, (col,)), _search(matrix, c, (col,))
            if sine and cosine:
                found.append((signs, Direction(sine, cosine)))
        if not found:
            raise ArithmeticError("the outer axes of a singular sequence are parallel")
        return min(found, key=lambda each: (each[1].sine.col, -each[1].sine.sign))

    @cached_property
    def _middle_pair(self) -> tuple[Scalar, Scalar]:
        return trig_of(Scalar.symbol(self.outer[1]))

    def _matrix(self, *pairs: tuple[Scalar, Scalar]) -> ScalarMatrix:
        turns = (rotation(move.axis, pair) for move, pair in zip(self.factors, pairs, strict=True))
        return reduce(ScalarMatrix.__matmul__, turns)

    def _direction(self, place: int) -> Direction:
        g = self._middle_pair[1 if self.even else 0]
        c, s = trig_of(Scalar.symbol(self.outer[place]))
        return Direction(_find(self.matrix, g * s), _find(self.matrix, g * c))


def rate_matrix(euler: Euler, seen_from: Literal["base", "body"] = "base") -> ScalarMatrix:
    """T (3 by 3) of omega = T times the rates of the angles (Siciliano et al., section 3.6): for each angle,
    in the order in which the rotations are made, the axis of its rotation where those before it in the
    product have carried it; in the body's own axes by R^T."""
    carried = ScalarMatrix.identity(3)
    columns: dict[str, ScalarMatrix] = {}
    for move, name in zip(euler.factors, euler.outer, strict=True):
        columns[name] = carried @ ScalarMatrix.column(UNIT[str(move.axis)])
        carried = carried @ rotation(move.axis, trig_of(Scalar.symbol(name)))
    T = ScalarMatrix.beside([columns[name] for name in euler.names])
    return T if seen_from == "base" else euler.matrix.T @ T


def _find(matrix: ScalarMatrix, value: Scalar) -> Entry:
    """The entry equal to plus or minus a value."""
    found = _search(matrix, value)
    if found is None:
        raise ArithmeticError(f"no entry of the matrix is {value}")
    return found


def _search(matrix: ScalarMatrix, value: Scalar, cols: tuple[int, ...] = (0, 1, 2)) -> Entry | None:
    """The first entry, in reading order, that is plus or minus a value."""
    for row, col, sign in product(range(3), cols, SIGNS):
        if matrix[row, col] == sign * value:
            return Entry(row, col, sign)
    return None


def _quarter(even: bool, entry: Sign) -> Number:
    """The middle angle in multiples of pi at which its cosine (even) or sine is 1 or -1."""
    if even:
        return number(0 if entry > 0 else 1)
    return number("1/2" if entry > 0 else "-1/2")


def _axis(letter: str) -> Literal["x", "y", "z"]:
    return "x" if letter == "x" else "y" if letter == "y" else "z"
