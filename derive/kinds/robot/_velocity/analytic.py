"""The analytic Jacobian: the rates of three angles in place of the angular velocity."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import permutations
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers import floats as numeric
from derive.algebra.numbers.floats import Point
from derive.derivation import Derivation, Step
from derive.errors import NotDerivable
from derive.expression import Call, Expr, Indexed, Matrix, Symbol, is_negative, symbols
from derive.expression import replace as put_in
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import Place
from derive.kinds.pose import euler_rates
from derive.kinds.pose.euler_rates import E
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of, oracle_of
from derive.kinds.robot._columns import Facts
from derive.kinds.robot._point import Tracked, tracked
from derive.kinds.sure import place as surely
from derive.kinds.values_at import point_of
from derive.kinds.work import Work
from derive.mechanics.euler import Convention, Euler, rate_matrix
from derive.mechanics.jacobian import halves
from derive.mechanics.oracle import STEP
from derive.mechanics.poses import rotation_part
from derive.mechanics.task import ROWS, rows_of

DIFFERENCES = 1e-5
SMALL = 1e-9
J, J_A, J_V, J_OMEGA = symbols("J J_a J_v J_omega")


def analytic(options: Any, problem: Problem) -> Derivation:
    """J_a = diag(1, E^-1) J (6 by n; Siciliano et al., eq. 3.65; Spong et al., eq. 4.88).

    Raises NotDerivable in the frame of the tool: the rates of angles have no axes.
    """
    if options.frame == "tool":
        raise NotDerivable("rates of Euler angles belong to no frame: leave out 'in: tool'", "in")
    base = problem.ask("jacobian", point=options.point)
    rates = problem.ask("euler-rates", convention=options.convention, angles=options.angles)
    first, second, third = rates.told(euler_rates.Facts).short_names
    euler = Euler(Convention.of(options.convention), (first, second, third))
    point = tracked(problem, chain_of(problem), options.point)
    frame = point.frame
    _refuse_singular(problem, euler, frame)
    linear, angular = halves(normal_matrix(base.definitions[J]))
    J_v, J_omega = map(problem.readable_matrix, (linear, angular))
    angular_rates = rate_matrix(euler).inverse() @ angular
    found = ScalarMatrix.stacked([linear, angular_rates])
    block = Matrix(((J_V,), (Call("inverse", (E,)) * J_OMEGA,)))
    work = Work(problem, uses=(base, rates)).knowing({J_V: J_v, J_OMEGA: J_omega, E: rates.definitions[E]})
    work = work.line(J_A, block, value=found, rule="analytic")
    head: Symbol | Indexed = J_A
    own = () if options.rows else _joints_of(problem, euler, frame)
    if options.rows:
        head, found = Indexed("J", tuple(map(Symbol, options.rows))), rows_of(found, options.rows)
        work = work.line(head, value=found, rule="rows", label="rows")
    routes = _by_rates(angular_rates, problem, euler, frame), _by_angles(problem, euler, frame)
    work = work.closed(head).agrees("rates-agree", problem.symbols, *routes, DIFFERENCES)
    answer = work.steps[-1].result
    if own:
        work = work.showing(_in_joints(problem, euler, own, linear, angular, found))
        work = work.claim(route("own-angles", _turned_alike(problem, euler, own, frame)))
    det = rates.scalar("det")
    told = _evaluated(problem, options.evaluate, found, euler, frame)
    if told:
        there = _there(problem, dict(options.evaluate), euler, point)
        right = [there[ROWS.index(row)] for row in options.rows or ROWS]
        work = work.claim(route("there", close(told["J"], right, DIFFERENCES)))
    return work.answer(
        "jacobian",
        {"J": answer},
        Facts(
            analytic=True,
            numbers=("J",),
            angles=tuple(map(Symbol, euler.names)),
            own=tuple(zip(map(Symbol, euler.names), map(Symbol, own), strict=False)),
            det=-det if is_negative(det) else det,
        ),
        evaluated=told,
        matrices=frozenset({"J"}),
    )


def _joints_of(problem: Problem, euler: Euler, frame: int) -> tuple[str, ...]:
    """The three joint variables that are the angles themselves, where the orientation of the frame is that of
    their rotations; none of another arm."""
    chain = chain_of(problem)
    R = rotation_part(chain.T_tool if frame >= len(chain.T) else chain.T[frame])
    letters = {name for entry in R.entries for name in entry.letters()} & set(problem.subject.variables)
    if len(letters) != len(euler.names):
        return ()
    orders = permutations(sorted(letters))
    return next(((a, b, c) for a, b, c in orders if replace(euler, names=(a, b, c)).matrix == R), ())


def _in_joints(
    problem: Problem, euler: Euler, own: tuple[str, ...], linear: ScalarMatrix, angular: ScalarMatrix,
    found: ScalarMatrix,
) -> Step:  # fmt: skip
    """J_a with the joint variables in place of the angles, found anew from their own E."""
    first, second, third = own
    rates = rate_matrix(replace(euler, names=(first, second, third))).inverse() @ angular
    values = dict[Expr, Expr](zip(map(Symbol, euler.names), map(Symbol, own), strict=True))
    instance: dict[Expr, Expr] = {J_A: put_in(problem.readable_matrix(found), values)}
    J_own = problem.readable_matrix(ScalarMatrix.stacked([linear, rates]))
    return Step("J_own", (J_A, J_own), "law", instance=instance)


def _turned_alike(problem: Problem, euler: Euler, own: tuple[str, ...], frame: int) -> Iterator[bool]:
    """Whether the joint variables, as these angles, give the orientation of the frame, in numbers."""
    oracle = oracle_of(problem)
    for at in random_points(problem.symbols, 2):
        known = oracle.at(at)
        poses = oracle.poses(known)
        R = (oracle.tool(known) if frame >= len(poses) else poses[frame])[:3, :3]
        angles = {name: known[joint] for name, joint in zip(euler.names, own, strict=True)}
        yield close(numeric.matrix_numbers(euler.matrix, angles), R.tolist(), SMALL)


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


def _there(problem: Problem, place: dict[str, Expr], euler: Euler, point: Tracked) -> list[Any]:
    """J (6 by n) at the place, by differences of the point and of the angles."""
    at = surely({**problem.where, **place})
    moved = oracle_of(problem).jacobian(at, point.frame, point.offset)
    return [*moved[:3], *_by_angles(problem, euler, point.frame)(at)]


def _angles(problem: Problem, euler: Euler, frame: int, known: Point) -> dict[str, float]:
    """Of the orientation of a frame, by the solution whose common factor is positive."""
    oracle = oracle_of(problem)
    poses = oracle.poses(known)
    R = (oracle.tool(known) if frame >= len(poses) else poses[frame])[:3, :3]
    entries = {f"r_{i + 1}{j + 1}": float(R[i, j]) for i in range(3) for j in range(3)}
    return {name: numeric.number(tree, entries) for name, tree in euler.regular(1).items()}


def _refuse_singular(problem: Problem, euler: Euler, frame: int) -> None:
    """Raises NotDerivable where the angles fail in every configuration, as ZYZ does for arms in a plane."""
    det = rate_matrix(euler).det()
    for at in random_points(problem.symbols, 2):
        known = oracle_of(problem).at(at)
        if abs(numeric.scalar_number(det, _angles(problem, euler, frame, known))) > SMALL:
            return
    raise NotDerivable(
        "in every configuration of this arm these angles are singular (det E = 0): choose another convention",
        "convention",
    )


def _by_rates(found: ScalarMatrix, problem: Problem, euler: Euler, frame: int) -> Callable[[Point], Any]:
    """The lower half (3 by n) at the angles of the pose."""

    def route(at: Point) -> Any:
        known = oracle_of(problem).at(at)
        return numeric.matrix_numbers(found, {**known, **_angles(problem, euler, frame, known)})

    return route


def _by_angles(problem: Problem, euler: Euler, frame: int) -> Callable[[Point], Any]:
    """The same by differences of the angles themselves."""

    def route(at: Point) -> Any:
        known, columns = oracle_of(problem).at(at), []
        for name in problem.subject.variables:
            moved = [{**known, name: known[name] + h} for h in (STEP, -STEP)]
            ahead, behind = (_angles(problem, euler, frame, each) for each in moved)
            columns.append([math.remainder(ahead[n] - behind[n], math.tau) / (2 * STEP) for n in euler.names])
        return [list(row) for row in zip(*columns, strict=True)]

    return route
