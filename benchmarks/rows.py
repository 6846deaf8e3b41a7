"""A robot as plain rows in SymPy's syntax, which every peer can read."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.infix import text
from derive.mechanics.bodies import Body
from derive.mechanics.dynamics import gravity_of
from derive.mechanics.moments import moments
from derive.mechanics.robot import DHRow, JointType, Link, Robot


@dataclass(frozen=True, slots=True)
class Weight:
    """mass, com (x, y, z in the link's frame) and Ixx, Iyy, Izz, Ixy, Iyz, Ixz about it."""

    mass: str
    com: tuple[str, ...]
    moments: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Row:
    """A Denavit-Hartenberg row, its joint variable, and the body it carries."""

    theta: str
    d: str
    a: str
    alpha: str
    variable: str
    joint: JointType
    weight: Weight


@dataclass(frozen=True, slots=True)
class Rows:
    """The rows in the standard convention, and gravity in the base frame."""

    rows: tuple[Row, ...]
    gravity: tuple[str, ...]

    @property
    def variables(self) -> tuple[str, ...]:
        return tuple(row.variable for row in self.rows)


def rows_of(robot: Robot) -> Rows:
    """Raises ValueError for what not every peer can be told: free rows, fixed ones, links without a body."""
    return Rows(tuple(map(_row, robot.links)), tuple(map(text, gravity_of(robot))))


def _row(link: Link) -> Row:
    if not isinstance(link.row, DHRow) or link.variable is None or link.body is None:
        raise ValueError("a benchmark robot has a joint and a body in every Denavit-Hartenberg row")
    columns = (link.row.theta, link.row.d, link.row.a, link.row.alpha)
    return Row(*map(text, columns), link.variable, link.joint, _weight(link.body))


def _weight(body: Body) -> Weight:
    if body.com == "center":
        raise ValueError("a benchmark robot gives each com by its coordinates")
    return Weight(text(body.mass), tuple(map(text, body.com)), tuple(map(text, moments(body))))
