"""How the Jacobian changes while the arm moves, and the acceleration that comes of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers import floats as numeric
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts, Step
from derive.expression import Derivative, Expr, Product, Symbol, add, column
from derive.kinds.checks import agreement, links
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import closing, oracle_of
from derive.kinds.robot._dynamics.rates import rate_column
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._velocity.task import RowName, Task, task_of
from derive.mechanics.oracle import STEP
from derive.mechanics.robot import Robot
from derive.mechanics.task import ROWS, moving_rows

RESULTS = {"J_dot": "dJ/dt (m by n); rates are written theta1_dot", "bias": "J_dot qdot (m)"}
EXAMPLE = """\
title: The derivative of a Jacobian
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: l1, alpha: 0}
    - {theta: theta2*, d: 0, a: l2, alpha: 0}
  find: jacobian-derivative
  rows: [vx, vy]
"""
DIFFERENCES = 1e-4  # of differences of what is known by differences itself
J, J_DOT = Symbol("J"), Symbol("J_dot")


class Options(OptionsModel):
    """`rows`: some rows only, all that are not zero if left out; `point`: the end-effector if left out."""

    rows: tuple[RowName, ...] = ()
    point: PointOn | None = None


class Facts(PageFacts):
    rows: tuple[Expr, ...]
    all: bool
    rates: tuple[Symbol, ...]


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """J_dot, the sum of dJ/dq_k qdot_k, and J_dot qdot: the acceleration is J qddot + J_dot qdot
    (Siciliano et al., eq. 3.99)."""
    whole = task_of(problem, ROWS, options.point)
    linear, angular = moving_rows(whole.J)
    task = task_of(problem, options.rows or (*linear, *angular), options.point)
    rate = _rate(task)
    written = problem.readable_matrix(rate)
    rates = column(task.rates)
    bias = problem.readable_matrix(rate @ rate_column(_names(task)))
    total = add(*(Product((Derivative(J, Symbol(n)), Symbol(f"{n}_dot"))) for n in _names(task)))
    steps = (
        task.step,
        closing(Step("J_dot", (J_DOT, total, written), "chain-rule"), problem.final(written)),
        closing(Step("bias", (Product((J_DOT, Symbol("q_dot"))), bias), "product"), problem.final(bias)),
    )
    definitions: dict[Expr, Expr] = {J: task.written, J_DOT: written, Symbol("q_dot"): rates}
    claim = agreement(
        "differences",
        task.symbols | {name.name for name in task.rates},
        lambda at: numeric.matrix_numbers(rate, _known(task, at)),
        lambda at: _differences(task, at),
        DIFFERENCES,
    )
    return Derivation(
        "jacobian-derivative", steps, {"J_dot": problem.final(written), "bias": problem.final(bias)},
        (*links(steps, {**problem.names, **definitions}), claim), definitions, uses=(task.base,),
        facts=Facts(rows=task.velocities, all=len(task.rows) == len(ROWS), rates=task.rates),
        matrices=frozenset({"J_dot"}),
    )  # fmt: skip


def _names(task: Task) -> tuple[str, ...]:
    return task.found.variables


def _rate(task: Task) -> ScalarMatrix:
    """The sum over the joints."""
    total = ScalarMatrix.zeros(*task.J.shape)
    for name in _names(task):
        total = total + task.J.diff(name).scaled(Scalar.symbol(f"{name}_dot"))
    return total


def _known(task: Task, at: Mapping[str, float]) -> Mapping[str, float]:
    return oracle_of(task.problem).at(at)


def _differences(task: Task, at: Mapping[str, float]) -> Any:
    """Of the Jacobian a little later and a little earlier on the way."""
    step = STEP * 100  # each of the two is known to 1e-10 only
    ahead, behind = (
        task.numbers({**at, **{n: at[n] + h * at[f"{n}_dot"] for n in _names(task)}}) for h in (step, -step)
    )
    return (ahead - behind) / (2 * step)
