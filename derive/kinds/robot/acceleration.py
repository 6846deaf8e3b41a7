"""The linear and angular acceleration of a point of an arm."""

from __future__ import annotations

from itertools import chain

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import Point, numbers
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts
from derive.expression import Expr, Symbol, column, symbols
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._units import of_variables, together
from derive.kinds.robot._velocity.second_order import acceleration_seen
from derive.kinds.robot._velocity.task import RowName, Task, task_of
from derive.kinds.work import Work
from derive.mechanics.robot import Robot
from derive.mechanics.task import ROWS, moving_rows

CLAIMS = ("chain-rule", "acceleration-in-numbers")
measures = together(of_variables, a="m/s^2", alpha="rad/s^2")
NEAR = 1e-8
J, J_DOT, Q_DOT, Q_DDOT, A, ALPHA = symbols("J J_dot q_dot q_ddot a alpha")


class Options(OptionsModel):
    """Which components are wanted, of which point."""

    rows: tuple[RowName, ...] = ()
    """Some components only; all if left out."""
    point: PointOn | None = None
    """The point whose motion counts; that of the end-effector if left out."""


class Facts(PageFacts):
    rows: tuple[Symbol, ...]  # none where all are meant
    rises: tuple[Symbol, ...]
    told: tuple[str, ...]  # "a", "alpha"


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """a and alpha (3 by 1 each in the axes of the base, or the components asked for): J qddot + J_dot qdot
    (Siciliano et al., eq. 3.99; Spong et al., eq. 4.93)."""
    moving = tuple(chain(*moving_rows(task_of(problem, ROWS, options.point).J)))
    task = task_of(problem, options.rows or moving, options.point)
    rises = tuple(Symbol(f"{name}_ddot") for name in task.found.variables)
    base = problem.ask("jacobian-derivative", rows=options.rows, point=options.point)
    work = Work(problem).resting_on(base).knowing({Q_DDOT: column(rises), Q_DOT: column(task.rates)})
    value = work.value_matrix(J * Q_DDOT + J_DOT * Q_DOT)
    work = work.law("chain-rule", value == _by_chain_rule(task.J, task.found.variables))
    found: dict[str, Expr] = {}
    for name, letter in ((A, "v"), (ALPHA, "w")):
        part = [
            value[task.rows.index(row), 0] if row in task.rows else Scalar.of(0)
            for row in _rows(options, letter)
        ]
        if part:
            work = work.line(name, value=ScalarMatrix.column(part), rule="components").closed(name)
            found[name.name] = work.final(name)
    names = {*rises, *task.rates}
    work = work.agrees(
        "acceleration-in-numbers",
        task.symbols.union(name.name for name in names),
        lambda at: [numbers(each, at) for each in found.values()],
        lambda at: _seen(task, options, at),
        NEAR,
    )
    facts = Facts(
        rows=task.velocities if options.rows else (),
        rises=rises,
        told=tuple(found),
    )
    return work.answer("acceleration", found, facts, unread=frozenset({"jacobian-derivative"}))


def _rows(options: Options, letter: str) -> list[str]:
    """The components of a (letter v) or of alpha (w)."""
    return [row for row in options.rows or ROWS if row[0] == letter]


def _seen(task: Task, options: Options, at: Point) -> list[list[float]]:
    found = dict(zip(ROWS, acceleration_seen(task, at), strict=True))
    parts = [[found[row] for row in _rows(options, letter)] for letter in "vw"]
    return [part for part in parts if part]


def _by_chain_rule(J: ScalarMatrix, variables: tuple[str, ...]) -> ScalarMatrix:
    """dv/dt (m by 1) of v = J qdot."""
    rates = [Scalar.symbol(f"{name}_dot") for name in variables]
    v = J @ ScalarMatrix.column(rates)
    total = J @ ScalarMatrix.column(Scalar.symbol(f"{name}_ddot") for name in variables)
    for name, rate in zip(variables, rates, strict=True):
        total = total + v.diff(name).scaled(rate)
    return total
