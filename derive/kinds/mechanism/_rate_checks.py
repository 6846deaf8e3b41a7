"""Rates of a linkage held to differences: its crank turned a little either way, and the bars joined again."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

from derive.algebra.numbers.floats import number as at
from derive.derivation import Branch, Result
from derive.expression import Expr, Symbol
from derive.kinds.checks import close
from derive.kinds.mechanism._loop import Loop, rate
from derive.kinds.mechanism._loop_oracle import angle_of, rockers, sliders, tip
from derive.kinds.mechanism._position_checks import There, in_turn
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.linkages import FourBar, SliderCrank

STEP, ROUGH = 1e-5, 1e-5
DRIVEN = 1.3  # rad/s


def joined(linkage: FourBar | SliderCrank, sizes: Sequence[float], near: float) -> tuple[float, float] | None:
    """The angle of the coupler and what follows, of the way to join the bars that is near; None where there
    is none."""
    crank, rod, *others, angle = sizes
    if isinstance(linkage, FourBar):
        rocker, ground = others
        ways = rockers(crank, rod, rocker, ground, angle)
        ends = [ground + tip(rocker, theta) for theta in ways]
        gaps = [abs(tip(1, way) - tip(1, near)) for way in ways]
    else:
        ways = sliders(crank, rod, others[0], angle)
        ends = [place + 1j * others[0] for place in ways]
        gaps = [abs(way - near) for way in ways]
    if not gaps:
        return None
    best = min(range(len(ways)), key=gaps.__getitem__)
    return angle_of(ends[best] - tip(crank, angle)), ways[best]


def _by_hand(
    linkage: FourBar | SliderCrank, place: There, values: Mapping[str, float], last: str
) -> list[float] | None:
    """The rates of both coordinates while the crank turns; None where the bars come apart."""
    *bars, angle = place.sizes
    ahead, behind = (
        joined(linkage, (*bars, angle + side * STEP), values[last]) for side in (1, -1)
    )  # fmt: skip
    if ahead is None or behind is None:
        return None
    further = ahead[1] - behind[1]
    further = angle_of(tip(1, further)) if isinstance(linkage, FourBar) else further
    return [moved / (2 * STEP) * DRIVEN for moved in (angle_of(tip(1, ahead[0] - behind[0])), further)]


def by_differences(
    linkage: FourBar | SliderCrank, loop: Loop, rates: Sequence[Expr], results: Mapping[str, Result],
    there: list[There], problem: Problem,
) -> Iterator[bool]:  # fmt: skip
    """Each rate, as it is written and in each solution."""
    driving, named = rate(loop.angle).name, [rate(name).name for name in loop.unknown]
    own = [name.name for name in loop.unknown]
    solutions = results["solutions"]
    branches = solutions if isinstance(solutions, tuple) else ()
    for place in there:
        for values, branch in zip(place.assemblies, branches, strict=True):
            wanted = _by_hand(linkage, place, values, own[-1])
            if wanted is None or not isinstance(branch, Branch):
                continue
            here, point = {**values, driving: DRIVEN}, {**place.point, driving: DRIVEN}
            whole = {name: at(problem.final(tree), point) for name, tree in branch.values.items()}
            short = in_turn(point, {Symbol(name): tree for name, tree in branch.short.items()})
            yield close([at(entry, here) for entry in rates], wanted, ROUGH)
            yield all(close([each[name] for name in named], wanted, ROUGH) for each in (whole, short))
            placed = [values[name] for name in own]
            yield all(close([each[name] for name in own], placed) for each in (whole, short))


def jacobians(linkage: FourBar | SliderCrank, work: Work, loop: Loop, there: list[There]) -> Iterator[bool]:
    """The equations hold where the bars are joined; each derivative is that of the gap between bars laid end
    to end while one coordinate moves alone; and the determinant is theirs."""
    names = [loop.angle.name, *(name.name for name in loop.unknown)]
    for place in islice(there, 2):
        for values in place.assemblies:
            sides = [step.chain for step in work.steps[:2]]
            yield close([at(left, values) for left, _ in sides], [at(right, values) for _, right in sides])
            slopes = [_slope(linkage, place, [values[name] for name in names], k) for k in range(3)]
            J_x, J_q = (
                [[at(entry, values) for entry in row] for row in work.matrix(name).rows]
                for name in ("J_x", "J_q")
            )
            yield close(J_q, [[slopes[0].real], [slopes[0].imag]], ROUGH)
            yield close(J_x, [[s.real for s in slopes[1:]], [s.imag for s in slopes[1:]]], ROUGH)
            (det,) = (at(step.result, values) for step in work.steps if step.name == "det")
            yield close(det, J_x[0][0] * J_x[1][1] - J_x[0][1] * J_x[1][0])


def _slope(linkage: FourBar | SliderCrank, place: There, moving: Sequence[float], which: int) -> complex:
    """Of the gap, while one coordinate moves."""
    ahead, behind = (
        _gap(linkage, place, [value + side * STEP * (k == which) for k, value in enumerate(moving)])
        for side in (1, -1)
    )
    return (ahead - behind) / (2 * STEP)


def _gap(linkage: FourBar | SliderCrank, place: There, moving: Sequence[float]) -> complex:
    """From the end of the one side to that of the other, wherever the bars are."""
    crank, rod, *others, _ = place.sizes
    angle, third, last = moving
    there = tip(crank, angle) + tip(rod, third)
    if isinstance(linkage, FourBar):
        return there - others[1] - tip(others[0], last)
    return there - last - 1j * others[0]
