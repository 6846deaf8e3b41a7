"""The factor by which a motion of the joints has to be slowed down, or can be made faster, to just keep the
limits of their torques."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

from pydantic import Field, PlainValidator, WithJsonSchema

from derive.derivation import Derivation, PageFacts, Phrase, Result, Table
from derive.errors import DivisionByZero, NotDerivable
from derive.expression import Approximate, Expr, column, free_symbols
from derive.kinds.checks import route
from derive.kinds.fields import Evaluation, OptionsModel, Place, Quantity, Time, read_point
from derive.kinds.path._timing import T as MOMENT
from derive.kinds.problem import Problem
from derive.kinds.robot._efforts import efforts
from derive.kinds.robot._scaled.checks import as_drawn, as_tabled, keeps, moves, right_words, scales
from derive.kinds.robot._scaled.demands import Demands
from derive.kinds.robot._scaled.planned import ENDS, Law, Planned, planned
from derive.kinds.robot._scaled.told import told_of, units_of
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.robot import Robot

NEEDS = ("bodies",)
CLAIMS = ("moves", "scales", "keeps", "as-tabled", "as-drawn", "right-words")
CLAIMED = {"factors": "as-tabled", "moments": "as-tabled", "active": "right-words"}
UNBOUND = "the motion needs no torque beyond that of gravity: no limit bounds how fast it can be"
RUBBING = "torques of friction do not scale as the others do; it is not derived yet for joints with friction"
ROUGH = "the joints have no velocity or acceleration at some time of the motion"
OPEN = (
    "torques are compared with their limits in numbers, and no value is known for {}; give one under where:"
)

Configuration = Annotated[Place, PlainValidator(read_point), WithJsonSchema({"type": "object"})]


class Options(OptionsModel):
    """The motion of the joints, from rest to rest or as functions of the time t, and their limits; `evaluate`
    gives values of symbols."""

    start: Configuration = Field((), alias="from")
    """Joint variables where the motion begins, at rest."""
    end: Configuration = Field((), alias="to")
    """Joint variables where it ends, at rest."""
    law: Law | None = None
    """The polynomial by which all joints go from one to the other; cubic if left out."""
    joints: tuple[Quantity, ...] = ()
    """The joint variables as functions of t, in place of from, to and law."""
    time: Time
    """How long the motion takes."""
    torque_max: tuple[Quantity, ...] = Field(min_length=1)
    """The greatest torque of each joint, or force of one that slides, in both directions."""
    evaluate: Evaluation = None


class Facts(PageFacts):
    given: tuple[tuple[Expr, Expr], ...]
    law: Phrase
    shares: tuple[str, ...]  # steps, as those that follow
    joints: tuple[str, ...]
    efforts: Phrase
    slower: Phrase
    scaled: str
    limit: Phrase
    needed: str
    table: Table
    greatest: Phrase
    needs: Phrase
    again: tuple[Phrase, ...]
    factor: str
    time: str
    verdict: Phrase


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """k^2 is the greatest of |tau - g|/(tau_M -+ g) (Hollerbach, Dynamic scaling of manipulator trajectories,
    1984; Siciliano et al., section 7.7).

    Raises NotDerivable where symbols are left, with friction, and where gravity alone is too much.
    """
    demands = _demands(robot, options, problem)
    try:
        peaks = demands.peaks
    except DivisionByZero:
        raise NotDerivable(ROUGH, "joints") from None
    if not any(each.k for each in peaks):
        raise NotDerivable(UNBOUND)
    plan, told, k = demands.plan, told_of(demands), max(each.k for each in peaks)
    work = Work(problem).resting_on(demands.motion).showing(*plan.shares, *plan.joints, *told.steps)
    facts = Facts(
        given=plan.given,
        law=told.law,
        shares=tuple(step.name for step in plan.shares),
        joints=tuple(step.name for step in plan.joints),
        efforts=efforts(robot),
        slower=told.slower,
        scaled="scaled",
        limit=told.limit,
        needed="needed",
        table=told.table,
        greatest=told.greatest,
        needs=told.needs,
        again=told.again,
        factor="factor",
        time="time",
        verdict=told.verdict,
        numbers=(),
        page_names={"k": told.names.k.name, "time": told.names.T_k.name},
    )
    listed = {"factors": [each.k for each in peaks], "moments": [each.t for each in peaks]}
    alone = {"k": k, "time": k * demands.whole}
    results: dict[str, Result] = {name: Approximate(value) for name, value in alone.items()}
    results |= {name: column(map(Approximate, values)) for name, values in listed.items()}
    results["active"] = told.active
    work = work.claim(
        route("moves", moves(demands)),
        route("scales", scales(demands, told)),
        route("keeps", keeps(demands, told)),
        route("as-tabled", as_tabled(demands, told, results)),
        route("as-drawn", as_drawn(demands, told)),
        route("right-words", right_words(demands, told)),
    )
    units = units_of(told.names, demands)
    answer = work.answer("time-scaling", results, facts, plots=(told.picture,), units=units)
    return replace(answer, evaluated={**alone, **listed})


def _demands(robot: Robot, options: Options, problem: Problem) -> Demands:
    """In numbers. Raises NotDerivable where there are none, and with friction."""
    n, limits = len(robot.variables), options.torque_max
    if len(limits) != n:
        joints = f"{n} joints" if n > 1 else "one joint"
        raise NotDerivable(f"{len(limits)} limits for {joints}", "torque_max")
    if any(link.friction is not None for link in robot.links):
        raise NotDerivable(RUBBING)
    plan = planned(problem, options.law, options.start, options.end, options.joints, options.time)
    point = point_of(dict(options.evaluate or ()), problem.where)
    found = Demands(plan, problem.ask("dynamics"), limits, point)
    if missing := sorted(_names(found, plan, robot) - point.keys()):
        raise NotDerivable(OPEN.format(", ".join(missing)))
    if found.whole <= 0:
        raise NotDerivable("the time must be positive", "time")
    if any(most <= 0 for most in found.most):
        raise NotDerivable("a limit is the size of a torque, and positive", "torque_max")
    return found


def _names(found: Demands, plan: Planned, robot: Robot) -> set[str]:
    """Those that need a value."""
    trees = (found.motion.matrix("tau"), *plan.by_time, *found.limits, plan.time)
    moving = {f"{name}{end}" for name in robot.variables for end in ENDS}
    return {name for tree in trees for name in free_symbols(tree)} - moving - {MOMENT.name}
