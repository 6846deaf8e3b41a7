"""The joint torques and forces that balance a force at the end-effector."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import Field

from derive.algebra.normal import normal
from derive.algebra.numbers import floats as numeric
from derive.derivation import Derivation, PageFacts, Phrase
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, column, free_symbols, transpose
from derive.kinds.fields import OptionsModel, Quantity
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of
from derive.kinds.robot._point import PointOn, tracked
from derive.kinds.robot._units import of_joints
from derive.kinds.robot._velocity.linear import combined
from derive.kinds.robot._velocity.task import RowName, Task, task_of
from derive.kinds.work import Work
from derive.mechanics.robot import Robot
from derive.mechanics.task import moving_rows
from derive.names import free

FORCES = {"vx": "fx", "vy": "fy", "vz": "fz", "wx": "mx", "wy": "my", "wz": "mz"}
DIFFERENCES = 1e-6
TAU, F, J = Symbol("tau"), Symbol("F"), Symbol("J")

CLAIMS = ("work-done",)
measures = of_joints("tau", effort=True)


class Options(OptionsModel):
    """`force`: what the end-effector exerts along the `rows`, forces then moments, by name or value;
    `point`: where it acts."""

    force: tuple[Quantity, ...] | None = Field(None, min_length=1, max_length=6)
    rows: tuple[RowName, ...] = ()
    point: PointOn | None = None


class Facts(PageFacts):
    rows: tuple[Symbol, ...]  # none where all are meant
    where: Phrase  # the force acts
    revolute: bool
    moments: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """tau = J^T F, by virtual work (Siciliano et al., section 3.8; Spong et al., section 4.10).

    Raises NotDerivable where the force has not one component for each row.
    """
    task = task_of(problem, _rows(options, problem), options.point)
    force = options.force or tuple(_symbol(row, problem) for row in task.rows)
    if len(force) != len(task.rows):
        which = f"the {len(task.rows)} rows {', '.join(task.rows)}"
        raise NotDerivable(f"{len(force)} components of the force for {which}; give one for each")
    work = task.board(Work(problem).given(F, column(force)))
    written = work.matrix(J).T * work[F]
    turned = transpose(J) * F
    work = work.line(TAU, turned, written, value=_by_components(work, turned, force), rule="virtual-work")
    work = work.agrees(
        "work-done",
        task.symbols.union(*map(free_symbols, force)),
        work.value(TAU),
        lambda at: _by_work(task, force, at),
        DIFFERENCES,
    ).closed(TAU)
    return work.answer("statics", {"tau": work.final(TAU)}, _facts(task))


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
    linear, angular = moving_rows(point.jacobian(found))
    if options.force is None:
        return linear or angular
    choices = (linear, linear + angular, ("vx", "vy"), ("vx", "vy", "vz"), ("vx", "vy", "wz"), tuple(FORCES))
    return next((rows for rows in choices if len(rows) == len(options.force)), linear)


def _by_work(task: Task, force: tuple[Expr, ...], at: Mapping[str, float]) -> Any:
    import numpy as np

    F_now = np.array([[numeric.scalar_number(normal(part, task.problem.names), at)] for part in force])
    return task.numbers(at).T @ F_now


def _facts(task: Task) -> Facts:
    return Facts(
        rows=() if set(task.rows) >= {"vx", "vy", "vz", "wx", "wy", "wz"} else task.velocities,
        where=_where(task.asked, task.point.name),
        revolute=all(joint.type == "revolute" for _, joint in task.found.moving),
        moments=any(row[0] == "w" for row in task.rows),
    )


def _where(asked: PointOn | None, name: Symbol) -> Phrase:
    if asked is None:
        return Phrase("at-the-end-effector")
    if asked.link is None:
        return Phrase("at-an-origin", {"frame": asked.frame or 0})
    return Phrase("at-a-point", {"point": name, "link": asked.link})
