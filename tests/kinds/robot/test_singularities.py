"""Singular sets of the textbooks, found from the factored determinant.

Sources: Siciliano et al., section 3.3 (2R, anthropomorphic, wrist); Spong et al., section 4.9 (elbow
manipulator, spherical arm, SCARA, wrist); Craig, section 5.8 and Kucuk and Bingul for the PUMA 560; Kebria et
al. (2016) for the UR5; Busson and Bearee (2018) for arms of seven joints with spherical shoulder and wrist.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from derive.algebra import bounds
from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.derivation import Branch
from derive.errors import NotDerivable
from derive.mechanics.oracle import Oracle
from derive.mechanics.robot import Robot
from derive.render.phrases import spoken
from tests.mechanics.robots import problem, robot, row

NAMES = [*(f"{letter}{k}" for letter in "qlad" for k in range(1, 7))]
TWO_R = (("q1*", "0", "l1", "0"), ("q2*", "0", "l2", "0"))
THREE_R = (*TWO_R, ("q3*", "0", "l3", "0"))
SCARA = (
    ("q1*", "0", "a1", "0"),
    ("q2*", "0", "a2", "180 deg"),
    ("0", "q3*", "0", "0"),
    ("q4*", "d4", "0", "0"),
)
ELBOW = (("q1*", "d1", "0", "90 deg"), ("q2*", "0", "a2", "0"), ("q3*", "0", "a3", "0"))
SPHERICAL = (("q1*", "0", "0", "-90 deg"), ("q2*", "0", "0", "90 deg"), ("0", "q3*", "0", "0"))
CYLINDRICAL = (("q1*", "d1", "0", "0"), ("0", "q2*", "0", "-90 deg"), ("0", "q3*", "0", "0"))
WRIST = (("q4*", "0", "0", "-90 deg"), ("q5*", "0", "0", "90 deg"), ("q6*", "d6", "0", "0"))
STANFORD = (("q1*", "0", "0", "-90 deg"), ("q2*", "d2", "0", "90 deg"), ("0", "q3*", "0", "0"), *WRIST)
PUMA = (
    ("q1*", "0", "0", "90 deg"), ("q2*", "0", "a2", "0"), ("q3*", "d3", "a3", "-90 deg"),
    ("q4*", "d4", "0", "90 deg"), ("q5*", "0", "0", "-90 deg"), ("q6*", "0", "0", "0"),
)  # fmt: skip
UR5 = (
    ("q1*", "d1", "0", "90 deg"), ("q2*", "0", "a2", "0"), ("q3*", "0", "a3", "0"),
    ("q4*", "d4", "0", "90 deg"), ("q5*", "d5", "0", "-90 deg"), ("q6*", "d6", "0", "0"),
)  # fmt: skip
IIWA = (
    ("q1*", "d1", "0", "-90 deg"), ("q2*", "0", "0", "90 deg"), ("q3*", "d3", "0", "-90 deg"),
    ("q4*", "0", "0", "90 deg"), ("q5*", "d5", "0", "-90 deg"), ("q6*", "0", "0", "90 deg"),
    ("q7*", "d7", "0", "0"),
)  # fmt: skip

TEXTBOOK = {  # rows of the arm, rows of J, det, what is fixed
    "2R": (TWO_R, (), "l1 l2 sin(q2)", [{"q2": "0"}, {"q2": "pi"}]),
    "3R": (THREE_R, (), "l1 l2 sin(q2)", [{"q2": "0"}, {"q2": "pi"}]),
    "SCARA": (SCARA, (), "a1 a2 sin(q2)", [{"q2": "0"}, {"q2": "pi"}]),
    "anthropomorphic": (
        ELBOW, (), "-a2 a3 sin(q3) (a2 cos(q2) + a3 cos(q2 + q3))",
        [
            {"q3": "0"}, {"q3": "pi"}, {"q2": "atan2(a2 + a3 cos(q3), a3 sin(q3))"},
            {"q2": "atan2(-a2 - a3 cos(q3), -a3 sin(q3))"},
        ],
    ),
    "spherical": (SPHERICAL, (), "-q3^2 sin(q2)", [{"q2": "0"}, {"q2": "pi"}, {"q3": "0"}]),
    "cylindrical": (CYLINDRICAL, (), "q3", [{"q3": "0"}]),
    "wrist": (WRIST, (), "-sin(q5)", [{"q5": "0"}, {"q5": "pi"}]),
    "Stanford": (
        STANFORD, (), "q3^2 sin(q2) sin(q5)",
        [{"q2": "0"}, {"q2": "pi"}, {"q3": "0"}, {"q5": "0"}, {"q5": "pi"}],
    ),
    "PUMA 560": (
        PUMA, (), "a2 sin(q5) (d4 cos(q3) + a3 sin(q3)) (a2 cos(q2) + a3 cos(q2 + q3) - d4 sin(q2 + q3))",
        [
            {"q2": "atan2(a2 + a3 cos(q3) - d4 sin(q3), d4 cos(q3) + a3 sin(q3))"},
            {"q2": "atan2(d4 sin(q3) - a2 - a3 cos(q3), -d4 cos(q3) - a3 sin(q3))"},
            {"q3": "atan2(-d4, a3)"}, {"q3": "atan2(d4, -a3)"}, {"q5": "0"}, {"q5": "pi"},
        ],
    ),
    "UR5": (
        UR5, (), "a2 a3 sin(q3) sin(q5) (a2 cos(q2) + a3 cos(q2 + q3) + d5 sin(q2 + q3 + q4))",
        [
            {"q5": "0"}, {"q5": "pi"}, {"q3": "0"}, {"q3": "pi"},
            {"q2": "atan2(a2 + a3 cos(q3) + d5 sin(q3 + q4), a3 sin(q3) - d5 cos(q3 + q4))"},
            {"q2": "atan2(-a2 - a3 cos(q3) - d5 sin(q3 + q4), d5 cos(q3 + q4) - a3 sin(q3))"},
        ],
    ),
}  # fmt: skip
LOOKS = {
    "2R": ["elbow stretched at joint 2", "elbow folded at joint 2"],
    "anthropomorphic": [
        "elbow stretched",
        "elbow folded",
        "shoulder: the end-effector lies on the axis of joint 1",
    ],
    "PUMA 560": [
        "shoulder: ",
        "elbow stretched at joint 3",
        "elbow folded at joint 3",
        "wrist: the axes of joints 4 and 6",
    ],
    "UR5": [
        "wrist: the axes of joints 4 and 6 are parallel",
        "elbow stretched",
        "elbow folded",
        "shoulder: ",
    ],
    "Stanford": ["shoulder: ", "wrist: the axes of joints 4 and 6 coincide"],
}


def arm(rows: Any) -> Robot:
    return robot(*(row(*each) for each in rows))


def asked(rows: Any, names: tuple[str, ...] = ()) -> Any:
    return problem(arm(rows)).ask("singularities", rows=names)


def said(each: Branch) -> str:
    """When a set is met, in plain text."""
    return spoken("robot", "singularities").when(each.when)


def outer(found: Any) -> list[Any]:
    """The sets that lie in no other."""
    return [each for each in found.results["solutions"] if not said(each).startswith("inside")]


@pytest.mark.parametrize("name", TEXTBOOK)
def test_the_determinant_is_that_of_the_textbook(name: str) -> None:
    rows, which, det, _ = TEXTBOOK[name]
    found = normal(asked(rows, which).results["det"])
    assert found in (normal(parse(det)), -normal(parse(det)))


@pytest.mark.parametrize("name", TEXTBOOK)
def test_the_sets_are_those_of_the_textbook(name: str) -> None:
    rows, which, _, sets = TEXTBOOK[name]
    found = [dict(branch.values) for branch in outer(asked(rows, which))]
    at = {symbol: 0.3 + 0.1 * place for place, symbol in enumerate(NAMES)}
    wanted = [{key: number(parse(value), at) for key, value in each.items()} for each in sets]
    got = [{key: number(value, at) for key, value in each.items()} for each in found]
    assert len(got) == len(wanted)
    assert all(any(each == pytest.approx(other) for other in got) for each in wanted)


@pytest.mark.parametrize("name", LOOKS)
def test_what_they_are_called_comes_from_their_geometry(name: str) -> None:
    found = [said(branch) for branch in asked(TEXTBOOK[name][0]).results["solutions"]]
    assert all(any(look in each for each in found) for look in LOOKS[name])


@pytest.mark.parametrize("name", TEXTBOOK)
def test_every_claim_holds_and_none_takes_much_work(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bounds, "MOST_WORK", bounds.MOST_WORK // 4)
    found = asked(*TEXTBOOK[name][:2])
    assert all(claim.holds for claim in found.claims)


def test_a_redundant_arm_is_singular_where_all_minors_vanish() -> None:
    """The planar arm of three joints, its position only: all links in one line."""
    found = asked(THREE_R, ("vx", "vy"))
    values = [
        {name: number(value, {}) for name, value in branch.values.items()}
        for branch in found.results["solutions"]
    ]
    assert sorted(map(sorted_values, values)) == [(0, 0), (0, math.pi), (math.pi, 0), (math.pi, math.pi)]


def sorted_values(values: dict[str, float]) -> tuple[float, ...]:
    return tuple(values[name] for name in sorted(values))


def test_an_arm_of_seven_joints() -> None:
    """Elbow; shoulder with the third joint square; wrist with the fifth; shoulder and wrist together."""
    found = asked(IIWA)
    assert len(outer(found)) == 14
    got = {frozenset(branch.values) for branch in outer(found)}
    assert got == {frozenset(each) for each in (["q4"], ["q2", "q3"], ["q5", "q6"], ["q2", "q6"])}
    assert all(claim.holds for claim in found.claims)


@pytest.mark.parametrize("name", ["2R", "anthropomorphic", "PUMA 560", "UR5"])
def test_numpy_sees_the_rank_drop(name: str) -> None:
    rows = TEXTBOOK[name][0]
    oracle = Oracle(arm(rows), {})
    at = {s: 0.4 + 0.07 * k for k, s in enumerate(NAMES)}
    found = asked(rows)
    lines = {"2R": [0, 1], "anthropomorphic": [0, 1, 2]}.get(name, range(6))
    for branch in outer(found):
        here = dict(at)
        here |= {key: number(value, here) for key, value in branch.values.items()}
        J = oracle.jacobian(here, len(rows), (0, 0, 0))[lines]
        assert np.linalg.matrix_rank(J, tol=1e-6) == len(lines) - 1


def test_rows_that_never_suffice() -> None:
    with pytest.raises(NotDerivable, match="dependent in every configuration"):
        asked(TWO_R, ("vx", "vz"))


def test_an_arm_that_is_never_singular() -> None:
    found = asked((("0", "q1*", "0", "90 deg"), ("0", "q2*", "0", "0")))
    assert found.results["solutions"] == ()


def test_decimals_stay_lengths() -> None:
    """No common denominator of 10000 is multiplied up."""
    rows = (("q1*", "0", "0.4318", "0"), ("q2*", "0", "0.0203", "0"))
    assert number(asked(rows).results["det"], {"q2": 1.0}) == pytest.approx(0.4318 * 0.0203 * math.sin(1))
