"""A five-bar linkage laid out in numbers with bars in line, where its Jacobians must be singular."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from derive.algebra.numbers.floats import Point
from derive.algebra.numbers.floats import number as at
from derive.derivation import Branch, Derivation, Phrase
from derive.expression import Expr, Matrix, free_symbols, replace
from derive.kinds.checks import close, random_points
from derive.kinds.mechanism._loop_oracle import angle_of, tip, zeros
from derive.kinds.work import Work
from derive.mechanics.linkages import FiveBar
from derive.names import free

POINTS, NEAR, TURNS = 4, 1e-6, (0.9, 2.0, 0.2, 2.8)


def in_line(
    robot: FiveBar, work: Work, base: Derivation, branches: Sequence[Branch], meeting: Sequence[Phrase]
) -> Iterator[bool]:
    """Each distance that was found is that of joints whose bars are laid in line; there an entry of the one
    matrix vanishes, or the determinant of the other. Every line holds. The cranks meet, and leave the point
    a circle, just where couplers that are equally long are folded."""
    problem = work.problem
    J_x, J_q = base.matrix("J_x"), base.matrix("J_q")
    axes = [free(problem.taken, axis, f"p_{axis}") for axis in "xy"]
    motors = [free(problem.taken, f"theta_{k}", f"q_{k}") for k in (1, 2)]
    sizes = [problem.final(tree) for tree in (*robot.cranks, *robot.couplers, robot.ground)]
    for point in random_points(frozenset().union(*map(free_symbols, sizes)), POINTS):
        a_1, a_2, b_1, b_2, d = (at(tree, point) for tree in sizes)
        found = [at(tree, point) for branch in branches for tree in branch.values.values()]
        for leg, (crank, rod, foot) in enumerate(((a_1, b_1, 0.0), (a_2, b_2, d))):
            for folded, spot, elbow in _legs(crank, rod, foot):
                yield close([abs(spot - elbow), abs(spot - foot)], [rod, found[2 * leg + folded]])
                angle = angle_of(elbow - foot)
                here = _at(point, axes, spot, motors, (angle, angle))
                yield abs(at(problem.final(J_q.rows[leg][leg]), here)) < NEAR
        yield from (
            (said.key == "elbows-meet") == (abs(b_1 + way * b_2) < NEAR)
            for said, way in zip(meeting, (1, -1), strict=True)
        )
        for reach, way in ((found[4], 1), (found[5], -1)):
            for turns, spot in _couplers(sizes, point, reach, way):
                here = _at(point, axes, spot, motors, turns)
                yield abs(_det(problem.final(J_x), here)) < NEAR
        for step, value in zip(work.steps, found, strict=True):
            formulas = [problem.final(replace(each, work.definitions)) for each in step.chain[1:]]
            yield all(close(at(each, point), value) for each in formulas)


def _legs(crank: float, rod: float, foot: float) -> Iterator[tuple[int, complex, complex]]:
    """The point and the elbow of a leg stretched, and folded."""
    for turn in TURNS[:2]:
        elbow = foot + tip(crank, turn)
        yield 0, elbow + tip(rod, turn), elbow
        yield 1, elbow - tip(rod, turn), elbow


def _couplers(
    sizes: Sequence[Expr], point: Point, reach: float, way: int
) -> Iterator[tuple[tuple[float, float], complex]]:
    """Angles of the motors with which the ends of the cranks are so far apart, and the point in line."""
    a_1, a_2, b_1, b_2, d = (at(tree, point) for tree in sizes)
    for turn in TURNS:
        first = tip(a_1, turn)
        for other in zeros(lambda t, one=first: abs(d + tip(a_2, t) - one) - reach, 0, 7):  # type: ignore[misc]
            along = (d + tip(a_2, other) - first) / reach
            yield (turn, other), first + along * (b_1 if way > 0 or b_1 > b_2 else -b_1)
            return


def _at(
    point: Point, axes: Sequence[str], spot: complex, motors: Sequence[str], turns: Sequence[float]
) -> Mapping[str, float]:
    return {**point, axes[0]: spot.real, axes[1]: spot.imag, **dict(zip(motors, turns, strict=True))}


def _det(J: Expr, here: Mapping[str, float]) -> float:
    rows = J.rows if isinstance(J, Matrix) else ()
    (a, b), (c, d) = ([at(entry, here) for entry in row] for row in rows)
    return a * d - b * c
