"""The Jacobian whose columns are the twists of the joints: in the space frame or in that of the body."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from pydantic import Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.floats import matrix_numbers
from derive.derivation import Claim, Derivation, PageFacts, Step, named_results
from derive.expression import (
    ZERO,
    Expr,
    Indexed,
    Matrix,
    Product,
    Symbol,
    add,
    column,
    cross,
    negate,
    transpose,
)
from derive.kinds.checks import agreement, law, links
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import axis_names, chain_of, closing, oracle_of
from derive.kinds.robot._couplings import drive_names, gamma_of, phi_of
from derive.mechanics.chain import Chain
from derive.mechanics.jacobian import jacobian, motions_jacobian
from derive.mechanics.poses import inverse_pose, position_part, rotation_part, skew
from derive.mechanics.robot import Robot

RESULTS = {
    "J_s": "6 by n: the twists of the joints in the base frame, linear rows first",
    "J_b": "with `in: body`: the same in the frame of the end-effector",
}
EXAMPLE = """\
title: The twists of a planar arm
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  questions:
  - {find: space-jacobian}
  - {find: space-jacobian, in: body}
"""
STEP = 1e-6  # of differences
DIFFERENCES = 1e-6  # what central differences leave
NOTHING, NO_BLOCK = Symbol("0"), Symbol("0_3x3")
RE, OE = Symbol("R_e"), Symbol("o_e")
SO = Indexed("S", (OE,))  # S_{o_e} p = o_e x p


class Options(OptionsModel):
    """`in`: the frame of the twists, `space` (the base frame) or `body` (the end-effector's)."""

    frame: Literal["space", "body"] = Field("space", alias="in")


class Facts(PageFacts):
    body: bool
    turning: tuple[int, ...]
    sliding: tuple[int, ...]
    helical: tuple[int, ...]
    coupled: bool


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """Column i is the screw of joint i where the joints before it have carried it, (o_i x z_i, z_i) or
    (z_i, 0); in the body, J_b = Ad(T^-1) J_s (Lynch and Park, section 5.1)."""
    found = chain_of(problem)
    J = space_jacobian(found)
    if options.frame == "space":
        uses = problem.ask("joint-axes")
        steps = _space(problem, found, J)
    else:
        uses = problem.ask("space-jacobian")
        J, steps = _body(problem, found, J)
    name = steps[-1].name
    result = problem.final(problem.readable_matrix(J))
    steps = (*steps[:-1], closing(steps[-1], result))
    definitions = {**named_results(steps), NOTHING: column((ZERO, ZERO, ZERO)), **_skew(problem, found)}
    claims = (
        *links(steps, {**problem.names, **uses.definitions, **definitions}),
        *_laws(found, J, options),
        _second_route(problem, J, options),
    )
    facts = _facts(found, options)
    return Derivation(
        "space-jacobian",
        steps,
        {name: result},
        claims,
        definitions,
        uses=(uses,),
        facts=facts,
        matrices=frozenset({name}),
    )


def space_jacobian(found: Chain) -> ScalarMatrix:
    """J_s (6 by n): the Jacobian of the point of the last body that just passes the origin."""
    return jacobian(found, ScalarMatrix.zeros(3, 1), len(found.T))


def _space(problem: Problem, found: Chain, J: ScalarMatrix) -> tuple[Step, ...]:
    """J_s from the twists of the joints; of coupled ones from those of the motions of the rows."""
    name, written, robot = Symbol("J_s"), problem.readable_matrix(J), problem.subject
    if found.coupling is None:
        return (Step("J_s", (name, _blocks(problem, found, robot), written), "twists"),)
    motions = Symbol(f"J_s_{phi_of(problem).name}")
    origin = ScalarMatrix.zeros(3, 1)
    value = problem.readable_matrix(motions_jacobian(found.coupling, origin, len(found.T)))
    chain = (motions, _motion_blocks(found, robot), value)
    return (
        Step(motions.name, chain, "motion-twists"),
        Step("J_s", (name, Product((motions, gamma_of(problem))), written), "twists"),
    )


def _motion_blocks(found: Chain, robot: Robot) -> Matrix:
    """The twist of each motion of a row, in the names of its vectors."""
    columns = []
    for drive in found.coupling.drives if found.coupling else ():
        axis, o = drive_names(found, robot, drive)
        columns.append((axis, NOTHING) if drive.slides else (cross(o, axis), axis))
    return Matrix(tuple(zip(*columns, strict=True)))


def _blocks(problem: Problem, found: Chain, robot: Robot) -> Matrix:
    """The columns in the names of their vectors."""
    columns: list[tuple[Expr, Expr]] = []
    for i, joint in found.moving:
        z, o = axis_names(found, robot, i)
        if joint.type == "prismatic":
            columns.append((z, NOTHING))
        else:
            along = (Product((problem.readable(joint.pitch), z)),) if joint.pitch else ()
            columns.append((add(cross(o, z), *along), z))
    return Matrix(tuple(zip(*columns, strict=True)))


def _body(problem: Problem, found: Chain, J: ScalarMatrix) -> tuple[ScalarMatrix, tuple[Step, ...]]:
    """J_b = Ad(T^-1) J_s, with R_e and o_e the end-effector's."""
    T = found.T_tool
    R, o, S = rotation_part(T), position_part(T), skew(position_part(T))
    top = ScalarMatrix.beside([R.T, -(R.T @ S)])
    bottom = ScalarMatrix.beside([ScalarMatrix.zeros(3, 3), R.T])
    result = ScalarMatrix.stacked([top, bottom]) @ J
    read = problem.readable_matrix
    turned = transpose(RE)
    adjoint = Matrix(((turned, negate(Product((turned, SO)))), (NO_BLOCK, turned)))
    return result, (
        Step("R_e", (RE, read(R)), "extract"),
        Step("o_e", (OE, read(o)), "extract"),
        Step("S", (SO, read(S)), "skew"),
        Step("J_b", (Symbol("J_b"), Product((adjoint, Symbol("J_s"))), read(result)), "adjoint"),
    )


def _skew(problem: Problem, found: Chain) -> dict[Expr, Expr]:
    """What the matrices beside the rotation stand for."""
    read = problem.readable_matrix
    return {SO: read(skew(position_part(found.T_tool))), NO_BLOCK: read(ScalarMatrix.zeros(3, 3))}


def _laws(found: Chain, J: ScalarMatrix, options: Options) -> tuple[Claim, ...]:
    """[J e_i] = dT/dq_i T^-1, of the body T^-1 dT/dq_i."""
    T, back, holds = found.T_tool, inverse_pose(found.T_tool), True
    for k, name in enumerate(found.variables):
        v, w = J.columns(k).block(slice(0, 3), slice(0, 1)), J.columns(k).block(slice(3, 6), slice(0, 1))
        bracket = ScalarMatrix.stacked([ScalarMatrix.beside([skew(w), v]), ScalarMatrix.zeros(1, 4)])
        rate = T.diff(name) @ back if options.frame == "space" else back @ T.diff(name)
        holds &= bracket == rate
    return (law("twists-in-space" if options.frame == "space" else "twists-in-body", holds),)


def _second_route(problem: Problem, J: ScalarMatrix, options: Options) -> Claim:
    oracle = oracle_of(problem)

    def differences(point: Mapping[str, float]) -> Any:
        import numpy as np

        at = oracle.at(point)
        back = np.linalg.inv(oracle.tool(at))
        columns = []
        for name in problem.subject.variables:
            ahead, behind = (oracle.tool({**at, name: at[name] + h}) for h in (STEP, -STEP))
            rate = (ahead - behind) / (2 * STEP)
            S = rate @ back if options.frame == "space" else back @ rate
            columns.append([*S[:3, 3], S[2, 1], S[0, 2], S[1, 0]])
        return np.array(columns).T

    return agreement(
        "differences",
        problem.symbols,
        lambda at: matrix_numbers(J, oracle.at(at)),
        differences,
        DIFFERENCES,
    )


def _facts(found: Chain, options: Options) -> Facts:
    return Facts(
        body=options.frame == "body",
        turning=tuple(i for i, joint in found.moving if joint.type != "prismatic"),
        sliding=tuple(i for i, joint in found.moving if joint.type == "prismatic"),
        helical=tuple(i for i, joint in found.moving if joint.pitch),
        coupled=found.coupling is not None,
    )
