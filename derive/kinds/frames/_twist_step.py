"""A twist in another frame: the adjoint of the pose between the frames."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import number
from derive.derivation import Step
from derive.expression import ZERO, Expr, Indexed, Matrix, Product, Symbol, column
from derive.kinds.frames._frames import origin_name, rotation_name
from derive.kinds.problem import Problem
from derive.mechanics.elementary import skew

NO_BLOCK = Symbol("0_3x3")
NOTHING = Matrix(((ZERO,) * 3,) * 3)


def twist_step(
    given: tuple[Expr, ...], source: int, target: int, R: Matrix, o: Matrix, problem: Problem
) -> tuple[tuple[Step, ...], dict[Expr, Expr]]:
    """S(o), and V^0 = [[R, S(o) R], [0, R]] V^1 (Lynch and Park, section 3.3.2; linear part first)."""
    V, before = Symbol(f"V^{target}"), Symbol(f"V^{source}")
    R_name, o_name = rotation_name(source, target), origin_name(source, target)
    S_name = Indexed("S", (o_name,))
    (x,), (y,), (z,) = o.rows
    S = skew((x, y, z))
    adjoint = Matrix(((R_name, Product((S_name, R_name))), (NO_BLOCK, R_name)))
    filled: dict[Expr, Expr] = {R_name: R, S_name: S, NO_BLOCK: NOTHING}
    numbers_in = Product((problem.readable_matrix(normal_matrix(adjoint, filled)), column(given)))
    value = problem.readable_matrix(normal_matrix(numbers_in))
    exact = problem.final(value)
    last = () if exact == value else (exact,)
    chain = (V, Product((adjoint, before)), numbers_in, value, *last)
    definitions: dict[Expr, Expr] = {**filled, o_name: o, before: column(given), V: value}
    steps = (Step("S_o", (S_name, S), "skew"), Step(V.name, chain, "change-of-frame"))
    return steps, definitions


def moved(T: Any, twist: tuple[Expr, ...], point: Mapping[str, float]) -> Any:
    """The second route: [V^0] = T [V^1] T^-1, in NumPy."""
    import numpy as np

    v1, v2, v3, x, y, z = (number(part, point) for part in twist)
    bracket = np.array([[0, -z, y, v1], [z, 0, -x, v2], [-y, x, 0, v3], [0, 0, 0, 0]])
    B = T @ bracket @ np.linalg.inv(T)
    return np.array([*B[:3, 3], B[2, 1], B[0, 2], B[1, 0]])
