"""A twist in another frame: the adjoint of the pose between the frames."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from derive.algebra.numbers.floats import number
from derive.derivation import Step
from derive.expression import ZERO, Expr, Indexed, Matrix, Symbol
from derive.kinds.work import Work
from derive.mechanics.elementary import skew

NO_BLOCK = Symbol("0_3x3")
NOTHING = Matrix(((ZERO,) * 3,) * 3)


def twist_lines(work: Work, V: Symbol, before: Symbol, R: Symbol, o: Symbol) -> Work:
    """S(o), and V^0 = [[R, S(o) R], [0, R]] V^1 (Lynch and Park, section 3.3.2; linear part first)."""
    S_name = Indexed("S", (o,))
    (x,), (y,), (z,) = work.matrix(o).rows
    S = skew((x, y, z))
    work = work.knowing({S_name: S, NO_BLOCK: NOTHING})
    work = work.showing(Step("S_o", (S_name, S), "skew"))
    adjoint = Matrix(((R, S_name * R), (NO_BLOCK, R)))
    written = work.readable(work.value(adjoint)) * work[before]
    return work.line(V, adjoint * before, written, rule="change-of-frame").closed(V)


def moved(T: Any, twist: tuple[Expr, ...], point: Mapping[str, float]) -> Any:
    """The second route: [V^0] = T [V^1] T^-1, in NumPy."""
    import numpy as np

    v1, v2, v3, x, y, z = (number(part, point) for part in twist)
    bracket = np.array([[0, -z, y, v1], [z, 0, -x, v2], [-y, x, 0, v3], [0, 0, 0, 0]])
    B = T @ bracket @ np.linalg.inv(T)
    return np.array([*B[:3, 3], B[2, 1], B[0, 2], B[1, 0]])
