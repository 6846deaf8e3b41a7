"""The Jacobians of a robot with cranks: what the rods of its legs make of the velocity of its point."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import islice
from math import dist

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import number as at
from derive.derivation import Derivation
from derive.expression import (
    Call,
    Degrees,
    Expr,
    Symbol,
    add,
    column,
    cos,
    number,
    sin,
    subtract,
    terms_of,
)
from derive.kinds.checks import close, route
from derive.kinds.mechanism._facts import JacobianFacts
from derive.kinds.mechanism._leg_checks import elbow_and_end, places
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.linkages import Delta, FiveBar
from derive.names import free

STEP, ROUGH, POINTS = 1e-4, 1e-6, 3


def jacobians_of_rods(
    robot: FiveBar | Delta, position: Sequence[Expr] | None, problem: Problem
) -> Derivation:
    """h_i^T (v - B_i'(theta_i) thetadot_i) = 0, h_i along the rod of leg i: J_x v = J_q thetadot (Gosselin
    and Angeles, Singularity analysis of closed-loop kinematic chains)."""
    axes = "xyz" if isinstance(robot, Delta) else "xy"
    wanted = position or tuple(Symbol(free(problem.taken, axis, f"p_{axis}")) for axis in axes)
    work, point = Work(problem).naming(**dict(zip(axes, wanted, strict=True)))
    work, rods, angles = _rods(robot, work, point)
    given = work.typed
    count = len(rods)
    ends = [f"_{k}" for k in range(1, count + 1)]
    letter = free(problem.taken, "h", "hh", indices=ends)  # s_1 is a sine
    names = [Symbol(letter + end) for end in ends]
    for name, rod in zip(names, rods, strict=True):
        work = work.line(name, column(rod))
    values = [work.value_matrix(name) for name in names]
    J_x = ScalarMatrix.of([[*value.entries] for value in values])
    turned = [value.T @ value.diff(angle.name) for value, angle in zip(values, angles, strict=True)]
    zero = turned[0][0, 0] - turned[0][0, 0]
    J_q = ScalarMatrix.of(
        [[-turned[i][0, 0] if i == j else zero for j in range(count)] for i in range(count)]
    )
    work = work.line("J_x", value=J_x).line("J_q", value=J_q)
    if count == 2:
        work = work.line(Call("det", (Symbol("J_x"),)), value=J_x.det(), label="det")
    results = {"J_x": work.final("J_x"), "J_q": work.final("J_q")}
    work = work.claim(route("by-differences", _by_differences(robot, work, wanted, angles)))
    facts = JacobianFacts(
        given=given, rods=tuple(name.name for name in names), first=names[0], angles=tuple(angles),
        delta=isinstance(robot, Delta), by_joint=("J_x", "J_q"),
    )  # fmt: skip
    return work.answer("jacobian", results, facts)


def _rods(
    robot: FiveBar | Delta, work: Work, point: tuple[Symbol, ...]
) -> tuple[Work, list[list[Expr]], list[Symbol]]:
    """The vector along the rod of each leg, from the end of its crank, by the point and the angle; and the
    angles."""
    angles = [Symbol(free(work.problem.taken, f"theta_{k}", f"q_{k}")) for k in range(1, 4)]
    if isinstance(robot, FiveBar):
        first, second = robot.cranks
        work, (a, b, d) = work.naming(a_1=first, a_2=second, d=robot.ground)
        x, y = point
        one, two, _ = angles
        rods = [
            [subtract(x, a * cos(one)), subtract(y, a * sin(one))],
            [x - d - b * cos(two), subtract(y, b * sin(two))],
        ]
        return work, rods, angles[:2]
    work, (R, r, L) = work.naming(R=robot.base, r=robot.platform, L=robot.arm)
    x, y, z = point
    rods = []
    for k, angle in enumerate(angles):
        out, turn = r - R - L * cos(angle), Degrees(number(120 * k).value)
        along = [out * cos(turn)] if k else terms_of(out)
        rods.append([add(x, *along), y + out * sin(turn) if k else y, z + L * sin(angle)])
    return work, rods, angles


def _by_differences(
    robot: FiveBar | Delta, work: Work, wanted: Sequence[Expr], angles: Sequence[Symbol]
) -> Iterator[bool]:
    """Half the square of the distance between the joints of each rod, while the point or a crank moves."""
    problem = work.problem
    typed = {name.name: value for name, value in work.typed if isinstance(name, Symbol)}
    for point, sizes, position in islice(places(robot, work, wanted), POINTS):
        turns = [0.3 + 0.4 * k for k in range(len(angles))]
        values = {**point, **{name: at(problem.final(value), point) for name, value in typed.items()}}
        values |= {angle.name: turn for angle, turn in zip(angles, turns, strict=True)}
        J_x, J_q = (
            [[at(e, values) for e in row] for row in work.matrix(name).rows] for name in ("J_x", "J_q")
        )
        for leg, turn in enumerate(turns):
            worth = partial(_half_square, robot, sizes, leg + 1)
            ahead, behind = (
                [worth(_moved(position, k, side * STEP), turn) for k in range(len(position))]
                for side in (1, -1)
            )
            row = [(one - other) / (2 * STEP) for one, other in zip(ahead, behind, strict=True)]
            driven = (worth(position, turn + STEP) - worth(position, turn - STEP)) / (2 * STEP)
            yield close(J_x[leg], row, ROUGH)
            yield close(J_q[leg], [-driven if k == leg else 0.0 for k in range(len(angles))], ROUGH)


def _half_square(
    robot: FiveBar | Delta, sizes: Sequence[float], leg: int, place: tuple[float, ...], turn: float
) -> float:
    return dist(*elbow_and_end(robot, sizes, place, leg, turn)) ** 2 / 2


def _moved(place: Sequence[float], which: int, by: float) -> tuple[float, ...]:
    return tuple(value + by * (k == which) for k, value in enumerate(place))
