"""Ranks and null spaces against a published example, NumPy and SciPy."""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.linalg import null_space

from derive.errors import SheetErrors
from tests.sheets import pages

ARM = """
title: An arm
problems:
- robot:
    links:
    - {theta: q1*, d: 0, a: 1, alpha: 0}
    - {theta: q2*, d: 0, a: 1, alpha: 0}
    - {theta: q3*, d: 0, a: 1, alpha: 0}
  find: rank
"""
BASES = ("null_space", "range", "left_null_space")


def asked(text: str, folder: Path) -> dict[str, Any]:
    """The results of the one question of a sheet."""
    sheet = folder / "sheet.yaml"
    sheet.write_text(text, encoding="utf-8")
    (page,) = pages(sheet, folder / "out", "json")
    found: dict[str, Any] = json.loads(page.read_text())["problems"][0]["questions"][0]["results"]
    return found


def given(matrix: Any, *more: str) -> str:
    rows = [list(map(int, row)) for row in matrix]
    lines = ("title: A matrix", "problems:", f"- matrix: {{value: {rows}}}", "  find: rank", *more)
    return "\n".join(lines) + "\n"


def numbers(told: Any, height: int) -> Any:
    """A basis as an array with a row for each entry of its columns."""
    return np.array(told, dtype=float) if told else np.zeros((height, 0))


def same_space(a: Any, b: Any) -> bool:
    ranks = [np.linalg.matrix_rank(each) if each.shape[1] else 0 for each in (a, b, np.hstack([a, b]))]
    return bool(ranks[0] == ranks[1] == ranks[2] == a.shape[1])


def test_strang_has_this_null_space(tmp_path: Path) -> None:
    """Strang, Introduction to Linear Algebra, section 3.2: special solutions (-2, 1, 0, 0), (2, 0, -2, 1)."""
    A = [[1, 2, 2, 2], [2, 4, 6, 8], [3, 6, 8, 10]]
    found = asked(given(A, "  velocity: [1, 5, 6]", "  wrench: [1, 1, -1]"), tmp_path)
    assert found["rank"] == "2" and found["feasible"] is True
    assert found["null_space"] == [["-2", "2"], ["1", "0"], ["0", "-2"], ["0", "1"]]
    assert same_space(numbers(found["left_null_space"], 3), np.array([[1.0], [1.0], [-1.0]]))
    assert found["tau"] == ["0"] * 4
    assert found["qdot"][3] == "k_2"


@pytest.mark.parametrize("seed", range(4))
def test_matrices_at_random(seed: int, tmp_path: Path) -> None:
    """Products of thin matrices of small whole numbers have every rank."""
    draw = random.Random(seed)
    m, n, r = draw.randint(1, 4), draw.randint(1, 5), draw.randint(0, 3)
    A = np.array([[draw.randint(-2, 2) for _ in range(r)] for _ in range(m)], dtype=float).reshape(m, r)
    B = np.array([[draw.randint(-2, 2) for _ in range(n)] for _ in range(r)], dtype=float).reshape(r, n)
    J = A @ B
    found = asked(given(J), tmp_path)
    assert int(found["rank"]) == np.linalg.matrix_rank(J)
    assert same_space(numbers(found["null_space"], n), null_space(J))
    assert same_space(numbers(found["left_null_space"], m), null_space(J.T))
    assert np.allclose(numbers(found["left_null_space"], m).T @ numbers(found["range"], m), 0)


def test_a_planar_arm_folded_back(tmp_path: Path) -> None:
    """At q = (0, 0, pi) the tip moves along y alone; a force along x needs no torque."""
    more = "  rows: [vx, vy]\n  evaluate: {q1: 0, q2: 0, q3: 180 deg}\n"
    found = asked(ARM + more + "  velocity: [0, 1]\n  wrench: [2, 0]\n", tmp_path)
    J = np.array([[0.0, 0, 0], [1, 0, -1]])
    assert found["rank"] == "1" and found["feasible"] is True and found["tau"] == ["0"] * 3
    assert same_space(numbers(found["null_space"], 3), null_space(J))
    assert asked(ARM + more + "  velocity: [1, 1]\n", tmp_path)["feasible"] is False


def test_whole_numbers_may_be_large(tmp_path: Path) -> None:
    """A basis of decimals is written in whole numbers: what rounding leaves of zero grows with them."""
    J = np.random.default_rng(3).integers(-(10**5), 10**5, (4, 3)) @ [
        [1, 0, 2, 5],
        [0, 1, 7, -3],
        [1, 1, 9, 2],
    ]
    found = asked(given(J), tmp_path)
    assert int(found["rank"]) == np.linalg.matrix_rank(J)
    null, left = (numbers(found[key], 4) for key in ("null_space", "left_null_space"))
    assert np.abs(left).max() > 1e6
    for ours, theirs in ((null, null_space(J)), (left, null_space(J.T))):
        unit = ours / np.abs(ours).max(axis=0)
        assert unit.shape == theirs.shape and np.allclose(theirs @ (theirs.T @ unit), unit)


@pytest.mark.parametrize(
    ("sheet", "said"),
    [
        (ARM + "  rows: [vx, vy]\n  velocity: [1, 2, 3]\n", "give one for each"),
        (given([[1, 2]], "  rows: [vx]"), "has no rows"),
        (ARM + "  rows: [vx]\n  task: [q1]\n", "in place of rows"),
    ],
)
def test_what_does_not_fit_is_said(sheet: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as fault:
        asked(sheet, tmp_path)
    assert said in str(fault.value.errors[0])
