"""The joint variables for a position, found step by step from a first guess."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, PlainValidator, WithJsonSchema

from derive.algebra.numbers.floats import matrix_numbers, scalar_number
from derive.algebra.numbers.floats import number as value_of
from derive.derivation import Derivation, PageFacts, Phrase, Result, Said, Step, Table
from derive.errors import NotDerivable, how_many
from derive.expression import (
    Approximate,
    Expr,
    Matrix,
    Measured,
    Relation,
    Symbol,
    add,
    children,
    column,
    number,
    symbols,
)
from derive.kinds.checks import close, route
from derive.kinds.fields import OptionsModel, Place, Quantity, read_point
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import oracle_of
from derive.kinds.robot._lengths import unit_of_lengths
from derive.kinds.robot._units import of_variables
from derive.kinds.robot._velocity.ellipsoids import exactly
from derive.kinds.robot._velocity.iterated import (
    E,
    ended,
    error_plot,
    outlook,
    result_row,
    share,
    stopped,
    table_row,
)
from derive.kinds.robot._velocity.repeated import Repeated
from derive.kinds.robot._velocity.task import Task, task_of
from derive.kinds.sure import place
from derive.kinds.units import in_degrees
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.iteration import CLOSE, Iteration, iterate
from derive.mechanics.robot import Robot
from derive.mechanics.task import ROWS, moving_rows

CLAIMED = {"iterations": "as-listed", "solution": "last-row"}
CLAIMS = ("rows-in-numbers", "place", "begun", "numbered", "errors", "ended", "as-listed", "last-row")
J, R, F, ALPHA = symbols("J r_d f alpha")
ERROR = Relation(E, "=", R - F)
BOUND = number(10) ** number(-10)  # of an error that is none


Start = Annotated[Place, PlainValidator(read_point), WithJsonSchema({"type": "object"})]


class Options(OptionsModel):
    """Where the end-effector is to be, and how the joints are found."""

    ONLY_WITH: ClassVar = {"step": ("method", "gradient")}

    target: tuple[Quantity, ...] = Field(min_length=1, max_length=3)
    """x, y in a plane (and the angle of the last link), or x, y, z."""
    start: Start = ()
    """A value for each joint variable to begin with."""
    method: Literal["newton", "gradient"] = "newton"
    """newton: by the inverse of the Jacobian; gradient: by its transpose."""
    iterations: int = Field(10, ge=1, le=200)
    """How many are made at most."""
    step: Quantity | None = None
    """The fixed step of the gradient method; the best one each time if left out."""
    evaluate: Annotated[Place | None, PlainValidator(read_point), WithJsonSchema({"type": "object"})] = None


class Facts(PageFacts):
    """How the iteration went: the law of its steps, where it was not explained before; its table; how it
    ended, where, and what is to be expected of more steps."""

    again: Phrase | None  # explained before
    newton: Phrase | None
    pseudo: Phrase | None
    gradient: Phrase | None
    best: Phrase | None  # no step is given
    alpha: tuple[Expr, Expr] | None
    measure: Phrase | None
    table: Table | None  # of more than the start
    ended: Phrase
    stopped: Phrase | None  # why, by the Jacobian there
    solution: tuple[tuple[Symbol, Expr], ...]
    outlook: Phrase | None
    drawn: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """Newton's method, q + J^-1 (r_d - f(q)), or the gradient method, q + alpha J^T (r_d - f(q)), which goes
    down the slope of H = |r_d - f(q)|^2 / 2 (Siciliano et al., section 3.7).

    Raises NotDerivable for an arm with names that have no value, and a start that is not one.
    """
    task = _task(options, problem)
    arm = Arm(task, _numbers(task, options, problem))
    target = [_value(part, arm.here) for part in options.target]
    fixed = None if options.step is None else _value(options.step, arm.here)
    start = [arm.here[name] for name in arm.variables]
    run = iterate(arm.pose, target, start, options.method, options.iterations, fixed)
    listed = [[k, *map(float, row.q), row.error, row.H] for k, row in enumerate(run.rows)]
    evaluated = {"iterations": listed, "solution": list(map(float, run.rows[-1].q))}
    rows = tuple(result_row(k, row) for k, row in enumerate(run.rows))
    table = Table(
        (Symbol("k"), *map(Symbol, arm.variables), Phrase("error")),
        tuple(table_row(k, row, BOUND) for k, row in enumerate(run.rows)),
    )
    facts, forward = _facts(arm, options, run, table), arm.forward()
    solution = _solution(arm, run)
    results: dict[str, Result] = {
        "iterations": rows,
        "solution": column(value for _, value in solution),
    }
    given = {**problem.where, **dict(options.evaluate or ()), **dict(options.start)}
    here = {**arm.here, **place(given)}
    again = Repeated(task, here, arm.turning, target, options.method, fixed, options.iterations)
    known: dict[Expr, Expr] = {F: forward, R: column(options.target)}
    work = Work(problem, uses=(problem.ask("forward-kinematics"),), known=known)
    work = work.showing(Step("r_d", (R, work[R]), "given"), Step("f", (F, forward), "forward"))
    work = task.proved(work.line(J, value=task.J, rule="rows"))
    work = work.agrees("place", problem.symbols, forward, again.place)
    told = {name.name: value_of(value, {}) for name, value in solution}
    work = work.claim(*again.claims(table, listed, here, run.verdict, told))
    errors = [said.about["e"] for said in (facts.newton, facts.pseudo, facts.gradient) if said]
    work = work.claim(route("error-told", (again.tells(each, here) for each in errors))) if errors else work
    if _explained(problem, options):
        work = replace(work, steps=work.steps[:1])
    if facts.outlook and "share" in facts.outlook.about:
        first, *_, end = (row.error for row in run.rows)
        work = work.claim(route("share", close(first * run.share ** (len(run.rows) - 1), end)))
    if facts.stopped:
        there = _at_start(arm, options) if len(run.rows) == 1 else ()
        there = there or _there(arm, run, target)
        there = there[:1] if run.verdict == "singular" else there
        work = work.step(*there).claim(again.stops(arm.at(run.rows[-1].q), *(step.result for step in there)))
    units = _units(arm, options)
    plot = (
        error_plot(run, options.method == "newton", units.get(Phrase("error"), "")) if facts.drawn else None
    )
    return work.answer(
        "numerical-inverse-kinematics",
        results,
        facts,
        evaluated=evaluated,
        plots=(plot,) if plot else (),
        units=units,
    )


def _units(arm: Arm, options: Options) -> dict[Expr | Phrase, str]:
    """Those of the columns: angles as the author typed them, errors in metres where the target was."""
    problem = arm.task.problem
    turned = problem.style.degrees or problem.style.turned
    units: dict[Expr | Phrase, str] = {
        Symbol(name): in_degrees(unit, turned) for name, unit in of_variables(problem.subject).items()
    }
    if unit_of_lengths(problem, options.target) and all(row[0] == "v" for row in arm.task.rows):
        units |= {Phrase("error"): "m", R: "m", E: "m"}
    return units


@dataclass(frozen=True, slots=True)
class Arm:
    """The velocities of an arm that the target has coordinates for, and a value for every name."""

    task: Task
    here: Mapping[str, float]

    @property
    def variables(self) -> tuple[str, ...]:
        """The joint variables in order."""
        return self.task.found.variables

    @property
    def turning(self) -> list[str]:
        """The joints that turn an arm in its plane; a half turn between them is not counted."""
        return [joint.variable for _, joint in self.task.found.moving if joint.type == "revolute"]

    def at(self, q: Iterable[float]) -> dict[str, float]:
        """Every name with the joint variables of an iteration."""
        return {**self.here, **dict(zip(self.variables, map(float, q), strict=True))}

    def pose(self, q: Any) -> tuple[list[float], Any]:
        """f(q) and J(q)."""
        at = self.at(q)
        p = [scalar_number(each, at) for each in self.task.point.position.entries]
        return self.place(at, p), matrix_numbers(self.task.J, at)

    def place(self, at: Mapping[str, float], p: Sequence[float]) -> list[float]:
        """The coordinates of p that are sought, and the angle of the last link where it is."""
        turn = sum(at[name] for name in self.turning)
        return [turn if row == "wz" else p[ROWS.index(row)] for row in self.task.rows]

    def forward(self) -> Matrix:
        """f(q) as it is written."""
        position = self.task.problem.readable_matrix(self.task.point.position)
        rows = [position.rows[ROWS.index(row)][0] for row in self.task.rows if row[0] == "v"]
        turn = [add(*map(Symbol, self.turning))] if "wz" in self.task.rows else []
        return column((*rows, *turn))


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
            f"a target of {how_many(size, 'coordinate')}, but the end-effector has {wanted} to be given",
            "target",
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
    used = {name for entry in task.point.position.entries for name in entry.generators()}
    if needed := [name for name in open_names if name in used]:
        raise NotDerivable(
            f"no value is known for {_listed(needed)}: iterations need numbers, under where: or evaluate:",
            "evaluate",
        )
    return {**dict.fromkeys(open_names, 0.0), **here}


def _listed(names: Any) -> str:
    return ", ".join(names)


def _value(tree: Expr, here: Mapping[str, float]) -> float:
    try:
        return value_of(tree, here)
    except KeyError as error:
        raise NotDerivable(f"no value is known for {error.args[0]} in the target", "target") from error


def _facts(arm: Arm, options: Options, run: Iteration, table: Table) -> Facts:
    problem, last = arm.task.problem, len(run.rows) - 1
    newton, explained = options.method == "newton", _explained(problem, options)
    again = options.method in explained
    found = run.verdict in ("converged", "unfinished")
    error = run.rows[-1].error
    about: dict[str, Said] = {
        "steps": last,
        "error": _measured(Approximate(error), arm, options),
        "bound": _measured(BOUND, arm, options),
    }
    fixed = None if newton else options.step
    first = not again
    return Facts(
        again=Phrase("newton-again" if newton else "gradient-again") if again else None,
        newton=Phrase("newton", {"e": ERROR}) if first and newton and arm.task.square else None,
        pseudo=Phrase("newton-pseudo", {"e": ERROR}) if first and newton and not arm.task.square else None,
        gradient=None if newton or again else Phrase("gradient", {"e": ERROR}),
        best=Phrase("best-step", {"f": F}) if first and not newton and fixed is None else None,
        alpha=(ALPHA, fixed) if fixed is not None and first else None,
        measure=None if explained or not last else Phrase("measure", {"r_d": R, "f": F}),
        table=table if last else None,
        ended=Phrase(ended(run.verdict, newton, not last), about),
        stopped=stopped(run.verdict, arm.task.square),
        solution=_solution(arm, run) if found else (),
        outlook=Phrase(outlook(run.verdict, newton, fixed is not None), share(run)) if found else None,
        drawn=sum(row.error >= CLOSE for row in run.rows) > 1,
        numbers=(),
    )


def _measured(error: Expr, arm: Arm, options: Options) -> Expr:
    """An error with its unit, where it has one."""
    unit = _units(arm, options).get(Phrase("error"))
    return Measured(error, unit) if unit else error


def _there(arm: Arm, run: Iteration, target: Sequence[float]) -> tuple[Step, ...]:
    """J where the iteration ended, and where it is stuck the error e."""
    place, J_now = arm.pose(run.rows[-1].q)
    J_here = Matrix(tuple(tuple(Approximate(float(each)) for each in row) for row in J_now))
    error = column(Approximate(r - f) for r, f in zip(target, place, strict=True))
    return Step("J_here", (J, J_here), "in-numbers"), Step("e_here", (E, error), "in-numbers")


def _at_start(arm: Arm, options: Options) -> tuple[Step, ...]:
    """The same at the start, where all of it is numbers of few digits, which nothing has rounded."""
    where = (*(options.evaluate or ()), *options.start)
    errors = (r + -f for r, f in zip(options.target, children(arm.forward()), strict=True))
    rows = (*arm.task.written.rows, tuple(errors))
    found = [[exactly(arm.task.problem, each, where) for each in row] for row in rows]
    *J_here, error = ([each for each in row if each is not None] for row in found)
    if [*J_here, error] != found:
        return ()
    J_matrix = Matrix(tuple(map(tuple, J_here)))
    return Step("J_here", (J, J_matrix), "in-numbers"), Step("e_here", (E, column(error)), "in-numbers")


def _solution(arm: Arm, run: Iteration) -> tuple[tuple[Symbol, Expr], ...]:
    """The joint variables of the last row."""
    values = zip(arm.variables, run.rows[-1].q, strict=True)
    return tuple((Symbol(name), Approximate(value)) for name, value in values)


def _explained(problem: Problem, options: Options) -> frozenset[str]:
    """The methods that earlier questions of the problem explained already."""
    asked = [each for kind, each in problem.questions if kind == "numerical-inverse-kinematics"]
    before = asked[: asked.index(options)] if options in asked else []
    return frozenset(each.method for each in before if len(each.target) == len(options.target))
