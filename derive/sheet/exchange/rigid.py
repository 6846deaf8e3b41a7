"""Poses and bodies in numbers, exact as long as they can be: what is welded together becomes one body."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

from derive.sheet.exchange.values import EXACT, Value, cosine_and_sine

Vector: TypeAlias = tuple[Value, Value, Value]
Rows: TypeAlias = tuple[Vector, Vector, Vector]

ORIGIN: Vector = (Fraction(0), Fraction(0), Fraction(0))
LEVEL: Rows = (
    (Fraction(1), Fraction(0), Fraction(0)),
    (Fraction(0), Fraction(1), Fraction(0)),
    (Fraction(0), Fraction(0), Fraction(1)),
)


@dataclass(frozen=True, slots=True)
class Pose:
    """A frame in another: R (3 by 3) and p (m)."""

    R: Rows = LEVEL
    p: Vector = ORIGIN

    def __matmul__(self, other: Pose) -> Pose:
        return Pose(product(self.R, other.R), self.of(other.p))

    def of(self, point: Vector) -> Vector:
        """A point of the frame, in the other."""
        return added(turned(self.R, point), self.p)


@dataclass(frozen=True, slots=True)
class Mass:
    """mass (kg), com (m) and I about the com (3 by 3, kg m^2), in one frame."""

    mass: Value
    com: Vector
    inertia: Rows


def vector(entries: Iterable[Value]) -> Vector:
    """Three entries."""
    x, y, z = entries
    return x, y, z


def rows(entries: Iterable[Iterable[Value]]) -> Rows:
    """Three by three entries."""
    first, second, third = map(vector, entries)
    return first, second, third


def added(a: Vector, b: Vector) -> Vector:
    """a + b."""
    return vector(x + y for x, y in zip(a, b, strict=True))


def turned(R: Rows, v: Vector) -> Vector:
    """R v."""
    return vector(_dot(row, v) for row in R)


def product(A: Rows, B: Rows) -> Rows:
    """A B."""
    return rows([[_dot(row, column) for column in zip(*B, strict=True)] for row in A])


def transposed(R: Rows) -> Rows:
    """R^T."""
    return rows(zip(*R, strict=True))


def rotation(rpy: Vector, within: float = EXACT) -> Rows:
    """R_z(yaw) R_y(pitch) R_x(roll) of URDF's roll, pitch and yaw (rad)."""
    R = LEVEL
    for k in (2, 1, 0):
        c, s = cosine_and_sine(rpy[k], within)
        i, j = (k + 1) % 3, (k + 2) % 3
        turn: list[list[Value]] = [list(row) for row in LEVEL]
        turn[i][i], turn[i][j], turn[j][i], turn[j][j] = c, -s, s, c
        R = product(R, rows(turn))
    return R


def seen_from(pose: Pose, body: Mass) -> Mass:
    """A body given in a frame, in the frame in which that one stands."""
    return Mass(body.mass, pose.of(body.com), product(product(pose.R, body.inertia), transposed(pose.R)))


def welded(bodies: Sequence[Mass]) -> Mass | None:
    """Several bodies of one frame as one, None where nothing has a mass or an inertia."""
    heavy = [body for body in bodies if body.mass or any(map(any, body.inertia))]
    if len(heavy) < 2:
        return heavy[0] if heavy else None
    mass = sum((body.mass for body in heavy), start=Fraction(0))
    moment = [sum((body.mass * body.com[i] for body in heavy), start=Fraction(0)) for i in range(3)]
    com = vector(each / mass for each in moment) if mass else ORIGIN
    inertia = [
        [Fraction(0) + sum(_about(com, body)[i][j] for body in heavy) for j in range(3)] for i in range(3)
    ]
    return Mass(mass, com, rows(inertia))


def _about(point: Vector, body: Mass) -> Rows:
    """I of a body about a point: Steiner's theorem."""
    r = vector(x - y for x, y in zip(body.com, point, strict=True))
    square = _dot(r, r)
    return rows(
        [body.inertia[i][j] + body.mass * ((square if i == j else 0) - r[i] * r[j]) for j in range(3)]
        for i in range(3)
    )


def _dot(a: Sequence[Value], b: Sequence[Value]) -> Value:
    terms = (x * y for x, y in zip(a, b, strict=True) if x and y)  # an exact zero takes a rounded factor away
    return sum(terms, start=Fraction(0))
