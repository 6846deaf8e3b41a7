"""An arm in numbers: where its frames are, how they move, and what forces its joints need."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeAlias, TypeVar, get_args

from derive.algebra.ball_arithmetic import precise
from derive.algebra.numbers.floats import Point, completed, number
from derive.expression import Expr, free_symbols
from derive.mechanics.frames import ByMatrix
from derive.mechanics.motion import Motion
from derive.mechanics.oracle.bodies import com_of, inertia_of
from derive.mechanics.oracle.calculus import slope, vee
from derive.mechanics.oracle.displacements import (
    Placed,
    joint_forces,
    many_digits,
)
from derive.mechanics.oracle.poses import compose
from derive.mechanics.oracle.rows import local
from derive.mechanics.oracle.sweep import Axis, Still, axis_of, torques_of_bodies
from derive.mechanics.oracle.values import Array, Value, trees_in
from derive.mechanics.robot import Link, Robot

TREES = get_args(Expr)
Found = TypeVar("Found")
Places: TypeAlias = dict[tuple[Any, ...], Found]
PLACES = 1000  # that are remembered


@dataclass(frozen=True, slots=True)
class Oracle:
    """A robot in numbers; `where` gives the names the sheet defines."""

    robot: Robot
    where: Mapping[str, Expr]
    value: Value = number  # or one that gives more digits
    names: tuple[str, ...] = field(init=False, repr=False, compare=False)  # on which poses can depend
    named: tuple[tuple[str, ...], ...] = field(init=False, repr=False, compare=False)  # the same of each row
    rows: Places[Array] = field(init=False, repr=False, compare=False)
    seen: Places[list[Array]] = field(init=False, repr=False, compare=False)
    moved: Places[Array] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        rows = [link.row for link in self.robot.links]
        object.__setattr__(self, "names", _names_in((self.robot.base, *rows)))
        object.__setattr__(self, "named", tuple(map(_names_in, rows)))
        for places in ("rows", "seen", "moved"):
            object.__setattr__(self, places, {})

    def at(self, point: Point) -> Point:
        """The point with the values of `where` added; those the point does not decide are left out."""
        return completed(point, self.where)

    # -- where it is --------------------------------------------------------------------------------

    def local(self, point: Any) -> list[Array]:
        """T from each row to the one before."""
        return [self._row(i, point) for i in range(len(self.robot.links))]

    def poses(self, point: Any) -> list[Array]:
        """T_00, T_01, ..., T_0n, base motion included; found once at a place, for checks come back to it."""
        if self.value is not number:
            return self._poses(point)
        place: tuple[Any, ...] = tuple(map(point.get, self.names))
        found: list[Array] = _remembered(self.seen, place, lambda: self._poses(point))
        return list(found)

    def _poses(self, point: Any) -> list[Array]:
        found = [compose(self.robot.base, point, self.value)]
        for T in self.local(point):
            found.append(found[-1] @ T)
        return found

    def tool(self, point: Any) -> Array:
        """T (4 by 4) of the end-effector."""
        return self.poses(point)[-1] @ self.in_hand(point)

    def in_hand(self, point: Any) -> Array:
        """T (4 by 4) of the end-effector in the last row's frame; of screws, the base while joints are at
        zero."""
        return self.home(point) @ compose(self.robot.tool, point, self.value)

    def home(self, point: Any) -> Array:
        """T (4 by 4) of the end-effector of a chain of screws while its joints are at zero."""
        import numpy as np

        match self.robot.home:
            case None:
                return np.eye(4)
            case Motion(made):
                return compose(made, point, self.value)
            case ByMatrix(matrix):
                entries = np.array([[self.value(entry, point) for entry in row] for row in matrix.rows])
                T, size = np.eye(4, dtype=entries.dtype), len(matrix.rows)
                T[:size, :size] = entries
                return T

    def _row(self, i: int, point: Any) -> Array:
        """T of a row, counted from 0; most stay as they are while one joint moves."""

        def found() -> Array:
            return local(self.robot.links[i].row, self.robot.convention, point, self.value)

        if self.value is not number:
            return found()
        return _remembered(self.rows, (i, *map(point.get, self.named[i])), found)

    # -- how it moves -------------------------------------------------------------------------------

    def jacobian(self, point: Point, frame: int, offset: Sequence[float | Expr]) -> Array:
        """J (6 by n) by central differences: of a point given in a frame (n+1: the tool's)."""
        names = {*self.names, *(name for x in offset if isinstance(x, TREES) for name in free_symbols(x))}
        place = (frame, *offset, *(point.get(name) for name in sorted(names)))
        return _remembered(self.moved, place, lambda: self._jacobian(point, frame, offset)).copy()

    def _jacobian(self, point: Point, frame: int, offset: Sequence[float | Expr]) -> Array:
        import numpy as np

        def pose(at: Point) -> Array:
            """That of the frame (3 by 4), moved on to the point."""
            T = self.tool(at) if frame > len(self.robot.links) else self.poses(at)[frame]
            return T[:3] @ self._shifted(offset, at)

        R, columns = pose(point)[:, :3], []
        after = self._after(point, frame, offset)
        for name in self.robot.variables:
            i = self._row_of(name, offset)
            rate = slope(pose, point, {name: 1.0}) if i is None else self._rate(i, name, point, after)
            columns.append([*rate[:, 3], *vee(rate[:, :3] @ R.T)])
        return np.array(columns).T

    def _shifted(self, offset: Sequence[float | Expr], at: Point) -> Array:
        """A pose (4 by 4) at a point of a frame, turned as the frame is."""
        import numpy as np

        there = np.array([self.value(x, at) if isinstance(x, TREES) else x for x in offset])
        T = np.eye(4, dtype=there.dtype if there.dtype == object else float)
        T[:3, 3] = there
        return T

    def _row_of(self, name: str, offset: Sequence[float | Expr]) -> int | None:
        """The row, from 0, that a variable moves; None where it moves anything else too."""
        others = (self.robot.base, self.robot.tool, self.robot.home, tuple(offset))
        rows = [i for i, names in enumerate(self.named) if name in names]
        return rows[0] if len(rows) == 1 and name not in _names_in(others) else None

    def _after(self, point: Point, frame: int, offset: Sequence[float | Expr]) -> list[Array]:
        """The motion from behind each row up to a point of a frame, or of the tool (n+1)."""
        count = len(self.robot.links)
        end = self._shifted(offset, point)
        found = [self.in_hand(point) @ end if frame > count else end]
        for i in reversed(range(1, min(frame, count))):
            found.append(self._row(i, point) @ found[-1])
        return found[::-1]

    def _rate(self, i: int, name: str, point: Point, after: Sequence[Array]) -> Array:
        """How fast a pose (3 by 4) changes with a variable that moves row i alone, by central differences."""
        import numpy as np

        if i >= len(after):
            return np.zeros((3, 4))
        rate = slope(lambda at: self._row(i, at), point, {name: 1.0})
        whole: Array = self.poses(point)[i] @ rate @ after[i]
        return whole[:3]

    def axes(self, point: Point) -> list[Axis | None]:
        """Those of the joints in the frames before them, None of a fixed row; where each variable moves its
        own row alone."""
        return [self._axis(i, point) for i in range(len(self.robot.links))]

    def _axis(self, i: int, point: Point) -> Axis | None:
        link = self.robot.links[i]
        name = link.variable
        if name is None:
            return None
        return axis_of(lambda by: self._row(i, {**point, name: point[name] + by}), link.joint != "prismatic")

    # -- what it needs ------------------------------------------------------------------------------

    def gravity(self, point: Any) -> Array:
        """The acceleration (3) of what falls, in the base frame: as given, else g down along z."""
        import numpy as np

        if self.robot.gravity is None:
            return np.array([0, 0, -point["g"]])
        return np.array([self.value(part, point) for part in self.robot.gravity])

    def torques(self, point: Point, still: Still | None = None) -> Array:
        """tau (n) by the motion of each body; rates and accelerations in the point by their names. `still` is
        where the arm is there, if that is known."""
        import numpy as np

        at = self.at(point)
        own = [_of_joint(link, at) for link in self.robot.links if link.variable]
        return np.array(own) + self._of_bodies(at, still or self.still(at))

    def inertia_matrix(self, point: Point, still: Still | None = None) -> Array:
        """D (n by n): row by row the torques of a unit acceleration from rest, less those of rest."""
        import numpy as np

        at, names = self.at(self._at_rest(point)), self.robot.variables
        still = still or self.still(at)
        rest = self.torques(at, still)
        return np.array([self.torques({**at, f"{name}_ddot": 1.0}, still) - rest for name in names])

    def torques_at_rest(self, point: Point, still: Still | None = None) -> Array:
        """tau (n) that holds the arm still."""
        return self.torques(self._at_rest(point), still)

    def torques_of_rates(self, point: Point) -> Array:
        """tau (n) at the rates of the point without accelerations, less that of rest."""
        even = {f"{name}_ddot": 0.0 for name in self.robot.variables}
        return self.torques({**point, **even}) - self.torques_at_rest(point)

    def _at_rest(self, point: Point) -> Point:
        names = self.robot.variables
        return {**point, **{f"{name}_{dots}": 0.0 for name in names for dots in ("dot", "ddot")}}

    def still(self, at: Point) -> Still | None:
        """Where the arm is, whatever its rates; None where a variable moves more than its own row."""
        if self.robot.coupled or self.robot.shifting:
            return None
        return Still(self.poses(at), self.axes(at), self.bodies(at), self.gravity(at))

    def _of_bodies(self, at: Point, still: Still | None) -> Array:
        """tau (n) without rotors and friction."""
        if still is None:
            return self._by_displacements(at)
        return torques_of_bodies(self.robot.links, still, at)

    def _by_displacements(self, point: Point) -> Array:
        """The same where a variable moves more than its own row."""
        precisely = replace(self, value=precise)
        with many_digits(point) as at:
            return joint_forces(precisely.placed, at, self.robot.variables, precisely.gravity(at))

    def placed(self, point: Any) -> list[Placed]:
        """Where the bodies are."""
        return [body for body in self.bodies(point) if body]

    def bodies(self, point: Any) -> list[Placed | None]:
        """Those of the links, None where one has none."""
        poses = self.poses(point)
        found: list[Placed | None] = []
        for link, before, T in zip(self.robot.links, poses, poses[1:], strict=False):
            if (body := link.body) is None:
                found.append(None)
                continue
            c, I = com_of(body, before, T, point, self.value), inertia_of(body, point, self.value)
            found.append(Placed(self.value(body.mass, point), c, T[:3, :3], I))
        return found


def _of_joint(link: Link, at: Point) -> float:
    """What rotor and friction need: the rotor G times as fast as its joint, its torque felt G times."""
    tau, rate, rise = 0.0, at[f"{link.variable}_dot"], at[f"{link.variable}_ddot"]
    if link.motor:
        G = number(link.motor.ratio, at)
        tau += G * (number(link.motor.inertia, at) * (G * rise))
    if link.friction:
        against = (rate > 0) - (rate < 0)
        tau += number(link.friction.viscous, at) * rate + number(link.friction.coulomb, at) * against
    return tau


def _names_in(parts: Any) -> tuple[str, ...]:
    return tuple(sorted({name for tree in trees_in(parts) for name in free_symbols(tree)}))


def _remembered(found: Places[Found], place: tuple[Any, ...], find: Callable[[], Found]) -> Found:
    """What is found at a place, once while few places are asked for."""
    if place not in found:
        if len(found) > PLACES:
            found.clear()
        found[place] = find()
    return found[place]
