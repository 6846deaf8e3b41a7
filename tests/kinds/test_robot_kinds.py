"""The kinds of robots: names and shapes of the results, options, and what cannot be derived."""

from __future__ import annotations

import json
import math
from itertools import product
from pathlib import Path
from typing import Any

import pytest
import sympy

from derive.algebra.infix import text
from derive.build import derive_all
from derive.errors import NotDerivable, SheetErrors
from derive.sheet.load import load_sheet
from derive.writing import render
from tests.mechanics.robots import body, problem, robot, row

TWO_LINKS = """\
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 0, mass: m1, com: center, inertia: {rod: a1, axis: x}}
    - {theta: theta2*, d: 0, a: a2, alpha: 0, mass: m2, com: center, inertia: {rod: a2, axis: x}}
"""
STANFORD = "    links:\n" + "".join(
    f"    - {{theta: {theta}, d: {d}, a: 0, alpha: {alpha}}}\n"
    for theta, d, alpha in (
        ("theta1*", "0", "-90 deg"), ("theta2*", "d2", "90 deg"), ("0", "d3*", "0"),
        ("theta4*", "0", "-90 deg"), ("theta5*", "0", "90 deg"), ("theta6*", "0", "0"),
    )
)  # fmt: skip


def asked(tmp_path: Path, question: str, arm: str = TWO_LINKS, more: str = "") -> dict[str, Any]:
    """The question's part of the JSON."""
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(f"title: A test\n{more}problems:\n- robot:\n{arm}  {question}\n", encoding="utf-8")
    (document,) = derive_all([load_sheet(sheet)], True, lambda _: None)
    return json.loads(render(document, "json"))["problems"][0]["questions"][0]


def shape(found: Any) -> tuple[int, ...]:
    return (len(found), *shape(found[0])) if isinstance(found, list) else ()


@pytest.mark.parametrize(
    ("kind", "shapes"),
    [
        ("dh-table", {"DH": (2, 4)}),
        ("forward-kinematics", {"T_1^0": (4, 4), "T_2^1": (4, 4), "T_2^0": (4, 4)}),
        ("jacobian", {"J": (6, 2)}),
        ("velocity", {"v": (3,), "omega": (3,)}),
        ("inertia-matrix", {"D": (2, 2), "J_v1": (3, 2), "J_w1": (3, 2), "J_v2": (3, 2), "J_w2": (3, 2)}),
        ("christoffel", {f"c_{i}{j}{k}": () for i, j, k in product((1, 2), repeat=3)}),
        ("gravity", {"P": (), "g": (2,)}),
    ],
)
def test_names_and_shapes(tmp_path, kind, shapes) -> None:
    found = asked(tmp_path, f"find: {kind}")
    assert found["find"] == kind
    assert {name: shape(value) for name, value in found["results"].items()} == shapes
    assert all(check["holds"] for check in found["checks"])


def test_dynamics_has_all_of_them(tmp_path) -> None:
    symbols = {f"c_{i}{j}{k}" for i, j, k in product((1, 2), repeat=3)}
    found = asked(tmp_path, "find: dynamics")["results"]
    assert set(found) == {"D", "P", "g", "tau", *symbols}
    assert shape(found["tau"]) == (2,)
    assert "theta1_ddot" in found["tau"][0]


def test_every_scalar_is_read_by_sympy(tmp_path) -> None:
    for entry in asked(tmp_path, "find: dynamics")["results"]["tau"]:
        assert "c_1" not in entry
        assert sympy.sympify(entry, locals={"g": sympy.Symbol("g")}).free_symbols


def test_the_frame_to_which(tmp_path) -> None:
    found = asked(tmp_path, "find: forward-kinematics\n  to: 2", STANFORD)["results"]
    assert list(found) == ["T_1^0", "T_2^1", "T_2^0"]
    with pytest.raises(SheetErrors):
        asked(tmp_path, "find: forward-kinematics\n  to: 7", STANFORD)


def test_the_tool_counts_in_the_last_pose(tmp_path) -> None:
    arm = TWO_LINKS + "    tool: [{translate: x, by: b}]\n"
    found = asked(tmp_path, "find: forward-kinematics", arm)["results"]
    bare = asked(tmp_path, "find: forward-kinematics")["results"]
    assert "b" in found["T_2^0"][0][3]
    assert found["T_2^1"] == bare["T_2^1"]


def test_the_base_comes_first(tmp_path) -> None:
    arm = TWO_LINKS + "    base: [{translate: z, by: h}]\n"
    assert asked(tmp_path, "find: forward-kinematics", arm)["results"]["T_2^0"][2][3] == "h"


def test_rows_come_in_the_order_asked_for(tmp_path) -> None:
    whole = asked(tmp_path, "find: jacobian")["results"]["J"]
    found = asked(tmp_path, "find: jacobian\n  rows: [wz, vx]")["results"]["J"]
    assert found == [whole[5], whole[0]]


@pytest.mark.parametrize("point", ["{link: 1, at: [-a1/2, 0, 0]}", "{frame: 1}", "{link: 2, at: [b, c, d]}"])
def test_a_point_of_a_link(tmp_path, point) -> None:
    """Each column is the derivative of the position by its joint."""
    J = asked(tmp_path, f"find: jacobian\n  point: {point}")["results"]["J"]
    x, y = planar(point)
    for column, name in enumerate(("theta1", "theta2")):
        for entry, position in ((J[0][column], x), (J[1][column], y)):
            difference = sympy.sympify(entry) - sympy.diff(sympy.sympify(position), name)
            assert is_zero(difference)


def planar(point: str) -> tuple[str, str]:
    if "b, c, d" in point:
        return (
            "a1*cos(theta1) + (a2 + b)*cos(theta1 + theta2) - c*sin(theta1 + theta2)",
            "a1*sin(theta1) + (a2 + b)*sin(theta1 + theta2) + c*cos(theta1 + theta2)",
        )
    half = "/2" if "at" in point else ""
    return f"a1*cos(theta1){half}", f"a1*sin(theta1){half}"


def symbols_of(entry: str) -> set[sympy.Symbol]:
    return sympy.sympify(entry).free_symbols


def is_zero(expr: sympy.Expr) -> bool:
    names = sorted(map(str, expr.free_symbols))
    values = {name: 0.3 + 0.37 * k for k, name in enumerate(names)}
    return abs(complex(expr.subs(values).evalf())) < 1e-12


def test_a_joint_beyond_the_point_gives_a_zero_column(tmp_path) -> None:
    J = asked(tmp_path, "find: jacobian\n  point: {frame: 1}")["results"]["J"]
    assert [line[1] for line in J] == ["0"] * 6


def test_the_jacobian_in_the_tool(tmp_path) -> None:
    """R^T J: the planar arm seen from its last link."""
    J = asked(tmp_path, "find: jacobian\n  in: tool")["results"]["J"]
    published = [["a1*sin(theta2)", "0"], ["a2 + a1*cos(theta2)", "a2"]]
    for ours, theirs in zip(J[:2], published, strict=True):
        for a, b in zip(ours, theirs, strict=True):
            assert is_zero(sympy.sympify(a) - sympy.sympify(b))
    assert J[5] == ["1", "1"]


def test_where_is_replaced_in_the_results(tmp_path) -> None:
    more = "where: {a1: L, a2: L/2}\n"
    found = asked(tmp_path, "find: jacobian", more=more)
    names = {str(name) for line in found["results"]["J"] for entry in line for name in symbols_of(entry)}
    assert names == {"L", "theta1", "theta2"}
    assert all(check["holds"] for check in found["checks"])


def test_evaluated_mirrors_the_results(tmp_path) -> None:
    found = asked(tmp_path, "find: jacobian\n  evaluate: {theta1: 30 deg, theta2: 60 deg, a1: 1, a2: 2}")
    assert shape(found["evaluated"]["J"]) == shape(found["results"]["J"])
    assert math.isclose(found["evaluated"]["J"][0][0], -2.5)
    assert math.isclose(found["evaluated"]["J"][1][1], 0, abs_tol=1e-12)


def test_a_value_that_is_missing(tmp_path) -> None:
    with pytest.raises(SheetErrors) as raised:
        asked(tmp_path, "find: jacobian\n  evaluate: true")
    assert "no value is known for" in raised.value.errors[0].message


def test_rates_belong_to_the_velocity(tmp_path) -> None:
    found = asked(tmp_path, "find: velocity")["results"]
    assert found["omega"] == ["0", "0", "theta1_dot + theta2_dot"]
    assert "theta1_dot" in found["v"][0]


# -- the inverse of the planar arm ---------------------------------------------------------------------


def test_both_elbows_reach_the_point(tmp_path) -> None:
    found = asked(tmp_path, "find: inverse-kinematics\n  given: [x, y]")["results"]["solutions"]
    assert len(found) == 2
    assert all(branch["when"] for branch in found)
    at = {"x": 0.9, "y": 0.7, "a1": 1.0, "a2": 0.8}
    angles = [
        [float(sympy.sympify(branch[name]).subs(at)) for name in ("theta1", "theta2")] for branch in found
    ]
    for first, second in angles:
        assert math.isclose(math.cos(first) + 0.8 * math.cos(first + second), 0.9, abs_tol=1e-12)
        assert math.isclose(math.sin(first) + 0.8 * math.sin(first + second), 0.7, abs_tol=1e-12)
    assert angles[0][1] * angles[1][1] < 0


def test_an_arm_without_a_closed_form() -> None:
    spatial = robot(row("x*", "0", "0", "90 deg"), row("y*", "0", "a2", "0"))
    with pytest.raises(NotDerivable):
        problem(spatial).ask("inverse-kinematics")


# -- what cannot be derived ----------------------------------------------------------------------------


def test_a_point_on_a_link_that_is_not_there() -> None:
    with pytest.raises(NotDerivable, match="the arm has 1 row"):
        problem(robot(row("x*", "0", "a", "0"))).ask("jacobian", point={"link": 3})


def test_a_free_row_has_its_parameters_found(tmp_path) -> None:
    arm = "    links:\n    - {motion: [{rotate: z, by: theta1*}, {translate: x, by: a1}]}\n"
    assert shape(asked(tmp_path, "find: forward-kinematics", arm)["results"]["T_1^0"]) == (4, 4)
    assert asked(tmp_path, "find: dh-table", arm)["results"] == {"DH": [["theta1", "0", "a1", "0"]]}


@pytest.mark.parametrize("kind", ["inertia-matrix", "christoffel", "gravity", "dynamics"])
def test_dynamics_needs_masses(tmp_path, kind) -> None:
    with pytest.raises(SheetErrors) as raised:
        asked(tmp_path, f"find: {kind}", STANFORD)
    assert any("mass" in f"{error.message} {error.hint}" for error in raised.value.errors)


# -- ways of saying the same ---------------------------------------------------------------------------


def test_conventions_are_two() -> None:
    rows = (row("x*", "d", "a", "90 deg"), row("y*", "0", "b", "0"))
    poses = [
        problem(robot(*rows, convention=c)).ask("forward-kinematics").results
        for c in ("standard", "modified")
    ]
    assert poses[0]["T_1^0"] != poses[1]["T_1^0"]


@pytest.mark.parametrize(
    ("inertia", "moments"),
    [
        ("{rod: b, axis: x}", "0, m*b^2/12, m*b^2/12, 0, 0, 0"),
        ("{box: [b, c, d]}", "m*(c^2 + d^2)/12, m*(b^2 + d^2)/12, m*(b^2 + c^2)/12, 0, 0, 0"),
        (
            "{cylinder: {radius: b, length: h}, axis: z}",
            "m*(3 b^2 + h^2)/12, m*(3 b^2 + h^2)/12, m*b^2/2, 0, 0, 0",
        ),
        ("{sphere: b}", "2/5 m*b^2, 2/5 m*b^2, 2/5 m*b^2, 0, 0, 0"),
        ("point", "0, 0, 0, 0, 0, 0"),
    ],
)  # fmt: skip
def test_shapes_are_their_moments(tmp_path, inertia, moments) -> None:
    link = f"{{theta: x*, d: 0, a: a, alpha: 90 deg, mass: m, com: [e, 0, 0], inertia: {inertia}}}"
    turned = "{theta: y*, d: 0, a: 0, alpha: 0, mass: M, com: [0, 0, 0], inertia: point}"
    arm = f"    links:\n    - {link}\n    - {turned}\n"
    found = asked(tmp_path, "find: inertia-matrix", arm)["results"]["D"]
    first = row("x*", "0", "a", "90 deg", body("m", "e, 0, 0", moments))
    second = row("y*", "0", "0", "0", body("M", "0, 0, 0", "0, 0, 0, 0, 0, 0"))
    same = problem(robot(first, second)).ask("inertia-matrix").results["D"]
    assert is_zero(sympy.sympify(found[0][0]) - sympy.sympify(text(same.rows[0][0])))


def test_a_question_is_derived_once() -> None:
    arm = robot(row("x*", "0", "a", "0", body("m", "0, 0, 0", "0, 0, I, 0, 0, 0")))
    one = problem(arm)
    assert one.ask("dynamics") is one.ask("dynamics")
    assert one.ask("inertia-matrix") in one.ask("dynamics").uses
