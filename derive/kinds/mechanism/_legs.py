"""The legs of a parallel robot with cranks: the angle at which the end of a crank has a given distance from a
point."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from derive.derivation import Branch, Phrase, Step
from derive.expression import (
    ZERO,
    Degrees,
    Expr,
    Symbol,
    add,
    atan2,
    cos,
    negate,
    number,
    replace,
    sin,
    sqrt,
    squared,
    subtract,
)
from derive.kinds.work import Work
from derive.mechanics.linkages import Delta, FiveBar
from derive.names import free

SIDES = {FiveBar: ("left", "right"), Delta: ("inside", "outside")}


@dataclass(frozen=True)
class Leg:
    """In the plane of a crank: where its point is seen from its pivot, along `x` and `y`, and how far `aside`
    of that plane (zero: in it); how long the crank and its rod are. Where y points up and the crank turns
    `down`, an angle of 90 degrees hangs."""

    index: int
    x: Expr
    y: Symbol
    aside: Expr
    crank: Symbol
    rod: Symbol
    down: bool


@dataclass(frozen=True)
class Solved:
    """The board with the lines of a leg, its angle, and the formulas by which it is found with either sign of
    the root, each in the names before it."""

    work: Work
    angle: Symbol
    lines: tuple[str, ...]
    ways: tuple[tuple[Phrase, dict[Symbol, Expr]], ...]

    def branches(self, given: dict[Expr, Expr]) -> Iterator[Branch]:
        """As results, with everything put in, and in short formulas."""
        for side, formulas in self.ways:
            short = {name: replace(formula, given) for name, formula in formulas.items()}
            values: dict[Expr, Expr] = {}
            for name, formula in short.items():
                values[name] = replace(formula, values)
            told = {name.name: formula for name, formula in short.items()}
            yield Branch({self.angle.name: values[self.angle]}, (side,), told)


def legs_of(robot: FiveBar | Delta, work: Work, point: tuple[Symbol, ...]) -> tuple[Work, list[Leg]]:
    """The board with the names of the lengths, and the legs."""
    if isinstance(robot, FiveBar):
        first, second = robot.cranks
        third, fourth = robot.couplers
        work, (a, b, e, f, d) = work.naming(a_1=first, a_2=second, b_1=third, b_2=fourth, d=robot.ground)
        x, y = point
        return work, [Leg(1, x, y, ZERO, a, e, False), Leg(2, subtract(x, d), y, ZERO, b, f, False)]
    work, (R, r, L, l) = work.naming(R=robot.base, r=robot.platform, L=robot.arm, l=robot.forearm)
    x, y, z = point
    legs = []
    for index in range(3):
        turn = Degrees(number(120 * index).value)
        along = x * cos(turn) + y * sin(turn) if index else x
        across = subtract(y * cos(turn), x * sin(turn)) if index else y
        legs.append(Leg(index + 1, along + r - R, z, across, L, l, True))
    return work, legs


def solved(leg: Leg, robot: FiveBar | Delta, work: Work) -> Solved:
    """x cos q + y sin q = k, from the square of the distance, which meets the circle of the crank twice."""
    i, taken, y = leg.index, work.problem.taken, leg.y
    angle = Symbol(free(taken, f"theta_{i}", f"q_{i}"))
    u, v, k, w = (Symbol(free(taken, f"{name}_{i}", f"{name}{name}_{i}")) for name in "uvkw")
    beside = () if leg.aside == ZERO else (v**2,)
    formulas: dict[Symbol, Expr] = {u: leg.x} | ({v: leg.aside} if beside else {})
    for name, formula in formulas.items():
        work = work.line(name, formula)
    if i == 1:  # the equation is the same for all
        rise = leg.crank * sin(angle)
        gap = y + rise if leg.down else subtract(y, rise)
        apart = add(squared(subtract(u, leg.crank * cos(angle))), *beside, squared(gap))
        work = work.showing(Step("apart", (apart, leg.rod**2), "in-numbers"))
    formulas[k] = (add(u**2, *beside, y**2, leg.crank**2) - leg.rod**2) / (2 * leg.crank)
    formulas[w] = sqrt(u**2 + y**2 - k**2)
    for name in (k, w):
        work = work.line(name, formulas[name], value=formulas[name])
    ways = list[tuple[Phrase, dict[Symbol, Expr]]]()
    for side, way in zip(SIDES[type(robot)], _ways(u, y, k, w, leg.down), strict=True):
        ways.append((Phrase(side, {"leg": number(i)}), {**formulas, angle: way}))
        work = work.showing(Step(f"{side}_{i}", (angle, way), "in-numbers"))
    return Solved(work, angle, tuple(name.name for name in formulas), tuple(ways))


def _ways(u: Symbol, y: Symbol, k: Symbol, w: Symbol, down: bool) -> tuple[Expr, Expr]:
    """The angle for either sign of the root."""
    if down:
        return atan2(u * w - y * k, u * k + y * w), atan2(negate(y * k) - u * w, u * k - y * w)
    return atan2(y * k + u * w, u * k - y * w), atan2(y * k - u * w, u * k + y * w)
