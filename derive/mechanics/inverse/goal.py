"""What is known of the end-effector: its coordinates by name, its orientation, or both."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import trig_of
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable
from derive.mechanics.poses import position_part, rotation_part

AXES = "xyz"


@dataclass(frozen=True, slots=True)
class Goal:
    """The known pose of the end-effector in the base, each part None where it is not known.

    `p` holds None for a coordinate that is not known. `angle` is the name of an angle given in the plane.
    `meanings` says what each given name stands for, in the joint variables.
    """

    p: tuple[Scalar | None, ...]
    R: ScalarMatrix | None
    names: tuple[str, ...]
    angle: str | None = None

    @property
    def whole_position(self) -> bool:
        return None not in self.p

    @property
    def size(self) -> int:
        """How many joint variables it can determine at most."""
        return sum(part is not None for part in self.p) + self._turning

    @property
    def _turning(self) -> int:
        return 0 if self.R is None else 1 if self.angle else 3


def of_pose() -> Goal:
    """Everything: r11 ... r33, x, y, z."""
    return Goal(tuple(map(Scalar.symbol, AXES)), _rotation(), (*_entries(), *AXES))


def of_orientation() -> Goal:
    """r11 ... r33 alone."""
    return Goal((None, None, None), _rotation(), _entries())


def of_coordinates(T: ScalarMatrix, given: Sequence[str], variables: Sequence[str]) -> Goal:
    """Two, three or four names: coordinates of the end-effector, and an angle in its plane.

    Raises NotDerivable where the names do not fit the way the arm moves.
    """
    p = position_part(T).entries
    varying = [axis for axis in range(3) if any(p[axis].diff(name) for name in variables)]
    turn = _turn(rotation_part(T), variables)
    if len(given) == 4:
        return _in_plane(T, given, [0, 1, 2], varying, variables)
    if len(given) == 3 and len(varying) == 2 and turn is not None and turn not in varying:
        return _in_plane(T, given, varying, varying, variables)
    if len(given) == 2 and len(varying) == 2:
        return _position(p, given, varying, varying)
    if len(given) == 3:
        return _position(p, given, [0, 1, 2], varying)
    raise NotDerivable(_misfit(given, varying))


def _misfit(given: Sequence[str], varying: Sequence[int]) -> str:
    moved = ", ".join(AXES[axis] for axis in varying) or "none of x, y, z"
    wanted = {1: "one coordinate", 2: "two coordinates"}.get(len(varying), "three coordinates")
    return (
        f"{len(given)} coordinates are given ({', '.join(given)}), but the position of this end-effector has "
        f"{wanted} that change ({moved}); give a name for each of them"
    )


def _position(
    p: Sequence[Scalar], given: Sequence[str], places: Sequence[int], varying: Sequence[int]
) -> Goal:
    known: list[Scalar | None] = [None if k in varying else p[k] for k in range(3)]
    for place, name in zip(places, given, strict=True):
        known[place] = Scalar.symbol(name)
    return Goal(tuple(known), None, tuple(given))


def _in_plane(
    T: ScalarMatrix, given: Sequence[str], places: Sequence[int], varying: Sequence[int], variables: Sequence[str]
) -> Goal:
    """The coordinates, and the angle of the first axis of the end-effector that lies in the plane."""
    turn = _turn(rotation_part(T), variables)
    if turn is None:
        raise NotDerivable(
            f"{given[-1]} would be the angle of the end-effector in a plane, but it turns about more than one axis"
        )
    goal = _position(position_part(T).entries, given[:-1], places, varying)
    R = _turned(rotation_part(T), given[-1], turn, variables)
    return Goal(goal.p, R, tuple(given), given[-1])


def _turn(R: ScalarMatrix, variables: Sequence[str]) -> int | None:
    """The base axis about which alone the end-effector turns: its row of R does not change."""
    fixed = [i for i in range(3) if not any(R[i, j].diff(name) for j in range(3) for name in variables)]
    return fixed[0] if len(fixed) == 1 else None


def _turned(R: ScalarMatrix, name: str, turn: int, variables: Sequence[str]) -> ScalarMatrix:
    """R by the angle from the first other base axis to the end-effector's axis in the plane."""
    column = reference_column(R, turn)
    first, second = (k for k in range(3) if k != turn)
    here, there = R[first, column], R[second, column]
    c, s = trig_of(Scalar.symbol(name))
    cosine, sine = c * here + s * there, s * here - c * there  # of the angle still to turn
    rows: list[list[Scalar]] = [[], [], []]
    for j in range(3):
        a, b = R[first, j], R[second, j]
        rows[first].append(cosine * a - sine * b)
        rows[second].append(sine * a + cosine * b)
        rows[turn].append(R[turn, j])
    return ScalarMatrix.of(rows)


def reference_column(R: ScalarMatrix, turn: int) -> int:
    """The first axis of the end-effector that lies in the plane of its turning."""
    return next(j for j in range(3) if R[turn, j] == 0)


def _rotation() -> ScalarMatrix:
    return ScalarMatrix.of([[Scalar.symbol(f"r{i}{j}") for j in (1, 2, 3)] for i in (1, 2, 3)])


def _entries() -> tuple[str, ...]:
    return tuple(f"r{i}{j}" for i, j in product((1, 2, 3), repeat=2))
