"""The Jacobian of a Stewart-Gough platform: how fast its legs extend while the platform moves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import dist
from typing import TYPE_CHECKING, TypeAlias

from derive.algebra.numbers.floats import number as at
from derive.derivation import Derivation
from derive.expression import (
    ZERO,
    Expr,
    Matrix,
    Quotient,
    Symbol,
    cross,
    free_symbols,
    replace,
)
from derive.kinds.checks import close, random_points, route
from derive.kinds.mechanism._facts import JacobianFacts, LegFacts
from derive.kinds.mechanism._stewart import Turn
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.linkages import Stewart
from derive.names import free

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]

STEP, ROUGH, POINTS = 1e-5, 1e-6, 2


def jacobian_of_legs(
    robot: Stewart, position: Sequence[Expr] | None, turn: Turn, legs: Derivation, problem: Problem
) -> Derivation:
    """ldot_i = u_i^T v + (r_i x u_i)^T omega with u_i = L_i/l_i (Lynch and Park, Modern Robotics, section
    7.1.2)."""
    told = legs.told(LegFacts)
    work = Work(problem).resting_on(legs)
    count = len(robot.base)
    ends = [f"_{k}" for k in range(1, count + 1)]
    arm = free(problem.taken, "r", "rr", indices=ends)
    rows = []
    for end, vector, length in zip(ends, told.vectors, told.lengths, strict=True):
        top = Symbol(f"{told.points[1].name.removesuffix('_1')}{end}") if told.points else Symbol("b")
        lever, along = Symbol(arm + end), Symbol(vector)
        work = work.line(lever, told.turned * top if told.turned else top)
        moment = work.problem.readable_matrix(work.value_matrix(cross(lever, along)))
        entries = [*work.entries(vector), *(entry for (entry,) in moment.rows)]
        rows.append(tuple(entry if entry == ZERO else Quotient(entry, Symbol(length)) for entry in entries))
    J = Matrix(tuple(rows))
    work = work.line("J", value=J)
    lengths: dict[Expr, Expr] = {Symbol(name): work[name] for name in told.lengths}
    final = Matrix(tuple(tuple(_final(problem, replace(e, lengths)) for e in row) for row in rows))
    results = {"J": final}
    work = work.claim(route("by-differences", _by_differences(robot, position, turn, problem, final)))
    facts = JacobianFacts(
        rods=tuple(arm + end for end in ends), first=Symbol(f"{arm}_1"),
        along=Symbol(told.vectors[0]) / Symbol(told.lengths[0]), by_joint=("J",),
    )  # fmt: skip
    return work.answer("jacobian", results, facts)


def _final(problem: Problem, tree: Expr) -> Expr:
    """With the names of `where` replaced, and nothing multiplied out."""
    return replace(tree, problem.names)


def _by_differences(
    robot: Stewart, position: Sequence[Expr] | None, turn: Turn, problem: Problem, J: Matrix
) -> Iterator[bool]:
    """The platform is moved and turned a little either way in numbers, and its legs are measured."""
    from derive.mechanics.oracle import in_sequence

    convention, angles = turn
    wanted = position or tuple(Symbol(free(problem.taken, axis, f"p_{axis}")) for axis in "xyz")
    trees = [*wanted, *(angles or (ZERO, ZERO, ZERO))]
    joints = [[part for point in points for part in point] for points in (robot.base, robot.platform)]
    finals = [problem.final(tree) for tree in (*trees, *joints[0], *joints[1])]
    for point in random_points(frozenset().union(*map(free_symbols, finals)), POINTS):
        values = [at(tree, point) for tree in finals]
        place, turns, parts = values[:3], values[3:6], values[6:]
        spots = [tuple(parts[k : k + 3]) for k in range(0, len(parts), 3)]
        R = in_sequence(convention, turns)
        half = len(spots) // 2
        columns = [
            [
                (ahead - behind) / (2 * STEP)
                for ahead, behind in zip(
                    _lengths(spots[:half], spots[half:], place, R, which, STEP),
                    _lengths(spots[:half], spots[half:], place, R, which, -STEP),
                    strict=True,
                )
            ]
            for which in range(6)
        ]
        ours = [[at(entry, point) for entry in row] for row in J.rows]
        yield close(ours, [list(row) for row in zip(*columns, strict=True)], ROUGH)


def _lengths(
    feet: list[tuple[float, ...]], tops: list[tuple[float, ...]], place: list[float], R: Array, which: int,
    by: float,
) -> list[float]:  # fmt: skip
    """Those of the legs, with the platform moved along an axis, or turned about one."""
    import numpy as np

    from derive.mechanics.oracle.poses import turn as turned

    axis = np.eye(3)[which % 3]
    spin = turned(axis, by) @ R if which > 2 else R
    middle = np.array(place) + (by * axis if which < 3 else 0 * axis)
    return [dist(foot, middle + spin @ np.array(top)) for foot, top in zip(feet, tops, strict=True)]
