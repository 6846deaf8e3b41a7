"""Arms without formulas: all solutions at a pose, against published counts and Newton's method in NumPy."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from derive.errors import SheetErrors
from derive.kinds.robot._inverse.everywhere import from_everywhere
from derive.mechanics.inverse import every_solution
from derive.mechanics.inverse.closed_loop import closed
from derive.mechanics.inverse.every_solution import EverySolution
from derive.mechanics.inverse.raghavan_roth import eliminations
from derive.mechanics.inverse.six_axes import SixAxes
from tests.sheets import pages

Rows = Sequence[tuple[float, float, float]]
SIXTEEN = (
    (0, 0.3, 90),
    (0, 1, 1),
    (0.2, 0, 90),
    (0, 1.5, 1),
    (0, 0, 90),
    (0, 0, 1),
)  # d, a, alpha in degrees
OFFSET_WRIST = ((0, 0, -90), (0, 0.54, 180), (0, 0, -90), (-0.54, 0, 90), (0.15, 0, -90), (-0.16, 0, 180))
JACO = (
    (0.2755, 0, 90), (0, 0.41, 180), (-0.0098, 0, 90), (-0.2502, 0, 60), (-0.0858, 0, 60), (-0.2116, 0, 180),
)  # fmt: skip
GENERAL = (
    (0.3, 0.5, 20),
    (0.2, 0.7, -50),
    (0.1, 0.3, 70),
    (0.4, 0.6, 35),
    (0.25, 0.35, -65),
    (0.15, 0.2, 15),
)
PUBLISHED = np.array(
    [
        [-0.760117, -0.641689, 0.102262, -1.140175],
        [0.133333, 0, 0.991071, 0],
        [-0.635959, 0.766965, 0.085558, 0],
        [0, 0, 0, 1],
    ]
)


def local(row: tuple[float, float, float], angle: float) -> np.ndarray:
    d, a, degrees = row
    c, s, k, z = (
        math.cos(angle),
        math.sin(angle),
        math.cos(math.radians(degrees)),
        math.sin(math.radians(degrees)),
    )
    return np.array([[c, -s * k, s * z, a * c], [s, c * k, -c * z, a * s], [0, z, k, d], [0, 0, 0, 1]])


def frames(rows: Rows, q: Sequence[float]) -> list[np.ndarray]:
    """Those on the axes, and that of the end."""
    found = [np.eye(4)]
    for row, angle in zip(rows, q, strict=True):
        found.append(found[-1] @ local(row, angle))
    return found


def solved(rows: Rows, pose: np.ndarray) -> list[list[float]]:
    *on_axes, end = frames(rows, [0.0] * 6)
    names = tuple(f"q{k}" for k in range(6))
    arm = SixAxes(names, tuple(on_axes), end, 1.0)
    for each in eliminations(closed(names, on_axes, end, pose)):
        found = EverySolution(each, names, lambda q: arm.sides(pose, q))
        if found.decides:
            return [[q[name] for name in names] for q in found.solutions]
    raise AssertionError("undecided")


@pytest.mark.parametrize("rows", [OFFSET_WRIST, JACO, GENERAL])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_each_is_a_solution_and_newton_finds_no_other(rows: Rows, seed: int) -> None:
    q = np.random.default_rng(seed).uniform(-math.pi, math.pi, 6)
    pose = frames(rows, q)[-1]
    found = solved(rows, pose)
    assert all(np.abs(frames(rows, each)[-1] - pose).max() < 1e-10 for each in found)
    assert any(np.abs(np.remainder(each - q + 3, 2 * math.pi) - 3).max() < 1e-8 for each in np.array(found))
    *on_axes, end = frames(rows, [0.0] * 6)
    axes = [(T[:3, 2], T[:3, 3]) for T in on_axes]
    for other in from_everywhere(axes, end, pose, 1.0):
        gaps = np.remainder(np.array(found) - other + 3, 2 * math.pi) - 3
        assert np.abs(gaps).max(axis=1).min() < 1e-6


def test_sixteen_are_real() -> None:
    """As many as there can be; the pose is rounded."""
    U, _, V = np.linalg.svd(PUBLISHED[:3, :3])
    pose = PUBLISHED.copy()
    pose[:3, :3] = U @ V
    found = solved(SIXTEEN, pose)
    assert len(found) == 16
    assert all(np.abs(frames(SIXTEEN, each)[-1] - pose).max() < 1e-10 for each in found)


def question(rows: Rows, pose: np.ndarray, folder: Path, left_out: str = "") -> dict[str, Any]:
    sheet = folder / "sheet.yaml"
    links = "".join(
        f"    - {{theta: theta{k}*, d: {d}, a: {a}, alpha: {alpha} deg}}\n"
        for k, (d, a, alpha) in enumerate(rows, 1)
    )
    values = {f"r{i + 1}{j + 1}": pose[i, j] for i in range(3) for j in range(3)} | dict(
        zip("xyz", pose[:3, 3], strict=True)
    )
    at = ", ".join(f"{name}: {float(value)!r}" for name, value in values.items() if name != left_out)
    sheet.write_text(
        f"title: Six axes\nproblems:\n- robot:\n    gravity: [0, 0, -g]\n    links:\n{links}"
        f"  find: inverse-kinematics\n  given: pose\n  evaluate: {{{at}}}\n",
        encoding="utf-8",
    )
    (path,) = (each for each in pages(sheet, folder, "json") if each.suffix == ".json")
    (found,) = json.loads(path.read_text(encoding="utf-8"))["problems"][0]["questions"]
    return dict(found)


def test_the_sheet_says_them_with_their_polynomial(tmp_path: Path) -> None:
    pose = frames(OFFSET_WRIST, [0.3, -0.7, 1.1, 0.4, -1.2, 2.0])[-1]
    found = question(OFFSET_WRIST, pose, tmp_path)
    told = found["evaluated"]["solutions"]
    assert any(
        np.allclose([each[f"theta{k}"] for k in range(1, 7)], [0.3, -0.7, 1.1, 0.4, -1.2, 2.0])
        for each in told
    )
    assert [float(each["theta1"]) for each in found["results"]["solutions"]] == [
        each["theta1"] for each in told
    ]
    assert "u**16" in found["results"]["polynomial"]


def test_a_general_arm_is_not_searched_to_the_end(tmp_path: Path) -> None:
    q = [0.3, -0.7, 1.1, 0.4, -1.2, 2.0]
    told = question(GENERAL, frames(GENERAL, q)[-1], tmp_path)["evaluated"]["solutions"]
    assert any(np.allclose([each[f"theta{k}"] for k in range(1, 7)], q) for each in told)


def test_where_the_pose_lies_specially(tmp_path: Path) -> None:
    """With the last axis along the first every elimination vanishes; solutions are followed from beside."""
    rows: Rows = JACO
    pose = np.diag([1.0, -1.0, -1.0, 1.0])
    pose[:3, 3] = 0.4, 0.3, 0.2
    found = question(rows, pose, tmp_path)
    assert "polynomial" not in found["results"]
    told = [[each[f"theta{k}"] for k in range(1, 7)] for each in found["evaluated"]["solutions"]]
    assert all(np.abs(frames(rows, each)[-1] - pose).max() < 1e-9 for each in told)
    *on_axes, end = frames(rows, [0.0] * 6)
    for other in from_everywhere([(T[:3, 2], T[:3, 3]) for T in on_axes], end, pose, 1.0):
        gaps = np.remainder(np.array(told) - other + 3, 2 * math.pi) - 3
        assert np.abs(gaps).max(axis=1).min() < 1e-6


def test_out_of_reach(tmp_path: Path) -> None:
    pose = frames(OFFSET_WRIST, [0.3, -0.7, 1.1, 0.4, -1.2, 2.0])[-1]
    pose[:3, 3] = 5, 0, 0
    found = question(OFFSET_WRIST, pose, tmp_path)
    assert found["results"]["solutions"] == []


@pytest.mark.parametrize(
    ("q", "left_out", "said"),
    [([0.0] * 6, "", "singular in one of them"), ([0.3, -0.7, 1.1, 0.4, -1.2, 2.0], "z", "z has none")],
)
def test_refused(q: list[float], left_out: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as raised:
        question(OFFSET_WRIST, frames(OFFSET_WRIST, q)[-1], tmp_path, left_out)
    assert said in raised.value.errors[0].message


def test_a_lost_solution_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = every_solution.EverySolution.roots.func
    short = property(lambda self: right(self)[1:])
    monkeypatch.setattr(every_solution.EverySolution, "roots", short)
    with pytest.raises(SheetErrors):
        question(OFFSET_WRIST, frames(OFFSET_WRIST, [0.3, -0.7, 1.1, 0.4, -1.2, 2.0])[-1], tmp_path)
