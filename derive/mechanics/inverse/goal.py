"""What is known of the end-effector: its coordinates by name, its orientation, or both."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import atan2
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import trig_of
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable, how_many
from derive.mechanics.poses import position_part, rotation_part

AXES = "xyz"


@dataclass(frozen=True, slots=True)
class Goal:
    """The known pose of the end-effector in the base, each part None where it is not known.

    `p` holds None for a coordinate that is not known. `places` says which entry of T each name stands for;
    `angle` is the name of an angle given in the plane of two base axes, from the first to the axis of the
    end-effector that is column `plane[2]` of R.
    """

    p: tuple[Scalar | None, ...]
    R: ScalarMatrix | None
    places: Mapping[str, tuple[int, int]]
    angle: str | None = None
    plane: tuple[int, int, int] = (0, 1, 0)

    @property
    def names(self) -> tuple[str, ...]:
        """Of everything that is known, the angle last."""
        return (*self.places, self.angle) if self.angle else tuple(self.places)

    def numbers(self, T: Any) -> dict[str, float]:
        """What is given, at a pose in floats (4 by 4)."""
        found = {name: float(T[i][j]) for name, (i, j) in self.places.items()}
        if self.angle:
            first, second, column = self.plane
            found[self.angle] = atan2(T[second][column], T[first][column])
        return found

    @property
    def whole_position(self) -> bool:
        """Whether x, y and z are known."""
        return None not in self.p

    @property
    def size(self) -> int:
        """How many joint variables it can determine at most: 6 of a pose, 3 of an orientation."""
        return {12: 6, 9: 3}.get(len(self.names), len(self.names))


def of_pose() -> Goal:
    """Everything: r11 ... r33, x, y, z."""
    return Goal(tuple(map(Scalar.symbol, AXES)), _rotation(), {**_entries(), **_coordinates(AXES, (0, 1, 2))})


def of_orientation() -> Goal:
    """r11 ... r33 alone."""
    return Goal((None, None, None), _rotation(), _entries())


def of_coordinates(T: ScalarMatrix, given: Sequence[str], variables: Sequence[str]) -> Goal:
    """Two, three or four names: coordinates of the end-effector, and an angle in its plane.

    Raises NotDerivable where the names do not fit the way the arm moves.
    """
    p = position_part(T).entries
    varying = [axis for axis in range(3) if any(p[axis].diff(name) for name in variables)]
    R = rotation_part(T)
    if len(given) == 4 and given[-1] not in AXES:
        return _in_plane(T, given, [0, 1, 2], varying, variables)
    if len(given) == 3 and len(varying) == 2 and given[-1] not in AXES and _turn(R, variables) is not None:
        return _in_plane(T, given, varying, varying, variables)
    if len(given) == 2 and len(varying) == 2:
        return _position(p, given, varying, varying)
    if len(given) == 3:
        return _position(p, given, [0, 1, 2], varying)
    raise NotDerivable(_misfit(given, varying))


def _misfit(given: Sequence[str], varying: Sequence[int]) -> str:
    moved = ", ".join(AXES[axis] for axis in varying) or "none of x, y, z"
    wanted = {1: "one coordinate", 2: "two coordinates"}.get(len(varying), "three coordinates")
    few = f"{how_many(len(given), 'coordinate')} {'is' if len(given) == 1 else 'are'} given"
    return (
        f"{few} ({', '.join(given)}), but the position of this end-effector has {wanted} "
        f"that change ({moved}); give a name for each of them"
    )


def _position(
    p: Sequence[Scalar], given: Sequence[str], places: Sequence[int], varying: Sequence[int]
) -> Goal:
    known: list[Scalar | None] = [None if k in varying else p[k] for k in range(3)]
    for place, name in zip(places, given, strict=True):
        known[place] = Scalar.symbol(name)
    return Goal(tuple(known), None, _coordinates(given, places))


def _in_plane(
    T: ScalarMatrix,
    given: Sequence[str],
    places: Sequence[int],
    varying: Sequence[int],
    variables: Sequence[str],
) -> Goal:
    """The coordinates, and the angle of the first axis of the end-effector that lies in the plane."""
    turn = _turn(rotation_part(T), variables)
    if turn is None:
        raise NotDerivable(
            f"{given[-1]} would be the angle of the end-effector in a plane, but it turns about more than "
            "one axis, or about none of x_0, y_0 and z_0"
        )
    goal = _position(position_part(T).entries, given[:-1], places, varying)
    first, second = (k for k in range(3) if k != turn)
    plane = (first, second, reference_column(rotation_part(T), turn))
    return Goal(goal.p, _turned(rotation_part(T), given[-1], plane), goal.places, given[-1], plane)


def _turn(R: ScalarMatrix, variables: Sequence[str]) -> int | None:
    """The base axis about which alone the end-effector turns: its row of R does not change."""
    fixed = [i for i in range(3) if not any(R[i, j].diff(name) for j in range(3) for name in variables)]
    return fixed[0] if len(fixed) == 1 else None


def _turned(R: ScalarMatrix, name: str, plane: tuple[int, int, int]) -> ScalarMatrix:
    """R by the angle from the first axis of the plane to the end-effector's axis in it."""
    first, second, column = plane
    here, there = R[first, column], R[second, column]
    c, s = trig_of(Scalar.symbol(name))
    cosine, sine = c * here + s * there, s * here - c * there  # of the angle still to turn
    rows = list(R.rows)
    rows[first] = tuple(cosine * a - sine * b for a, b in zip(R.rows[first], R.rows[second], strict=True))
    rows[second] = tuple(sine * a + cosine * b for a, b in zip(R.rows[first], R.rows[second], strict=True))
    return ScalarMatrix.of(rows)


def reference_column(R: ScalarMatrix, turn: int) -> int:
    """The first axis of the end-effector that lies in the plane of its turning."""
    return next(j for j in range(3) if R[turn, j] == 0)


def _rotation() -> ScalarMatrix:
    return ScalarMatrix.of([[Scalar.symbol(f"r{i}{j}") for j in (1, 2, 3)] for i in (1, 2, 3)])


def _entries() -> dict[str, tuple[int, int]]:
    return {f"r{i + 1}{j + 1}": (i, j) for i, j in product(range(3), repeat=2)}


def _coordinates(names: Sequence[str], places: Sequence[int]) -> dict[str, tuple[int, int]]:
    return {name: (place, 3) for name, place in zip(names, places, strict=True)}
