"""Three hundred random sheets against plain NumPy: results as formulas, results as numbers."""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from derive.build import build
from tests import random_sheets as plain
from tests.random_sheets import Dice, Drawn, Point

ARMS, MOTIONS, A_BLOCK = 240, 60, 20
EULER = ("ZYX", "ZYZ", "XYZ", "ZXZ", "xyz", "zyx", "YXZ")


@pytest.mark.parametrize("block", range(ARMS // A_BLOCK))
def test_arms(block: int, tmp_path: Path) -> None:
    for seed in range(block * A_BLOCK, (block + 1) * A_BLOCK):
        check_arm(seed, tmp_path)


@pytest.mark.parametrize("block", range(MOTIONS // A_BLOCK))
def test_motions(block: int, tmp_path: Path) -> None:
    for seed in range(block * A_BLOCK, (block + 1) * A_BLOCK):
        check_motion(seed, tmp_path)


def check_arm(seed: int, folder: Path) -> None:
    dice = Dice(random.Random(f"arm {seed}"))
    bodies = dice.one(True, False)
    drawn = plain.robot(dice, dice.roll.randrange(1, 4 if bodies else 6), bodies)
    at = point(dice, drawn)
    kinds = ["forward-kinematics", "jacobian"]
    kinds += ["inertia-matrix", "gravity", "dynamics"] if bodies else []
    found = answers(drawn.robot, "robot", [{"find": kind, "evaluate": at} for kind in kinds], seed, folder)
    arm, names = drawn.robot, drawn.variables
    T, J = np.real(plain.poses(arm, at)[-2]), plain.jacobian(arm, names, at)
    agree(found["forward-kinematics"], f"T_{len(arm['links'])}^0", T, at, seed)
    agree(found["jacobian"], "J", J, at, seed)
    if bodies:
        agree(found["inertia-matrix"], "D", plain.inertia(arm, names, at), at, seed)
        agree(found["gravity"], "g", plain.weight(arm, names, at), at, seed)
        agree(found["dynamics"], "tau", plain.torques(arm, names, at), at, seed)


def check_motion(seed: int, folder: Path) -> None:
    dice = Dice(random.Random(f"motion {seed}"))
    steps = [_step(dice, k) for k in range(dice.roll.randrange(1, 5))]
    convention = dice.one(*EULER)
    at = {"phi": dice.roll.uniform(-3, 3), "b": dice.roll.uniform(0.1, 1)}
    questions = [
        {"find": "transform", "evaluate": at},
        {"find": "euler-angles", "convention": convention, "evaluate": at},
        {"find": "quaternion", "evaluate": at},
    ]
    found = answers(steps, "motion", questions, seed, folder)
    T = np.eye(4)
    for step in steps:
        own = np.real(plain.move(step, at))
        T = own @ T if step.get("about") == "world" else T @ own
    agree(found["transform"], "T", T, at, seed)
    R = Rotation.from_matrix(T[:3, :3])
    q = np.array(found["quaternion"]["evaluated"]["q"], dtype=float)
    wanted = R.as_quat(scalar_first=True)
    assert min(np.abs(q - wanted).max(), np.abs(q + wanted).max()) < 1e-7, seed
    for branch in found["euler-angles"]["evaluated"]["solutions"]:
        if branch.get("real", True):
            angles = [branch[name] for name in list(branch) if name != "when"][:3]
            if all(isinstance(angle, float | int) for angle in angles):
                assert np.allclose(Rotation.from_euler(convention, angles).as_matrix(), T[:3, :3]), seed


def _step(dice: Dice, k: int) -> dict[str, Any]:
    about = {"about": "world"} if dice.roll.random() < 0.4 else {}
    if dice.roll.random() < 0.25:
        return {"translate": dice.one("x", "y", "z"), "by": dice.one("b", dice.decimal(-1, 1)), **about}
    return {"rotate": dice.axis(), "by": dice.one("phi", *(dice.angle() for _ in range(4))), **about}


def point(dice: Dice, drawn: Drawn) -> Point:
    """A value for every letter, rates and accelerations included."""
    found: Point = dict(drawn.letters)
    for name in drawn.variables:
        for suffix in ("", "_dot", "_ddot"):
            found[name + suffix] = round(dice.roll.uniform(0.2, 1.4), 4)
    return found


def answers(subject: Any, name: str, questions: list[Any], seed: int, folder: Path) -> dict[str, Any]:
    sheet = folder / f"{name}{seed}.yaml"
    problem = {name: subject, "questions": questions}
    sheet.write_text(json.dumps({"title": f"Sheet {seed}", "problems": [problem]}), encoding="utf-8")
    (page,) = build([sheet], ["json"], None)
    return {found["find"]: found for found in json.loads(str(page))["problems"][0]["questions"]}


def agree(question: dict[str, Any], name: str, wanted: Any, at: Point, seed: int) -> None:
    """The formula and the number, both against NumPy."""
    scale = max(1.0, float(np.abs(wanted).max()))
    as_number = np.array(question["evaluated"][name], dtype=float)
    as_formula = np.array(_values(question["results"][name], at), dtype=float)
    for got in (as_number, as_formula):
        assert got.shape == np.shape(wanted), (seed, name)
        assert np.abs(got - wanted).max() < 1e-6 * scale, (seed, name, got, wanted)


def _values(formulas: Any, at: Point) -> Any:
    if isinstance(formulas, list):
        return [_values(entry, at) for entry in formulas]
    return np.real(plain.value(formulas, at))


def test_eleven_joints(tmp_path: Path) -> None:
    """c_1,1,11 and c_1,11,1 are two symbols; run together they were one, and the last torque was wrong."""
    heavy = {"mass": "m", "com": ["0.1", 0, 0], "inertia": [0, 0, "0.2"]}
    light = {"mass": 0, "com": [0, 0, 0], "inertia": "point"}
    rows = [
        {"theta": f"q{i}*", "d": 0, "a": "0.3", "alpha": 0, **(heavy if i in (1, 11) else light)}
        for i in range(1, 12)
    ]
    drawn = Drawn({"convention": plain.STANDARD, "links": rows, "gravity": [0, "-g", 0]})
    drawn.variables, drawn.letters = [f"q{i}" for i in range(1, 12)], {"m": 1.3, "g": 9.81}
    at = point(Dice(random.Random("eleven")), drawn)
    found = answers(drawn.robot, "robot", [{"find": "dynamics", "evaluate": at}], 11, tmp_path)
    agree(found["dynamics"], "tau", plain.torques(drawn.robot, drawn.variables, at), at, 11)
