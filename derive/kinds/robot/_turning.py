"""The law of a turn, told of the joints of an arm: what a point of a body is moved at."""

from __future__ import annotations

from collections.abc import Collection

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.readable.form import readable_matrix
from derive.derivation import Step
from derive.expression import ONE, ZERO, Expr, Symbol, column, cos, cross, sin, symbols
from derive.names import free


def turning_law(taken: Collection[str]) -> Step:
    """p_dot = z x (p - o) of a turn about z through o, tried on a point that goes round in a circle."""
    rate, z, p, o = symbols("p_dot z p o")
    angle, x, y, r, high = (Symbol(free(taken, f"zeta_{k}")) for k in range(1, 6))
    along = column((x + r * cos(angle), y + r * sin(angle), high))
    moved: ScalarMatrix = normal_matrix(along).diff(angle.name)
    case: dict[Expr, Expr] = {
        z: column((ZERO, ZERO, ONE)),
        o: column((x, y, ZERO)),
        p: along,
        rate: readable_matrix(moved),
    }
    return Step("turning-law", (rate, cross(z, p - o)), "law", instance=case)
