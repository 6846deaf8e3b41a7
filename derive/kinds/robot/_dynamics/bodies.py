"""The bodies of an arm ready for its energies: where each com is, how it moves, what it weighs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Matrix, Symbol
from derive.kinds.problem import Problem
from derive.mechanics.bodies import Body, Moments, PointMass
from derive.mechanics.chain import Chain
from derive.mechanics.dynamics import LinkMotion
from derive.mechanics.jacobian import MovingPoint, drift
from derive.mechanics.moments import moments
from derive.mechanics.poses import position_part, rotation_part
from derive.names import free

ELEMENTS = ("xx", "yy", "zz", "xy", "yz", "xz")


@dataclass(frozen=True, slots=True)
class Weighted:
    """Link i and its body. `moments` are Ixx, Iyy, Izz, Ixy, Iyz, Ixz as written while working, and
    `named` what their names stand for; `com` is in the link's frame."""

    i: int
    body: Body
    com: ScalarMatrix
    moments: tuple[Expr, ...]
    named: dict[Expr, Expr]
    motion: LinkMotion
    at: MovingPoint  # the com
    I: Symbol  # the name of the inertia matrix about the com

    @property
    def matrix(self) -> Matrix:
        """The inertia matrix in the names used while working."""
        xx, yy, zz, xy, yz, xz = self.moments
        return Matrix(((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)))

    @property
    def turns(self) -> bool:
        """Whether its rotation stores energy."""
        return any(moment != ZERO for moment in self.moments)


def inertias(bodies: Sequence[Weighted]) -> Symbol:
    """What their matrices of inertia are called, whichever is meant: I_ci."""
    return Symbol(bodies[0].I.name.rstrip("0123456789") + "i")


def weighted(problem: Problem, found: Chain) -> tuple[Weighted, ...]:
    """Every link with a body. Raises NotDerivable where no link has one."""
    carried = [(i, link.body) for i, link in enumerate(problem.subject.links, 1) if link.body]
    if not carried:
        raise NotDerivable("no link has a mass; give each link `mass`, `com` and `inertia`")
    if any(joint.pitch for _, joint in found.moving):
        raise NotDerivable("the dynamics of a helical joint is not derived; only its kinematics is")
    alike = len({(body.mass, body.inertia) for _, body in carried}) == 1
    letter = free(problem.taken, "I_c", "I_C", "I_", indices=[str(i) for i, _ in carried])
    return tuple(_weighted(problem, found, i, body, "" if alike else str(i), letter) for i, body in carried)


def _weighted(problem: Problem, found: Chain, i: int, body: Body, index: str, letter: str) -> Weighted:
    written, named = _moments(problem, body, index)
    com = com_in_link(found, i, body)
    T = found.T[i]
    position = position_part(T) + rotation_part(T) @ com
    at = MovingPoint(position, i, drift(found, rotation_part(T), com))
    J = at.jacobian(found)
    inertia = ScalarMatrix.of([normal(written[k]) for k in row] for row in ((0, 3, 5), (3, 1, 4), (5, 4, 2)))
    mass = normal(body.mass)
    home = J.ring.with_symbols(name.name for name in named if isinstance(name, Symbol))
    for ring in (T.ring, position.ring, inertia.ring, mass.ring):
        home = home.union(ring)
    J, R = J.into(home), rotation_part(T).into(home)
    motion = LinkMotion(
        mass.into(home),
        position.into(home),
        J.block(slice(0, 3), slice(None)),
        J.block(slice(3, 6), slice(None)),
        R,
        inertia.into(home),
    )
    return Weighted(i, body, com, written, named, motion, at, Symbol(f"{letter}{i}"))


def _moments(problem: Problem, body: Body, index: str) -> tuple[tuple[Expr, ...], dict[Expr, Expr]]:
    """A shape's moments go by names (I_xx, I_xx1) while working; given ones stand as given."""
    values = moments(body)
    if body.about == "origin":
        return tuple(problem.readable(normal(value)) for value in values), {}
    if isinstance(body.inertia, Moments | PointMass):
        return values, {}
    named: dict[Expr, Expr] = {}
    written = []
    for element, value in zip(ELEMENTS, values, strict=True):
        name = Symbol(f"I_{element}{index}")
        written.append(ZERO if value == ZERO else name)
        if value != ZERO:
            named[name] = value
    return tuple(written), named


def com_in_link(found: Chain, i: int, body: Body) -> ScalarMatrix:
    """In the link's frame (3 by 1); "center" is half way to the origin of the frame before."""
    if body.com != "center":
        return ScalarMatrix.column([normal(part) for part in body.com])
    T = found.T_local[i - 1]
    back = -(rotation_part(T).T @ position_part(T))
    return back.map(lambda entry: entry * Scalar.of(Fraction(1, 2)))
