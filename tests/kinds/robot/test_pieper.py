"""Pieper's quartic: every solution of three offset axes, found otherwise by NumPy, and what is refused."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from derive.check import check
from derive.errors import SheetErrors
from derive.mechanics.inverse import pieper
from tests.kinds.robot.test_planted_formulas import plant
from tests.sheets import pages

Rows = Sequence[tuple[float, float, float]]
ORTHOGONAL = ((0, 1, -90), (1, 2, 90), (0, 1.5, 0))  # d, a, alpha in degrees
SKEW = ((0.1, 0.4, 25), (0.3, 0.5, -36), (-0.2, 0.6, 0))
STARTS, STEPS = 60, 40


def question(rows: Rows, place: Sequence[float], folder: Path) -> dict[str, Any]:
    sheet = folder / "sheet.yaml"
    links = "".join(
        f"    - {{theta: theta{k}*, d: {d}, a: {a}, alpha: {alpha} deg}}\n"
        for k, (d, a, alpha) in enumerate(rows, 1)
    )
    at = ", ".join(f"{name}: {value!r}" for name, value in zip("xyz", place, strict=True))
    sheet.write_text(
        f"title: Three axes\nproblems:\n- robot:\n    links:\n{links}  find: inverse-kinematics\n"
        f"  given: [x, y, z]\n  evaluate: {{{at}}}\n",
        encoding="utf-8",
    )
    (path,) = (each for each in pages(sheet, folder, "json") if each.suffix == ".json")
    (found,) = json.loads(path.read_text(encoding="utf-8"))["problems"][0]["questions"]
    return dict(found)


def tip(rows: Rows, q: np.ndarray) -> np.ndarray:
    """The position (3) of the end, by the matrices of the rows."""
    T = np.eye(4)
    for (d, a, degrees), angle in zip(rows, q, strict=True):
        c, s = math.cos(angle), math.sin(angle)
        k, z = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        T = T @ [[c, -s * k, s * z, a * c], [s, c * k, -c * z, a * s], [0, z, k, d], [0, 0, 0, 1]]
    return np.array(T[:3, 3])


def by_newton(rows: Rows, place: np.ndarray) -> list[np.ndarray]:
    """Every solution that Newton's method finds from many starts, angles between -pi and pi."""
    draw, found = np.random.default_rng(3), []
    for _ in range(STARTS):
        q = draw.uniform(-math.pi, math.pi, 3)
        for _ in range(STEPS):
            J = np.array([(tip(rows, q + h) - tip(rows, q - h)) / 2e-6 for h in 1e-6 * np.eye(3)]).T
            q = q - np.linalg.lstsq(J, tip(rows, q) - place, rcond=None)[0]
        q = np.remainder(q + math.pi, 2 * math.pi) - math.pi
        if np.abs(tip(rows, q) - place).max() < 1e-10 and not any(
            np.abs(q - each).max() < 1e-6 for each in found
        ):
            found.append(q)
    return found


@pytest.mark.parametrize("rows", [ORTHOGONAL, SKEW])
@pytest.mark.parametrize("seed", [1, 2])
def test_all_solutions_are_those_that_newton_finds(rows: Rows, seed: int, tmp_path: Path) -> None:
    place = tip(rows, np.random.default_rng(seed).uniform(-math.pi, math.pi, 3))
    told = question(rows, [float(each) for each in place], tmp_path)["evaluated"]["solutions"]
    ours = sorted([each[f"theta{k}"] for k in (1, 2, 3)] for each in told)
    assert np.allclose(ours, sorted(by_newton(rows, place), key=list), atol=1e-8)


@pytest.mark.parametrize(("place", "count"), [((2.5, 0, 0.5), 4), ((4, 0, 0.5), 2), ((5, 0, 0.5), 0)])
def test_as_many_as_wenger_counts(place: Sequence[float], count: int, tmp_path: Path) -> None:
    """Robotica 25 (2007), figure 2: four in the inner region of the orthogonal arm, two in the outer one."""
    told = question(ORTHOGONAL, place, tmp_path)["evaluated"]["solutions"]
    assert sum(each.get("real", True) for each in told) == count


def test_half_a_turn_is_a_solution(tmp_path: Path) -> None:
    place = [float(each) for each in tip(ORTHOGONAL, np.array([0.3, 0.2, math.pi]))]
    told = question(ORTHOGONAL, place, tmp_path)["evaluated"]["solutions"]
    assert any(np.allclose([abs(each[f"theta{k}"]) for k in (1, 2, 3)], [0.3, 0.2, math.pi]) for each in told)


def test_it_falls_apart_without_the_offset(tmp_path: Path) -> None:
    """Only even powers are left, and the roots come in pairs."""
    told = question(((0, 1, -90), (0, 2, 90), (0, 1.5, 0)), (2.5, 1, 0.5), tmp_path)["evaluated"]["solutions"]
    assert sorted(abs(each["u"]) for each in told)[::2] == pytest.approx(
        sorted(abs(each["u"]) for each in told)[1::2]
    )


def test_a_wrong_half_angle_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = pieper._in_half_angle

    def wrong(trig: pieper.TrigPolynomial) -> tuple[Any, ...]:
        first, second, *others = right(trig)
        return (first, -second, *others)

    plant(monkeypatch, right, wrong)
    with pytest.raises(SheetErrors):
        question(ORTHOGONAL, (2.5, 0, 0.5), tmp_path)


def test_a_lost_root_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from derive.kinds.robot._inverse import roots

    right = roots._apart
    monkeypatch.setattr(roots, "_apart", lambda found: right(found)[1:])
    with pytest.raises(SheetErrors):
        question(ORTHOGONAL, (2.5, 0, 0.5), tmp_path)


def test_a_motion_is_integrated_instead(tmp_path: Path) -> None:
    sheet = tmp_path / "sheet.yaml"
    links = "".join(
        f"    - {{theta: theta{k}*, d: {d}, a: {a}, alpha: {alpha} deg}}\n"
        for k, (d, a, alpha) in enumerate(ORTHOGONAL, 1)
    )
    sheet.write_text(
        f"title: A line\nproblems:\n- robot:\n    links:\n{links}  find: joint-motion\n"
        "  path: {line: {from: [2.5, 0, 0.5], to: [2.4, 0.3, 0.6]}, timing: {law: cubic, time: 2 s}}\n",
        encoding="utf-8",
    )
    with pytest.raises(SheetErrors) as raised:
        pages(sheet, tmp_path, "json")
    assert "inverse-velocity" in raised.value.errors[0].message


def test_published_numbers_are_held_against_the_solutions_there(tmp_path: Path) -> None:
    told = question(ORTHOGONAL, (2.5, 0, 0.5), tmp_path)["evaluated"]["solutions"]
    rounded = [{name: round(each[name], 4) for name in ("theta1", "theta2", "theta3")} for each in told]
    rounded[2]["theta1"] = -rounded[2]["theta1"]
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(
        f"{sheet.read_text(encoding='utf-8')}  answer: {{solutions: {json.dumps(rounded)}}}\n",
        encoding="utf-8",
    )
    verdicts = [each.verdict for each in check([sheet]).checks]
    assert verdicts == ["equal", "equal", "differs", "equal"]
