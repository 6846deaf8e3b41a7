"""Values with which an arm is drawn: of every symbol that its places rest on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from derive.expression import Expr, Symbol, free_symbols
from derive.figures.typical import names_in, typical
from derive.mechanics.bodies import Box, Cylinder, Rod, Sphere, coordinates
from derive.mechanics.dh import moves
from derive.mechanics.frames import ByMatrix
from derive.mechanics.motion import Motion, Move
from derive.mechanics.oracle.values import trees_in
from derive.mechanics.robot import DHRow, Robot, ScrewRow

MIDDLE = 0.5  # of a usual length: how far a point is along its link
LONG, WIDE = 1.8, 0.25  # of a usual length: a body, along and across
OFFSET = 0.45  # of a usual length: an offset beside a link


def values_of(
    robot: Robot, where: Mapping[str, Expr], points: Iterable[Expr] = ()
) -> tuple[dict[str, float], float]:
    """A value for every symbol but the joint variables, and the size of a usual length (m); coordinates of
    `points` of links are shorter."""
    every = [move for link in robot.links for move in moves(link, robot)]
    more = [part for link in robot.links if isinstance(link.row, ScrewRow) for part in link.row.through]
    home: tuple[Move, ...] = ()
    match robot.home:
        case Motion(home):
            pass
        case ByMatrix(matrix):
            more += [row[-1] for row in matrix.rows[:3] if len(row) == 4]
    point, usual = typical([*robot.base, *every, *robot.tool, *home], more, where, robot.variables)
    for name in _offsets(robot) & point.keys():
        point[name] *= OFFSET
    rows = tuple(link.row for link in robot.links)
    for tree in trees_in((robot.base, rows, robot.tool, robot.home)):
        for name in names_in(tree, where) - set(robot.variables):
            point.setdefault(name, usual)
    for name, share in _of_bodies(robot, where):
        point.setdefault(name, share * usual)
    for tree in points:
        for name in names_in(tree, where) - set(robot.variables):
            point.setdefault(name, MIDDLE * usual)
    return point, usual


def _of_bodies(robot: Robot, where: Mapping[str, Expr]) -> Iterator[tuple[str, float]]:
    """The symbols of the shapes and places of bodies, each with its share of a usual length."""
    for body in (link.body for link in robot.links if link.body):
        shares: list[tuple[Expr, float]] = [(part, MIDDLE) for part in coordinates(body)]
        match body.inertia:
            case Rod(long):
                shares.append((long, LONG))
            case Cylinder(radius, long):
                shares += [(radius, WIDE), (long, 1.0)]
            case Sphere(radius):
                shares.append((radius, WIDE / 2))
            case Box(sides):
                shares += [(side, WIDE) for side in sides]
        yield from ((name, share) for tree, share in shares for name in sorted(names_in(tree, where)))


def _offsets(robot: Robot) -> set[str]:
    """The symbols that are an offset d in a row with a link a, or after a link in the same direction."""
    found: set[str] = set()
    for link in robot.links:
        match link.row:
            case DHRow(d=Symbol(name), a=a) if free_symbols(a) and name != link.variable:
                found.add(name)
    return found
