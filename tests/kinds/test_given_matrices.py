"""Matrices without their arms, against published terms and determinants, SymPy and NumPy."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy

from derive.errors import SheetErrors
from tests.sheets import pages

PLANAR = "[[a1 + 2*a2*cos(q2), a3 + a2*cos(q2)], [a3 + a2*cos(q2), a3]]"
SPATIAL = """[[a1 + a2*sin(q2)^2 + 2*a4*sin(q2)*sin(q2 + q3), 0, 0],
             [0, b1 + 2*b2*cos(q3), b3 + b2*cos(q3)], [0, b3 + b2*cos(q3), b3]]"""


def asked(find: str, value: str, variables: str, folder: Path) -> dict[str, Any]:
    """The results of the one question of a sheet."""
    sheet = folder / "sheet.yaml"
    lines = ("title: A matrix", "problems:", f"- matrix: {{value: {value}, variables: {variables}}}")
    sheet.write_text("\n".join((*lines, f"  find: {find}")) + "\n", encoding="utf-8")
    (page,) = pages(sheet, folder / "out", "json")
    found: dict[str, Any] = json.loads(page.read_text())["problems"][0]["questions"][0]["results"]
    return found


def terms(C: list[list[str]], names: str) -> list[sympy.Expr]:
    """C qdot."""
    rates = sympy.Matrix(sympy.symbols([f"{name}_dot" for name in names.split()]))
    return [*(sympy.Matrix(C) * rates)]


def test_a_planar_arm_has_these_terms(tmp_path: Path) -> None:
    """De Luca, Robotics 2: c_1 = -a_2 s_2 (qdot_2^2 + 2 qdot_1 qdot_2), c_2 = a_2 s_2 qdot_1^2."""
    found = asked("properties", PLANAR, "[q1, q2]", tmp_path)
    a2, q2, u, v = sympy.symbols("a2 q2 q1_dot q2_dot")
    published = [-a2 * sympy.sin(q2) * (v**2 + 2 * u * v), a2 * sympy.sin(q2) * u**2]
    ours = terms(found["C"], "q1 q2")
    assert all(sympy.expand(one - other) == 0 for one, other in zip(ours, published, strict=True))
    assert found["parameters"] == ["a1", "a2", "a3"]


def test_christoffel_symbols_of_three_joints_by_sympy(tmp_path: Path) -> None:
    found = asked("christoffel", SPATIAL.replace("\n", " "), "[q1, q2, q3]", tmp_path)
    q = sympy.symbols("q1 q2 q3")
    D = sympy.Matrix(sympy.sympify(SPATIAL.replace("^", "**")))
    assert len(found) == 27
    for i, j, k in ((i, j, k) for i in range(3) for j in range(3) for k in range(3)):
        theirs = (D[k, j].diff(q[i]) + D[k, i].diff(q[j]) - D[i, j].diff(q[k])) / 2
        gap = sympy.sympify(found[f"c_{i + 1}{j + 1}{k + 1}"]) - theirs
        assert sympy.expand(gap, trig=True).rewrite(sympy.exp).expand() == 0


@pytest.mark.parametrize(
    ("value", "count"),
    [
        (
            "[[I1 + m2*(l^2 + d^2 + 2*l*d*cos(q2)), m2*d*(d + l*cos(q2))], [m2*d*(d + l*cos(q2)), m2*d^2]]",
            3,
        ),
        ("[[m + sqrt(2)*m*cos(q2), b], [b, 3*m]]", 2),  # sqrt(2) m is no constant of its own
        ("[[I/r^2 + m*cos(q2)/r, b], [b, 2*I/r^2]]", 3),
        ("[[3 + cos(q2), 1], [1, 2]]", 0),
    ],
)
def test_as_few_constants_as_will_do(value: str, count: int, tmp_path: Path) -> None:
    found = asked("properties", value, "[q1, q2]", tmp_path)
    assert len(found.get("parameters", ())) == count


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ("[[5 + 4*cos(q2), 2 + 2*cos(q2)], [2 + 2*cos(q2), 1]]", "= -7$ where $q_2 = 0$, so $D$ is not"),
        ("[[-3 + cos(q2), 1], [1, 2]]", "is negative, so $D$ is not positive definite"),
        ("[[1, 1], [1, 1]]", "vanishes, so $D$ is not"),
        ("[[3 + cos(q2), 1], [1, 2]]", "All of them are positive, so $D$ is positive definite"),
        ("[[I1 + m2*q2^2, 0], [0, m2]]", "Masses and moments of inertia are positive"),
        (PLANAR, "just where $a_3 > 0$ and $a_1 a_3 - a_2^2 - a_3^2 > 0$"),
        ("[[a + b*cos(q2), 0], [0, c]]", "configuration just where $c > 0$, "),
        ("[[a + b*sin(q2), 0], [0, c]]", "positive definite where"),
    ],
)
def test_whether_it_is_positive_definite(value: str, said: str, tmp_path: Path) -> None:
    sheet = tmp_path / "sheet.yaml"
    text = f"title: A\nproblems:\n- matrix: {{value: {value}, variables: [q1, q2]}}\n  find: properties\n"
    sheet.write_text(text, encoding="utf-8")
    (page,) = pages(sheet, tmp_path / "out", "md")
    assert said in page.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("value", "variables", "said"),
    [
        ("[[q1, q2, 1], [q2, q1, 1]]", "[q1, q2]", "is square, and this one is 2 by 3"),
        ("[[1, cos(q2)], [sin(q2), 1]]", "[q1, q2]", "the entries 1, 2 and 2, 1 differ"),
        ("[[1, cos(q2)], [cos(q2), 1]]", "[q2]", "of 2 rows has 2 joint variables"),
    ],
)
def test_what_is_no_inertia_matrix(value: str, variables: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as fault:
        asked("christoffel", value, variables, tmp_path)
    assert said in str(fault.value.errors[0])


REACH, FALL = "(a2*cos(q2) + a3*cos(q2 + q3))", "(a2*sin(q2) + a3*sin(q2 + q3))"
ELBOW = f"""[[-sin(q1)*{REACH}, -cos(q1)*{FALL}, -a3*cos(q1)*sin(q2 + q3)],
            [cos(q1)*{REACH}, -sin(q1)*{FALL}, -a3*sin(q1)*sin(q2 + q3)], [0, {REACH}, a3*cos(q2 + q3)]]"""
UPPER = "[[sin(q1), 1, 1, 1], [0, sin(q2), 1, 1], [0, 0, sin(q3), 1], [0, 0, 0, sin(q4)]]"


def test_an_arm_with_an_elbow_loses_rank_here(tmp_path: Path) -> None:
    """Siciliano et al., section 3.3.2: det J = -a_2 a_3 s_3 (a_2 c_2 + a_3 c_23)."""
    found = asked("singularities", ELBOW.replace("\n", " "), "[q1, q2, q3]", tmp_path)
    published = sympy.sympify("-a2*a3*sin(q3)*(a2*cos(q2) + a3*cos(q2 + q3))")
    assert sympy.expand(sympy.sympify(found["det"]) - published, trig=True) == 0
    assert found["complete"] is True
    assert [each["rank"] for each in found["solutions"]] == [2, 2, 2, 2, 1]


@pytest.mark.parametrize(
    ("value", "variables", "count"),
    [
        ("[[cos(q1), -sin(q1)], [sin(q1), cos(q1)]]", "[q1]", 0),
        ("[[-q2*sin(q1), cos(q1)], [q2*cos(q1), sin(q1)]]", "[q1, q2]", 1),
        ("[[1, cos(q2) + 25, cos(q2)], [0, sin(q2), sin(q2)]]", "[q2]", 2),
        (UPPER, "[q1, q2, q3, q4]", None),
    ],
)
def test_sets_of_a_matrix_have_the_ranks_that_are_told(
    value: str, variables: str, count: int | None, tmp_path: Path
) -> None:
    """By NumPy, in configurations of each set that is told by its values."""
    found = asked("singularities", value, variables, tmp_path)
    assert count is None or len(found["solutions"]) == count
    J = sympy.Matrix(sympy.sympify(value))
    for each in found["solutions"]:
        names = [name for name in variables.strip("[]").split(", ") if name in each]
        if names:
            there = J.subs({name: sympy.sympify(each[name]) for name in names})
            some = np.array(there.subs(dict.fromkeys(there.free_symbols, 0.7)), dtype=float)
            assert np.linalg.matrix_rank(some, tol=1e-9) == each["rank"]


@pytest.mark.parametrize(
    ("value", "variables", "said"),
    [
        ("[[1, 2], [3, 4]]", "[]", "list the names that vary"),
        ("[[q1, 2*q1], [q2, 2*q2]]", "[q1, q2]", "never has full rank"),
        ("[[1/q1, q2], [1, q1]]", "[q1, q2]", "below a fraction"),
        ("[[exp(q1), q2], [1, q1]]", "[q1, q2]", "in another function"),
        ("[[cos(q1), q2], [1, q1]]", "[q1, q2]", "q1 stands both"),
    ],
)
def test_singular_sets_that_are_not_sought(value: str, variables: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as fault:
        asked("singularities", value, variables, tmp_path)
    assert said in str(fault.value.errors[0])
