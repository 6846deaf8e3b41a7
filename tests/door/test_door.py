"""The Python door: sheets, subjects and answers from a program; its code is run by NumPy, Octave and gcc."""

from __future__ import annotations

import subprocess
import sys
from ctypes import CDLL, c_double
from pathlib import Path

import numpy as np
import pytest
import sympy

import derive

EXERCISES = Path(__file__).parents[2] / "exercises"
LINKS = [
    {"theta": "theta1*", "d": 0, "a": "l1", "alpha": 0},
    {"theta": "theta2*", "d": 0, "a": "l2", "alpha": 0},
]
AT = {"l1": 0.7, "l2": 0.4, "theta1": 0.3, "theta2": 1.1}


@pytest.fixture(scope="module")
def arm() -> derive.Subject:
    found: derive.Subject = derive.robot(links=LINKS, symbols={"l1": "positive", "l2": "positive"})
    return found


def expected() -> np.ndarray:
    """Of the two links by complex numbers: the derivative of l1 e^(i theta1) + l2 e^(i theta12)."""
    outer = AT["l2"] * np.exp(1j * (AT["theta1"] + AT["theta2"])) * 1j
    inner = AT["l1"] * np.exp(1j * AT["theta1"]) * 1j
    both = [inner + outer, outer]
    return np.array([[each.real for each in both], [each.imag for each in both]])


def test_results_are_objects_of_sympy_with_the_assumptions_of_the_sheet(arm: derive.Subject) -> None:
    J = arm.jacobian(rows=["vx", "vy"]).results["J"]
    l1, theta1 = sympy.Symbol("l1", real=True, positive=True), sympy.Symbol("theta1", real=True)
    assert {l1, theta1} <= J.free_symbols
    found = np.array(J.subs({each: AT[each.name] for each in J.free_symbols}), float)
    assert np.allclose(found, expected(), atol=1e-12)
    assert sympy.sqrt(l1**2) == l1


def test_numbers_are_arrays_and_claims_and_steps_are_data(arm: derive.Subject) -> None:
    answer = arm.jacobian(rows=["vx", "vy"], evaluate=AT)
    assert np.allclose(answer.evaluated["J"], expected(), atol=1e-12)
    assert all(claim.holds for claim in answer.claims)
    assert {claim.truth for claim in answer.claims} >= {"step", "law", "number"}
    assert any("c_{12}" in step.latex for step in answer.steps)


def test_an_answer_shows_its_page(arm: derive.Subject) -> None:
    answer = arm.jacobian()
    assert "#### Solution" in answer._repr_markdown_()
    assert answer._repr_html_().startswith("<iframe") and "&lt;math" in answer._repr_html_()
    assert answer._repr_latex_().startswith(r"$\displaystyle")
    assert repr(answer) == "<answer to jacobian: J>"


def test_sheets_are_read_from_files_and_texts() -> None:
    sheet = derive.load(EXERCISES / "week3.yaml")
    answer = sheet.problems[0].questions[1].answer
    assert answer.results["T_6^0"].shape == (4, 4)
    text = (EXERCISES / "week3.yaml").read_text(encoding="utf-8")
    again = derive.loads(text, EXERCISES / "week3.yaml").problems[0].questions[1].answer
    assert again.results == answer.results


def test_all_faults_come_at_once_with_their_places(arm: derive.Subject) -> None:
    with pytest.raises(derive.DeriveError) as caught:
        derive.loads(
            "title: x\nproblems:\n- robot: {links: [{theta: q*, d: 0, a: 1, alpa: 0}]}\n  find: jacobien\n"
        )
    assert len(caught.value.errors) == 2
    assert "did you mean" in str(caught.value) and "sheet.yaml:3" in str(caught.value)
    with pytest.raises(derive.DeriveError, match="rows"):
        arm.jacobian(rowz=["vx"])
    with pytest.raises(AttributeError, match="jacobian"):
        arm.jacobien  # noqa: B018


def test_importing_derive_imports_nothing_else() -> None:
    code = "import sys, derive; print([n for n in sys.modules if n.startswith(('derive.', 'sympy'))])"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


# -- code ---------------------------------------------------------------------------------------------


def test_python_code_runs(arm: derive.Subject) -> None:
    scope: dict[str, object] = {}
    exec(arm.jacobian(rows=["vx", "vy"]).code("python"), scope)
    found = scope["J"](**AT)  # type: ignore[operator]
    assert np.allclose(found, expected(), atol=1e-12)


def test_solutions_bring_the_arm_there(arm: derive.Subject) -> None:
    scope: dict[str, object] = {}
    exec(arm.inverse_kinematics(given=["x", "y"]).code("python"), scope)
    for name in ("solutions_1", "solutions_2"):
        theta1, theta2 = scope[name](0.7, 0.4, 0.6, 0.5).ravel()  # type: ignore[operator]
        place = 0.7 * np.exp(1j * theta1) + 0.4 * np.exp(1j * (theta1 + theta2))
        assert abs(place - (0.6 + 0.5j)) < 1e-12


def test_octave_code_runs(arm: derive.Subject, tmp_path: Path) -> None:
    script = arm.jacobian(rows=["vx", "vy"]).code("matlab") + "\nprintf('%.15g ', J(0.7, 0.4, 0.3, 1.1)');\n"
    (tmp_path / "run.m").write_text(script, encoding="utf-8")
    run = subprocess.run(
        ["octave-cli", "--no-init-file", "run.m"], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert np.allclose(np.array(run.stdout.split(), float).reshape(2, 2), expected(), atol=1e-12)


def test_c_code_compiles_and_runs(arm: derive.Subject, tmp_path: Path) -> None:
    (tmp_path / "j.c").write_text(arm.jacobian(rows=["vx", "vy"]).code("c"), encoding="utf-8")
    command = ["gcc", "-std=c99", "-Wall", "-Werror", "-shared", "-fPIC", "j.c", "-o", "j.so", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    result = ((c_double * 2) * 2)()
    CDLL(str(tmp_path / "j.so")).J(*map(c_double, (0.7, 0.4, 0.3, 1.1)), result)
    assert np.allclose([list(row) for row in result], expected(), atol=1e-12)


def test_what_is_no_formula_has_no_code() -> None:
    answer = derive.mechanism(space="planar", bodies=4, joints=[{"revolute": 4}]).mobility()
    assert answer.results["dof"] == 1
    with pytest.raises(ValueError, match="fortran"):
        answer.code("fortran")
