"""Angles, axes and quaternions of every subject, against SciPy and the published yaw, pitch and roll."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from derive.algebra.formulas.grammar import parse
from derive.algebra.numbers.floats import number, numbers
from derive.errors import NotDerivable
from derive.expression import Degrees, Symbol
from derive.kinds.problem import Problem
from derive.mechanics.motion import Motion, Move
from derive.render.phrases import spoken
from tests.kinds.published import matrix, same

PUBLISHED = """
cos(phi)*cos(theta), -sin(phi)*cos(psi)+cos(phi)*sin(theta)*sin(psi),
  sin(phi)*sin(psi)+cos(phi)*sin(theta)*cos(psi)
sin(phi)*cos(theta), cos(phi)*cos(psi)+sin(phi)*sin(theta)*sin(psi),
  -cos(phi)*sin(psi)+sin(phi)*sin(theta)*cos(psi)
-sin(theta), cos(theta)*sin(psi), cos(theta)*cos(psi)
"""
UP = "0,sin(psi-phi),cos(psi-phi)\n0,cos(psi-phi),-sin(psi-phi)\n-1,0,0"
DOWN = "0,-sin(psi+phi),-cos(psi+phi)\n0,cos(psi+phi),-sin(psi+phi)\n1,0,0"
TWO_TURNS = Motion((Move("rotate", "y", Symbol("q")), Move("rotate", "z", Symbol("w"))))


def turned(*turns):
    return Problem("motion", Motion(tuple(Move("rotate", axis, Degrees(Fraction(by))) for axis, by in turns)))


def holds(derivation):
    return all(claim.holds for claim in derivation.claims)


def test_yaw_pitch_roll_published():
    d = Problem("motion", TWO_TURNS).ask("euler-angles", convention="ZYX")
    assert same(d.results["R"], matrix(PUBLISHED))
    assert d.step("theta_plus").chain[1] == parse("atan2(-r_31, sqrt(r_11^2 + r_21^2))")
    assert d.step("psi_plus").chain[1] == parse("atan2(r_32, r_33)")
    assert d.step("phi_minus").chain[1] == parse("atan2(-r_21, -r_11)")
    assert same(d.step("R_singular_1").result, matrix(UP)) and same(
        d.step("R_singular_2").result, matrix(DOWN)
    )
    assert d.step("determined_1").chain == (parse("psi - phi"), parse("atan2(r_12, r_22)"))
    assert d.step("determined_2").chain == (parse("phi + psi"), parse("atan2(-r_12, r_22)"))
    assert len(d.results["solutions"]) == 4 and holds(d)


@pytest.mark.parametrize("convention", ["ZYX", "xyz", "ZYZ", "zxz", "XZY"])
def test_solutions_of_a_motion_give_it_back(convention):
    d = Problem("motion", TWO_TURNS).ask("euler-angles", convention=convention)
    point = {"q": 0.4, "w": -1.2}
    R = (Rotation.from_euler("y", 0.4) * Rotation.from_euler("z", -1.2)).as_matrix()
    for branch in d.results["solutions"][:2]:
        angles = [number(branch.values[name], point) for name in ("phi", "theta", "psi")]
        assert np.allclose(Rotation.from_euler(convention, angles).as_matrix(), R)
    assert holds(d)


def test_numbers_have_the_regular_case_only_and_exact_angles():
    d = turned(("z", 30), ("x", 60)).ask("euler-angles", convention="ZYX")
    values = d.results["solutions"][0].values
    assert len(d.results["solutions"]) == 2 and holds(d)
    assert [values[name] for name in ("phi", "theta", "psi")] == [
        parse("30 deg"),
        parse("0"),
        parse("60 deg"),
    ]


def test_numbers_have_the_singular_case_only():
    d = turned(("y", 90), ("x", 20)).ask("euler-angles", convention="ZYX")
    (branch,) = d.results["solutions"]
    angles = [number(branch.values[name], {"psi": 0.3}) for name in ("phi", "theta", "psi")]
    expected = (
        Rotation.from_euler("y", 90, degrees=True) * Rotation.from_euler("x", 20, degrees=True)
    ).as_matrix()
    assert np.allclose(Rotation.from_euler("ZYX", angles).as_matrix(), expected)
    assert "theta = 90 deg" in spoken("pose", "euler-angles").when(branch.when) and holds(d)


def test_evaluated_says_which_case_occurs():
    d = Problem("motion", TWO_TURNS).ask("euler-angles", convention="ZYX", evaluate={"q": 1, "w": 2})
    assert [branch.get("real", True) for branch in d.evaluated["solutions"]] == [True, True, False, False]


def test_angles_named_otherwise():
    subject = Motion((Move("rotate", "y", Symbol("phi")), Move("rotate", "z", Symbol("psi"))))
    d = Problem("motion", subject).ask("euler-angles", convention="ZYX")
    assert set(d.results["solutions"][0].values) == {"alpha", "beta", "gamma"}
    with pytest.raises(NotDerivable, match="phi has a meaning"):
        Problem("motion", subject).ask("euler-angles", convention="ZYX", angles=("phi", "b", "c"))


@pytest.mark.parametrize("turns", [(("x", 90), ("z", 90)), (("x", 180), ("z", 90)), (("y", 40), ("x", 75))])
def test_axis_and_angle_are_scipys(turns):
    d = turned(*turns).ask("axis-angle")
    expected = np.eye(3)
    for axis, by in turns:
        expected = expected @ Rotation.from_euler(axis, by, degrees=True).as_matrix()
    vector = number(d.results["angle"], {}) * np.array(numbers(d.results["axis"], {}))
    assert np.allclose(Rotation.from_rotvec(vector).as_matrix(), expected) and holds(d)


def test_nothing_turned_has_no_axis():
    d = turned(("x", 90), ("x", -90)).ask("axis-angle")
    assert d.results["angle"] == parse("0") and d.results["axis"] == "any" and holds(d)


@pytest.mark.parametrize(
    "turns", [(("x", 90), ("z", 90)), (("x", 180), ("z", 90)), (("y", 40), ("x", 75)), (("x", 45), ("y", 45))]
)
def test_quaternion_is_scipys(turns):
    d = turned(*turns).ask("quaternion")
    expected = Rotation.identity()
    for axis, by in turns:
        expected = expected * Rotation.from_euler(axis, by, degrees=True)
    w, x, y, z = numbers(d.results["q"], {})
    assert np.allclose(Rotation.from_quat([x, y, z, w]).as_matrix(), expected.as_matrix()) and holds(d)


def test_symbolic_quaternion():
    d = Problem("motion", TWO_TURNS).ask("quaternion")
    w, x, y, z = numbers(d.results["q"], {"q": 0.4, "w": -1.2})
    expected = Rotation.from_euler("y", 0.4) * Rotation.from_euler("z", -1.2)
    assert np.allclose(Rotation.from_quat([x, y, z, w]).as_matrix(), expected.as_matrix()) and holds(d)


def test_inverse_is_numpys():
    subject = Motion((Move("rotate", "z", Symbol("q")), Move("translate", "x", Symbol("a"), "world")))
    d = Problem("motion", subject).ask("inverse")
    q, a = 0.7, 1.3
    T = np.array([[np.cos(q), -np.sin(q), 0, a], [np.sin(q), np.cos(q), 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    assert np.allclose(numbers(d.results["T"], {"q": q, "a": a}), np.linalg.inv(T)) and holds(d)
