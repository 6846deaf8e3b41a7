"""The inverse of any open chain, by the sub-problems that a search finds in its equations."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

from derive.algebra.bounds import at_most
from derive.algebra.numbers.floats import Point
from derive.derivation import Derivation, Result
from derive.errors import NotDerivable
from derive.kinds.checks import route
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import LINKS_ALONE
from derive.kinds.robot._inverse import by_elimination
from derive.kinds.robot._inverse.branches import Solutions
from derive.kinds.robot._inverse.checks import Tried, as_printed
from derive.kinds.robot._inverse.choices import Choices, signs_of
from derive.kinds.robot._inverse.evaluated import by_plan, evaluated, in_degrees
from derive.kinds.robot._inverse.given import Given, goal_of, refuse_namesakes
from derive.kinds.robot._inverse.left_open import choosable, follow
from derive.kinds.robot._inverse.lines import Lines
from derive.kinds.robot._inverse.placed import Placed
from derive.kinds.robot._inverse.postures import Postures
from derive.kinds.robot._inverse.ranges import Ranges
from derive.kinds.robot._inverse.refused import no_closed_form, refuse_at_once, refuse_self_motion
from derive.kinds.robot._inverse.roots import Roots
from derive.kinds.robot._inverse.sampled import sample_points
from derive.kinds.robot._inverse.seen import Seen, angle_told, meeting_told
from derive.kinds.robot._inverse.stages import Stages
from derive.kinds.robot._inverse.target import Target
from derive.kinds.robot._inverse.told import Told
from derive.kinds.robot._rows.by_rows import by_rows
from derive.kinds.work import Work
from derive.mechanics.budget import Budget
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.arm_angle import ArmAngle, arm_angle
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.plan import Plan, Search
from derive.mechanics.inverse.search import MOST_TERMS
from derive.mechanics.inverse.six_axes import SixAxes
from derive.names import free

POINTS, MOST_POINTS = 5, 40
ATTEMPT = 1_000_000  # units of work: the equations of an arm with an offset wrist take a quarter
DIGITS = "0123456789"


def derive(
    chain: Chain, given: Given, place: Place | None, problem: Problem, psi: str | None = None
) -> Derivation:
    """The plan, worked and tried; for screws without one, that of the rows found for them. Seven joints by
    the arm angle, which may have a name. Raises NotDerivable where there is no plan, with what is left to
    solve."""
    goal = goal_of(given, chain, problem)
    unused = partial(free, problem.taken | set(goal.names) | ({psi} if psi else set()))
    arm = arm_angle(chain, goal, psi or unused("psi"), unused)
    target = Target.of(problem, chain, goal)
    draw = partial(_points, chain, goal, problem, arm)
    if arm is None:
        refuse_at_once(chain, goal)
    points = draw(POINTS)
    if arm is None:
        refuse_self_motion(target, points)
    search = Search(chain, goal, points[:2], unused, Budget(MOST_TERMS))
    plan = search.by_arm_angle(arm) if arm else _plan(search, target)
    if not (plan and plan.complete) and problem.subject.by_screws:
        return by_rows("inverse-kinematics", problem, given=given, evaluate=place)
    if not (plan and plan.complete) and place and by_elimination.fits(chain, target):
        return by_elimination.derive(chain, target, place, problem)
    if plan is None:
        raise NotDerivable(by_elimination.NO_FORMULA + by_elimination.offered(chain, target))
    if not plan.complete:
        raise NotDerivable(no_closed_form(plan, goal, problem) + by_elimination.offered(chain, target))
    worked = Stages(problem, chain, goal, plan, unused).worked()
    solutions = Solutions(worked.items, chain.variables, frozenset(plan.knowledge.slides), problem, unused)
    roots = Roots.of(plan, worked, solutions, target)
    named = roots.named if roots else tuple
    trial = _tried(solutions, target, named(points), lambda count: named(draw(count)))
    if trial.partial:
        solutions = replace(solutions, reached=trial.reached)
    two = worked.two_valued
    postures = Postures(worked, trial, signs_of(two, solutions.chosen)).found()
    choices = Choices(two, solutions.chosen, postures, unused, roots.found.root if roots else "")
    results: dict[str, Result] = {"solutions": solutions.branches}
    if solutions.order:
        results["order"] = solutions.order
    in_numbers = partial(by_plan, solutions, plan, target, place or ())
    if roots:
        in_numbers = partial(roots.each, in_numbers=in_numbers)
    values = evaluated(solutions.branches, place, problem, in_numbers, roots.names if roots else frozenset())
    ranges = Ranges.of(problem, place)
    values = ranges.judged(values)
    work = Work(problem, known=worked.definitions, uses=(problem.ask("forward-kinematics"),))
    work = work.showing(*worked.steps).linked(but=worked.conditional).claim(*trial.claims())
    work = work.claim(as_printed(trial, solutions.branches, solutions.order))
    work = work.claim(*Lines(trial, worked, solutions.chosen).claims())
    for part in values.each:
        placed = Placed(target, solutions.branches, solutions.order, part, solutions.at_home)
        work = work.claim(*placed.claims(place, problem))
    if roots:
        results["quartic"] = roots.polynomial
        work = work.claim(*roots.claims(points, values))
    if opened := tuple(choosable(worked.solved, target)):
        work = work.claim(route("left-open", (each for one in opened for each in follow(one, target))))
    work = work.claim(*Seen(worked, trial, choices).claims())
    work = work.claim(*ranges.claims(values))
    facts = Told(worked, solutions, choices, opened).facts(trial.partial, values, in_degrees(problem, place))
    facts = replace(facts, feasible=ranges.said, turn_limits=ranges.of_angles)
    if facts.known and goal.angle:
        work = work.claim(angle_told(facts.known, trial))
    if facts.wrist and facts.wrist.meeting and "meet" in facts.wrist.meeting.key:
        work = work.claim(meeting_told(facts.wrist.meeting, worked, trial))
    read = facts.wrist is not None and facts.wrist.stands  # off the pose of the end-effector
    unread = frozenset() if read else LINKS_ALONE
    return work.answer("inverse-kinematics", results, facts, evaluated=values.values, unread=unread)


def swung_by(chain: Chain, given: Given, free: tuple[str, ...], problem: Problem) -> str | None:
    """What the author calls the arm angle: the one name under `free`, where that is not called like a joint
    and the arm has such an angle. Raises NotDerivable where it stands for something else."""
    stems = {name.rstrip(DIGITS) for name in chain.variables}
    if len(free) != 1 or free[0].rstrip(DIGITS) in stems:
        return None
    goal = goal_of(given, chain, problem)
    if arm_angle(chain, goal, free[0], str) is None:
        return None
    refuse_namesakes(free, problem.taken | set(goal.names))
    return free[0]


def _points(
    chain: Chain, goal: Goal, problem: Problem, arm: ArmAngle | None, count: int
) -> tuple[dict[str, float], ...]:
    """Poses that the arm reaches, with the arm angle it has there."""
    found = sample_points(chain, goal, problem, count)
    return tuple({**each, arm.psi: arm.at(chain, each)[arm.psi]} for each in found) if arm else found


def _plan(search: Search, target: Target) -> Plan | None:
    """None where no three neighbouring axes suggest that there is one, and the search for it grows long."""
    chain, point = search.chain, search.points[0]
    if not by_elimination.fits(chain, target) or SixAxes.of(chain, point, target.size(point)).has_formulas:
        return search.plan()
    try:
        with at_most(ATTEMPT):
            return search.plan()
    except NotDerivable:
        return None


def _tried(
    solutions: Solutions, target: Target, points: Sequence[Point], draw: Callable[[int], Sequence[Point]]
) -> Tried:
    """At poses enough for every branch to be real at one of them, if any is."""
    for tried in (points, draw(MOST_POINTS)):
        met = [[solutions.known(each, point) for each in solutions.chosen] for point in tried]
        if all(any(branch) for branch in zip(*met, strict=True)):
            break
    return Tried(target, tried, solutions.conditions, met, solutions.at_home)
