"""Which positions an arm reaches: its workspace, with its holes."""

from __future__ import annotations

from derive.algebra.numbers import floats as numeric
from derive.derivation import Derivation, PageFacts, Phrase, Plot, Step
from derive.expression import ZERO, Expr, Symbol
from derive.figures.workspaces import cross_section, from_above
from derive.kinds.chains import closing
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.robot._point import PointOn, Tracked, tracked
from derive.kinds.robot._reach.checks import Reached
from derive.kinds.robot._reach.regions import Region, Secondary, final_distance, region_of, secondary
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.reach import moving_joints, turns_freely
from derive.mechanics.robot import Robot

CLAIMS = ("largest-distance", "smallest-distance", "lines", "link-lengths", "hole")
R_MIN, R_MAX = Symbol("r_min"), Symbol("r_max")


class Options(OptionsModel):
    """`point`: whose positions, the end-effector's if left out; `evaluate`: lengths, to draw it."""

    point: PointOn | None = None
    evaluate: Evaluation = None


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
    region = region_of(problem, found, point)
    r_max, r_min = final_distance(problem, region.largest[-1]), final_distance(problem, region.smallest[-1])
    steps = (
        closing(Step("r_max", (R_MAX, *region.largest), "stretched"), r_max),
        closing(Step("r_min", (R_MIN, *region.smallest), "folded"), r_min),
    )
    work = Work(problem, uses=(problem.ask("forward-kinematics"),), steps=steps).linked(but=("r_min",))
    plots = _pictures(problem, region, options)
    facts = _facts(problem, region, point, plots)
    reached = Reached(problem, found, point, region, {1: r_max, -1: r_min})
    work = work.claim(*reached.claims(steps, region.smallest[-1] == ZERO, facts.secondary))
    results = {"r_min": r_min, "r_max": r_max, "description": facts.description}
    return work.answer("workspace", results, facts, plots=plots)


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
        secondary=secondary(problem, region) if region.kind == "planar" and n > 2 else None,
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
