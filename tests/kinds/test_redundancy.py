"""Rates of redundant arms against published numbers, NumPy and SciPy."""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import linprog, lsq_linear, minimize

from derive.errors import SheetErrors
from tests.sheets import pages


def asked(matrix: Any, folder: Path, **options: Any) -> dict[str, Any]:
    """The results for a matrix that is given, in floats."""
    question = {"find": "redundancy", **options}
    lines = json.dumps({"title": "A matrix", "problems": [{"matrix": {"value": matrix}, **question}]})
    sheet = folder / "sheet.yaml"
    sheet.write_text(lines, encoding="utf-8")
    (page,) = pages(sheet, folder / "out", "json")
    found = json.loads(page.read_text())["problems"][0]["questions"][0]["results"]
    return {name: numbers(value) for name, value in found.items()}


def numbers(told: Any) -> Any:
    if isinstance(told, str):
        top, _, bottom = told.partition("/")
        return float(top) / float(bottom or 1)
    return np.array([numbers(each) for each in told])


def drawn(seed: int, m: int, n: int) -> tuple[Any, Any]:
    draw = random.Random(seed)
    J = [[draw.randint(-4, 4) for _ in range(n)] for _ in range(m)]
    return J, [draw.randint(-5, 5) for _ in range(m)]


def test_strang_has_this_pseudo_inverse(tmp_path: Path) -> None:
    """Introduction to Linear Algebra, section 7.4."""
    found = asked([[2, 2], [1, 1]], tmp_path, velocity=[3, 4])
    assert np.allclose(found["J_pinv"], np.array([[2, 1], [2, 1]]) / 10)


def test_flacco_de_luca_and_khatib_saturate_the_first_joint(tmp_path: Path) -> None:
    """The planar arm with four unit links of De Luca's lectures at (90, -90, 90, -90) degrees."""
    J = [[-2, -1, -1, 0], [2, 2, 1, 1]]
    found = asked(J, tmp_path, velocity=[-4, -1.5], method="within-limits", limits=[2, 2, 4, 4])
    assert np.allclose(found["qdot"], [2, -1.8333, 1.8333, -3.6667], atol=1e-4) and found["s"] == 1


@pytest.mark.parametrize(
    ("m", "n", "lost"), [(2, 3, 0), (2, 4, 1), (3, 3, 1), (3, 2, 0), (3, 7, 0), (6, 7, 0)]
)
def test_least_rates_are_those_of_numpy(m: int, n: int, lost: int, tmp_path: Path) -> None:
    J, v = drawn(m * n, m, n)
    if lost:
        J[-1] = [2 * entry for entry in J[0]]
    found = asked(J, tmp_path, velocity=v)
    plus = np.linalg.pinv(J)
    assert np.allclose(found["J_pinv"], plus) and np.allclose(found["qdot"], plus @ v)
    assert np.allclose(found["P"], np.eye(n) - plus @ J)


@pytest.mark.parametrize("seed", range(2))
def test_weights_and_damping_are_least_by_scipy(seed: int, tmp_path: Path) -> None:
    J, v = drawn(seed + 5, 2, 4)
    W = np.diag([1.0, 2, 3, 5])
    met = {"type": "eq", "fun": lambda x: J @ x - np.array(v), "jac": lambda _: np.array(J)}
    least = minimize(lambda x: x @ W @ x, np.zeros(4), jac=lambda x: 2 * W @ x, constraints=met, tol=1e-14)
    found = asked(J, tmp_path, velocity=v, method="weighted", weights=[1, 2, 3, 5])
    assert np.allclose(found["qdot"], least.x, atol=1e-6)
    whole = np.vstack([J, 0.3 * np.eye(4)])
    damped = asked(J, tmp_path, velocity=v, method="damped", damping=0.3)
    assert np.allclose(damped["qdot"], lsq_linear(whole, [*v, 0, 0, 0, 0], tol=1e-14).x, atol=1e-6)


def test_a_second_task_comes_second(tmp_path: Path) -> None:
    """Of all rates that meet the first task, those nearest to the second; both are met where they can be."""
    J, v = drawn(3, 2, 4)
    second = {"matrix": [[1, 0, 2, 1], [0, 1, 1, -1], [1, 1, 0, 0]], "rate": [1, 2, 3]}
    found = asked(J, tmp_path, velocity=v, method="task-priority", second=second)
    N = np.linalg.svd(np.array(J))[2][2:].T
    first = np.linalg.pinv(J) @ v
    J_s = np.array(second["matrix"])
    left = np.array(second["rate"]) - J_s @ first
    assert np.allclose(found["qdot"], first + N @ np.linalg.lstsq(J_s @ N, left, rcond=None)[0])
    second = {"matrix": second["matrix"][:2], "rate": [1, 2]}
    both = asked(J, tmp_path, velocity=v, method="extended", second=second)
    assert np.allclose(both["qdot"], np.linalg.solve([*J, *second["matrix"]], [*v, 1, 2]))


@pytest.mark.parametrize("seed", range(4))
def test_limits_hold_and_the_share_is_possible(seed: int, tmp_path: Path) -> None:
    """The share is at most that of a linear program, and 1 where the least rates are within the limits."""
    J, v = drawn(seed + 20, 2, 5)
    v = [3 * each for each in v]
    found = asked(J, tmp_path, velocity=v, method="within-limits", limits=[1, 1, 2, 2, 3])
    s, limits = found["s"], np.array([1, 1, 2, 2, 3])
    assert np.all(np.abs(found["qdot"]) <= limits + 1e-9) and np.allclose(J @ found["qdot"], s * np.array(v))
    columns = np.hstack([np.array(J), -np.array(v)[:, None]])
    bounds = [*((-limit, limit) for limit in limits), (0, 1)]
    most = linprog([0] * 5 + [-1], A_eq=columns, b_eq=[0, 0], bounds=bounds)
    assert 0 < s <= -most.fun + 1e-9


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"method": "weighted"}, "needs weights"),
        ({"method": "damped", "damping": 1, "velocity": [1]}, "give one for each"),
        ({"method": "extended", "second": {"matrix": [[1, 0, 0], [0, 1, 0]]}}, "in both tasks together"),
        ({"method": "within-limits", "limits": [1, 1, 1]}, "in numbers"),
        ({"second": {"matrix": [[1, 0, 0]]}}, "is not used"),
        ({"rows": ["vx"]}, "has no rows"),
    ],
)
def test_what_does_not_fit_is_said(options: dict[str, Any], said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as fault:
        asked([[1, 2, 3], [0, 1, 1]], tmp_path, **options)
    assert said in str(fault.value.errors[0])
