"""Screws against Lynch and Park, Modern Robotics (2017): its worked examples, and the examples that document
the functions of its code library. Twists there have the angular part first; here the linear part is first."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from derive.algebra.numbers.floats import numbers
from derive.build import assemble
from derive.derivation import Derivation
from derive.errors import SheetErrors
from derive.expression import free_symbols
from derive.sheet.load import load_sheet
from tests.kinds.published import matrix, same

MIXED = """
    - {screw: {axis: z, through: [0, 4, 0]}, variable: theta1*}
    - {screw: {slide: y}, variable: d2*}
    - {screw: {axis: [0, 0, -1], through: [0, 6, 0], pitch: 0.1}, variable: theta3*}
    home: [[-1, 0, 0, 0], [0, 1, 0, 6], [0, 0, -1, 2], [0, 0, 0, 1]]
"""
# v = (0, 0.2, 0.2), (2, 0, 3), (0, 2, 1), (0.2, 0.3, 0.4) with w = z, x, y, x: q = w x v and h = w . v
HELICES = """
    - {screw: {axis: z, through: [-0.2, 0, 0], pitch: 0.2}, variable: q1*}
    - {screw: {axis: x, through: [0, -3, 0], pitch: 2}, variable: q2*}
    - {screw: {axis: y, through: [1, 0, 0], pitch: 2}, variable: q3*}
    - {screw: {axis: x, through: [0, -0.4, 0.3], pitch: 0.2}, variable: q4*}
"""
UR5 = """
    - {screw: {axis: z, through: [0, 0, 0]}, variable: theta1*}
    - {screw: {axis: y, through: [0, 0, H_1]}, variable: theta2*}
    - {screw: {axis: y, through: [L_1, 0, H_1]}, variable: theta3*}
    - {screw: {axis: y, through: [L_1 + L_2, 0, H_1]}, variable: theta4*}
    - {screw: {axis: [0, 0, -1], through: [L_1 + L_2, W_1, 0]}, variable: theta5*}
    - {screw: {axis: y, through: [L_1 + L_2, 0, H_1 - H_2]}, variable: theta6*}
    home: [[-1, 0, 0, L_1 + L_2], [0, 0, 1, W_1 + W_2], [0, 1, 0, H_1 - H_2], [0, 0, 0, 1]]
"""
SPATIAL = """
    - {screw: {axis: z, through: [0, 0, 0]}, variable: theta1*}
    - {screw: {axis: [0, -1, 0], through: [L_1, 0, 0]}, variable: theta2*}
    - {screw: {axis: x, through: [0, 0, -L_2]}, variable: theta3*}
    home: [[0, 0, 1, L_1], [0, 1, 0, 0], [-1, 0, 0, -L_2], [0, 0, 0, 1]]
"""
SCARA = """
    - {screw: {axis: z, through: [0, 0, 0]}, variable: theta1*}
    - {screw: {axis: z, through: [L_1, 0, 0]}, variable: theta2*}
    - {screw: {axis: z, through: [L_1 + L_2, 0, 0]}, variable: theta3*}
    - {screw: {slide: z}, variable: d4*}
    home: [{translate: x, by: L_1 + L_2}]
"""


def asked(folder: Path, links: str, *questions: str, name: str = "links") -> list[Derivation]:
    text = f"title: t\nproblems:\n- robot:\n    {name}:{links.rstrip()}\n  questions:\n"
    sheet = folder / "sheet.yaml"
    sheet.write_text(
        text + "".join(f"  - {{find: {question}}}\n" for question in questions), encoding="utf-8"
    )
    found = [question.derivation for _, question in assemble(load_sheet(sheet)).questions()]
    assert all(claim.holds for each in found if each for claim in each.claims)
    return [each for each in found if each]


def test_mixed_screws_as_the_documentation_of_fkinspace(tmp_path: Path) -> None:
    (found,) = asked(tmp_path, MIXED, "forward-kinematics")
    at = {"theta1": np.pi / 2, "d2": 3, "theta3": np.pi}
    expected = [[0, 1, 0, -5], [1, 0, 0, 4], [0, 0, -1, 1.68584073], [0, 0, 0, 1]]
    assert np.allclose(numbers(found.results["T_3^0"], at), expected, atol=1e-8)
    assert numbers(found.results["S_1"], {}) == [4, 0, 0, 0, 0, 1]
    assert numbers(found.results["S_2"], {}) == [0, 1, 0, 0, 0, 0]
    assert np.allclose(numbers(found.results["S_3"], {}), [-6, 0, -0.1, 0, 0, -1])


def test_jacobians_as_the_documentation_of_the_code_library(tmp_path: Path) -> None:
    space, body = asked(tmp_path, HELICES, "space-jacobian", "space-jacobian, in: body")
    at = {"q1": 0.2, "q2": 1.1, "q3": 0.1, "q4": 1.2}
    of_space = np.array(
        [
            [0, 0.98006658, -0.09011564, 0.95749426],
            [0, 0.19866933, 0.4445544, 0.28487557],
            [1, 0, 0.89120736, -0.04528405],
            [0, 1.95218638, -2.21635216, -0.51161537],
            [0.2, 0.43654132, -2.43712573, 2.77535713],
            [0.2, 2.96026613, 3.23573065, 2.22512443],
        ]
    )
    of_body = np.array(
        [
            [-0.04528405, 0.99500417, 0, 1],
            [0.74359313, 0.09304865, 0.36235775, 0],
            [-0.66709716, 0.03617541, -0.93203909, 0],
            [2.32586047, 1.66809, 0.56410831, 0.2],
            [-1.44321167, 2.94561275, 1.43306521, 0.3],
            [-2.06639565, 1.82881722, -1.58868628, 0.4],
        ]
    )
    assert np.allclose(numbers(space.results["J_s"], at), np.vstack([of_space[3:], of_space[:3]]), atol=1e-7)
    assert np.allclose(numbers(body.results["J_b"], at), np.vstack([of_body[3:], of_body[:3]]), atol=1e-7)


def test_ur5_of_example_4_5(tmp_path: Path) -> None:
    (found,) = asked(tmp_path, UR5, "forward-kinematics")
    lengths = {"W_1": 0.109, "W_2": 0.082, "L_1": 0.425, "L_2": 0.392, "H_1": 0.089, "H_2": 0.095}
    angles = {f"theta{i}": 0.0 for i in range(1, 7)} | {"theta2": -np.pi / 2, "theta5": np.pi / 2}
    expected = [[0, -1, 0, 0.095], [1, 0, 0, 0.109], [0, 0, 1, 0.988], [0, 0, 0, 1]]
    assert np.allclose(numbers(found.results["T_6^0"], {**lengths, **angles}), expected, atol=1e-3)


def test_three_joints_of_example_4_1(tmp_path: Path) -> None:
    (found,) = asked(tmp_path, SPATIAL, "forward-kinematics")
    twists = {"S_1": "0,0,0,0,0,1", "S_2": "0,0,-L_1,0,-1,0", "S_3": "0,-L_2,0,1,0,0"}
    for name, published in twists.items():
        assert same(found.results[name], matrix("\n".join(published.split(",")))), name


def test_space_jacobian_of_example_5_2(tmp_path: Path) -> None:
    (found,) = asked(tmp_path, SCARA, "space-jacobian")
    published = """
        0, L_1*sin(theta1), L_1*sin(theta1) + L_2*sin(theta1 + theta2), 0
        0, -L_1*cos(theta1), -L_1*cos(theta1) - L_2*cos(theta1 + theta2), 0
        0, 0, 0, 1
        0, 0, 0, 0
        0, 0, 0, 0
        1, 1, 1, 0
    """
    assert same(found.results["J_s"], matrix(published))


@pytest.mark.parametrize("links", [SPATIAL, SCARA, UR5], ids=["spatial", "scara", "ur5"])
def test_everything_agrees_with_the_rows_found(tmp_path: Path, links: str) -> None:
    """The rows of link parameters that are found from the screws make an arm with the same Jacobian."""
    rows, J, v = asked(tmp_path, links, "dh-table", "jacobian", "velocity")
    assert rows.facts.found
    table = "".join(
        f"\n    - {{theta: {theta}, d: {d}, a: {a}, alpha: {alpha}}}" for theta, d, a, alpha in texts(rows)
    )
    tool = "T_tool" in rows.results
    (again,) = asked(tmp_path, table, "forward-kinematics") if tool else asked(tmp_path, table, "jacobian")
    if not tool:
        assert same(again.results["J"], J.results["J"])
    assert len(v.results) == 2


def texts(rows: Derivation) -> list[tuple[str, ...]]:
    """The table as it would be typed."""
    from derive.algebra.infix import text

    starred = {name for row in rows.facts.table.rows for entry in row for name in free_symbols(entry)}
    variables = [name.removesuffix("*") for name in starred if name.endswith("*")]

    def typed(entry) -> str:
        written = text(entry)
        for name in variables:
            written = written.replace(name, f"{name}*")
        return written

    return [tuple(map(typed, row)) for row in rows.results["DH"].rows]


TURNED = (
    UR5[: UR5.index("    home")]
    + """
    home: [{translate: x, by: L_1}, {rotate: x, by: 30 deg}, {rotate: y, by: 45 deg}]
"""
)


@pytest.mark.parametrize("links", [UR5, TURNED], ids=["as in the book", "another tool"])
def test_inverse_kinematics_of_screws(tmp_path: Path, links: str) -> None:
    """Found by way of the rows; each branch is put back through the pose of the arm."""
    (found,) = asked(tmp_path, links, "inverse-kinematics, given: pose")
    assert len(found.results["solutions"]) == 8
    assert [used.kind for used in found.uses] == ["dh-table", "forward-kinematics"]


ONE = "\n    - {screw: {axis: z}, variable: q1*}"
ROW = "\n    - {theta: q1*, d: 0, a: 0, alpha: 0}"
FAULTS = {
    "screws and other rows": f"{ONE}\n    - {{theta: q2*, d: 0, a: 0, alpha: 0}}",
    "no joint variable": f"{ONE}\n    - {{screw: {{axis: z}}, variable: q2}}",
    "no direction": "\n    - {screw: {axis: [0, 0, 0]}, variable: q1*}",
    "belongs to a robot of screws": f"{ROW}\n    home: [{{translate: x, by: 1}}]",
    "not right-handed": f"{ONE}\n    home: [[1, 0, 0], [0, 1, 0], [0, 0, -1]]",
    "a screw is written": "\n    - {screw: {through: [0, 0, 0]}, variable: q1*}",
}


@pytest.mark.parametrize("fault", FAULTS)
def test_faults(tmp_path: Path, fault: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        asked(tmp_path, FAULTS[fault], "forward-kinematics")
    assert any(fault in error.message for error in caught.value.errors)
    assert all(error.place for error in caught.value.errors)


def test_a_helix_has_no_row(tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as caught:
        asked(tmp_path, MIXED, "dh-table")
    assert "turns and slides" in caught.value.errors[0].message
