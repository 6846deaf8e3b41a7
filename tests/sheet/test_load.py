"""Sheets that are right: every subject of the language as the values the kinds work on."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from derive.control.system import System
from derive.errors import SheetErrors
from derive.expression import ZERO, Degrees, Number, Quotient, Symbol, number
from derive.mechanics.bodies import Box, Cylinder, Moments, PointMass, Rod, Sphere
from derive.mechanics.frames import ByMatrix, Frames, Observed
from derive.mechanics.motion import Motion, Move
from derive.mechanics.robot import DHRow, FreeRow, Robot
from derive.sheet.load import load_sheet
from derive.sheet.model import Problem, Sheet


def load(text: str, folder: Path) -> Sheet:
    path = folder / "sheet.yaml"
    path.write_text(text, encoding="utf-8")
    return load_sheet(path)


def only(subject: str, folder: Path) -> Problem:
    return load(f"title: A sheet\nproblems:\n- {subject}\n  find: transform\n", folder).problems[0]


def test_the_top(tmp_path: Path) -> None:
    sheet = load(
        """
title: Week 3
date: September 2023
marks: false
notation: {atan2: xy, digits: 4}
symbols: {m: positive}
where: {L_c: L/2, k: 2*m}
problems:
- where: {L: 50 cm}
  motion: [{rotate: x, by: phi}]
  questions:
  - {find: transform, marks: 10, hint: Think., text: 'Find $T$.', evaluate: {phi: 30 deg, L: 0.5 m}}
  - {find: transform, evaluate: true}
""",
        tmp_path,
    )
    assert (sheet.title, sheet.date, sheet.marks, sheet.notation.atan2) == (
        "Week 3",
        "September 2023",
        False,
        "xy",
    )
    (problem,) = sheet.problems
    assert problem.where["L_c"] == Quotient(Symbol("L"), number(2))
    assert problem.where["L"] == number("1/2", True)
    assert problem.assumptions == {"m": "positive"}
    first, second = problem.questions
    assert (first.marks, first.hint, first.text) == (10, "Think.", "Find $T$.")
    assert first.evaluate == {"phi": Degrees(Fraction(30)), "L": Number(Fraction(1, 2), decimal=True)}
    assert second.evaluate == {}


def test_motion(tmp_path: Path) -> None:
    motion = "motion: [{rotate: x, by: alpha, about: world}, {translate: [1, 1, 0], by: 100 mm}]"
    one = number(1)
    assert only(motion, tmp_path).subject == Motion(
        (
            Move("rotate", "x", Symbol("alpha"), "world"),
            Move("translate", (one, one, ZERO), number("1/10", True), "current"),
        )
    )


def test_frames(tmp_path: Path) -> None:
    frames = """frames:
  - {x: -x0, y: -z0, z: -y0, origin: [0, c + e, a - d]}
  - {x: 0.6*x1 - 0.8*y1, y: 0.8*x1 + 0.6*y1, z: z1}
  - {matrix: [[0, -1, 0], [1, 0, 0], [0, 0, 1]], in: 0}
  - {x: cos(t)*x3 + sin(t)*y3, y: cos(t)*y3 - sin(t)*x3, z: z3}
  - {motion: [{rotate: z, by: theta}]}"""
    subject = only(frames, tmp_path).subject
    assert isinstance(subject, Frames)
    assert [frame.parent for frame in subject.frames] == [0, 1, 0, 3, 4]
    first, second = subject.frames[0].source, subject.frames[1].source
    assert isinstance(first, Observed)
    assert isinstance(second, Observed)
    assert first.y == (ZERO, ZERO, number(-1))
    assert second.x == (Number(Fraction(3, 5), True), Number(Fraction(-4, 5), True), ZERO)
    assert isinstance(subject.frames[2].source, ByMatrix)


ROBOT = """robot:
    name: An arm
    convention: modified
    links:
    - {theta: theta1* + 90 deg, d: 0, a: 0, alpha: 0, mass: m, com: center, inertia: point}
    - {theta: 0, d: d2*, a: 0, alpha: 0, mass: 2*m, com: [0, 0, 1], inertia: {box: [L, L/10, L/10]}}
    - {motion: [{rotate: z, by: q3*}, {translate: x, by: 1 m}],
       mass: m, com: center, inertia: {rod: L, axis: x}}
    - {theta: q4*, d: 0, a: 0, alpha: 0, mass: m, com: center, inertia: [a, b, c]}
    - {theta: q5*, d: 0, a: 0, alpha: 0, mass: m, com: center,
       inertia: {cylinder: {radius: r, length: h}, axis: z}}
    - {theta: 0, d: h, a: 0, alpha: 0, mass: m, com: center, inertia: {sphere: r}}
    tool: [{translate: z, by: d6}]
    gravity: [0, 0, -g]"""


def test_robot(tmp_path: Path) -> None:
    robot = only(ROBOT, tmp_path).subject
    assert isinstance(robot, Robot)
    assert robot.variables == ("theta1", "d2", "q3", "q4", "q5")
    assert [link.joint for link in robot.links] == [
        "revolute", "prismatic", "revolute", "revolute", "revolute", "fixed",
    ]  # fmt: skip
    assert isinstance(robot.links[0].row, DHRow)
    assert isinstance(robot.links[2].row, FreeRow)
    bodies = [type(link.body.inertia) for link in robot.links if link.body]
    assert bodies == [PointMass, Box, Rod, Moments, Cylinder, Sphere]
    assert robot.tool == (Move("translate", "z", Symbol("d6")),)


@pytest.mark.parametrize("top", ["", "robot:\n  "])
def test_robot_of_a_file(top: str, tmp_path: Path) -> None:
    (tmp_path / "robots").mkdir()
    row = "links: [{theta: q*, d: 0, a: 0, alpha: 0}]\n"
    (tmp_path / "robots" / "arm.yaml").write_text(top + row, encoding="utf-8")
    assert only("robot: robots/arm.yaml", tmp_path).subject.variables == ("q",)


def test_system(tmp_path: Path) -> None:
    text = 'system: {equations: ["V = R*I", "T = K*I + T_d"], input: V, output: T, disturbance: T_d}'
    system = only(text, tmp_path).subject
    assert isinstance(system, System)
    assert (system.input, system.output, system.disturbance) == (Symbol("V"), Symbol("T"), Symbol("T_d"))


@pytest.mark.parametrize(("control", "count"), [("armature", 5), ("field", 4)])
@pytest.mark.parametrize(("output", "signal"), [("angle", "theta"), ("speed", "omega")])
def test_motor(control: str, count: int, output: str, signal: str, tmp_path: Path) -> None:
    system = only(f"motor: {{control: {control}, output: {output}}}", tmp_path).subject
    assert len(system.equations) == count
    assert system.output == Symbol(signal)
    assert system.motor == (control, output)


def test_options_know_the_declared_names(tmp_path: Path) -> None:
    sheet = load(
        f"title: A sheet\nsymbols: {{m: positive}}\nproblems:\n- {ROBOT}\n"
        "  find: jacobian\n  at: [2 m, 100 mm, 0]\n  in: 2\n",
        tmp_path,
    )
    options = sheet.problems[0].questions[0].options
    assert options.at[1] == number("1/10", True)
    assert options.at[0] == number(2)  # a length is wanted, so m is the metre
    assert options.frame == 2


def test_links_that_lead_in_a_circle(tmp_path: Path) -> None:
    (tmp_path / "one.yaml").symlink_to("two.yaml")
    (tmp_path / "two.yaml").symlink_to("one.yaml")
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text("title: t\nproblems:\n- robot: one.yaml\n  find: jacobian\n")
    with pytest.raises(SheetErrors) as caught:
        load_sheet(sheet)
    assert [error.message for error in caught.value.errors] == ["one.yaml is no ordinary file"]
