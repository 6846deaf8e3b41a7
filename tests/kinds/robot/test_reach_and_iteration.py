"""Workspaces and numerical inverse kinematics, as an author asks for them."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

from derive.algebra.infix import text
from derive.algebra.numbers.floats import number
from derive.build import derive_all
from derive.errors import NotDerivable, SheetErrors
from derive.render.phrases import spoken
from derive.sheet.load import load_sheet
from derive.writing import render
from tests.kinds.robot.test_singularities import ELBOW, PUMA, SCARA, STANFORD, THREE_R, TWO_R, arm
from tests.mechanics.robots import problem

ONE_BY_ONE = "    links:\n" + "".join(
    f"    - {{theta: theta{k}*, d: 0, a: 1, alpha: 0}}\n" for k in (1, 2)
)  # fmt: skip


def asked(tmp_path: Path, question: str, more: str = "") -> dict[str, Any]:
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(
        f"title: A test\nproblems:\n- robot:\n{ONE_BY_ONE}  {question}\n{more}", encoding="utf-8"
    )
    (document,) = derive_all([load_sheet(sheet)], True, lambda _: None)
    render(document, "md")
    return json.loads(render(document, "json"))["problems"][0]["questions"][0]


def test_the_annulus_of_two_links() -> None:
    found = problem(arm(TWO_R)).ask("workspace").results
    assert (text(found["r_min"]), text(found["r_max"])) == ("Abs(l1 - l2)", "l1 + l2")


@pytest.mark.parametrize(
    ("lengths", "hole"), [((3, 1, 1), 1), ((1, 1, 1), 0), ((1, 1, 3), 1), ((2, 5, 2), 1), ((2, 2, 4), 0)]
)
def test_three_links_leave_a_hole_only_under_a_long_one(lengths, hole) -> None:
    rows = [(f"q{k}*", "0", str(length), "0") for k, length in enumerate(lengths, 1)]
    found = problem(arm(rows)).ask("workspace")
    assert number(found.results["r_min"], {}) == hole
    assert number(found.results["r_max"], {}) == sum(lengths)
    assert all(claim.holds for claim in found.claims)
    symbolic = problem(arm(THREE_R)).ask("workspace").results["r_min"]
    assert number(symbolic, dict(zip(("l1", "l2", "l3"), lengths, strict=True))) == hole


@pytest.mark.parametrize(
    ("a", "swung", "told"),
    [
        (("0", "0", "a3"), False, ("a3", "a3")),
        (("a1", "0", "a3"), False, ("Abs(a1 - a3)", "a1 + a3")),
        (("0", "a2", "0", "a4"), True, ("Abs(a2 - a4)", "a2 + a4")),
    ],
)
def test_axes_that_coincide_are_one(a: tuple[str, ...], swung: bool, told: tuple[str, str]) -> None:
    twists = ["90 deg" if swung and k == 1 else "0" for k, _ in enumerate(a, 1)]
    rows = [(f"q{k}*", "0", *each) for k, each in enumerate(zip(a, twists, strict=True), 1)]
    found = problem(arm(rows)).ask("workspace")
    assert (text(found.results["r_min"]), text(found.results["r_max"])) == told
    assert all(claim.holds for claim in found.claims)


@pytest.mark.parametrize("offset", ["0", "a1"])
def test_a_joint_that_only_repeats_another_is_to_be_left_out(offset: str) -> None:
    rows = [("q1*", "0", offset, "90 deg"), ("q2*", "0", "0", "0"), ("q3*", "0", "a3", "0")]
    with pytest.raises(NotDerivable, match="one of q1, q2, q3 only repeats what the others do"):
        problem(arm(rows)).ask("workspace")


def test_a_void_is_closed_where_its_border_only_comes_to_the_axis() -> None:
    rows = [("q1*", "0", "0", "90 deg"), ("q2*", "0", "0.1", "-90 deg"), ("q3*", "0", "0.3", "0")]
    found = problem(arm(rows)).ask("workspace", evaluate=())
    assert all(claim.holds for claim in found.claims)
    assert "section-void" in {claim.key for claim in found.claims}


def test_the_hollow_ball_of_the_anthropomorphic_arm() -> None:
    found = problem(arm(ELBOW)).ask("workspace").results
    assert (text(found["r_min"]), text(found["r_max"])) == ("Abs(a2 - a3)", "a2 + a3")
    assert spoken("robot", "workspace").say(found["description"]) == "a spherical shell about the shoulder"


def test_an_arm_that_is_neither_is_refused() -> None:
    with pytest.raises(NotDerivable, match="neither"):
        problem(arm(STANFORD)).ask("workspace")


def test_newton_finds_the_closed_form(tmp_path) -> None:
    question = (
        "find: numerical-inverse-kinematics\n  target: [1.2, 0.8]\n  start: {theta1: 0, theta2: 60 deg}"
    )
    found = asked(tmp_path, question)
    theta1, theta2 = found["evaluated"]["solution"]
    expected = math.acos((1.2**2 + 0.8**2 - 2) / 2)
    assert theta2 == pytest.approx(expected)
    assert theta1 == pytest.approx(math.atan2(0.8, 1.2) - expected / 2)
    assert len(found["results"]["iterations"]) == len(found["evaluated"]["iterations"]) == 5
    assert found["evaluated"]["iterations"][0][:3] == [0, 0.0, pytest.approx(math.pi / 3)]
    assert all(check["holds"] for check in found["checks"])


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ("target: [1, 1]\n  start: {theta1: 0}", "no value to theta2"),
        (
            "target: [1, 1]\n  start: {theta1: 0, theta2: 1, theta9: 0}",
            "'theta9' under start is no joint variable",
        ),
        ("target: [1]\n  start: {theta1: 0, theta2: 1}", "a target of 1 coordinate"),
        ("target: [x, 1]\n  start: {theta1: 0, theta2: 1}", "no value is known for x"),
    ],
)
def test_what_is_missing_is_said(tmp_path, options: str, said: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        asked(tmp_path, f"find: numerical-inverse-kinematics\n  {options}")
    assert said in str(caught.value.errors[0])


def test_a_target_with_an_angle(tmp_path) -> None:
    rows = [(f"q{k}*", "0", "1", "0") for k in (1, 2, 3)]
    from derive.expression import number as exact

    start = (("q1", exact("1/10")), ("q2", exact("1/2")), ("q3", exact("3/10")))
    target = (exact("3/2"), exact(1), exact("3/2"))
    found = problem(arm(rows)).ask("numerical-inverse-kinematics", target=target, start=start, iterations=30)
    q = found.evaluated["solution"]
    assert sum(q) == pytest.approx(1.5)
    sums = [q[0], q[0] + q[1], sum(q)]
    assert (sum(map(math.cos, sums)), sum(map(math.sin, sums))) == pytest.approx((1.5, 1))


@pytest.mark.parametrize(
    ("rows", "r_min", "r_max", "description"),
    [
        (SCARA, "Abs(a1 - a2)", "a1 + a2", "a hollow cylinder about the first axis"),
        (
            PUMA,
            "sqrt((a2 - sqrt(a3**2 + d4**2))**2 + d3**2)",
            "sqrt((a2 + sqrt(a3**2 + d4**2))**2 + d3**2)",
            "a spherical shell about the shoulder, bored through along the first axis",
        ),
    ],
)
def test_joints_that_do_not_move_the_point_are_left_out(rows, r_min, r_max, description) -> None:
    found = problem(arm(rows)).ask("workspace")
    assert (text(found.results["r_min"]), text(found.results["r_max"])) == (r_min, r_max)
    assert spoken("robot", "workspace").say(found.results["description"]) == description
    assert found.facts.orientations.key.startswith("both-the-same")
    assert all(claim.holds for claim in found.claims)
