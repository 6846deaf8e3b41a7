"""The analytic Jacobian: the rates of three angles in place of the angular velocity."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.derivation import Claim, Derivation, Step
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Indexed, Matrix, Product, Symbol, is_negative, negate
from derive.kinds.checks import agreement, links, random_points
from derive.kinds.evaluation import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, closing, matrix_of, oracle_of, scalar_of
from derive.kinds.robot._point import tracked
from derive.kinds.robot.jacobian import Facts
from derive.kinds.values_at import point_of
from derive.mechanics.euler import Convention, Euler
from derive.mechanics.euler_rates import rate_matrix
from derive.mechanics.oracle import STEP
from derive.mechanics.task import rows_of

DIFFERENCES = 1e-5
SMALL = 1e-9
J, J_A, J_V, J_OMEGA, T = map(Symbol, ("J", "J_a", "J_v", "J_omega", "T"))


def analytic(options: Any, problem: Problem) -> Derivation:
    """J_a = diag(1, T^-1) J (Siciliano et al., eq. 3.65; Spong et al., eq. 4.88).

    Raises NotDerivable in the frame of the tool: the rates of angles have no axes.
    """
    if options.frame == "tool":
        raise NotDerivable("rates of Euler angles belong to no frame: leave out 'in: tool'")
    base = problem.ask("jacobian", point=options.point)
    rates = problem.ask("euler-rates", convention=options.convention, angles=options.angles)
    euler = Euler(Convention.of(options.convention), _names(rates))
    frame = tracked(problem, chain_of(problem), options.point).frame
    _refuse_singular(problem, euler, frame)
    whole = normal_matrix(base.definitions[J])
    linear, angular = whole.block(slice(0, 3), slice(None)), whole.block(slice(3, 6), slice(None))
    found = ScalarMatrix.stacked([linear, rate_matrix(euler).inverse() @ angular])
    asked = rows_of(found, options.rows) if options.rows else found
    steps = _steps(problem, found, asked, options.rows)
    definitions: dict[Expr, Expr] = {
        J_V: problem.readable_matrix(linear),
        J_OMEGA: problem.readable_matrix(angular),
        T: matrix_of(rates, "T"),
        J_A: problem.readable_matrix(found),
    }
    claims = (*links(steps, {**problem.names, **definitions}), _second_route(problem, found, euler, frame))
    return Derivation(
        "jacobian", steps, {"J": problem.final(problem.readable_matrix(asked))}, claims, definitions,
        _evaluated(problem, options.evaluate, asked, euler, frame), (base, rates),
        facts=Facts(
            analytic=True, angles=tuple(map(Symbol, euler.names)), det=_unsigned(scalar_of(rates, "det")),
            numbers=("J",),
        ), matrices=frozenset({"J"}),
    )  # fmt: skip


def _names(rates: Derivation) -> tuple[str, str, str]:
    """Of the angles, as the kind that finds their rates chose them."""
    column = rates.step("rates").chain[0]
    first, second, third = (name.removesuffix("_dot") for name in _listed(column))
    return first, second, third


def _listed(column: Expr) -> list[str]:
    rows = column.rows if isinstance(column, Matrix) else ()
    return [entry.name for (entry,) in rows if isinstance(entry, Symbol)]


def _unsigned(tree: Expr) -> Expr:
    return negate(tree) if is_negative(tree) else tree


def _steps(
    problem: Problem, found: ScalarMatrix, asked: ScalarMatrix, rows: tuple[str, ...]
) -> tuple[Step, ...]:
    block = Matrix(((J_V,), (Product((Call("inverse", (T,)), J_OMEGA)),)))
    whole = Step("J_a", (J_A, block, problem.readable_matrix(found)), "analytic")
    if not rows:
        return (closing(whole, problem.final(whole.result)),)
    written = problem.readable_matrix(asked)
    name = Indexed("J", tuple(map(Symbol, rows)))
    return (whole, closing(Step("rows", (name, written), "rows"), problem.final(written)))


def _evaluated(
    problem: Problem, place: Place | None, asked: ScalarMatrix, euler: Euler, frame: int
) -> dict[str, Any]:
    """In numbers; the angles are those of the pose at that place."""
    if place is None:
        return {}
    point = point_of(dict(place), problem.where)
    try:
        known = oracle_of(problem).at(point)
        known = {**known, **_angles(problem, euler, frame, known), **point}
        return {"J": numeric.matrix_numbers(asked, known)}
    except KeyError:  # some symbols are left: J is told in these
        return {}


def _angles(problem: Problem, euler: Euler, frame: int, known: Mapping[str, float]) -> dict[str, float]:
    """Of the orientation of a frame, by the solution whose common factor is positive."""
    oracle = oracle_of(problem)
    poses = oracle.poses(known)
    R = (oracle.tool(known) if frame >= len(poses) else poses[frame])[:3, :3]
    entries = {f"r_{i + 1}{j + 1}": float(R[i, j]) for i in range(3) for j in range(3)}
    return {name: numeric.number(tree, entries) for name, tree in euler.regular(1).items()}


def _refuse_singular(problem: Problem, euler: Euler, frame: int) -> None:
    """Raises NotDerivable where the angles fail in every configuration, as ZYZ does for arms in a plane."""
    det = rate_matrix(euler).det()
    for at in random_points(sorted(problem.symbols), 2):
        known = dict(oracle_of(problem).at(at))
        if abs(numeric.scalar_number(det, _angles(problem, euler, frame, known))) > SMALL:
            return
    raise NotDerivable(
        "in every configuration of this arm these angles are singular (det T = 0): choose another convention"
    )


def _second_route(problem: Problem, found: ScalarMatrix, euler: Euler, frame: int) -> Claim:
    """The lower half by differences of the angles themselves."""
    oracle, names = oracle_of(problem), problem.subject.variables

    def differences(at: Mapping[str, float]) -> Any:
        known = dict(oracle.at(at))
        columns = []
        for name in names:
            moved = [{**known, name: known[name] + h} for h in (STEP, -STEP)]
            ahead, behind = (_angles(problem, euler, frame, each) for each in moved)
            columns.append([math.remainder(ahead[n] - behind[n], math.tau) / (2 * STEP) for n in euler.names])
        return [list(row) for row in zip(*columns, strict=True)]

    def ours(at: Mapping[str, float]) -> Any:
        known = dict(oracle.at(at))
        angular = found.block(slice(3, 6), slice(None))
        return numeric.matrix_numbers(angular, {**known, **_angles(problem, euler, frame, known)})

    return agreement("rates-agree", problem.symbols, ours, differences, DIFFERENCES)
