"""The exponential of a twist written out, tried on a turn that is made of moves."""

from __future__ import annotations

from collections.abc import Collection

from derive.algebra.readable.form import readable_matrix
from derive.derivation import Step
from derive.expression import (
    ONE,
    ZERO,
    Call,
    Expr,
    Indexed,
    Matrix,
    Symbol,
    add,
    column,
    multiply,
    number,
    symbols,
)
from derive.mechanics.motion import Axis, Move
from derive.mechanics.poses import composed, rotation_part
from derive.names import free

AXES: tuple[Axis, ...] = ("x", "y", "z")
PLACE = tuple(map(number, (2, -1, 3)))
PITCH = number(5)


def exponential_law(taken: Collection[str], helical: bool) -> Step:
    """e^{[S] theta} of a turn through q, which advances by h for each radian where it is `helical`."""
    R, I, q, theta, omega, h = symbols("R I q theta omega h")
    angle = Symbol(free(taken, "zeta_1"))
    way, turn = tuple(zip(AXES, PLACE, strict=True)), Move("rotate", "z", angle)
    there = [Move("translate", axis, by) for axis, by in way]
    back = [Move("translate", axis, -by) for axis, by in reversed(way)]
    advance = [Move("translate", "z", PITCH * angle)] if helical else []
    exponential = Indexed("e", (), (multiply(Call("bracket", (Symbol("S"),)), theta),))
    along = (multiply(h, theta, omega),) if helical else ()
    written = Matrix(((R, add(multiply(add(I, -R), q), *along)), (Symbol("0"), ONE)))
    case: dict[Expr, Expr] = {
        exponential: readable_matrix(composed((*there, turn, *advance, *back))),
        R: readable_matrix(rotation_part(composed((turn,)))),
        I: Matrix(tuple(tuple(number(i == k) for k in range(3)) for i in range(3))),
        q: column(PLACE),
        omega: column((ZERO, ZERO, ONE)),
        h: PITCH,
        theta: angle,
        Symbol("0"): Matrix(((ZERO, ZERO, ZERO),)),
    }
    return Step("exponential-law", (exponential, written), "law", instance=case)
