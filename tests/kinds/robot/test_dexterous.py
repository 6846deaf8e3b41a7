"""Positions with every orientation, against published regions, and every direction of the last link tried."""

from __future__ import annotations

import json
import math
import random
from pathlib import Path
from typing import Any

import pytest

from derive.errors import SheetErrors
from tests.sheets import pages

WRIST = """    - {theta: q1*, d: 0, a: 0, alpha: 90 deg}
    - {theta: q2*, d: 0, a: 2, alpha: 0}
    - {theta: q3*, d: 0, a: 0, alpha: 90 deg}
    - {theta: q4*, d: 1, a: 0, alpha: -90 deg}
    - {theta: q5*, d: 0, a: 0, alpha: 90 deg}
    - {theta: q6*, d: 0, a: 0, alpha: 0}"""


def planar(*lengths: object) -> str:
    rows = (f"    - {{theta: q{k}*, d: 0, a: {length}, alpha: 0}}" for k, length in enumerate(lengths, 1))
    return "\n".join(rows)


def asked(rows: str, folder: Path) -> dict[str, Any]:
    """The results of the one question of a sheet."""
    sheet = folder / "sheet.yaml"
    text = f"title: A\nproblems:\n- robot:\n    links:\n{rows}\n  find: workspace\n  kind: dexterous\n"
    sheet.write_text(text, encoding="utf-8")
    (page,) = pages(sheet, folder / "out", "json")
    found: dict[str, Any] = json.loads(page.read_text())["problems"][0]["questions"][0]["results"]
    return found


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        (planar(1, 1), "the point on the first axis alone"),  # Craig, section 4.2
        (planar(2, 1), "empty"),
        (planar("l", "l", "l"), "a disc of radius l about the first axis"),  # De Luca, Robotics 1
        (planar(1, 1, 5), "empty"),
        (planar(2, 1, 3), "the point on the first axis alone"),
        (planar("l1", "l2"), "empty, except that for equally long links it is the point on the first axis"),
        (planar(2, 1, 0), "an annulus about the first axis"),
        (WRIST, "a spherical shell about the shoulder"),
    ],
)
def test_regions_that_are_known(rows: str, said: str, tmp_path: Path) -> None:
    assert asked(rows, tmp_path)["description"] == said


@pytest.mark.parametrize("seed", range(4))
def test_rings_by_every_direction_of_the_last_link(seed: int, tmp_path: Path) -> None:
    draw = random.Random(seed)
    *others, last = (draw.randint(1, 12) for _ in range(draw.choice((3, 4))))
    found = asked(planar(*others, last), tmp_path)
    rings = [[float(end) for end in ring] for ring in found.get("rings", [])]
    near, far = max(0, 2 * max(others) - sum(others)), sum(others)
    for r in (0.05 + 0.1 * k for k in range(10 * (far + last))):
        starts = (
            math.hypot(r - last * math.cos(a), last * math.sin(a)) for a in (k / 60 for k in range(377))
        )
        if not any(abs(r - end) < 0.05 for ring in rings for end in ring):
            assert any(low <= r <= high for low, high in rings) == all(near <= s <= far for s in starts)


def test_an_arm_within_ranges_is_refused(tmp_path: Path) -> None:
    rows = planar(1, 1, 1).replace("alpha: 0}", "alpha: 0, range: [0, 90 deg]}", 1)
    with pytest.raises(SheetErrors) as fault:
        asked(rows, tmp_path)
    assert "not derived yet" in str(fault.value.errors[0])


def test_boundaries_of_links_to_the_side_of_an_axis_are_those_told(tmp_path: Path) -> None:
    """The PUMA 560 of Corke: what is drawn of the wrist is as far from the shoulder as the page says."""
    rows = """    - {theta: q1*, d: 0, a: 0, alpha: 90 deg}
    - {theta: q2*, d: 0, a: 0.4318, alpha: 0}
    - {theta: q3*, d: 0.15005, a: 0.4318, alpha: 0}"""
    assert asked(rows, tmp_path)["description"] == "empty"
