"""Workspaces of arms whose first joint turns: against sampling in NumPy, roots counted another way, and a
published arm (Wenger 2004)."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from derive.errors import SheetErrors
from derive.mechanics.covering import Covering
from tests.sheets import pages

ORTHOGONAL = (
    "{theta: q1*, d: 0, a: 1, alpha: -90 deg}, {theta: q2*, d: 1, a: 2, alpha: 90 deg%s}, "
    "{theta: q3*, d: 0, a: 3/2, alpha: 0%s}"
)


def told(links: str, folder: Path, more: str = "") -> dict[str, Any]:
    sheet = folder / "sheet.yaml"
    sheet.write_text(
        f"title: A test\nproblems:\n- robot: {{links: [{links}]}}\n  find: workspace\n{more}",
        encoding="utf-8",
    )
    (path,) = (each for each in pages(sheet, folder, "json") if each.suffix == ".json")
    (question,) = json.loads(path.read_text(encoding="utf-8"))["problems"][0]["questions"]
    assert all(check["holds"] for check in question["checks"])
    return {**question["results"], **question.get("evaluated", {})}


def moved(rows: list[tuple[float, float, float]], q: np.ndarray) -> np.ndarray:
    """The end (N by 3) of revolute rows (d, a, alpha) at angles (k by N)."""
    T = np.tile(np.eye(4), (q.shape[1], 1, 1))
    for (d, a, alpha), angle in zip(rows, q, strict=True):
        c, s, ca, sa = np.cos(angle), np.sin(angle), math.cos(alpha), math.sin(alpha)
        A = np.zeros((len(angle), 4, 4))
        A[:, 0] = np.stack([c, -s * ca, s * sa, a * c], -1)
        A[:, 1] = np.stack([s, c * ca, -c * sa, a * s], -1)
        A[:, 2] = [0, sa, ca, d]
        A[:, 3, 3] = 1
        T = T @ A
    return T[:, :3, 3]


def ends(p: np.ndarray) -> tuple[float, float, float, float]:
    rho = np.hypot(p[:, 0], p[:, 1])
    return rho.min(), rho.max(), p[:, 2].min(), p[:, 2].max()


def postures(rho: float, z: float) -> int:
    """Of the orthogonal arm: z = -s2 (2 + 1.5 c3), so q3 decides q2 up to its cosine's sign."""
    q3 = np.linspace(-math.pi, math.pi, 400_001)
    sine = -z / (2 + 1.5 * np.cos(q3))
    total = 0
    for sign in (1, -1):
        cosine = sign * np.sqrt(1 - sine**2, where=abs(sine) <= 1, out=np.full(sine.shape, np.nan))
        x = 1 + cosine * (2 + 1.5 * np.cos(q3))
        y = 1.5 * np.sin(q3) + 1
        off = np.hypot(x, y) - rho
        total += int((off[1:] * off[:-1] < 0).sum())
    return total


def test_the_orthogonal_arm_of_wenger(tmp_path: Path) -> None:
    found = told(ORTHOGONAL % ("", ""), tmp_path)
    q = np.random.default_rng(0).uniform(-math.pi, math.pi, (3, 400_000))
    sampled = ends(moved([(0, 1, -math.pi / 2), (1, 2, math.pi / 2), (0, 1.5, 0)], q))
    numbers = [found[name] for name in ("r_min", "r_max", "z_min", "z_max")]
    assert numbers == pytest.approx(sampled, abs=0.02)
    counts = [int(count) for *_, count in found["regions"]]
    assert counts == [0, 2, 4] and "void" in found["description"]
    assert [postures(rho, z) for rho, z, _ in found["regions"]] == counts
    assert postures(2.5, 0.5) == 4  # as published
    assert numbers[3] == pytest.approx(3.5)


def test_ranges_leave_a_part(tmp_path: Path) -> None:
    found = told(ORTHOGONAL % (", range: [-40 deg, 80 deg]", ", range: [0, 150 deg]"), tmp_path)
    rng = np.random.default_rng(1)
    q = np.stack([np.zeros(400_000), rng.uniform(*np.radians([-40, 80]), 400_000),
                  rng.uniform(0, math.radians(150), 400_000)])  # fmt: skip
    sampled = ends(moved([(0, 1, -math.pi / 2), (1, 2, math.pi / 2), (0, 1.5, 0)], q))
    assert [found[name] for name in ("r_min", "r_max", "z_min", "z_max")] == pytest.approx(sampled, abs=0.02)


@pytest.mark.parametrize(("first", "said"), [("", "an annulus"), (", range: [-60 deg, 60 deg]", "a part of")])
def test_three_links_in_a_plane_within_ranges(first: str, said: str, tmp_path: Path) -> None:
    links = (
        f"{{theta: q1*, d: 0, a: 0.5, alpha: 0{first}}}, "
        "{theta: q2*, d: 0, a: 0.4, alpha: 0, range: [-20 deg, 120 deg]}, "
        "{theta: q3*, d: 0, a: 0.3, alpha: 0, range: [30 deg, 90 deg]}"
    )
    found = told(links, tmp_path)
    rng = np.random.default_rng(2)
    angles = (rng.uniform(*np.radians(each), 300_000) for each in ((-20, 120), (30, 90)))
    q = np.stack([np.zeros(300_000), *angles])
    sampled = ends(moved([(0, 0.5, 0), (0, 0.4, 0), (0, 0.3, 0)], q))
    assert (found["r_min"], found["r_max"]) == pytest.approx(sampled[:2], abs=0.003)
    assert found["description"].startswith(said)


def test_a_swung_arm_within_ranges(tmp_path: Path) -> None:
    """Stretched at 45 degrees it would reach higher; the elbow is kept from that."""
    links = (
        "{theta: q1*, d: 0, a: 0, alpha: 90 deg}, {theta: q2*, d: 0, a: 0.5, alpha: 0, range: [0, 45 deg]}, "
        "{theta: q3*, d: 0, a: 0.4, alpha: 0, range: [-150 deg, -30 deg]}"
    )
    found = told(links, tmp_path)
    assert found["z_max"] == pytest.approx(0.5 * math.sin(math.pi / 4) + 0.4 * math.sin(math.pi / 12))
    assert found["r_max"] == pytest.approx(math.sqrt(0.41 + 0.4 * math.cos(math.pi / 6)))


def test_a_first_joint_with_a_range_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as caught:
        told(ORTHOGONAL.replace("-90 deg}", "-90 deg, range: [0, 90 deg]}") % ("", ""), tmp_path)
    assert "whole turn" in str(caught.value.errors[0])


@pytest.mark.parametrize(("twists", "low"), [((60, -60), -1 / 2), ((40, 70), math.cos(math.radians(110)))])
def test_a_wrist_points_into_a_cone(twists: tuple[int, int], low: float, tmp_path: Path) -> None:
    links = (
        f"{{theta: q1*, d: 0, a: 0, alpha: {twists[0]} deg}}, "
        f"{{theta: q2*, d: 0, a: 0, alpha: {twists[1]} deg}}, "
        "{theta: q3*, d: 1/2, a: 0, alpha: 0}"
    )
    found = told(links, tmp_path, "  evaluate: true\n")
    assert (found["r_min"], found["r_max"]) == pytest.approx((0.5, 0.5))
    high = math.cos(math.radians(abs(abs(twists[0]) - abs(twists[1]))))
    assert (found["z_min"], found["z_max"]) == pytest.approx((low / 2, high / 2))


def test_the_center_of_a_wrist_stays(tmp_path: Path) -> None:
    links = ", ".join(
        f"{{theta: q{k}*, d: 0, a: 0, alpha: {twist}}}" for k, twist in ((1, "60 deg"), (2, "-60 deg"))
    )
    found = told(f"{links}, {{theta: q3*, d: 0, a: 0, alpha: 0}}", tmp_path)
    assert (found["r_min"], found["r_max"], found["description"]) == ("0", "0", "this one point")


def test_a_palletizer_reaches_a_shell(tmp_path: Path) -> None:
    links = "{theta: q1*, d: 0.5, a: 0, alpha: 90 deg}" + "".join(
        f", {{theta: q{k}*, d: 0, a: {a}, alpha: 0}}" for k, a in ((2, 0.9), (3, 0.3), (4, 0.2))
    )
    found = told(links, tmp_path, "  evaluate: true\n")
    assert (found["r_min"], found["r_max"]) == pytest.approx((0.4, 1.4))
    coupled = links.replace("q3*", "q3* - q2").replace("q4*", "q4* - q3")
    assert told(coupled, tmp_path, "  evaluate: true\n")["r_max"] == pytest.approx(1.4)


def test_a_fold_is_counted_twice() -> None:
    """The square u^2, v of the plane lies over x > 0 twice, and over nothing else."""
    u, v = np.meshgrid(np.linspace(-1, 1, 101), np.linspace(0, 1, 81), indexing="ij")
    covering = Covering(u**2, v)
    counts = covering.counts
    inside = [
        counts[i, j]
        for i in range(counts.shape[0])
        for j in range(counts.shape[1])
        if 0.01 < covering.middle(i, j)[0] < 0.99 and 0.01 < covering.middle(i, j)[1] < 0.99
    ]
    assert {*map(int, inside)} == {2}
    assert int(counts[counts > 0].sum()) == pytest.approx(2 / math.prod(covering.size), rel=0.02)
