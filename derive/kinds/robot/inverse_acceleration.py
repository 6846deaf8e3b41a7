"""The joint accelerations that give the end-effector a wanted acceleration."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice
from typing import Any

from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import completed
from derive.derivation import Derivation, PageFacts
from derive.expression import Expr, Symbol, column, replace, replace_all, symbols
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import OptionsModel, Quantity
from derive.kinds.problem import Problem
from derive.kinds.robot._point import PointOn
from derive.kinds.robot._units import of_joints
from derive.kinds.robot._velocity.functions import task_for
from derive.kinds.robot._velocity.task import RowName, Task
from derive.kinds.work import Work
from derive.mechanics.oracle import STEP, slope
from derive.mechanics.robot import Robot
from derive.names import free

CLAIMS = ("acceleration-met",)
CLAIMED = {"qddot": "acceleration-met"}
measures = of_joints("qddot", power=2)
POINTS, NEAR = 3, 1e-4
J_DOT, Q_DOT, Q_DDOT, V_DOT, R_DDOT = symbols("J_dot q_dot q_ddot v_dot r_ddot")
WANTED = {"vx": "ax", "vy": "ay", "vz": "az", "wx": "alphax", "wy": "alphay", "wz": "alphaz"}


class Options(OptionsModel):
    """Which accelerations are wanted, of which point."""

    rows: tuple[RowName, ...] = ()
    """The components ax, ay, ..., alphaz that are wanted, by the velocities they are the rates of."""
    point: PointOn | None = None
    """The point whose motion counts; that of the end-effector if left out."""
    task: tuple[Quantity, ...] = ()
    """Functions of the joint variables whose second derivatives r1_ddot, r2_ddot, ... are wanted, in place of
    rows."""


class Facts(PageFacts):
    wanted: tuple[Symbol, ...]
    components: tuple[Symbol, ...]
    square: bool
    redundant: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """qddot (n by 1): J^-1 (a - J_dot qdot), least accelerations where there are more joints (Siciliano et
    al., section 3.6; De Luca, Robotics 1, inverse differential kinematics).

    Raises NotDerivable where J has no inverse, or one too large to be written.
    """
    task = task_for(problem, options.rows, options.point, options.task)
    asked: dict[str, Any] = {"rows": () if options.task else task.rows, "point": options.point}
    rates = problem.ask("inverse-velocity", task=options.task, **asked)
    change = problem.ask("jacobian-derivative", task=options.task, **asked)
    wanted = tuple(Symbol(_wanted(task, k)) for k in range(len(task.rows)))
    b, a = Symbol(free(problem.taken, "b", "b_w")), wanted[0]
    work = Work(problem).resting_on(rates, change).knowing({Q_DOT: column(task.rates)})
    if len(wanted) > 1:
        a = R_DDOT if options.task else V_DOT
        work = work.knowing({a: column(wanted)})
    work = work.line(b, a - J_DOT * Q_DOT, rule="rest", label="b").closed(b)
    parts = (b,) if len(wanted) == 1 else tuple(Symbol(f"{b.name}_{k}") for k in range(1, len(wanted) + 1))
    in_parts = dict[Expr, Expr](zip(task.velocities, parts, strict=True))
    entries = work.entries(b) if len(wanted) > 1 else (work[b],)
    known = dict[Expr, Expr](zip(parts, entries, strict=True))
    told = next((step.result for step in rates.steps if step.name == "qdot"), rates.matrix("qdot"))
    shown = replace(told, in_parts)  # in the names of minors, where it has such
    work = work.knowing(known).line(Q_DDOT, value=shown, rule="solve", label="qddot")
    qddot = replace(replace(rates.matrix("qdot"), in_parts), known)
    both = (qddot, replace_all(shown, {**rates.definitions, **known}))
    work = work.claim(
        route(
            "acceleration-met",
            (_is_met(task, each, wanted, at) for at in _points(task, wanted) for each in both),
        )
    )
    facts = Facts(wanted=wanted, components=parts, square=task.square, redundant=task.redundant)
    return work.answer("inverse-acceleration", {"qddot": qddot}, facts)


def _wanted(task: Task, k: int) -> str:
    name = task.rows[k]
    return WANTED.get(name, f"{name}_ddot")


def _points(task: Task, wanted: tuple[Symbol, ...]) -> Any:
    names = task.symbols | {each.name for each in (*wanted, *task.rates)}
    where = task.problem.where
    return (completed(at, where) for at in islice(random_points(names, POINTS), POINTS))


def _is_met(task: Task, qddot: Expr, wanted: tuple[Symbol, ...], at: Mapping[str, float]) -> bool:
    """Whether these are the accelerations of NumPy's pseudo-inverse of a Jacobian by differences, of what its
    change along the motion leaves of the wanted one."""
    import numpy as np

    rates = {name: at[f"{name}_dot"] for name in task.found.variables}
    rise = np.array(slope(task.numbers, at, rates, STEP * 100))
    left = np.array([at[name.name] for name in wanted]) - rise @ [*rates.values()]
    return close(arrays(qddot, at)[:, 0], np.linalg.pinv(task.numbers(at)) @ left, NEAR)
