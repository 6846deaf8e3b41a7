"""The geometric Jacobian of any point of an arm, column by column."""

from __future__ import annotations

from functools import partial
from typing import Annotated, Any, ClassVar, Literal

from pydantic import AfterValidator, Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import Point
from derive.derivation import Derivation, Phrase
from derive.errors import NotAsWritten
from derive.expression import ZERO, Indexed, Matrix, Symbol, free_symbols, symbols, transpose
from derive.kinds.fields import Evaluation, Name, OptionsModel
from derive.kinds.pose.euler_angles import known_convention
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import by_index
from derive.kinds.robot._chain import TOOL, chain_of, oracle_of
from derive.kinds.robot._columns import Facts as Facts
from derive.kinds.robot._columns import jacobian_lines
from derive.kinds.robot._point import PointOn, Tracked, tracked
from derive.kinds.robot._seen import sorts
from derive.kinds.robot._turning import Sorts, turning_law
from derive.kinds.robot._units import of_variables
from derive.kinds.robot._velocity.task import RowName
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.jacobian import halves
from derive.mechanics.oracle import Oracle
from derive.mechanics.poses import rotation_part, skew
from derive.mechanics.robot import Robot
from derive.mechanics.task import ROWS, rows_of

STILL = {False: "still", True: "all-still"}  # whether several joints come after the point
CLAIMED = {"J": "differences|rates-agree"}

DIFFERENCES = 1e-6  # what central differences leave
measures = of_variables


J, J_E = symbols("J J^e")


class Options(OptionsModel):
    """Of which point the Jacobian is wanted, which rows of it, in which axes."""

    ONLY_WITH: ClassVar = {"convention": ("kind", "analytic"), "angles": ("kind", "analytic")}

    point: PointOn | None = None
    """The point whose motion counts; that of the end-effector if left out."""
    rows: tuple[RowName, ...] = ()
    """Some rows only, in this order; all six if left out."""
    frame: Literal["base", "tool"] = Field("base", alias="in")
    """The axes in which the velocities are written."""
    kind: Literal["geometric", "analytic"] = "geometric"
    """geometric: the angular velocity; analytic: the rates of three Euler angles instead."""
    convention: Annotated[str, AfterValidator(known_convention)] = "ZYX"
    """The order in which the rotations are made: ZYX about current axes, xyz about world axes, as in
    SciPy."""
    angles: tuple[Name, Name, Name] | None = None
    """Names for the three angles, in the order of the convention."""
    evaluate: Evaluation = None


def claims_of(robot: Robot, options: Options) -> tuple[str, ...]:
    """What is only turned or cut rests on the whole one in the base."""
    if options.kind == "analytic":
        return ("rates-agree",)
    whole = not options.rows and options.frame == "base"
    return ("linear", "angular", "differences") if whole else ("differences",)


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """J (6 by n): z x (o - o_i) over z for each revolute joint, z over 0 for each prismatic one
    (Spong et al., eq. 4.56 and 4.57; Siciliano et al., eq. 3.30)."""
    if options.kind == "analytic":
        from derive.kinds.robot._velocity.analytic import analytic  # few sheets need it

        return analytic(options, problem)
    if options.evaluate is not None:  # it changes nothing but the numbers: the same derivation, once
        return problem.answer("jacobian", options.model_copy(update={"evaluate": None}))
    if options.rows or options.frame == "tool":
        return _restated(options, problem)
    found = chain_of(problem)
    point = tracked(problem, found, options.point)
    value = point.jacobian(found)
    work = Work(problem).resting_on(problem.ask("joint-axes", to=_needed(problem, point)))
    made, kinds = point.name not in work.known, Sorts.of(found, point.last)
    if made:
        work = point.line(work, found)
    if kinds.coupled or kinds.turning:
        work = work.showing(turning_law(problem.taken))
    work = jacobian_lines(work, found, point.moving, J, point.name)
    asked = any(kind == "jacobian" for kind, _ in problem.questions)
    written, work = work.matrix(J), work.closed(J, spare=not asked)
    linear, angular = _moves_and_turns(found, point, value)
    work = work.law("linear", linear).law("angular", angular)
    oracle = oracle_of(problem)
    work = work.agrees(
        "differences",
        problem.symbols.union(*map(free_symbols, point.offset)),
        work[J],
        lambda at: oracle.jacobian(at, point.frame, point.offset),
        DIFFERENCES,
    )
    result = {"J": work.final(J)}
    work = work.knowing({J: written})  # those who build on it keep the names of `where`
    work = by_index(work, result)
    if not kinds.coupled:
        joints = [i for i, _ in found.moving]
        work = work.claim(sorts(problem, written, joints, (kinds.told, kinds.advancing)))
    facts = _facts(found, point, kinds, made, value, end=options.point is None)
    return work.answer("jacobian", result, facts, matrices=frozenset(result))


def _needed(problem: Problem, point: Tracked) -> int | None:
    """The last row that moves the point, where nothing else is asked that needs the whole arm."""
    robot = problem.subject
    alone = len(problem.questions) == 1 and not robot.by_screws
    return point.last if alone and 0 < point.last < len(robot.links) else None


def _restated(options: Options, problem: Problem) -> Derivation:
    """The Jacobian in the frame and with the rows asked for, from that in the base."""
    base, found = problem.ask("jacobian", point=options.point), chain_of(problem)
    point = tracked(problem, found, options.point)
    R, R_now = _rotation(found, point), rotation_part(_pose(found, point))
    turned = (problem.ask("forward-kinematics"),) if options.frame == "tool" else ()  # by its rotation
    work = Work(problem, uses=turned).resting_on(base).knowing({R: problem.readable_matrix(R_now)})
    head: Symbol | Indexed = J
    value = normal_matrix(work[J])
    if options.frame == "tool":
        head, value = J_E, ScalarMatrix.stacked([R_now.T @ half for half in halves(value)])
        turn = Matrix(((transpose(R), ZERO), (ZERO, transpose(R)))) * J
        work = work.line(J_E, turn, value=value, rule="other-frame")
    if options.rows:
        head, value = Indexed("J", tuple(map(Symbol, options.rows))), rows_of(value, options.rows)
        work = work.line(head, value=value, rule="rows", label="rows")
    work = work.closed(head)
    result = {"J": work.steps[-1].result}
    work = work.agrees(
        "differences",
        problem.symbols.union(*map(free_symbols, point.offset)),
        result["J"],
        partial(_by_differences, oracle_of(problem), point, options),
        DIFFERENCES,
    )
    work = by_index(work, result)
    return work.answer("jacobian", result, Facts(restated=True), matrices=frozenset(result))


def _by_differences(oracle: Oracle, point: Tracked, options: Options, at: Point) -> Any:
    """J in numbers, in the frame and with the rows asked for."""
    J_now: Any = oracle.jacobian(at, point.frame, point.offset)
    if options.frame == "tool":
        carried = point.frame <= len(oracle.robot.links)
        R = (oracle.poses(at)[point.frame] if carried else oracle.tool(at))[:3, :3]
        J_now = [*(R.T @ J_now[:3]), *(R.T @ J_now[3:])]
    return [J_now[ROWS.index(row)] for row in options.rows or ROWS]


def _rotation(found: Chain, point: Tracked) -> Symbol:
    """R_2^0 of the frame the point is fixed in; R_e^0 of the tool's."""
    return Symbol(f"R_{TOOL if point.frame > len(found.T_local) else point.frame}^0")


def _pose(found: Chain, point: Tracked) -> ScalarMatrix:
    """Of the frame the point is fixed in."""
    return found.T_tool if point.frame > len(found.T_local) else found.T[point.frame]


def _facts(found: Chain, point: Tracked, kinds: Sorts, made: bool, J_now: ScalarMatrix, end: bool) -> Facts:
    """Raises NotAsWritten where a joint that is said not to move the point does."""
    still = tuple(i for i, _ in found.moving if i > point.last)
    columns = dict(zip((i for i, _ in found.moving), J_now.T.rows, strict=False))
    if not kinds.coupled and any(any(columns[i]) for i in still):
        raise NotAsWritten("a joint that comes after the point moves it")
    key = "end" if end else "carried" if point.carried else "origin"
    where = Phrase(key, {"link": point.frame, "point": point.name})
    return Facts(
        point=where if made else None,
        sorts=kinds.told,
        helical=kinds.advancing,
        still=Phrase(STILL[len(still) > 1], {"still": still}) if still and not kinds.coupled else None,
    )


def _moves_and_turns(found: Chain, point: Tracked, J: ScalarMatrix) -> tuple[bool, bool]:
    """Whether each column is the velocity, and the angular velocity, that its joint alone gives."""
    R = rotation_part(_pose(found, point))
    linear = angular = True
    for k, name in enumerate(found.variables):
        J_v, J_w = halves(J.columns(k))
        linear &= point.position.diff(name) == J_v
        angular &= R.diff(name) @ R.T == skew(J_w)
    return linear, angular
