"""The same solutions as EAIK 1.2.2 (Ostermeier, Kuelz and Althoff 2025) finds in numbers.

`eaik.json` has rows (d, a, alpha in degrees), a pose of each arm and all solutions there."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from derive.expression import Number
from tests.kinds.robot.arms import Arm

FOUND = json.loads(Path(__file__).with_name("eaik.json").read_text(encoding="utf-8"))
SAME = 1e-8


def gap(one: Sequence[float], other: Sequence[float]) -> float:
    return max(abs(math.remainder(a - b, 2 * math.pi)) for a, b in zip(one, other, strict=True))


def place(pose: Sequence[Sequence[float]]) -> tuple[tuple[str, Number], ...]:
    values = {f"r{i + 1}{j + 1}": pose[i][j] for i in range(3) for j in range(3)}
    values |= dict(zip("xyz", (row[3] for row in pose), strict=True))
    return tuple((name, Number(Fraction(repr(value)))) for name, value in values.items())


@pytest.mark.parametrize("name", FOUND)
def test_the_same_solutions(name: str) -> None:
    theirs: Any = FOUND[name]
    rows = tuple(
        (f"theta{i}*", str(d), str(a), f"{alpha} deg") for i, (d, a, alpha) in enumerate(theirs["rows"], 1)
    )
    arm = Arm(rows, "pose", 8)
    found = arm.problem().ask("inverse-kinematics", given="pose", evaluate=place(theirs["pose"]))
    ours = [
        [each[joint] for joint in arm.joints]
        for each in found.evaluated["solutions"]
        if each.get("real", True)
    ]
    assert len(ours) == len(theirs["solutions"])
    assert all(min(gap(one, other) for other in ours) < SAME for one in theirs["solutions"])
