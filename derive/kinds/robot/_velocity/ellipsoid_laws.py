"""The laws of the ellipsoids of velocity and force, each tried on numbers."""

from __future__ import annotations

from derive.algebra.normal import normal_matrix
from derive.algebra.readable.form import readable_matrix
from derive.derivation import Step
from derive.expression import ONE, Expr, Matrix, Power, Product, column, number, symbols, transpose

J, V, F, RATE = symbols("J v F q_dot")
CASE = Matrix(tuple(tuple(map(number, row)) for row in ((1, 2), (3, -1))))
UNIT = column((number("3/5"), number("4/5")))  # joint rates, and joint torques


def ellipsoid_laws(thin: bool) -> tuple[Step, Step]:
    """What velocities and forces obey for rates and torques of unit size; where there are fewer joints than
    velocities the ellipsoid of these is `thin`, and they are J q_dot."""
    gram, here = Product((J, transpose(J))), normal_matrix(CASE)
    pushed = here.T.adjugate() @ normal_matrix(UNIT)
    case: dict[Expr, Expr] = {
        J: CASE,
        RATE: UNIT,
        V: readable_matrix(here @ normal_matrix(UNIT)),
        F: readable_matrix(pushed.map(lambda entry: entry / here.det())),
    }
    velocities = (V, J * RATE) if thin else (Product((transpose(V), Power(gram, number(-1)), V)), ONE)
    return (
        Step("velocities-law", velocities, "law", instance=case),
        Step("forces-law", (Product((transpose(F), gram, F)), ONE), "law", instance=case),
    )
