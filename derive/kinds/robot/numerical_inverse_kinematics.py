"""The joint variables for a position, found step by step from a first guess."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, PlainValidator, ValidationInfo, WithJsonSchema

from derive.algebra.numbers.floats import matrix_numbers, scalar_number
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Claim, Derivation, PageFacts, Phrase, Plot, Result, Step, Table
from derive.errors import NotDerivable
from derive.expression import Approximate, Expr, Symbol, add, column, number
from derive.kinds.checks import SECOND_ROUTE, links
from derive.kinds.evaluation import Place, read
from derive.kinds.fields import OptionsModel, Quantity
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._velocity.task import Task, task_of
from derive.kinds.values_at import point_of
from derive.mechanics.iteration import CLOSE, Iteration, Pose, Row, iterate
from derive.mechanics.robot import Robot
from derive.mechanics.task import ROWS, moving_rows

RESULTS = {
    "iterations": "a table: the number of the step, the joint variables, the error of the position, H",
    "solution": "the joint variables at the end (n)",
}
EXAMPLE = """\
title: Inverse kinematics by iteration
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: 1, alpha: 0}
    - {theta: theta2*, d: 0, a: 1, alpha: 0}
  questions:
  - find: numerical-inverse-kinematics
    target: [1.2, 0.8]
    start: {theta1: 0, theta2: 60 deg}
  - find: numerical-inverse-kinematics
    target: [1.2, 0.8]
    start: {theta1: 0, theta2: 60 deg}
    method: gradient
    iterations: 12
"""
NOTHING = 1e-16  # an error too small for a logarithm
MOST_ROWS = 13  # of a printed table; the middle of a longer one is left out
J, R, F, H = map(Symbol, ("J", "r_d", "f", "H"))


def _start(typed: Any, info: ValidationInfo) -> Any:
    return read(typed, info)


Start = Annotated[Place, PlainValidator(_start), WithJsonSchema({"type": "object"})]


class Options(OptionsModel):
    """`target`: x, y in a plane (and the angle of the last link), or x, y, z; `start`: a value for each joint
    variable; `step`: the fixed step of the gradient method, the best one for each step if left out."""

    ONLY_WITH: ClassVar = {"step": ("method", "gradient")}

    target: tuple[Quantity, ...] = Field(min_length=1, max_length=3)
    start: Start = ()
    method: Literal["newton", "gradient"] = "newton"
    iterations: int = Field(10, ge=1, le=200)
    step: Quantity | None = None
    evaluate: Annotated[Place | None, PlainValidator(_start), WithJsonSchema({"type": "object"})] = None


class Facts(PageFacts):
    method: str
    square: bool
    table: Table
    verdict: str
    steps: int
    error: Expr
    best: bool  # no step is given
    alpha: Expr | None
    solution: tuple[tuple[Symbol, Expr], ...]
    seen: frozenset[str]  # methods that were explained before


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """Newton's method, q + J^-1 (r_d - f(q)), or the gradient method, q + alpha J^T (r_d - f(q)), which goes
    down the slope of H = |r_d - f(q)|^2 / 2 (Siciliano et al., section 3.7).

    Raises NotDerivable for an arm with names that have no value, and a start that is not one.
    """
    task = _task(options, problem)
    here = _numbers(task, options, problem)
    arm = _arm(task, here)
    target = [_value(part, here) for part in options.target]
    fixed = None if options.step is None else _value(options.step, here)
    start = [here[name] for name in task.found.variables]
    run = iterate(arm, target, start, options.method, options.iterations, fixed)
    steps = _steps(task, options)
    definitions: dict[Expr, Expr] = {J: task.written, F: _forward(task), R: column(options.target)}
    evaluated = {
        "iterations": [[k, *map(float, row.q), row.error, row.H] for k, row in enumerate(run.rows)],
        "solution": list(map(float, run.rows[-1].q)),
    }
    results: dict[str, Result] = {
        "iterations": tuple(_row(k, row) for k, row in enumerate(run.rows)),
        "solution": column(map(Approximate, run.rows[-1].q)),
    }
    claims = (*links(steps, {**problem.names, **definitions}), *_claims(task, here, target, run))
    return Derivation(
        "numerical-inverse-kinematics", steps, results, claims, definitions, evaluated,
        uses=(task.base,), plots=(_plot(run),), facts=_facts(task, options, run),
    )  # fmt: skip


def _task(options: Options, problem: Problem) -> Task:
    """The rows that the target has coordinates for."""
    whole = task_of(problem, ROWS)
    linear, angular = moving_rows(whole.J)
    size = len(options.target)
    choices = [linear]
    if len(linear) == 2 and angular == ("wz",):
        choices.append((*linear, "wz"))
    rows = next((each for each in choices if len(each) == size), None)
    if rows is None:
        wanted = " or ".join(str(len(each)) for each in choices)
        raise NotDerivable(
            f"a target of {size} coordinates, but the end-effector has {wanted} to be given", "target"
        )
    return task_of(problem, rows)


def _numbers(task: Task, options: Options, problem: Problem) -> dict[str, float]:
    """A value for every name: the start, and what `where` and `evaluate` say."""
    start = point_of({**dict(options.evaluate or ()), **dict(options.start)}, problem.where)
    unknown = sorted(set(dict(options.start)) - set(task.found.variables))
    if unknown:
        raise NotDerivable(
            f"'{unknown[0]}' under start is no joint variable; they are {_listed(task.found.variables)}",
            "start",
        )
    missing = [name for name in task.found.variables if name not in start]
    if missing:
        raise NotDerivable(f"start gives no value to {_listed(missing)}", "start")
    here = dict(oracle_of(problem).at(start))
    open_names = sorted(problem.symbols - set(here))
    if needed := _needed(task, open_names):
        raise NotDerivable(
            f"no value is known for {_listed(needed)}: iterations need numbers, under where: or evaluate:"
        )
    return {**dict.fromkeys(open_names, 0.0), **here}


def _needed(task: Task, names: list[str]) -> list[str]:
    """Those of them that stand in the position."""
    used = {name for entry in task.point.position.entries for name in entry.generators()}
    return [name for name in names if name in used]


def _listed(names: Any) -> str:
    return ", ".join(names)


def _value(tree: Expr, here: dict[str, float]) -> float:
    try:
        return value_of(tree, here)
    except KeyError as error:
        raise NotDerivable(f"no value is known for {error.args[0]} in the target", "target") from error


def _arm(task: Task, here: dict[str, float]) -> Pose:
    position, names = task.point.position, task.found.variables
    places = [ROWS.index(row) for row in task.rows]

    def pose(q: Any) -> tuple[list[float], Any]:
        at = {**here, **dict(zip(names, map(float, q), strict=True))}
        values = [
            sum(at[n] for n in _turning(task)) if k == 5 else scalar_number(position[k, 0], at)
            for k in places
        ]
        return values, matrix_numbers(task.J, at)

    return pose


def _turning(task: Task) -> list[str]:
    """The joints that turn an arm in its plane; a half turn between them is not counted."""
    return [joint.variable for _, joint in task.found.moving if joint.type == "revolute"]


def _forward(task: Task) -> Expr:
    position = task.problem.readable_matrix(task.point.position)
    rows = [position.rows[ROWS.index(row)][0] for row in task.rows if row[0] == "v"]
    turn = [add(*map(Symbol, _turning(task)))] if "wz" in task.rows else []
    return column((*rows, *turn))


def _steps(task: Task, options: Options) -> tuple[Step, ...]:
    f = Step("f", (F, _forward(task)), "forward")
    target = Step("r_d", (R, column(options.target)), "given")
    return (target, f, task.step)


def _facts(task: Task, options: Options, run: Iteration) -> Facts:
    variables = [Symbol(name) for name in task.found.variables]
    rows = [_row(k, row) for k, row in enumerate(run.rows)]
    kept: list[tuple[Expr | str, ...]]
    kept = [*rows] if len(rows) <= MOST_ROWS else [*rows[: MOST_ROWS - 2], ("...",) * len(rows[0]), rows[-1]]
    last = run.rows[-1]
    return Facts(
        method=options.method,
        square=task.square,
        table=Table((Symbol("k"), *variables, Phrase("error"), H), tuple(kept)),
        verdict=run.verdict,
        steps=len(run.rows) - 1,
        error=Approximate(last.error if last.error >= CLOSE else 0.0),
        best=options.step is None,
        alpha=options.step,
        solution=tuple((name, Approximate(value)) for name, value in zip(variables, last.q, strict=True)),
        seen=_seen(task.problem, options),
        numbers=(),
    )


def _row(k: int, row: Row) -> tuple[Expr, ...]:
    """One line of the table."""
    error = row.error if row.error >= CLOSE else 0.0  # below, it is what rounding leaves
    return (number(k), *map(Approximate, row.q), Approximate(error), Approximate(error**2 / 2))


def _seen(problem: Problem, options: Options) -> frozenset[str]:
    """The methods that earlier questions of the problem explained already."""
    asked = [each for kind, each in problem.questions if kind == "numerical-inverse-kinematics"]
    before = asked[: asked.index(options)] if options in asked else []
    return frozenset(each.method for each in before if len(each.target) == len(options.target))


def _plot(run: Iteration) -> Plot:
    """By powers of ten: Newton's method falls ever more steeply, the gradient method along a line."""
    counts = tuple(float(k) for k in range(len(run.rows)))
    powers = tuple(math.log10(max(row.error, NOTHING)) for row in run.rows)
    return Plot("error", Phrase("iteration"), Phrase("power-of-ten"), {Phrase("error"): (counts, powers)})


def _claims(task: Task, here: dict[str, float], target: list[float], run: Iteration) -> tuple[Claim, ...]:
    """Every error of the table by the poses in NumPy."""
    import numpy as np

    oracle, holds = oracle_of(task.problem), True
    for row in run.rows:
        at = {**here, **dict(zip(task.found.variables, row.q, strict=True))}
        p = oracle.tool(at)[:3, 3]
        reached = [p[ROWS.index(name)] for name in task.rows if name[0] == "v"]
        if "wz" in task.rows:
            reached.append(sum(at[name] for name in _turning(task)))
        holds &= abs(float(np.linalg.norm(np.array(target) - reached)) - row.error) < 1e-7
    return (Claim("errors", SECOND_ROUTE, bool(holds)),)
