"""The order of factors and terms: as the books write them, and the same wherever a formula stands."""

from __future__ import annotations

import os
import random
import subprocess
import sys
from pathlib import Path

import pytest

from derive.algebra.infix import text
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.readable.form import readable, readable_matrix
from derive.algebra.readable.terms import Style
from derive.expression import Expr, Product, Sum, rebuild
from tests.trees import formula

JOINTS = tuple(f"q{i}" for i in range(1, 7))
BOOKS = [
    # Spong, Hutchinson and Vidyasagar: two links, section 7.4
    "m1*l_c1**2 + m2*(l1**2 + l_c2**2 + 2*l1*l_c2*cos(q2)) + I1 + I2",
    "-m2*l1*l_c2*sin(q2)",
    "-m2*l1*l_c2*sin(q2)*(q1_dot + q2_dot)",
    "-l1*sin(q1) - l2*sin(q1 + q2)",
    "m2*g*l_c2*cos(q1 + q2)",
    "(m1*l_c1 + m2*l1)*g*cos(q1)",
    # the same: Stanford arm and spherical wrist, sections 3.2 and 3.3
    "cos(q4)*cos(q5)*cos(q6) - sin(q4)*sin(q6)",
    "sin(q4)*cos(q5)*cos(q6) + cos(q4)*sin(q6)",
    "-sin(q5)*cos(q6)",
    "cos(q1)*(cos(q2)*cos(q4)*sin(q5) + sin(q2)*cos(q5)) - sin(q1)*sin(q4)*sin(q5)",
    "d3*cos(q1)*sin(q2) - d2*sin(q1)",
    "d3*sin(q1)*sin(q2) + d2*cos(q1)",
    # Craig: the PUMA 560, section 3.7
    "cos(q1)*(a2*cos(q2) + a3*cos(q2 + q3) - d4*sin(q2 + q3)) - d3*sin(q1)",
    "sin(q1)*(a2*cos(q2) + a3*cos(q2 + q3) - d4*sin(q2 + q3)) + d3*cos(q1)",
    # SCARA
    "a1*cos(q1) + a2*cos(q1 + q2)",
    "d4 - d3",
    # what is unknown goes by its powers
    "x**2 + y**2 - l1**2 - l2**2",
    "m*s**2 + b*s + k",
    "t - 1/4",
    "m*l*theta_dot*sin(theta)*cos(theta)",
    "m*(l*theta_dot**2 + g*cos(theta))*sin(theta)",
    "(m1 + m2)*g*l1*sin(q1)",
]


@pytest.mark.parametrize("printed", BOOKS)
def test_the_order_of_the_books(printed: str) -> None:
    assert text(readable(normal(formula(printed)), Style(order=JOINTS))) == printed


def test_a_rotation_in_the_order_of_its_product() -> None:
    """Siciliano et al., section 2.4: roll, pitch and yaw."""
    style = Style(order=("phi", "theta", "psi"))
    row = (
        "cos(phi)*sin(theta)*sin(psi) - sin(phi)*cos(psi)",
        "sin(phi)*sin(theta)*sin(psi) + cos(phi)*cos(psi)",
    )
    assert [text(readable(normal(formula(entry)), style)) for entry in row] == list(row)


def shuffled(expr: Expr, seed: random.Random) -> Expr:
    """The same with terms and factors in another order."""
    expr = rebuild(expr, lambda part: shuffled(part, seed))
    match expr:
        case Sum(parts):
            return Sum(tuple(seed.sample(parts, len(parts))))
        case Product(parts):
            return Product(tuple(seed.sample(parts, len(parts))))
    return expr


@pytest.mark.parametrize("seed", range(20))
def test_the_order_does_not_depend_on_where_or_how_it_was_typed(seed: int) -> None:
    """Alone, among other entries, and typed in any order: one way of writing a value."""
    drawn = random.Random(seed)
    typed = [formula(each) for each in drawn.sample(BOOKS, 4)]
    style = Style(order=JOINTS)
    together = ScalarMatrix.column([normal(shuffled(each, drawn)) for each in typed])
    alone = [readable(normal(each), style) for each in typed]
    assert [row[0] for row in readable_matrix(together, style).rows] == alone


WRITTEN = """
from derive.algebra.infix import text
from derive.algebra.normal import normal
from derive.algebra.readable.form import readable
from tests.algebra.test_order import BOOKS
from tests.trees import formula
print([text(readable(normal(formula(each)))) for each in BOOKS])
"""


def test_the_order_does_not_depend_on_the_hashes_of_a_run() -> None:
    runs = [
        subprocess.run(
            [sys.executable, "-c", WRITTEN],
            env={**os.environ, "PYTHONHASHSEED": seed},
            cwd=Path(__file__).parents[2],
            capture_output=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    ]
    assert runs[0] == runs[1]
