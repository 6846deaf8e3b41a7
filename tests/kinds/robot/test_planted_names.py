"""A thing under the name of another one: a plain build refuses it, though every chain is equal."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from derive import names
from derive.errors import SheetErrors
from derive.expression import Symbol
from derive.kinds.robot import _chain
from tests.kinds.robot.test_planted_formulas import build, plant

ARM = """
problems:
- robot:
    gravity: [0, -g, 0]
    links:
    - {{theta: theta1*, d: 0, a: a1, alpha: 90 deg, mass: m1, com: [-a1/2, 0, b], inertia: {{sphere: r}}}}
    - {{theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: [-a2/3, 0, 0], inertia: [I1, I2, I3]}}
    - {{theta: theta3*, d: d3, a: a3, alpha: 0, mass: m3, com: [0, c, 0], inertia: point}}
  find: {kind}
"""

IN_A_PLANE = """
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  find: %s
"""


def wrong_axis(found: Any, robot: Any, i: int) -> tuple[Symbol, Symbol]:
    """z_i for z_{i-1}."""
    return Symbol(f"z_{i}"), Symbol(f"o_{i - 1}")


def wrong_origin(found: Any, robot: Any, i: int) -> tuple[Symbol, Symbol]:
    return Symbol(f"z_{i - 1}"), Symbol(f"o_{i}")


def wrong_pose(i: int, reference: int = 0) -> Symbol:
    """T_1^2 for T_2^1."""
    return Symbol(f"T_{reference}^{i}")


def turned(letter: str, *indices: int) -> Symbol:
    """c_kji for c_ijk, d_ji for d_ij."""
    return right(letter, *reversed(indices))


def shifted(letter: str, *indices: int) -> Symbol:
    return right(letter, *(index % 3 + 1 for index in indices))


right = names.entry_symbol
MISTAKES: dict[str, tuple[Callable[..., Any], Callable[..., Any], tuple[str, ...]]] = {
    "axis": (_chain.axis_names, wrong_axis, ("joint-axes", "jacobian")),
    "origin": (_chain.axis_names, wrong_origin, ("joint-axes", "jacobian")),
    "pose": (_chain.pose_name, wrong_pose, ("forward-kinematics", "joint-axes")),
    "order of indices": (right, turned, ("christoffel", "dynamics", "coriolis-matrix")),
    "indices": (right, shifted, ("inertia-matrix", "christoffel", "coriolis-matrices")),
}
CASES = [(mistake, kind) for mistake, (_, _, kinds) in MISTAKES.items() for kind in kinds]


@pytest.mark.parametrize(("mistake", "kind"), CASES)
def test_a_name_is_that_of_the_thing(
    mistake: str, kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sheet, (function, wrong, _) = ARM.format(kind=kind), MISTAKES[mistake]
    build(sheet, tmp_path)
    plant(monkeypatch, function, wrong)
    with pytest.raises(SheetErrors):
        build(sheet, tmp_path)


@pytest.mark.parametrize("kind", ["joint-axes", "jacobian", "velocity"])
def test_axes_that_are_parallel_have_their_own_names(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of an arm in a plane z_1 is z_0, and no value tells them apart."""
    build(IN_A_PLANE % kind, tmp_path)
    plant(monkeypatch, _chain.axis_names, wrong_axis)
    with pytest.raises(SheetErrors):
        build(IN_A_PLANE % kind, tmp_path)


def test_entries_are_named_by_row_and_column(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sheet, function = ARM.format(kind="forward-kinematics"), names.pose_entries

    def columns_first(*arguments: Any) -> dict[tuple[int, int], Symbol]:
        made = function(*arguments)
        return {(i, j): made[j, i] if max(i, j) < 3 else name for (i, j), name in made.items()}

    build(sheet, tmp_path)
    plant(monkeypatch, function, columns_first)
    with pytest.raises(SheetErrors):
        build(sheet, tmp_path)
