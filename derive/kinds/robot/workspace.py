"""Which positions an arm reaches: its workspace, with its holes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from derive.algebra import numeric
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.derivation import Claim, Derivation, Plot, Result, Step
from derive.errors import NotDerivable
from derive.expression import (
    ZERO,
    Call,
    Expr,
    Symbol,
    add,
    number,
    sqrt,
    squared,
    subtract,
)
from derive.kinds.checks import SECOND_ROUTE, links, random_points
from derive.kinds.evaluation import Evaluation
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, closing, oracle_of
from derive.kinds.robot._point import PointOn, Tracked, tracked
from derive.kinds.robot._reach_pictures import cross_section, from_above
from derive.mechanics.chain import Chain
from derive.mechanics.reach import PlanarArm, SwungArm, planar_arm, swung_arm
from derive.mechanics.robot import Robot

RESULTS = {
    "r_min": "the smallest distance that is reached (0: there is no hole)",
    "r_max": "the largest",
    "description": "what the workspace looks like, and from where the distances count",
}
EXAMPLE = """\
title: Workspace
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: l1, alpha: 0}
    - {theta: theta2*, d: 0, a: l2, alpha: 0}
  find: workspace
"""
SMALL = 1e-6
NEAR = 1e-2  # a search creeps where links of 2, 2 and 4 are folded
SWEEPS = 40  # of a search joint by joint
R_MIN, R_MAX = Symbol("r_min"), Symbol("r_max")


class Options(OptionsModel):
    """`point`: whose positions, the end-effector's if left out; `evaluate`: lengths, to draw it."""

    point: PointOn | None = None
    evaluate: Evaluation = None


@dataclass(frozen=True, slots=True)
class Region:
    """`kind` is "planar" or "swung"; `lengths` of the links, as trees; r_min and r_max with the chains that
    lead to them, and the distances they count: from `center` (3 by 1)."""

    kind: str
    lengths: tuple[Expr, ...]
    smallest: tuple[Expr, ...]
    largest: tuple[Expr, ...]
    center: ScalarMatrix
    offset: Expr = ZERO
    side: Expr = ZERO


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """The annulus or the hollow sphere between the arm folded and the arm stretched; joints turn without
    limits.

    Raises NotDerivable for arms of any other build.
    """
    found = chain_of(problem)
    point = tracked(problem, found, options.point)
    region = _region(problem, found, point)
    steps = (
        Step("r_max", (R_MAX, *region.largest), "stretched"),
        Step("r_min", (R_MIN, *region.smallest), "folded"),
    )
    steps = tuple(closing(step, _final(problem, step.result)) for step in steps)
    facts = _facts(problem, region, point)
    results: dict[str, Result] = {
        "r_min": steps[1].result,
        "r_max": steps[0].result,
        "description": facts["description"],
    }
    plots = _pictures(problem, region, options)
    facts["plots"] = tuple(plot.name for plot in plots)
    facts["numbers"] = ("r_min", "r_max")
    return Derivation(
        "workspace", steps, results,
        (*links(steps[:1], problem.names), *_second_route(problem, found, point, region, steps)),
        {}, uses=(problem.ask("forward-kinematics"),), plots=plots, facts=facts,
    )  # fmt: skip


def _final(problem: Problem, tree: Expr) -> Expr:
    """With the values of `where`; a value that is a number is one."""
    if isinstance(tree, Call) and tree.function == "max":
        return _largest(problem, tuple(problem.final(part) for part in tree.arguments))
    return problem.final(tree)


def _region(problem: Problem, found: Chain, point: Tracked) -> Region:
    planar = planar_arm(found, point.position, point.last)
    if planar:
        return _annulus(problem, planar)
    swung = swung_arm(found, point.position, point.last)
    if swung:
        return _shell(problem, swung)
    raise NotDerivable(
        "the workspace is found for arms whose revolute joints are all parallel, and for three revolute "
        "joints of which the last two are parallel and square to the first; this arm is neither"
    )


def _annulus(problem: Problem, arm: PlanarArm) -> Region:
    lengths = tuple(map(problem.readable, arm.lengths))
    largest = _sum(problem, arm.lengths)
    if len(lengths) == 1:
        return Region("planar", lengths, (lengths[0],), largest, arm.center)
    if len(lengths) == 2:
        return Region("planar", lengths, _difference(problem, arm.lengths), largest, arm.center)
    return Region("planar", lengths, _holes(problem, _overreach(problem, arm.lengths)), largest, arm.center)


def _shell(problem: Problem, arm: SwungArm) -> Region:
    lengths = tuple(map(problem.readable, arm.lengths))
    offset, side = problem.readable(arm.offset), problem.readable(arm.side)
    if offset != ZERO:
        whole = _sum(problem, (arm.offset, *arm.lengths))[-1]
        far = (whole,) if side == ZERO else (sqrt(add(squared(whole), squared(side))),)
        return Region("torus", lengths, _difference(problem, arm.lengths), far, arm.center, offset, side)
    near, far = _difference(problem, arm.lengths), _sum(problem, arm.lengths)
    if side != ZERO:
        near = (sqrt(add(squared(_bare(near[-1])), squared(side))),) if near[-1] != ZERO else (side,)
        far = (sqrt(add(squared(far[-1]), squared(side))),)
    return Region("swung", lengths, near, far, arm.center, offset, side)


def _bare(tree: Expr) -> Expr:
    """The inside of |...|, where its square is all that counts."""
    return tree.arguments[0] if isinstance(tree, Call) and tree.function == "abs" else tree


def _sum(problem: Problem, lengths: tuple[Scalar, ...]) -> tuple[Expr, ...]:
    """l1 + l2, and its value where that is shorter."""
    written = add(*map(problem.readable, lengths))
    value = problem.readable(sum(lengths, Scalar.of(0)))
    return (written,) if value == written else (written, value)


def _difference(problem: Problem, lengths: tuple[Scalar, ...]) -> tuple[Expr, ...]:
    """|l1 - l2|."""
    one, two = map(problem.readable, lengths)
    value = lengths[0] - lengths[1]
    written = Call("abs", (subtract(one, two),))
    if value.constant is not None:
        size = problem.readable(value if value.constant >= 0 else -value)
        return (written, size)
    return (written,)


def _holes(problem: Problem, holes: tuple[Expr, ...]) -> tuple[Expr, ...]:
    """max(0, l1 - l2 - l3, ...): the longest link reaches over all others, or there is no hole."""
    chain: tuple[Expr, ...] = (Call("max", (ZERO, *holes)),)
    decided = _largest(problem, holes)
    return chain if decided == chain[0] else (*chain, decided)


def _largest(problem: Problem, holes: tuple[Expr, ...]) -> Expr:
    """max(0, ...) where all are numbers."""
    values = [normal(hole).constant for hole in holes]
    if any(value is None for value in values):
        return Call("max", (ZERO, *(hole for hole in holes if hole != ZERO)))
    best = max((value for value in values if value is not None), default=None)
    return problem.readable(Scalar.of(best)) if best is not None and best > 0 else number(0)


# -- words and pictures -------------------------------------------------------------------------------


def _facts(problem: Problem, region: Region, point: Tracked) -> dict[str, Any]:
    n = len(region.lengths)
    closed = region.smallest[-1] == ZERO
    return {
        "kind": region.kind,
        "lengths": region.lengths,
        "joints": n if region.kind == "planar" else 3,
        "offset": None if region.offset == ZERO else region.offset,
        "side": None if region.side == ZERO else region.side,
        "closed": closed,
        "same": n == 2 and closed,
        "description": _description(region, closed),
        "secondary": _secondary(problem, region) if region.kind == "planar" and n > 2 else None,
        "last": region.lengths[-1],
        "shoulder": (Symbol("o_s"), problem.readable_matrix(region.center)),
    }


def _description(region: Region, closed: bool) -> str:
    match region.kind, len(region.lengths):
        case "planar", 1:
            return "a circle about the axis of the joint"
        case "planar", _:
            return "a disc about the first axis" if closed else "an annulus about the first axis"
        case "torus", _:
            return "the annulus of the two links, at the offset from the first axis, swung about that axis"
    hole = "a ball" if closed else "a hollow ball"
    return f"{hole} about the shoulder" + (", bored through along the first axis" if region.side != ZERO else "")


def _secondary(problem: Problem, region: Region) -> dict[str, Expr]:
    """Between which distances every orientation is possible: the last link, in any direction, has to start
    where the others reach."""
    *others, last = region.lengths
    far = problem.readable(normal(subtract(add(*others), last)))
    scalars = tuple(map(normal, others))
    gap = _difference(problem, scalars)[-1] if len(others) == 2 else _gap(problem, scalars)
    return {"far": far, "gap": gap, "inside": Call("abs", (subtract(Symbol("r"), last),))}


def _gap(problem: Problem, lengths: tuple[Scalar, ...]) -> Expr:
    """The radius of the hole in the workspace of these links."""
    return _holes(problem, _overreach(problem, lengths))[-1]


def _overreach(problem: Problem, lengths: tuple[Scalar, ...]) -> tuple[Expr, ...]:
    """By how much each link is longer than all the others together."""
    whole = sum(lengths, Scalar.of(0))
    return tuple(problem.readable(2 * length - whole) for length in lengths)


def _pictures(problem: Problem, region: Region, options: Options) -> tuple[Plot, ...]:
    """Where all lengths are numbers."""
    point = {name: numeric.number(value, {}) for name, value in options.evaluate or ()}
    try:
        known = oracle_of(problem).at(point)
        lengths = [numeric.number(length, known) for length in region.lengths]
        offset, side = numeric.number(region.offset, known), numeric.number(region.side, known)
    except KeyError:
        return ()
    return (from_above(lengths),) if region.kind == "planar" else (cross_section(lengths, offset, side),)


# -- what it is held to -------------------------------------------------------------------------------


def _second_route(
    problem: Problem, found: Chain, point: Tracked, region: Region, steps: tuple[Step, ...]
) -> tuple[Claim, ...]:
    """The largest and smallest distance by a search over the joints, one after the other."""
    if region.kind == "torus":
        return (_reached(problem, found, point, region, steps[0].result, 1),)
    return (
        _reached(problem, found, point, region, steps[0].result, 1),
        _reached(problem, found, point, region, steps[1].result, -1),
    )


def _reached(problem: Problem, found: Chain, point: Tracked, region: Region, bound: Expr, sign: int) -> Claim:
    import numpy as np

    names = [joint.variable for i, joint in found.moving if i <= point.last]
    holds = True
    for at in random_points(sorted(problem.symbols), 2):
        known = dict(oracle_of(problem).at(at))
        axis = np.array(numeric.matrix_numbers(found.axis(next(found.moving)[0]), known)).ravel()

        def distance(here: dict[str, float], axis: Any = axis) -> float:
            return _distance(problem, point, region, here, axis)

        search = _scan if region.kind == "torus" else _search
        best = search(distance, known, names, sign)
        beyond = sign * (best - numeric.number(bound, known))  # the search comes near, and never further
        size = numeric.number(region.largest[-1], known)
        holds &= -NEAR * size < beyond < SMALL * size
    word = "largest" if sign > 0 else "smallest"
    return Claim(f"the {word} distance agrees with a search over the joints", SECOND_ROUTE, holds)


def _distance(problem: Problem, point: Tracked, region: Region, here: dict[str, float], axis: Any) -> float:
    """From the center; in the plane of a planar arm, from the first axis where that is what counts."""
    import numpy as np

    oracle = oracle_of(problem)
    T = oracle.tool(here) if point.frame > len(problem.subject.links) else oracle.poses(here)[point.frame]
    p = T[:3, :3] @ np.array([numeric.number(x, here) for x in point.offset]) + T[:3, 3]
    d = p - np.array(numeric.matrix_numbers(region.center, here)).ravel()
    if region.kind in ("planar", "torus"):
        d = d - axis * (axis @ d)
    return float(np.linalg.norm(d))


def _search(
    distance: Callable[[dict[str, float]], float], at: dict[str, float], names: list[str], sign: int
) -> float:
    """The square of the distance is a + b cos q + c sin q in each joint: its extreme in closed form."""
    import math

    here = dict(at)
    for _ in range(SWEEPS):
        before = dict(here)
        for name in names:
            zero, half, quarter = (distance({**here, name: q}) ** 2 for q in (0.0, math.pi, math.pi / 2))
            a, b = (zero + half) / 2, (zero - half) / 2
            c = quarter - a
            if math.hypot(b, c) > 1e-12:
                here[name] = math.atan2(sign * c, sign * b)
        if all(abs(here[name] - before[name]) < 1e-10 for name in names):
            break
    return distance(here)


def _scan(
    distance: Callable[[dict[str, float]], float], at: dict[str, float], names: list[str], sign: int
) -> float:
    """The extreme by ever finer steps around the best so far; the first joint swings everything about the
    axis and is left where it is."""
    import math
    from itertools import product

    here, step = dict(at), math.pi / 4
    while step > 1e-5:
        tried = product(range(-4, 5), repeat=len(names) - 1)
        places = ({**here, **{n: here[n] + k * step for n, k in zip(names[1:], ks, strict=True)}} for ks in tried)
        here = max(places, key=lambda each: sign * distance(each))
        step /= 3
    return distance(here)
