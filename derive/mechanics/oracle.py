"""The second route: the same answers in plain NumPy, from the trees of the sheet, sharing no formula
with the symbolic derivations.

Poses by Rodrigues' formula, Jacobians by differences, torques by Newton's and Euler's equations for
each body, whose accelerations come by differences where joints are coupled. Arrays: T 4 by 4, vectors of
3, q of n.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeAlias, get_args

from flint import arb

from derive.algebra.ball_arithmetic import precise
from derive.algebra.numbers.floats import Point, completed, number
from derive.expression import Expr, Symbol, free_symbols
from derive.mechanics.bodies import Body, moments
from derive.mechanics.dh import moves
from derive.mechanics.displacements import Configuration, Placed, joint_forces, many_digits, velocities
from derive.mechanics.drives import friction_force, reflected
from derive.mechanics.frames import ByMatrix
from derive.mechanics.motion import Motion, Move
from derive.mechanics.robot import Robot, gravity_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

TREES = get_args(Expr)
Value: TypeAlias = Callable[[Expr, Any], Any]  # of a tree at a point
TERMS = 60  # of the exponential series; far more than angles of a few radians need
STEP = 1e-6  # of differences; their error is about 1e-10


@dataclass(frozen=True, slots=True)
class Oracle:
    """A robot in numbers; `where` gives the names the sheet defines."""

    robot: Robot
    where: Mapping[str, Expr]
    value: Value = number  # or one that gives more digits

    def at(self, point: Point) -> Point:
        """The point with the values of `where` added; those the point does not decide are left out."""
        return completed(point, self.where)

    def local(self, point: Point) -> list[Array]:
        """T from each row to the one before."""
        return [self._compose(moves(link, self.robot), point) for link in self.robot.links]

    def poses(self, point: Point) -> list[Array]:
        """T_00, T_01, ..., T_0n, base motion included."""
        found = [self._compose(self.robot.base, point)]
        for T in self.local(point):
            found.append(found[-1] @ T)
        return found

    def tool(self, point: Point) -> Array:
        """T (4 by 4) of the end-effector."""
        return self.poses(point)[-1] @ self.home(point) @ self._compose(self.robot.tool, point)

    def home(self, point: Point) -> Array:
        """T (4 by 4) of the end-effector of a chain of screws while its joints are at zero."""
        import numpy as np

        match self.robot.home:
            case None:
                return np.eye(4)
            case Motion(made):
                return self._compose(made, point)
            case ByMatrix(matrix):
                entries = np.array([[self.value(entry, point) for entry in row] for row in matrix.rows])
                T, size = np.eye(4, dtype=entries.dtype), len(matrix.rows)
                T[:size, :size] = entries
                return T

    def _compose(self, sequence: tuple[Move, ...], point: Any) -> Array:
        return compose(sequence, point, self.value)

    def jacobian(self, point: Point, frame: int, offset: Sequence[float | Expr]) -> Array:
        """J (6 by n) by central differences: of a point given in a frame (n+1: the tool's)."""
        import numpy as np

        precisely = replace(self, value=precise)

        def pose(at: Configuration) -> Array:
            """That of the frame, moved on to the point."""
            T = precisely.tool(at) if frame > len(self.robot.links) else precisely.poses(at)[frame]
            there = [precise(x, at) if isinstance(x, TREES) else arb(x) for x in offset]
            return np.column_stack([T[:3, :3], T[:3, :3] @ there + T[:3, 3]])

        with many_digits(point) as at:
            return velocities(pose, at, self.robot.variables)

    def torques(self, point: Point) -> Array:
        """tau (n) by the motion of each body; rates and accelerations in the point by their names."""
        import numpy as np

        at = self.at(point)
        own = []
        for name, link in ((link.variable, link) for link in self.robot.links if link.variable):
            rotor = number(reflected(link.motor), at) * at[f"{name}_ddot"]
            own.append(rotor + number(friction_force(link.friction, name), at))
        return np.array(own) + self._of_bodies(at)

    def inertia_matrix(self, point: Point) -> Array:
        """D (n by n): row by row the torques of a unit acceleration from rest, less those of rest."""
        import numpy as np

        still, names = self._still(point), self.robot.variables
        rest = self.torques(still)
        return np.array([self.torques({**still, f"{name}_ddot": 1.0}) - rest for name in names])

    def torques_at_rest(self, point: Point) -> Array:
        """tau (n) that holds the arm still."""
        return self.torques(self._still(point))

    def torques_of_rates(self, point: Point) -> Array:
        """tau (n) at the rates of the point without accelerations, less that of rest."""
        even = {f"{name}_ddot": 0.0 for name in self.robot.variables}
        return self.torques({**point, **even}) - self.torques_at_rest(point)

    def _still(self, point: Point) -> Point:
        names = self.robot.variables
        return {**point, **{f"{name}_{dots}": 0.0 for name in names for dots in ("dot", "ddot")}}

    def _of_bodies(self, at: Point) -> Array:
        """tau (n) without rotors and friction."""
        import numpy as np

        if self.robot.coupled or self.robot.shifting:
            return self._by_displacements(at)
        motion = _Sweep(self, at).bodies()
        torques = []
        for _, axis, origin, first, revolute in motion.joints:
            loads = (load for i, load in motion.loads.items() if i >= first)
            torques.append(sum(axis @ (N + np.cross(c - origin, F) if revolute else F) for c, F, N in loads))
        return np.array(torques, dtype=float)

    def _by_displacements(self, point: Point) -> Array:
        """The same where a variable moves more than its own row."""
        import numpy as np

        with many_digits(point) as at:
            gravity = np.array([precise(part, at) for part in gravity_of(self.robot)])
            return joint_forces(replace(self, value=precise).placed, at, self.robot.variables, gravity)

    def placed(self, point: Any) -> list[Placed]:
        """Where the bodies are."""
        poses, found = self.poses(point), []
        for i, link in enumerate(self.robot.links, 1):
            if link.body:
                c = com_of(link.body, poses[i - 1], poses[i], point, self.value)
                I = inertia_of(link.body, point, self.value)
                found.append(Placed(self.value(link.body.mass, point), c, poses[i][:3, :3], I))
        return found


@dataclass(frozen=True, slots=True)
class _Motion:
    """(name, axis, point, row, revolute) of each joint; (com, force, moment) of each body by row."""

    joints: list[tuple[str, Any, Any, int, bool]]
    loads: dict[int, tuple[Any, Any, Any]]


@dataclass(frozen=True, slots=True)
class _Sweep:
    """From base to tip: how every link turns and accelerates, in base coordinates."""

    oracle: Oracle
    point: Point

    def bodies(self) -> _Motion:
        import numpy as np

        robot, at = self.oracle.robot, self.point
        gravity = np.array([number(part, at) for part in gravity_of(robot)])
        poses = self.oracle.poses(at)
        w = alpha = acc = np.zeros(3)
        reference = poses[0][:3, 3]
        found = _Motion([], {})
        for i, link in enumerate(robot.links, 1):

            def carried(x: Any, w: Any = w, alpha: Any = alpha, acc: Any = acc, r: Any = reference) -> Any:
                return acc + np.cross(alpha, x - r) + np.cross(w, np.cross(w, x - r))

            if link.variable:
                axis, origin = self._axis(i, poses[i - 1])
                rate, rise = at[f"{link.variable}_dot"], at[f"{link.variable}_ddot"]
                revolute = link.joint == "revolute"
                found.joints.append((link.variable, axis, origin, i, revolute))
                if revolute:
                    acc, reference = carried(origin), origin
                    alpha = alpha + axis * rise + np.cross(w, axis * rate)
                    w = w + axis * rate
                else:
                    reference = poses[i][:3, 3]
                    acc = carried(reference) + 2 * np.cross(w, axis * rate) + axis * rise
            if link.body:
                found.loads[i] = self._load(
                    link.body, poses[i - 1], poses[i], (w, alpha, acc, reference), gravity
                )
        return found

    def _axis(self, i: int, T: Any) -> tuple[Any, Any]:
        """Direction and a point of the joint axis of row i, by moving it a little."""
        import numpy as np

        link = self.oracle.robot.links[i - 1]
        row = moves(link, self.oracle.robot)
        k = next(k for k, move in enumerate(row) if Symbol(link.variable or "") in _names(move.by))
        before = T @ compose(row[:k], self.point)
        return before[:3, :3] @ _direction(row[k], self.point) * _rate(
            row[k].by, link.variable or "", self.point
        ), np.array(before[:3, 3])

    def _load(
        self, body: Body, before: Any, T: Any, motion: tuple[Any, ...], gravity: Any
    ) -> tuple[Any, Any, Any]:
        import numpy as np

        w, alpha, acc, reference = motion
        mass, c = number(body.mass, self.point), com_of(body, before, T, self.point)
        I = T[:3, :3] @ inertia_of(body, self.point) @ T[:3, :3].T
        r = c - reference
        acceleration = acc + np.cross(alpha, r) + np.cross(w, np.cross(w, r))
        return c, mass * (acceleration - gravity), I @ alpha + np.cross(w, I @ w)


def com_of(body: Body, before: Array, T: Array, point: Any, value: Value = number) -> Array:
    """The com (3, base frame) of the link at T, the one before it at `before`."""
    import numpy as np

    if body.com == "center":
        return np.array((before[:3, 3] + T[:3, 3]) / 2)
    return np.array(T[:3, :3] @ np.array([value(x, point) for x in body.com]) + T[:3, 3])


def inertia_of(body: Body, point: Any, value: Value = number) -> Array:
    """I about the com in the link's own axes (3 by 3)."""
    import numpy as np

    xx, yy, zz, xy, yz, xz = (value(x, point) for x in moments(body))
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def slope(
    value: Callable[[Point], Array], at: Point, rates: Mapping[str, float], step: float = STEP
) -> Array:
    """How fast a value (an array) changes where the names change at these rates, by central differences."""
    ahead, behind = (
        value({**at, **{name: at[name] + h * rate for name, rate in rates.items()}}) for h in (step, -step)
    )
    return (ahead - behind) / (2 * step)


def vee(S: Array) -> list[float]:
    """The vector (3) of a skew-symmetric matrix, or of that in the corner of a twist."""
    return [S[2, 1], S[0, 2], S[1, 0]]


def exponential(X: Array) -> Array:
    """e^X (n by n), 1 + X + X^2/2 + ..."""
    import numpy as np

    term: Array = np.eye(len(X))
    total = term
    for k in range(1, TERMS):
        term = term @ X / k
        total = total + term
    return total


def compose(sequence: tuple[Move, ...], point: Any, value: Value = number) -> Array:
    """T (4 by 4) of moves about current axes."""
    import numpy as np

    T: Array = np.eye(4)
    for move in sequence:
        T = T @ elementary(move, point, value)
    return T


def made(moves: Iterable[Move], point: Any) -> Array:
    """T of moves as they are told, one after the other: about the axes of the world from the left, about
    current ones from the right."""
    import numpy as np

    T: Array = np.eye(4)
    for move in moves:
        step = elementary(move, point)
        T = step @ T if move.about == "world" else T @ step
    return T


def elementary(move: Move, point: Any, value: Value = number) -> Array:
    """T (4 by 4) of one move: Rodrigues' formula, or a shift."""
    import numpy as np

    k, by = _direction(move, point, value), value(move.by, point)
    T = np.eye(4, dtype=np.array(by).dtype)
    if move.kind == "translate":
        T[:3, 3] = by * k
        return T
    K = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    T[:3, :3] = np.eye(3) + np.sin(by) * K + (1 - np.cos(by)) * (K @ K)
    return T


def _direction(move: Move, point: Any, value: Value = number) -> Array:
    import numpy as np

    if isinstance(move.axis, str):
        unit: Array = np.eye(3)["xyz".index(move.axis)]
        return unit
    k = np.array([value(part, point) for part in move.axis])
    return np.array(k / np.sqrt(k @ k))


def _names(expr: Expr) -> set[Symbol]:
    return {Symbol(name) for name in free_symbols(expr)}


def _rate(by: Expr, name: str, point: Point) -> float:
    """How fast a move goes with its joint variable (1 or -1 in every textbook)."""
    ahead, behind = (number(by, {**point, name: point[name] + h}) for h in (0.5, -0.5))
    return ahead - behind
