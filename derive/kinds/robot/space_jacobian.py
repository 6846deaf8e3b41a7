"""The Jacobian whose columns are the twists of the joints: in the space frame or in that of the body."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.floats import Point
from derive.derivation import Derivation, PageFacts, Phrase
from derive.expression import ZERO, Expr, Indexed, Matrix, Symbol, column, symbols, transpose
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.robot._columns import blocks
from derive.kinds.robot._couplings import gamma_of, phi_of
from derive.kinds.robot._seen import sorts
from derive.kinds.robot._turning import Sorts, turning_law
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.jacobian import halves, jacobian, motions_jacobian
from derive.mechanics.oracle import slope, vee
from derive.mechanics.poses import inverse_pose, position_part, rotation_part, skew
from derive.mechanics.robot import Robot

CLAIMS = ("twists-in-space|twists-in-body", "differences")
DIFFERENCES = 1e-6  # what central differences leave
NOTHING, NO_BLOCK = Symbol("0"), Symbol("0_3x3")
J_S, J_B, R_E, O_E = symbols("J_s J_b R_e o_e")
S_O = Indexed("P", (O_E,))  # P_{o_e} p = o_e x p
ORIGIN = ScalarMatrix.zeros(3, 1)


class Options(OptionsModel):
    """Where the twists are seen from."""

    frame: Literal["space", "body"] = Field("space", alias="in")
    """The frame of the twists: space (the base frame) or body (that of the end-effector)."""


class Facts(PageFacts):
    body: bool
    sorts: Phrase | None  # of joints, and how they move it
    helical: Phrase | None


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """J (6 by n): column i is the screw of joint i where the joints before it have carried it,
    (o_i x z_i, z_i) or (z_i, 0); in the body, J_b = Ad(T^-1) J_s (Lynch and Park, section 5.1)."""
    found, body = chain_of(problem), options.frame == "body"
    name, work = (J_B, _body(problem, found)) if body else (J_S, _space(problem, found))
    J = work.value_matrix(name)
    claim = "twists-in-body" if body else "twists-in-space"
    work = work.closed(name).law(claim, _are_twists(found, J, body))
    work = work.agrees(
        "differences", problem.symbols, J, lambda at: _differences(problem, at, body), DIFFERENCES
    )
    work = _seen(work) if body else work
    kinds = Sorts.of(found)
    facts = Facts(
        body=body,
        sorts=None if body else kinds.told,
        helical=None if body else kinds.advancing,
    )
    if not kinds.coupled:
        joints = [i for i, _ in found.moving]
        work = work.claim(sorts(problem, work.matrix(name), joints, (kinds.told, kinds.advancing)))
    results = {name.name: work.final(name)}
    return work.answer("space-jacobian", results, facts, matrices=frozenset(results))


def _space(problem: Problem, found: Chain) -> Work:
    """J_s from the twists of the joints: the Jacobian of the point of the last body that just passes the
    origin; of coupled joints from the twists of the motions of the rows."""
    J = jacobian(found, ORIGIN, len(found.T))
    work = Work(problem).resting_on(problem.ask("joint-axes")).knowing({NOTHING: column((ZERO, ZERO, ZERO))})
    if found.coupling or any(joint.type != "prismatic" for _, joint in found.moving):
        work = work.showing(turning_law(problem.taken))
    formula: Expr = Matrix(tuple(zip(*blocks(problem, found, nothing=NOTHING), strict=True)))
    if found.coupling:
        motions = Symbol(f"J_s_{phi_of(problem).name}")
        J_phi = motions_jacobian(found.coupling, ORIGIN, len(found.T))
        work = work.line(motions, formula, value=J_phi, rule="motion-twists")
        formula = motions * gamma_of(problem)
    return work.line(J_S, formula, value=J, rule="twists")


def _body(problem: Problem, found: Chain) -> Work:
    """J_b = Ad(T^-1) J_s, with R_e and o_e the end-effector's."""
    T = found.T_tool
    R, S, none = rotation_part(T), skew(position_part(T)), ScalarMatrix.zeros(3, 3)
    adjoint = ScalarMatrix.stacked([ScalarMatrix.beside([R.T, -(R.T @ S)]), ScalarMatrix.beside([none, R.T])])
    turned = transpose(R_E)
    formula = Matrix(((turned, -(turned * S_O)), (NO_BLOCK, turned)))
    work = Work(problem).resting_on(problem.ask("space-jacobian"))
    work = work.knowing({NO_BLOCK: problem.readable_matrix(none)}).line(R_E, value=R, rule="extract")
    work = work.line(O_E, value=position_part(T), rule="extract").line(S_O, value=S, rule="skew", label="S")
    work = work.knowing({S_O: work.steps[-1].result})
    value = adjoint @ jacobian(found, ORIGIN, len(found.T))
    return work.line(J_B, formula * J_S, value=value, rule="adjoint")


def _seen(work: Work) -> Work:
    """With the claim that the rotation, the origin and its matrix are those of the end-effector."""
    problem = work.problem
    told = {step.name: step.result for step in work.steps}

    def pose(at: Point) -> Any:
        import numpy as np

        T = oracle_of(problem).tool(at)
        x, y, z = T[:3, 3]
        return [T[:3, :3], T[:3, 3], np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])]

    def lines(at: Point) -> Any:
        return [arrays(told[name], at) for name in ("R_e", "o_e", "S")]

    return work.agrees("pose-seen", problem.symbols, lines, pose)


def _are_twists(found: Chain, J: ScalarMatrix, body: bool) -> bool:
    """[J e_i] = dT/dq_i T^-1, of the body T^-1 dT/dq_i."""
    T, back, holds = found.T_tool, inverse_pose(found.T_tool), True
    for k, name in enumerate(found.variables):
        v, w = halves(J.columns(k))
        bracket = ScalarMatrix.stacked([ScalarMatrix.beside([skew(w), v]), ScalarMatrix.zeros(1, 4)])
        holds &= bracket == (back @ T.diff(name) if body else T.diff(name) @ back)
    return holds


def _differences(problem: Problem, at: Point, body: bool) -> Any:
    """The twists (6 by n) of the end-effector by differences of its pose."""
    import numpy as np

    tool, columns = oracle_of(problem).tool, []
    back = np.linalg.inv(tool(at))
    for name in problem.subject.variables:
        rate = slope(tool, at, {name: 1})
        twist = back @ rate if body else rate @ back
        columns.append([*twist[:3, 3], *vee(twist)])
    return np.array(columns).T
