"""Which positions an arm reaches: its workspace, with its holes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

from derive.algebra.numbers import floats as numeric
from derive.derivation import Claim, Derivation, Phrase, Plot, Step
from derive.errors import NotDerivable
from derive.expression import ZERO, Call, Expr, Symbol, between, walk
from derive.figures.typical import completed, typical
from derive.figures.workspaces import Sizes, cross_section, from_above
from derive.kinds.chains import closing, distinct
from derive.kinds.checks import close, route
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.robot._lengths import unit_of_lengths
from derive.kinds.robot._point import PointOn, Tracked, tracked
from derive.kinds.robot._reach import drawn, sampled
from derive.kinds.robot._reach.by_section import by_section, cut
from derive.kinds.robot._reach.checks import Reached
from derive.kinds.robot._reach.dexterous import (
    Rings,
    described,
    is_said,
    rings,
    rings_within,
    starts_as_said,
    with_unit,
)
from derive.kinds.robot._reach.every_way import dexterous
from derive.kinds.robot._reach.facts import Facts as Facts
from derive.kinds.robot._reach.facts import Limits
from derive.kinds.robot._reach.limited import shape_within
from derive.kinds.robot._reach.ranged import ranges_of
from derive.kinds.robot._reach.regions import (
    Region,
    Secondary,
    final_distance,
    refuse_coupled,
    region_of,
    secondary,
)
from derive.kinds.robot._reach.sections import orientations_held
from derive.kinds.robot._reach.shapes import Shape
from derive.kinds.robot._reach.told import (
    LAST_LINK,
    R_MAX,
    R_MIN,
    R,
    arm_told,
    closed_where,
    orientations_told,
    region_told,
    shape_orientations,
)
from derive.kinds.robot._reach.turning_about import TurningAbout
from derive.kinds.robot._reach.where_real import where_real
from derive.kinds.robot._reach.within_ranges import within_ranges
from derive.kinds.robot._units import of_variables, together
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.reach import moving_joints, planar_arm, swung_arm, turns_freely
from derive.mechanics.robot import Robot
from derive.names import free

NOTHING, NEARLY = 1e-9, 1e-3  # of a hole, and of the corners of a circle
EXAMPLE = 0.6  # of the first link: a second one of which nothing is known, so that a hole is seen
CLAIMED = {
    "r_min": "orientations|still",
    "r_max": "still",
    "rings": "orientations",
    "regions": "section-counts",
}
CLAIMED_OF_REGION = (
    "largest-distance|inside|section-told|on-sphere|still|reached-there",
    "smallest-distance|filled|section-told|on-sphere|still|reached-there",
    "lines|section-told|on-sphere|still|reached-there",
    "link-lengths|touching|section-told|on-sphere|still|reached-there",
    "called|section-told|on-sphere|still|reached-there",
)
measures = together(
    of_variables, r_min="m", r_max="m", area="m^2", volume="m^3", rho2="m^2", z="m", z_min="m", z_max="m"
)
SIZES = {"area": "its-area", "volume": "its-volume"}


class Options(OptionsModel):
    """Which positions are wanted; `evaluate` gives lengths, to draw them."""

    kind: Literal["reachable", "dexterous"] = "reachable"
    """reachable: positions reached with one orientation at least; dexterous: with every one."""
    point: PointOn | None = None
    """The point whose positions are wanted; the end-effector if left out."""
    evaluate: Evaluation = None


def claims_of(robot: Robot, options: Options) -> tuple[str, ...]:
    """Of the distances, or of the orientations."""
    return ("orientations",) if options.kind == "dexterous" else CLAIMED_OF_REGION


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """The annulus or the hollow sphere between the arm folded and the arm stretched: r_min and r_max in
    the unit of the lengths (Siciliano et al., section 2.10; Craig, section 4.2). Joints turn without limits.

    Raises NotDerivable for arms of any other build.
    """
    found = chain_of(problem)
    point = tracked(problem, found, options.point)
    refuse_coupled(found, point)
    if options.kind == "dexterous":
        return dexterous(TurningAbout(problem, found, point), options.point, options.evaluate)
    shape = _shape(problem, found, point, options)
    if isinstance(shape, Derivation):
        return shape
    if shape:
        return _within(problem, found, point, shape, options)
    if (told := by_section(problem, found, point, options.evaluate)) is not None:
        return told
    if (told := where_real(problem, found, point)) is not None:
        return told
    region = region_of(problem, found, point)
    r_max, r_min = final_distance(problem, region.largest[-1]), final_distance(problem, region.smallest[-1])
    steps = (
        closing(Step("r_max", (R_MAX, *region.largest), "stretched"), r_max),
        closing(Step("r_min", (R_MIN, *region.smallest), "folded"), r_min),
    )
    work = Work(problem, uses=(problem.ask("forward-kinematics"),), steps=steps).linked(but=("r_min",))
    planar = region.kind == "planar" and len(region.lengths) > 2
    inner = secondary(problem, region) if planar else None
    plots = _pictures(problem, region, options, inner)
    facts = _facts(problem, region, point, inner, plots)
    if inner and not region.slides:
        everywhere = rings(problem, region)
        facts = replace(facts, secondary=_in_lengths(problem, described(everywhere)))
        turned = TurningAbout(problem, found, point).rings(everywhere)
        work = work.claim(route("orientations", turned), _as_called(everywhere, facts))
    reached = Reached(problem, found, point, region, {1: r_max, -1: r_min})
    work = work.claim(*reached.claims(steps, region.smallest[-1] == ZERO, inner))
    called = region_told(region, region.smallest[-1] == ZERO)
    work = work.claim(
        reached.is_called(called, facts.arm), *_as_drawn(plots, (r_max, r_min), problem, options)
    )
    if facts.orientations.key in ("too-few-joints", "no-wrist"):
        work = work.claim(orientations_held(problem, found, point, facts.orientations))
    results = {"r_min": r_min, "r_max": r_max, "description": called}
    return work.answer("workspace", results, facts, plots=plots)


def _shape(problem: Problem, found: Chain, point: Tracked, options: Options) -> Shape | Derivation | None:
    """What is reached within ranges, in closed form, or else where all has values in numbers. Raises
    NotDerivable."""
    try:
        return _limited(problem, found, point)
    except NotDerivable:
        if (told := within_ranges(problem, found, point, options.evaluate or ())) is None:
            raise
        return told


def _limited(problem: Problem, found: Chain, point: Tracked) -> Shape | None:
    """The shape where a joint has a range, or slides so that it matters. Raises NotDerivable where there is a
    range and no shape is known."""
    rows = moving_joints(found, point.position, point.last)
    ranged = any(problem.subject.links[i - 1].range for i in rows)
    if not ranged and (
        planar_arm(found, point.position, point.last) or swung_arm(found, point.position, point.last)
    ):
        return None
    shape = shape_within(problem, found, point)
    if shape is None and ranged and cut(problem, found, point) is None:
        raise NotDerivable("the workspace within ranges of the joints of this arm is not derived yet")
    return shape


def _within(problem: Problem, found: Chain, point: Tracked, shape: Shape, options: Options) -> Derivation:
    """Every joint within its limits: the distances that are met, and the size of what they enclose."""
    heads = {
        "r_max": R_MAX, "r_min": R_MIN, "area": Symbol(free(problem.taken, "A", "A_w")),
        "volume": Symbol(free(problem.taken, "V", "V_w")),
    }  # fmt: skip
    told = {name: final_distance(problem, chain[-1]) for name, chain in shape.formulas.items()}
    steps = tuple(
        closing(Step(name, (heads[name], *distinct(chain)), name), told[name])
        for name, chain in shape.formulas.items()
    )
    unlinked = [step.name for step in steps if any(_is_no_form(each) for each in step.chain)]
    work = Work(problem, uses=(problem.ask("forward-kinematics"),)).step(*steps).linked(but=unlinked)
    units = {heads[name]: f"m^{k}" for k, name in ((2, "area"), (3, "volume")) if unit_of_lengths(problem)}
    planar = shape.kind in ("ring", "rail", "bent")
    turning = [i for i in shape.rows if found.joint(i).type == "revolute"]
    spare = tuple(i for i, _ in found.moving if i not in shape.rows and i <= point.last)
    loose = tuple(i for i in spare if problem.subject.links[i - 1].range is None)
    orientations = shape_orientations(
        shape, spare, bool(turning) and turns_freely(found, turning, loose, planar), planar
    )
    orientations = TurningAbout(problem, found, point).told(orientations)
    everywhere = None
    if orientations.key in LAST_LINK:
        everywhere = rings_within(problem, shape.far_start, shape.link, shape.gap or ZERO)
    work = work.claim(*sampled.claims(problem, found, point, shape, steps, told, everywhere))
    plots = tuple(drawn.plots(problem, found, point, shape, told, options.evaluate or ()))
    limits = _limits(problem, found, shape)
    work = work.law("called", _said_of_joints(problem, shape, limits))
    facts = Facts(
        arm=shape.arm,
        shoulder=None,
        description=shape.description,
        within=None,
        closed=None,
        nearer=None if shape.side == ZERO else Phrase("not-nearer", {"side": shape.side}),
        kinds=_kinds(planar, shape.lift is not None),
        orientations=_in_lengths(problem, orientations),
        secondary=_in_lengths(problem, described(everywhere)) if everywhere else None,
        plots=tuple(plot.name for plot in plots),
        limits=limits,
        limited=Limits(
            distances=tuple(name for name in ("r_max", "r_min") if name in told),
            measure=shape.measure,
            size=Phrase(SIZES[shape.measure]) if shape.measure else None,
            rise=_rise(shape),
            borders=shape.borders,
        ),
        numbers=(*told,),
        page_names={name: heads[name] for name in told},
    )
    if everywhere:
        work = work.claim(_as_called(everywhere, facts))
    return work.answer(
        "workspace", {**told, "description": shape.description}, facts, plots=plots, units=units
    )


def _as_called(everywhere: Rings, facts: Facts) -> Claim:
    """That the positions with every orientation are called by the ends of their rings."""
    called = facts.secondary is not None and is_said(everywhere, facts.secondary)
    return route("orientations", (called, starts_as_said(everywhere, facts.orientations)))


def _in_lengths(problem: Problem, told: Phrase) -> Phrase:
    return with_unit(told, unit_of_lengths(problem))


def _kinds(planar: bool, lifted: bool) -> Phrase:
    """What the primary and the secondary workspace are, of an arm in a plane that a slide may lift too."""
    return Phrase("kinds" if not planar else "kinds-about-an-axis" if lifted else "kinds-in-a-plane")


def _is_no_form(tree: Expr) -> bool:
    """Whether there is no normal form of it."""
    return any(isinstance(node, Call) and node.function in ("max", "acos", "abs") for node in walk(tree))


def _limits(problem: Problem, found: Chain, shape: Shape) -> Phrase:
    told = ranges_of(problem, shape.rows)
    rest = tuple(
        Symbol(found.joint(i).variable) for i in shape.rows if not problem.subject.links[i - 1].range
    )
    key = "without-limits" if not told else "within-limits-but" if rest else "within-limits"
    if not told and any(found.joint(i).type == "prismatic" for i in shape.rows):
        key = "slides-without-limits"
    return Phrase(key, {"ranges": told, "rest": rest})


def _said_of_joints(problem: Problem, shape: Shape, said: Phrase) -> Iterator[bool]:
    """Whether just the joints with ranges are said to have them, and one slide is said to be alone."""
    rows = shape.rows
    ranged = sum(problem.subject.links[i - 1].range is not None for i in rows)
    yield shape.kind != "box" or (shape.arm.key == "slide") == (len(rows) == 1)
    yield ("within" in said.key) == (ranged > 0)
    yield said.key.endswith("but") == (0 < ranged < len(rows))


def _rise(shape: Shape) -> Phrase | None:
    if shape.rise is None:
        return None
    function, low, high = shape.rise
    return Phrase("rise", {"function": function, "ends": between(low, function, high)})


def _facts(
    problem: Problem, region: Region, point: Tracked, inner: Secondary | None, plots: tuple[Plot, ...]
) -> Facts:
    found, closed, planar = chain_of(problem), region.smallest[-1] == ZERO, region.kind == "planar"
    moving = moving_joints(found, point.position, point.last)
    spare = tuple(i for i, _ in found.moving if i not in moving and i <= point.last)
    free = turns_freely(found, moving, spare, planar)
    return Facts(
        arm=arm_told(region, tuple(moving[1:])),
        shoulder=(Symbol("o_s"), problem.readable_matrix(region.center)) if region.kind == "swung" else None,
        description=region_told(region, closed),
        folds=_folds(region) if region.kind == "swung" else None,
        within=between(R_MIN, R, R_MAX) if planar and len(region.lengths) > 1 else None,
        closed=closed_where(region),
        nearer=None if region.side == ZERO else Phrase("not-nearer", {"side": region.side}),
        kinds=_kinds(planar, region.slides),
        orientations=TurningAbout(problem, found, point).told(
            orientations_told(region, closed, spare, free, inner)
        ),
        plots=tuple(plot.name for plot in plots),
        limits=Phrase("without-limits"),
        numbers=("r_min", "r_max"),
    )


def _folds(region: Region) -> Phrase:
    """Where the point is furthest from the shoulder and nearest to it."""
    return Phrase("elbow-folds" if len(region.lengths) == 2 else "links-fold")


def _pictures(
    problem: Problem, region: Region, options: Options, inner: Secondary | None
) -> tuple[Plot, ...]:
    """With the lengths that are given, else of two links with such as show what is meant."""
    given = dict(options.evaluate or ())
    unit = unit_of_lengths(problem, given.values())
    trees = (*region.lengths, region.offset, region.side)
    try:
        known, sure = oracle_of(problem).at(point_of(given, problem.where)), True
        for tree in trees:
            numeric.number(tree, known)
    except KeyError:
        if len(region.lengths) != 2:
            return ()
        known, sure = completed(typical((), trees, problem.where, ())[0], problem.where), False
    *lengths, offset, side = (abs(numeric.number(tree, known)) for tree in trees)
    if not sure and region.lengths[0] != region.lengths[1]:
        lengths[1] = EXAMPLE * lengths[0]
    sizes = Sizes(lengths, unit if sure else "", sure, offset, side)
    if region.kind != "planar":
        return (cross_section(sizes),)
    if inner is None:
        return (from_above(sizes, None),)
    return (from_above(sizes, (numeric.number(inner.far, known), numeric.number(inner.gap, known))),)


def _as_drawn(
    plots: tuple[Plot, ...], told: tuple[Expr, Expr], problem: Problem, options: Options
) -> Iterator[Claim]:
    """The boundaries that are drawn are at the distances of the page, where these are numbers there."""
    for plot in plots:
        if plot.unscaled or not plot.series:
            continue
        point = oracle_of(problem).at(point_of(dict(options.evaluate or ()), problem.where))
        curves = plot.series.values()
        radii = [max(map(math.hypot, xs, ys)) for xs, ys in curves]
        distances = [numeric.number(tree, point) for tree in told]
        yield route("drawn", (any(close(r, d, NEARLY) for d in distances) for r in radii))
        yield route("drawn", close(max(radii), max(distances), NEARLY))
