"""Which positions an arm reaches: its workspace, with its holes."""

from __future__ import annotations

from derive.algebra.normal import normal
from derive.algebra.numbers import floats as numeric
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts, Phrase, Plot, Record, Step
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
from derive.figures.workspaces import cross_section, from_above
from derive.kinds.chains import closing
from derive.kinds.evaluation import Evaluation
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.robot._point import PointOn, Tracked, tracked
from derive.kinds.robot._reach.checks import Region, second_route
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.reach import PlanarArm, SwungArm, moving_joints, planar_arm, swung_arm, turns_freely
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
R_MIN, R_MAX = Symbol("r_min"), Symbol("r_max")


class Options(OptionsModel):
    """`point`: whose positions, the end-effector's if left out; `evaluate`: lengths, to draw it."""

    point: PointOn | None = None
    evaluate: Evaluation = None


class Secondary(Record):
    """Between which distances every orientation is possible: the last link, in any direction, has to start
    where the others reach."""

    far: Expr
    gap: Expr
    inside: Expr


class Facts(PageFacts):
    kind: str  # "planar", "swung", "torus"
    lengths: tuple[Expr, ...]
    joints: int
    offset: Expr | None
    side: Expr | None
    slides: bool
    pair: tuple[int, ...]  # joints of the two links
    spare: tuple[int, ...]  # joints that do not move the point
    free: bool  # these turn the end-effector as they like
    same: bool  # there is no hole
    description: Phrase
    secondary: Secondary | None
    last: Expr
    shoulder: tuple[Expr, Expr]
    plots: tuple[str, ...]


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """The annulus or the hollow sphere between the arm folded and the arm stretched: r_min and r_max in
    the unit of the lengths (Siciliano et al., section 2.10; Craig, section 4.2). Joints turn without limits.

    Raises NotDerivable for arms of any other build.
    """
    found = chain_of(problem)
    point = tracked(problem, found, options.point)
    region = _region(problem, found, point)
    r_max, r_min = _final(problem, region.largest[-1]), _final(problem, region.smallest[-1])
    steps = (
        closing(Step("r_max", (R_MAX, *region.largest), "stretched"), r_max),
        closing(Step("r_min", (R_MIN, *region.smallest), "folded"), r_min),
    )
    work = Work(problem, uses=(problem.ask("forward-kinematics"),), steps=steps).linked(but=("r_min",))
    work = work.claim(*second_route(problem, found, point, region, {1: r_max, -1: r_min}))
    plots = _pictures(problem, region, options)
    facts = _facts(problem, region, point, plots)
    results = {"r_min": r_min, "r_max": r_max, "description": facts.description}
    return work.answer("workspace", results, facts, plots=plots)


def _final(problem: Problem, tree: Expr) -> Expr:
    """With the values of `where`; a value that is a number is one."""
    if isinstance(tree, Call) and tree.function == "max":
        return _largest(problem, tuple(problem.final(part) for part in tree.arguments))
    return problem.final(tree)


def _region(problem: Problem, found: Chain, point: Tracked) -> Region:
    _refuse_coupled(found, point)
    planar = planar_arm(found, point.position, point.last)
    if planar:
        return _annulus(problem, planar)
    swung = swung_arm(found, point.position, point.last)
    if swung:
        return _shell(problem, swung)
    raise NotDerivable(
        "the workspace is found where all joints that move the point are parallel, and where they are three "
        "revolute ones of which the last two are parallel and square to the first; this arm is neither"
    )


def _refuse_coupled(found: Chain, point: Tracked) -> None:
    """Raises NotDerivable where the rows do not turn as they like, or the point moves in its link."""
    if point.drift is not None or not _each_its_row(found):
        raise NotDerivable(
            "the workspace is found where every row turns freely; in this arm the motion of one is tied to "
            "that of another"
        )


def _each_its_row(found: Chain) -> bool:
    """Whether the rows with joints move one by one, as they do where joints are not coupled."""
    coupling = found.coupling
    return coupling is None or (coupling.free and coupling.rows == tuple(i for i, _ in found.moving))


def _annulus(problem: Problem, arm: PlanarArm) -> Region:
    lengths = tuple(map(problem.readable, arm.lengths))
    smallest = lengths
    if len(lengths) == 2:
        smallest = _difference(problem, arm.lengths)
    elif len(lengths) > 2:
        smallest = _holes(problem, _overreach(problem, arm.lengths))
    return Region("planar", lengths, smallest, _sum(problem, arm.lengths), arm.center, slides=arm.slides)


def _shell(problem: Problem, arm: SwungArm) -> Region:
    lengths = tuple(map(problem.readable, arm.lengths))
    offset, side = problem.readable(arm.offset), problem.readable(arm.side)
    if offset != ZERO:
        whole = _aside(_sum(problem, (arm.offset, *arm.lengths)), side)
        return Region("torus", lengths, _difference(problem, arm.lengths), whole, arm.center, offset, side)
    near = _aside(_difference(problem, arm.lengths), side)
    far = _aside(_sum(problem, arm.lengths), side)
    return Region("swung", lengths, near, far, arm.center, offset, side)


def _aside(distance: tuple[Expr, ...], side: Expr) -> tuple[Expr, ...]:
    """The same distance to a point that lies to the side of it."""
    if side == ZERO:
        return distance
    return (side,) if distance[-1] == ZERO else (sqrt(add(squared(_bare(distance[-1])), squared(side))),)


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
    if value.constant is None:
        return (written,)
    return written, problem.readable(value if value.constant >= 0 else -value)


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


def _facts(problem: Problem, region: Region, point: Tracked, plots: tuple[Plot, ...]) -> Facts:
    n = len(region.lengths)
    found = chain_of(problem)
    moving = moving_joints(found, point.position, point.last)
    spare = [i for i, _ in found.moving if i not in moving and i <= point.last]
    closed = region.smallest[-1] == ZERO
    return Facts(
        kind=region.kind,
        lengths=region.lengths,
        joints=n if region.kind == "planar" else 3,
        offset=None if region.offset == ZERO else region.offset,
        side=None if region.side == ZERO else region.side,
        slides=region.slides,
        pair=tuple(moving[-2:]),
        spare=tuple(spare),
        free=turns_freely(found, moving, spare, region.kind == "planar"),
        same=n == 2 and closed,
        description=_description(region, closed),
        secondary=_secondary(problem, region) if region.kind == "planar" and n > 2 else None,
        last=region.lengths[-1],
        shoulder=(Symbol("o_s"), problem.readable_matrix(region.center)),
        plots=tuple(plot.name for plot in plots),
        numbers=("r_min", "r_max"),
    )


def _description(region: Region, closed: bool) -> Phrase:
    match region.kind, len(region.lengths):
        case "planar", 1:
            return Phrase("side-of-a-cylinder" if region.slides else "circle")
        case "planar", _ if region.slides:
            return Phrase("cylinder" if closed else "hollow-cylinder")
        case "planar", _:
            return Phrase("disc" if closed else "annulus")
        case "torus", _:
            return Phrase("swung-annulus")
    ball = Phrase("ball" if closed else "hollow-ball")
    return ball if region.side == ZERO else Phrase("bored-through", {"ball": ball})


def _secondary(problem: Problem, region: Region) -> Secondary:
    *others, last = region.lengths
    far = problem.readable(normal(subtract(add(*others), last)))
    scalars = tuple(map(normal, others))
    chain = (
        _difference(problem, scalars) if len(others) == 2 else _holes(problem, _overreach(problem, scalars))
    )
    gap = chain[-1]  # the radius of the hole in the workspace of these links
    return Secondary(far=far, gap=gap, inside=Call("abs", (subtract(Symbol("r"), last),)))


def _overreach(problem: Problem, lengths: tuple[Scalar, ...]) -> tuple[Expr, ...]:
    """By how much each link is longer than all the others together."""
    whole = sum(lengths, Scalar.of(0))
    return tuple(problem.readable(2 * length - whole) for length in lengths)


def _pictures(problem: Problem, region: Region, options: Options) -> tuple[Plot, ...]:
    """Where all lengths are numbers."""
    point = point_of(dict(options.evaluate or ()), problem.where)
    try:
        known = oracle_of(problem).at(point)
        lengths = [numeric.number(length, known) for length in region.lengths]
        offset, side = numeric.number(region.offset, known), numeric.number(region.side, known)
    except KeyError:
        return ()
    return (from_above(lengths),) if region.kind == "planar" else (cross_section(lengths, offset, side),)
