"""The joint torques and forces that balance a force at the end-effector."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Literal

from pydantic import Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers import floats as numeric
from derive.derivation import Derivation, PageFacts, Phrase
from derive.errors import NotDerivable, how_many
from derive.expression import ZERO, Expr, Symbol, column, free_symbols, symbols, transpose
from derive.kinds.fields import OptionsModel, Quantity
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of
from derive.kinds.robot._efforts import effort, efforts
from derive.kinds.robot._point import PointOn, tracked
from derive.kinds.robot._units import of_joints, together
from derive.kinds.robot._velocity.linear import combined
from derive.kinds.robot._velocity.task import RowName, Task, task_of
from derive.kinds.robot._velocity.wrenches import Seen, Wrench, rotation_of
from derive.kinds.work import Work
from derive.mechanics.jacobian import halves
from derive.mechanics.robot import Robot
from derive.mechanics.task import ROWS, moving_rows
from derive.names import free

FORCES = {"vx": "fx", "vy": "fy", "vz": "fz", "wx": "mx", "wy": "my", "wz": "mz"}
DIFFERENCES = 1e-6
TAU, F, J, OUTSIDE = symbols("tau F J F_ext")

CLAIMED = {"wrench": "wrench-turned"}
measures = together(of_joints("tau", effort=True), wrench="")  # forces and moments have no one unit


class Options(OptionsModel):
    """The force, and where it acts."""

    force: tuple[Quantity, ...] | None = Field(None, min_length=1, max_length=6)
    """What the end-effector exerts along the rows, forces then moments, by name or value."""
    rows: tuple[RowName, ...] = ()
    """The directions in which forces and moments act, as those of the velocities."""
    point: PointOn | None = None
    """Where the force acts; at the end-effector if left out."""
    frame: Literal["base", "tool"] | None = Field(None, alias="in")
    """The axes in which the force is given; those of the base if left out."""
    acting: Literal["on-environment", "on-robot"] = "on-environment"
    """Whether the force acts on the surroundings, or is theirs on the robot."""


class Facts(PageFacts):
    rows: tuple[Symbol, ...]  # none where all are meant
    where: Phrase  # the force acts
    effort: Phrase  # of a joint
    efforts: Phrase  # of all joints
    moments: bool
    outside: Symbol | None  # what the surroundings exert on the robot
    seen: Seen | None = None  # from the other frame


def claims_of(robot: Robot, options: Options) -> tuple[str, ...]:
    """A wrench that is seen from another frame too is turned by the pose in numbers."""
    return ("work-done", "wrench-turned") if _is_seen(options) else ("work-done",)


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """tau = J^T F, by virtual work (Siciliano et al., section 3.8; Spong et al., section 4.10).

    Raises NotDerivable where the force has not one component for each row.
    """
    rows = _rows(options, problem)
    force = options.force or tuple(_symbol(row, problem) for row in rows)
    if len(force) != len(rows):
        given, asked = how_many(len(force), "component"), how_many(len(rows), "row")
        which = f"the {asked} {', '.join(rows)}"
        raise NotDerivable(f"{given} of the force for {which}; give one for each", "force")
    task, work = task_of(problem, rows, options.point), Work(problem)
    components, outside = dict(zip(task.rows, force, strict=True)), options.acting == "on-robot"
    wrench = Wrench(problem, task.point, components, options.frame == "tool", outside)
    exerted: tuple[Expr, ...] = force
    if wrench.in_tool:
        work = wrench.lines(work)
        seen = dict(zip(ROWS, wrench.turned(work), strict=True))
        task = task_of(problem, tuple(row for row in ROWS if seen[row] != ZERO) or rows, options.point)
        exerted = tuple(seen[row] for row in task.rows)
    if outside:
        work = work.given(OUTSIDE, column(exerted)).line(F, -OUTSIDE, rule="third-law")
        exerted = work.entries(F)
    else:
        work = work.given(F, column(exerted))
    work = task.board(work)
    written = work.matrix(J).T * work[F]
    turned = transpose(J) * F
    work = work.line(TAU, turned, written, value=_by_components(work, turned, exerted), rule="virtual-work")
    work = work.agrees(
        "work-done",
        task.symbols.union(*map(free_symbols, force)),
        work.value(TAU),
        lambda at: _by_work(task, exerted, at),
        DIFFERENCES,
    ).closed(TAU)
    results: dict[str, Expr] = {"tau": work.final(TAU)}
    facts = _facts(task, options)
    if _is_seen(options):
        work = work if wrench.in_tool else wrench.lines(work)
        results["wrench"] = problem.final(column(wrench.turned(work)))
        facts = replace(facts, seen=wrench.seen())
        work = work.agrees(
            "wrench-turned",
            task.symbols.union(*map(free_symbols, force)),
            lambda at: numeric.numbers(results["wrench"], at),
            wrench.numbers,
        )
    return work.answer("statics", results, facts)


def _is_seen(options: Options) -> bool:
    """Whether the wrench is wanted in the other frame too."""
    return options.frame is not None or options.acting == "on-robot"


def _by_components(work: Work, turned: Expr, force: tuple[Expr, ...]) -> Expr:
    """J^T F with a term for each component of the force, where these are names."""
    if not all(isinstance(each, Symbol) for each in force):
        return work.problem.readable_matrix(work.value_matrix(turned))
    return column(combined(zip(row, force, strict=True)) for row in work.matrix(J).T.rows)


def _symbol(row: str, problem: Problem) -> Symbol:
    """fx, or f_ex where the sheet means something else by that."""
    name = FORCES[row]
    return Symbol(free(problem.taken, name, f"{name[0]}_e{name[1]}"))


def _rows(options: Options, problem: Problem) -> tuple[str, ...]:
    """Those asked for; else as many as the force has components: forces first, then moments."""
    if options.rows:
        return options.rows
    found = chain_of(problem)
    point = tracked(problem, found, options.point)
    whole = point.jacobian(found)
    if options.frame == "tool":
        R = rotation_of(found, point)
        whole = ScalarMatrix.stacked([R.T @ half for half in halves(whole)])
    linear, angular = moving_rows(whole)
    if options.force is None:
        return linear or angular
    choices = (linear, linear + angular, ("vx", "vy"), ("vx", "vy", "vz"), ("vx", "vy", "wz"), tuple(FORCES))
    return next((rows for rows in choices if len(rows) == len(options.force)), linear)


def _by_work(task: Task, force: tuple[Expr, ...], at: Mapping[str, float]) -> Any:
    import numpy as np

    F_now = np.array([[numeric.scalar_number(normal(part, task.problem.names), at)] for part in force])
    return task.numbers(at).T @ F_now


def _facts(task: Task, options: Options) -> Facts:
    return Facts(
        rows=() if set(task.rows) >= {"vx", "vy", "vz", "wx", "wy", "wz"} else task.velocities,
        where=_where(task.asked, task.point.name),
        effort=effort(task.problem.subject),
        efforts=efforts(task.problem.subject),
        moments=any(row[0] == "w" for row in task.rows),
        outside=OUTSIDE if options.acting == "on-robot" else None,
    )


def _where(asked: PointOn | None, name: Symbol) -> Phrase:
    if asked is None:
        return Phrase("at-the-end-effector")
    if asked.link is None:
        return Phrase("at-an-origin", {"frame": asked.frame or 0})
    return Phrase("at-a-point", {"point": name, "link": asked.link})
