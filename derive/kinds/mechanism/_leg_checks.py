"""Legs of parallel robots in numbers: the elbow placed, its distance measured, and all around looked at."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import cos, dist, radians, sin, tau

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.derivation import Branch
from derive.errors import NotDerivable, NotReal
from derive.expression import Expr, Symbol, free_symbols
from derive.kinds.checks import close, random_points
from derive.kinds.mechanism._legs import Solved
from derive.kinds.mechanism._loop_oracle import tip, zeros
from derive.kinds.mechanism._position_checks import in_turn
from derive.kinds.work import Work
from derive.mechanics.linkages import Delta, FiveBar

DRAWS, POINTS = 600, 3
STRETCHED = 1e-3
Vector = tuple[float, ...]


def elbow_and_end(
    robot: FiveBar | Delta, sizes: Sequence[float], point: Vector, leg: int, angle: float
) -> tuple[Vector, Vector]:
    """Where the crank of a leg ends at an angle, and the joint at the other end of its rod."""
    if isinstance(robot, FiveBar):
        first, second, _, _, ground = sizes
        end = tip(first, angle) if leg == 1 else ground + tip(second, angle)
        return (end.real, end.imag), point
    base, platform, arm, _ = sizes
    out = base + arm * cos(angle)
    turn = radians(120 * (leg - 1))
    x, y, z = point
    return (
        (out * cos(turn), out * sin(turn), -arm * sin(angle)),
        (x + platform * cos(turn), y + platform * sin(turn), z),
    )


def rod_of(robot: FiveBar | Delta, sizes: Sequence[float], leg: int) -> float:
    """How long its rod is."""
    return sizes[1 + leg] if isinstance(robot, FiveBar) else sizes[3]


def lengths(robot: FiveBar | Delta) -> list[Expr]:
    """As they are given."""
    if isinstance(robot, FiveBar):
        return [*robot.cranks, *robot.couplers, robot.ground]
    return [robot.base, robot.platform, robot.arm, robot.forearm]


def places(
    robot: FiveBar | Delta, work: Work, wanted: Sequence[Expr]
) -> Iterator[tuple[Point, list[float], Vector]]:
    """Points of the symbols, the lengths and the position there. Coordinates that are free are measured by
    the rods, and a platform hangs below its base."""
    problem = work.problem
    sizes, position = ([problem.final(tree) for tree in trees] for trees in (lengths(robot), wanted))
    own = frozenset().union(*map(free_symbols, sizes))
    for point in random_points(own.union(*map(free_symbols, position)), DRAWS):
        known = [at(tree, point) for tree in sizes]
        reach, placed = rod_of(robot, known, 1), dict(point)
        for k, tree in enumerate(position):
            if isinstance(tree, Symbol) and tree.name not in own:
                drawn = point[tree.name]
                placed[tree.name] = reach * (-0.5 * drawn if k == 2 else 0.6 * (drawn - 1))
        yield placed, known, tuple(at(tree, placed) for tree in position)


def legs_close(
    robot: FiveBar | Delta, work: Work, parts: Sequence[Solved], wanted: Sequence[Expr],
    branches: Sequence[Branch],
) -> Iterator[bool]:  # fmt: skip
    """From each elbow that was found the rod reaches the point, and it is on the side that is said; there is
    no other; every line holds. Raises NotDerivable where nothing is within reach."""
    found = 0
    for point, sizes, position in places(robot, work, wanted):
        ways = _values(work, parts, point)
        if not ways:
            continue
        found += 1
        for leg, (part, values) in enumerate(zip(parts, ways, strict=True), 1):
            yield from _leg(robot, sizes, position, leg, [each[part.angle.name] for each in values])
            yield from _lines(work, part, leg, values)
        ours = [each[part.angle.name] for part, values in zip(parts, ways, strict=True) for each in values]
        told = [_told(work, branch, point) for branch in branches]
        yield all(close(each, [value, value]) for each, value in zip(told, ours, strict=True))
        if found == POINTS:
            return
    if not found:
        raise NotDerivable("no position was found that all legs reach", "position")


def _values(work: Work, parts: Sequence[Solved], point: Point) -> list[list[dict[str, float]]] | None:
    """Those of all names, for each leg either way; None out of reach."""
    typed = {name.name: value for name, value in work.typed if isinstance(name, Symbol)}
    start = {**point, **{name: at(work.problem.final(value), point) for name, value in typed.items()}}
    try:
        ways = [[in_turn(start, formulas) for _, formulas in part.ways] for part in parts]
    except (NotReal, ValueError, ZeroDivisionError):
        return None
    stretched = any(each[0][part.lines[-1]] < STRETCHED for each, part in zip(ways, parts, strict=True))
    return None if stretched else ways


def _told(work: Work, branch: Branch, point: Point) -> list[float]:
    """The angle of a branch as a whole, and in short formulas."""
    ((name, tree),) = branch.values.items()
    short = in_turn(point, {Symbol(each): formula for each, formula in branch.short.items()})
    return [at(work.problem.final(tree), point), short[name]]


def _lines(work: Work, part: Solved, leg: int, values: Sequence[dict[str, float]]) -> Iterator[bool]:
    """The equation of the distance and the angle, as they are written."""
    for (side, _), each in zip(part.ways, values, strict=True):
        names = (f"{side.key}_{leg}", *(("apart",) if leg == 1 else ()))
        lines = [step.chain for step in work.steps if step.name in names]
        yield all(close(at(left, each), at(right, each)) for left, right in lines)


def _leg(
    robot: FiveBar | Delta, sizes: Sequence[float], position: Vector, leg: int, angles: list[float]
) -> Iterator[bool]:
    rod = rod_of(robot, sizes, leg)
    ends = [elbow_and_end(robot, sizes, position, leg, angle) for angle in angles]
    yield all(close(dist(*each), rod) for each in ends)
    around = zeros(lambda angle: dist(*elbow_and_end(robot, sizes, position, leg, angle)) - rod, 0, tau)
    yield close(sorted(each % tau for each in angles), sorted(each % tau for each in around), 1e-7)
    if isinstance(robot, FiveBar):
        pivot = 0.0 if leg == 1 else sizes[4]
        for side, (elbow, end) in zip((1, -1), ends, strict=True):
            turn = (end[0] - pivot) * elbow[1] - end[1] * (elbow[0] - pivot)
            yield side * turn > 0
    elif position[2] < 0:
        inside, outside = (cos(angle) for angle in angles)
        yield inside < outside
