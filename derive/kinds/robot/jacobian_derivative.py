"""How the Jacobian changes while the arm moves, and the acceleration that comes of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from derive.algebra.numbers.floats import numbers
from derive.derivation import Derivation, PageFacts
from derive.errors import TooManyTerms
from derive.expression import Derivative, Symbol, add, column, symbols
from derive.kinds.fields import OptionsModel, Quantity
from derive.kinds.problem import Problem
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._velocity.functions import task_for
from derive.kinds.robot._velocity.task import RowName, Task, task_of
from derive.mechanics.oracle import STEP, slope
from derive.mechanics.robot import Robot
from derive.mechanics.task import ROWS, moving_rows
from derive.names import free

CLAIMS = ("differences",)

DIFFERENCES = 1e-4  # of differences of what is known by differences itself
MOST_OF_J = 1500  # terms: ten joints at right angles have 2600
J, J_DOT, Q_DOT = symbols("J J_dot q_dot")


class Options(OptionsModel):
    """Which rows are wanted, of which point."""

    rows: tuple[RowName, ...] = ()
    """Some rows only; all that are not zero if left out."""
    point: PointOn | None = None
    """The point whose motion counts; that of the end-effector if left out."""
    task: tuple[Quantity, ...] = ()
    """Functions of the joint variables, in place of rows."""


class Facts(PageFacts):
    rows: tuple[Symbol, ...]  # none where all are meant
    rates: tuple[Symbol, ...]
    of_functions: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """J_dot (m by n), the sum of dJ/dq_k qdot_k, and J_dot qdot (m by 1): the acceleration is
    J qddot + J_dot qdot (Siciliano et al., eq. 3.99)."""
    task = _task(options, problem)
    terms = sum(len(entry.numerator) for row in task.J.rows for entry in row if entry)
    if terms > MOST_OF_J:
        raise TooManyTerms(
            f"the Jacobian has {terms} terms, and its derivative would have many times as many (more than "
            f"{MOST_OF_J} are not differentiated): ask for fewer rows, or give numbers to lengths and twists"
        )
    total = add(*(Derivative(J, Symbol(n)) * Symbol(f"{n}_dot") for n in task.found.variables))
    bias = J_DOT * Q_DOT
    work = task.board().knowing({Q_DOT: column(task.rates)}).line(J_DOT, total, rule="chain-rule")
    letter = free(problem.taken, "b", indices=(f"_{i}" for i in range(1, len(task.rows) + 1)))
    entries = {(i, 0): Symbol(f"{letter}_{i + 1}") for i in range(len(task.rows))}
    work = work.line(bias, label="bias", rule="product", entries=entries)
    work = work.closed(J_DOT, bias)
    some = () if len(task.rows) == len(ROWS) or options.task else task.velocities
    facts = Facts(rows=some, rates=task.rates, of_functions=bool(options.task))
    results = {"J_dot": work.final(J_DOT), "bias": work.steps[-1].result}
    work = work.agrees(
        "differences",
        task.symbols | {name.name for name in task.rates},
        lambda at: [numbers(each, at) for each in results.values()],
        lambda at: _differences(task, at),
        DIFFERENCES,
    )
    return work.answer("jacobian-derivative", results, facts, matrices=frozenset({"J_dot"}))


def _task(options: Options, problem: Problem) -> Task:
    """The functions, the rows asked for, or those that are not zero."""
    if options.task or options.rows:
        return task_for(problem, options.rows, options.point, options.task)
    linear, angular = moving_rows(task_of(problem, ROWS, options.point).J)
    return task_of(problem, (*linear, *angular), options.point)


def _differences(task: Task, at: Mapping[str, float]) -> Any:
    """Of the Jacobian a little later and a little earlier on the way, and what it makes of the rates."""
    import numpy as np

    rates = {name: at[f"{name}_dot"] for name in task.found.variables}
    rise = np.array(slope(task.numbers, at, rates, STEP * 100))  # each of the two is known to 1e-10 only
    return [rise, rise @ [*rates.values()]]
