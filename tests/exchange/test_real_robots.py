"""Robots of PyPI, read and held to what pinocchio finds of the same files (`make_numbers.py`), then written
as URDF and read again."""

from __future__ import annotations

import json
from pathlib import Path
from random import Random

import numpy as np
import pytest

import derive
from derive.expression import free_symbols
from derive.kinds.problem import expressions
from derive.sheet.exchange.files import Wish, as_urdf
from derive.sheet.reader import read as read_yaml
from derive.sheet.source import At
from tests.exchange.reading import HERE, ROBOTS, built, numbers, read
from tests.sheets import ROOT

FOUND = json.loads((HERE / "numbers.json").read_text())["robots"]
OUT = [*sorted(ROBOTS.glob("*.urdf")), *sorted((ROOT / "exercises" / "robots").glob("*.yaml"))]
NEAR = {"al5d": 3e-9}  # its 3.141592653 is taken for pi, twice


@pytest.mark.parametrize("name", sorted(FOUND))
def test_as_pinocchio_has_it(name: str) -> None:
    given = FOUND[name]
    robot = read(ROBOTS / f"{name}.urdf", Wish(tip=given["tip"]))
    ours = numbers(robot, dict(zip(robot.variables, given["q"].values(), strict=True)))
    for key, value in ours.items():
        np.testing.assert_allclose(value, given[key], atol=NEAR.get(name, 1e-9), rtol=1e-9, err_msg=key)
    assert ("D" in ours) == bool(np.any(given["D"]))


def test_mimic_joints_are_derived_as_coupled_ones() -> None:
    given = FOUND["mimics"]
    point = dict(zip(("theta1", "d3"), given["q"].values(), strict=True))
    kinds = {"jacobian": "J", "inertia-matrix": "D", "gravity": "g"}
    asked = [{"find": kind, "evaluate": point} for kind in kinds]
    sheet = derive.loads(
        json.dumps({"title": "S", "problems": [{"robot": "mimics.urdf", "questions": asked}]}),
        ROBOTS / "s.yaml",
    )
    for question, key in zip(sheet.problems[0].questions, kinds.values(), strict=True):
        found = question.answer.evaluated[key]
        np.testing.assert_allclose(np.ravel(found), np.ravel(given[key]), atol=1e-12)


@pytest.mark.parametrize("path", OUT, ids=lambda path: path.stem)
def test_what_is_written_as_urdf_is_the_same_robot(path: Path, tmp_path: Path) -> None:
    robot = read(path) if path.suffix == ".urdf" else built(At(read_yaml(path)))
    names = {name for tree in expressions(robot) for name in free_symbols(tree)} - {"pi", *robot.variables}
    random = Random(path.stem)
    values = {name: random.uniform(0.2, 1) for name in sorted(names)}
    (tmp_path / "out.urdf").write_text(as_urdf(path, values)[0])
    again = read(tmp_path / "out.urdf")
    q = [random.uniform(-1, 1) for _ in robot.variables]
    before = numbers(robot, dict(zip(robot.variables, q, strict=True)) | values)
    after = numbers(again, dict(zip(again.variables, q, strict=True)))
    for key in "TJ" if any(link.motor for link in robot.links) else before:  # URDF has neither rotors
        if key != "g" or path.suffix == ".urdf":  # nor a gravity of its own
            np.testing.assert_allclose(after[key], before[key], atol=2e-9, err_msg=key)


def test_an_arm_may_begin_and_end_within_a_robot() -> None:
    """Behind joint 3 of the Panda D is that of the whole, however the joints before stand."""
    given = FOUND["panda"]
    robot = read(ROBOTS / "panda.urdf", Wish(base="panda_link3", tip="panda_link7"))
    D = numbers(robot, dict(zip(robot.variables, list(given["q"].values())[3:], strict=True)))["D"]
    np.testing.assert_allclose(D, np.array(given["D"])[3:, 3:], atol=1e-9)
