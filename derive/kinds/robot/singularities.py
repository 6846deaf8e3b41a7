"""The configurations in which the end-effector can no longer move in every direction."""

from __future__ import annotations

from collections.abc import Sequence

from derive.algebra.infix import text
from derive.derivation import Derivation, Drawing, Result
from derive.errors import NotDerivable
from derive.expression import free_symbols
from derive.figures.singular_poses import drawn
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import LINKS_ALONE
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._singular.by_poses import center_seen, of_arm
from derive.kinds.robot._singular.checks import Checked
from derive.kinds.robot._singular.facts import Facts as Facts
from derive.kinds.robot._singular.facts import facts_of
from derive.kinds.robot._singular.graded import graded
from derive.kinds.robot._singular.lengths import at_special_lengths, lengths_told
from derive.kinds.robot._singular.minors import Way
from derive.kinds.robot._singular.saying import branches
from derive.kinds.robot._singular.sets import Analysed
from derive.kinds.robot._singular.ways import by_determinant, by_minors, by_wrist
from derive.kinds.robot._velocity.task import RowName, Task, task_of
from derive.mechanics.coupling import out_of_proportion
from derive.mechanics.robot import Robot
from derive.mechanics.seen import easiest
from derive.mechanics.strata import searching
from derive.mechanics.wrist import wrist_of

CLAIMED = {"det": "determinant-seen", "solutions": "full-rank"}
CLAIMS = ("jacobian-seen", "determinant-seen", "full-rank")
MOST_DRAWN = 4  # poses beside each other
WHOLE = ("vx", "vy", "vz", "wx", "wy", "wz")


class Options(OptionsModel):
    """Which velocities are to be commanded, of which point."""

    rows: tuple[RowName, ...] = ()
    """The velocities to be commanded."""
    point: PointOn | None = None
    """The point whose motion counts; that of the end-effector if left out."""


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """Where det J = 0, factor by factor (Siciliano et al., section 3.3; Spong et al., section 4.9).

    Raises NotDerivable where the rows asked for are dependent in every configuration.
    """
    task = task_of(problem, options.rows, options.point)
    _refuse_out_of_proportion(task)
    way = _way(task, options)
    sets = _analysed(task, way)
    J = of_arm(task, way)
    lengths = lengths_told(J, problem.assumptions, sets, way)
    sliding = any(link.joint != "revolute" for link in robot.links if link.variable)
    solutions = branches(problem, sets, way.point)
    facts = facts_of(problem, way, sets, lengths, sliding)
    results: dict[str, Result] = {
        "det": problem.final(way.det),
        "solutions": solutions,
        "complete": way.complete,
    }
    work = way.work.claim(*Checked(J, way, sets, solutions, facts).claims())
    work = work.claim(*center_seen(task, way, J), *at_special_lengths(J, sets, lengths))
    return work.answer("singularities", results, facts, plots=_drawn(task, sets), unread=LINKS_ALONE)


def _drawn(task: Task, sets: Sequence[Analysed]) -> tuple[Drawing, ...]:
    """A planar arm in its singular poses, where these are joints at certain angles."""
    if {*task.rows} != {"vx", "vy"} or task.asked is not None:
        return ()
    cases = [{str(text(name)): value for name, value in case.values} for each in sets for case in each.cases]
    if not 0 < len(cases) <= MOST_DRAWN or any(free_symbols(v) for case in cases for v in case.values()):
        return ()
    figure = drawn(task.problem.subject, task.problem.where, cases)
    return (figure,) if figure else ()


def _refuse_out_of_proportion(task: Task) -> None:
    """Raises NotDerivable where angles are no sums of joint variables: zeros of such sums are sought."""
    coupling = task.found.coupling
    if coupling and (name := out_of_proportion(coupling, task.found.variables)):
        raise NotDerivable(
            f"singular configurations are sought where rows turn by sums of joint variables; here {name} "
            "turns one by other than a number of times itself (manipulability has numbers at a point)"
        )


def _analysed(task: Task, way: Way) -> tuple[Analysed, ...]:
    """Every set with its rank, those inside others last."""
    J = easiest(task.found, task.whole, task.rows, task.point.position)
    return graded(task.problem, way, J, searching(task.found, task.problem.readable))


def _way(task: Task, options: Options) -> Way:
    whole = set(task.rows) == set(WHOLE) and options.point is None
    wrist = wrist_of(task.found) if whole else None
    if wrist:
        return by_wrist(task, wrist)
    return by_determinant(task) if task.square else by_minors(task)
