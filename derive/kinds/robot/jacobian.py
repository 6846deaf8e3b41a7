"""The geometric Jacobian of any point of an arm, column by column."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import AfterValidator, Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.derivation import Claim, Derivation, PageFacts, Step, named_results
from derive.expression import ZERO, Expr, Indexed, Matrix, Product, Symbol, free_symbols, transpose
from derive.kinds.checks import agreement, law, links
from derive.kinds.evaluation import Evaluation
from derive.kinds.fields import Name, OptionsModel
from derive.kinds.pose.euler_angles import known_convention
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import TOOL, chain_of, closing, oracle_of
from derive.kinds.robot._columns import jacobian_steps
from derive.kinds.robot._point import PointOn, Tracked, tracked
from derive.mechanics.chain import Chain
from derive.mechanics.poses import rotation_part, skew
from derive.mechanics.robot import Robot

RESULTS = {"J": "6 by n, linear rows first; only the `rows` asked for, in their order"}
EXAMPLE = """\
title: The Jacobian of a planar arm
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  questions:
  - {find: jacobian}
  - {find: jacobian, point: {link: 2, at: [-a2/2, 0, 0]}, rows: [vx, vy]}
  - {find: jacobian, kind: analytic, convention: ZYX}
"""
ROWS = ("vx", "vy", "vz", "wx", "wy", "wz")
RowName = Literal["vx", "vy", "vz", "wx", "wy", "wz"]
DIFFERENCES = 1e-6  # what central differences leave


class Options(OptionsModel):
    """`point`: where (the end-effector if left out); `rows`: some rows only; `in`: the frame of the vectors;
    `kind: analytic` has the rates of the Euler angles of a `convention` instead of the angular velocity."""

    ONLY_WITH: ClassVar = {"convention": ("kind", "analytic"), "angles": ("kind", "analytic")}

    point: PointOn | None = None
    rows: tuple[RowName, ...] = ()
    frame: Literal["base", "tool"] = Field("base", alias="in")
    kind: Literal["geometric", "analytic"] = "geometric"
    convention: Annotated[str, AfterValidator(known_convention)] = "ZYX"
    angles: tuple[Name, Name, Name] | None = None
    evaluate: Evaluation = None


class Facts(PageFacts):
    analytic: bool = False
    angles: tuple[Symbol, ...] = ()  # of the analytic one
    det: Expr | None = None  # that of their rates
    restated: bool = False
    point: Symbol | None = None
    link: int = 0  # that carries the point
    carried: bool = False
    revolute: tuple[int, ...] = ()
    helical: tuple[int, ...] = ()
    prismatic: tuple[int, ...] = ()
    coupled: bool = False
    still: tuple[int, ...] = ()  # joints after the point


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """z x (o - o_i) over z for each revolute joint, z over 0 for each prismatic one
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
    axes = problem.ask("joint-axes")
    J = point.jacobian(found)
    columns = jacobian_steps(problem, found, point.moving, Symbol("J"), point.name)
    own_point = () if point.name in axes.definitions else (point.step,)
    written = problem.readable_matrix(J)
    result = problem.final(written)
    steps = (*own_point, *columns[:-1], closing(columns[-1], result))
    definitions = {**axes.definitions, **point.definitions, **named_results(steps), Symbol("J"): written}
    claims = (
        *links(steps, {**problem.names, **definitions}),
        *_laws(found, point, J),
        _second_route(problem, point, J),
    )
    return Derivation(
        "jacobian",
        steps,
        {"J": result},
        claims,
        definitions,
        uses=(axes,),
        facts=_facts(found, point),
        matrices=frozenset({"J"}),
    )


def _restated(options: Options, problem: Problem) -> Derivation:
    """The Jacobian in the frame and with the rows asked for, from that in the base."""
    base = problem.ask("jacobian", point=options.point)
    found = chain_of(problem)
    point = tracked(problem, found, options.point)
    J, steps = _asked_for(problem, found, normal_matrix(base.definitions[Symbol("J")]), point, options)
    result = problem.final(problem.readable_matrix(J))
    steps = (*steps[:-1], closing(steps[-1], result))
    definitions = {**base.definitions, **named_results(steps)}
    definitions[_rotation(found, point)] = problem.readable_matrix(rotation_part(_pose(found, point)))
    return Derivation(
        "jacobian",
        steps,
        {"J": result},
        links(steps, {**problem.names, **definitions}),
        definitions,
        uses=(base,),
        facts=Facts(restated=True),
        matrices=frozenset({"J"}),
    )


def _asked_for(
    problem: Problem, found: Chain, J: ScalarMatrix, point: Tracked, options: Options
) -> tuple[ScalarMatrix, tuple[Step, ...]]:
    """The Jacobian in the frame and with the rows asked for, and the steps there."""
    steps: list[Step] = []
    if options.frame == "tool":
        R_T = rotation_part(_pose(found, point)).T
        J = ScalarMatrix.stacked([R_T @ J.block(rows, slice(None)) for rows in (slice(0, 3), slice(3, 6))])
        R = transpose(_rotation(found, point))
        turn = Product((Matrix(((R, ZERO), (ZERO, R))), Symbol("J")))
        steps.append(Step("J^e", (Symbol("J^e"), turn, problem.readable_matrix(J)), "other-frame"))
    if options.rows:
        name = Indexed("J", tuple(Symbol(row) for row in options.rows))
        J = ScalarMatrix(tuple(J.rows[ROWS.index(row)] for row in options.rows))
        steps.append(Step("rows", (name, problem.readable_matrix(J)), "rows"))
    return J, tuple(steps)


def _rotation(found: Chain, point: Tracked) -> Symbol:
    """R_2^0 of the frame the point is fixed in; R_e^0 of the tool's."""
    return Symbol(f"R_{TOOL if point.frame > len(found.T_local) else point.frame}^0")


def _pose(found: Chain, point: Tracked) -> ScalarMatrix:
    """Of the frame the point is fixed in."""
    return found.T_tool if point.frame > len(found.T_local) else found.T[point.frame]


def _facts(found: Chain, point: Tracked) -> Facts:
    moving = [(joint, i) for i, joint in found.moving if i <= point.last]
    return Facts(
        point=point.name,
        link=point.frame,
        carried=point.step.rule == "carry",
        revolute=tuple(i for joint, i in moving if joint.type != "prismatic"),
        helical=tuple(i for joint, i in moving if joint.pitch),
        prismatic=tuple(i for joint, i in moving if joint.type == "prismatic"),
        coupled=found.coupling is not None,
        still=tuple(i for i, _ in found.moving if i > point.last),
    )


def _laws(found: Chain, point: Tracked, J: ScalarMatrix) -> tuple[Claim, ...]:
    """Each column is the velocity that its joint alone gives."""
    R = rotation_part(_pose(found, point))
    linear = angular = True
    for k, name in enumerate(found.variables):
        column = J.columns(k)
        linear &= point.position.diff(name) == column.block(slice(0, 3), slice(0, 1))
        angular &= R.diff(name) @ R.T == skew(column.block(slice(3, 6), slice(0, 1)))
    return law("linear", linear), law("angular", angular)


def _second_route(problem: Problem, point: Tracked, J: ScalarMatrix) -> Claim:
    oracle = oracle_of(problem)

    def differences(at: Mapping[str, float]) -> Any:
        return oracle.jacobian(oracle.at(at), point.frame, point.offset)

    return agreement(
        "differences",
        problem.symbols.union(*map(free_symbols, point.offset)),
        lambda at: numeric.matrix_numbers(J, oracle.at(at)),
        differences,
        DIFFERENCES,
    )
