"""From the place of each centre of mass to its Jacobian and its inertia, as steps."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.algebra.infix import text
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.readable.operation_count import operations
from derive.derivation import Phrase, Said, Step
from derive.expression import Expr, Matrix, Symbol, add, transpose
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import pose_name
from derive.kinds.robot._columns import jacobian_steps
from derive.kinds.robot._dynamics.bodies import Weighted
from derive.mechanics.chain import Chain
from derive.mechanics.moments import given_moments, steiner
from derive.mechanics.poses import homogeneous, position_part


def com_step(problem: Problem, body: Weighted) -> Step:
    """o_c1 (3 by 1), from the origin of the frame of its link."""
    name, origin = Symbol(f"o_c{body.i}"), Symbol(f"o_{body.i}")
    shift = problem.readable_matrix(body.com)
    route = add(origin, Symbol(f"R_{body.i}^0") * shift) if any(body.com.entries) else origin
    return Step(name.name, (name, route, problem.readable_matrix(body.motion.com)), "center-of-mass")


def centers_told(bodies: Sequence[Weighted]) -> Phrase:
    """That centers of mass are given in frames, or are the origins of these."""
    about: dict[str, Said] = {name[0]: Symbol(name) for name in ("R_i^0", "o_i", "T_i^0")}
    if any(any(body.com.entries) for body in bodies):
        return Phrase("centers" if len(bodies) > 1 else "center", about)
    del about["R"]
    return Phrase("centers-at-origins" if len(bodies) > 1 else "center-at-origin", about)


def com_jacobian_steps(problem: Problem, found: Chain, body: Weighted) -> tuple[Step, ...]:
    """J_c1 (6 by n) in the names of its vectors and written out."""
    i = body.i
    return jacobian_steps(problem, found, body.at, Symbol(f"J_c{i}"), Symbol(f"o_c{i}"))


def local_steps(problem: Problem, bodies: tuple[Weighted, ...]) -> Iterator[Step]:
    """J_v and J_w (3 by n) of each com in the frame of its own link.

    There they hold only the angles between joint and link, so that their entries stay short where those of
    D would fill pages; D, its derivatives and g are sums over them.
    """
    for body in bodies:
        for part, J in (("v", body.motion.J_v), ("w", body.motion.J_w)):
            name = Symbol(f"J_{part}{body.i}^{body.i}")
            route = transpose(Symbol(f"R_{body.i}^0")) * Symbol(f"J_{part}{body.i}")
            local = problem.readable_matrix(body.motion.R.T @ J)
            yield Step(name.name, (name, route, local), "local-jacobian")


def inertia_steps(problem: Problem, bodies: tuple[Weighted, ...]) -> tuple[Step, ...]:
    """I_1 from the inertia about an origin, I_1 = I_2 about the com in the link's frame, equal ones once;
    then what the names of a shape's moments stand for."""
    alike: dict[Matrix, list[Symbol]] = {}
    for body in bodies:
        if body.turns and body.body.about == "com":
            alike.setdefault(body.matrix, []).append(body.I)
    matrices = [Step(names[0].name, (*names, matrix), "inertia") for matrix, names in alike.items()]
    values = {name: value for body in bodies for name, value in body.named.items()}
    equal: dict[Expr, list[Expr]] = {}
    for name, value in values.items():
        equal.setdefault(value, []).append(name)
    named = [_moment(problem, names, value) for value, names in equal.items()]
    return (*_moved(problem, bodies), *matrices, *named)


def _moved(problem: Problem, bodies: tuple[Weighted, ...]) -> Iterator[Step]:
    """I_1 from the inertia about the origin of the frame, by the theorem of parallel axes."""
    for body in bodies:
        if body.body.about == "origin" and body.turns:
            shift = tuple(problem.readable(normal(part)) for part in steiner(body.body))
            route = _square(given_moments(body.body)) + -_square(shift)
            yield Step(body.I.name, (body.I, route, body.matrix), "parallel-axes")


def _square(six: tuple[Expr, ...]) -> Matrix:
    xx, yy, zz, xy, yz, xz = six
    return Matrix(((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)))


def _moment(problem: Problem, names: list[Expr], value: Expr) -> Step:
    """I_yy = I_zz = m/12 (L^2 + (L/10)^2) = 101 m L^2/1200: as the tables have it, then multiplied out where
    that is shorter."""
    short, name = problem.readable(normal(value)), names[0]
    shorter = (short,) if operations(short) < operations(value) else ()
    return Step(text(name), (*names, value, *shorter), "moment")


def body_definitions(problem: Problem, body: Weighted) -> dict[Expr, Expr]:
    """What the names in D_i stand for."""
    i, motion = body.i, body.motion
    return {
        Symbol(f"J_v{i}"): problem.readable_matrix(motion.J_v),
        Symbol(f"J_w{i}"): problem.readable_matrix(motion.J_w),
        Symbol(f"R_{i}^0"): problem.readable_matrix(motion.R),
        body.I: body.matrix,
        Symbol(f"o_c{i}"): problem.readable_matrix(motion.com),
    }


def pose_definitions(problem: Problem, found: Chain, body: Weighted) -> dict[Expr, Expr]:
    """What the names on the way to the com and to its Jacobian stand for; that of its pose is for who has
    called it so."""
    pose = homogeneous(body.motion.R, body.motion.com.entries)
    J = ScalarMatrix.stacked([body.motion.J_v, body.motion.J_w])
    return {
        pose_name(body.i): problem.readable_matrix(found.T[body.i]),
        Symbol(f"o_{body.i}"): problem.readable_matrix(position_part(found.T[body.i])),
        Symbol(f"T_c{body.i}"): problem.readable_matrix(pose),
        Symbol(f"J_c{body.i}"): problem.readable_matrix(J),
    }
