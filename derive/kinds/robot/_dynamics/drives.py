"""The motors and the friction of an arm's joints, as its dynamics needs them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.derivation import PageFacts, Phrase, Said
from derive.expression import ZERO, Expr, Matrix, Symbol
from derive.mechanics.joint_loads import reflected, resistance
from derive.mechanics.robot import Link, Robot

ROTORS = Symbol("D_m")
EFFORTS = {  # of a joint, and of one with a gear
    "revolute": ("torque", "torque-at"),
    "prismatic": ("force", "force-at"),
    "": ("effort", "effort-at"),
}


class Facts(PageFacts):
    """What the words need to know of equations of motion, in either notation."""

    big: bool
    notation: str
    friction: bool = False  # in the notation of Khatib
    rubbing: Phrase | None = None  # in that of Spong
    effort: Phrase | None = None  # what tau_k is, in that of Spong


def moving(robot: Robot) -> tuple[Link, ...]:
    """The rows with a joint."""
    return tuple(link for link in robot.links if link.variable)


def diagonal(values: Iterable[Expr]) -> Matrix:
    """The matrix that has these on its diagonal (n by n)."""
    entries = tuple(values)
    n = range(len(entries))
    return Matrix(tuple(tuple(entries[i] if i == j else ZERO for j in n) for i in n))


def rotors(robot: Robot) -> Matrix | None:
    """What the rotors add to D: G^2 J on its diagonal; None without motors."""
    values = [reflected(link.motor) for link in moving(robot)]
    return diagonal(values) if any(value != ZERO for value in values) else None


def with_rotors(D: ScalarMatrix, robot: Robot) -> ScalarMatrix:
    """D of the links with the rotors added."""
    matrix = rotors(robot)
    return D if matrix is None else D + normal_matrix(matrix)


def friction_terms(robot: Robot) -> tuple[tuple[Expr, ...], ...]:
    """The terms of friction of each joint, in the order of the joints."""
    return tuple(resistance(link.friction, link.variable or "") for link in moving(robot))


def friction_sorts(robot: Robot) -> tuple[bool, bool]:
    """Whether there is viscous and whether there is Coulomb friction."""
    known = [link.friction for link in moving(robot) if link.friction]
    return any(each.viscous != ZERO for each in known), any(each.coulomb != ZERO for each in known)


def friction_told(viscous: bool, coulomb: bool) -> Phrase | None:
    """What joints rub by, in the letters of the law."""
    about: dict[str, Said] = {"viscous": Symbol("f_vk"), "coulomb": Symbol("tau_ck")}
    if viscous and coulomb:
        return Phrase("both-frictions", about)
    return Phrase("viscous", about) if viscous else Phrase("coulomb", about) if coulomb else None


def effort_told(robot: Robot) -> Phrase:
    """What drives a joint: a torque where all of them turn, a force where all slide; with motors, at the
    joint."""
    joints = {link.joint for link in moving(robot)}
    alone, at = EFFORTS[joints.pop() if len(joints) == 1 else ""]
    return Phrase(at if rotors(robot) else alone, {"k": Symbol("k")})


def rigid(robot: Robot) -> Robot:
    """The same arm without friction: what the equations of Euler and Lagrange describe."""
    return replace(robot, links=tuple(replace(link, friction=None) for link in robot.links))
