"""Two derivations in the same algebra that share no formula: energies by the Jacobians of the centres of
mass, and forces by Newton and Euler. Both give the same normal forms, and numbers agree with them."""

from __future__ import annotations

import numpy as np
import pytest

from derive.algebra.formulas.grammar import parse
from derive.algebra.scalar import Scalar
from derive.expression import Degrees, Symbol, number
from derive.mechanics.bodies import Body, Box, Cylinder, Rod
from derive.mechanics.motion import Move
from derive.mechanics.newton_euler import NewtonEuler
from derive.mechanics.robot import FreeRow, Link, Robot
from tests.mechanics.robots import body, robot, row
from tests.mechanics.two_derivations import Arm, torques

POINTS = 20


def full(i: int) -> Body:
    """Ten inertial parameters."""
    return body(f"m{i}", f"x{i}, y{i}, z{i}", f"Ixx{i}, Iyy{i}, Izz{i}, Ixy{i}, Iyz{i}, Ixz{i}")


def diagonal(i: int, com: str) -> Body:
    """A com on one axis, and principal axes along the frame."""
    return body(f"m{i}", com, f"Ixx{i}, Iyy{i}, Izz{i}, 0, 0, 0")


def planar(n: int) -> Robot:
    rows = (
        row(f"theta{i}*", "0", f"a{i}", "0", body(f"m{i}", f"x{i}, 0, 0", f"0, 0, I{i}, 0, 0, 0"))
        for i in range(1, n + 1)
    )
    return robot(*rows, gravity="0, -g, 0")


def seven_joints() -> Robot:
    """A shoulder, an elbow and a wrist, each com on the axis of its joint."""
    rows = (
        row(
            f"theta{i}*",
            f"d{i}" if i % 2 else "0",
            "0",
            "0" if i == 7 else "-90 deg" if i % 2 else "90 deg",
            diagonal(i, f"0, 0, z{i}"),
        )
        for i in range(1, 8)
    )
    return robot(*rows)


def uniform(i: int) -> Body:
    a = Symbol(f"a{i}")
    return Body(Symbol(f"m{i}"), "center", Rod(a, "x"))


PUMA_ROWS = (
    ("0", "0", "90 deg"),
    ("0", "a2", "0"),
    ("d3", "a3", "-90 deg"),
    ("d4", "0", "90 deg"),
    ("0", "0", "-90 deg"),
    ("0", "0", "0"),
)
MODIFIED_ROWS = (  # Craig, figure 3.21
    ("0", "0", "0"),
    ("0", "0", "-90 deg"),
    ("d3", "a2", "0"),
    ("d4", "a3", "-90 deg"),
    ("0", "0", "90 deg"),
    ("0", "0", "-90 deg"),
)
ARMS = {
    "2R, uniform links": robot(
        row("theta1*", "0", "a1", "0", uniform(1)),
        row("theta2*", "0", "a2", "0", uniform(2)),
        gravity="0, -g, 0",
    ),
    "anthropomorphic": robot(
        row("theta1*", "0", "0", "90 deg", diagonal(1, "0, y1, 0")),
        row("theta2*", "0", "a2", "0", diagonal(2, "x2, 0, 0")),
        row("theta3*", "0", "a3", "0", diagonal(3, "x3, 0, 0")),
    ),
    "Stanford": robot(
        row("theta1*", "0", "0", "-90 deg", full(1)),
        row("theta2*", "d2", "0", "90 deg", full(2)),
        row("0", "d3*", "0", "0", full(3)),
        row("theta4*", "0", "0", "-90 deg", full(4)),
        row("theta5*", "0", "0", "90 deg", full(5)),
        row("theta6*", "d6", "0", "0", full(6)),
    ),
    "PUMA 560": robot(*(row(f"theta{i}*", *each, full(i)) for i, each in enumerate(PUMA_ROWS, 1))),
    "PUMA 560, modified": robot(
        *(row(f"theta{i}*", *each, full(i)) for i, each in enumerate(MODIFIED_ROWS, 1)), convention="modified"
    ),
    "7R": seven_joints(),
    "planar 3R": planar(3),
    "planar 6R": planar(6),
    "SCARA": robot(
        row("theta1*", "0", "a1", "0", full(1)),
        row("theta2*", "0", "a2", "180 deg", full(2)),
        row("0", "d3*", "0", "0", full(3)),
        row("theta4*", "d4", "0", "0", full(4)),
    ),
    "PRP": robot(
        row("90 deg", "d1*", "a1", "90 deg", full(1)),
        row("theta2* + 90 deg", "0", "a2", "-60 deg", full(2)),
        row("0", "d3*", "0", "alpha", full(3)),
        tool="h",
    ),
    "free rows": Robot(
        "",
        "standard",
        (
            Link(
                FreeRow((Move("rotate", "y", Symbol("q1")), Move("translate", "x", Symbol("a1")))),
                "revolute",
                "q1",
                Body(Symbol("m1"), "center", Box((Symbol("a1"), Symbol("b"), number(1)))),
            ),
            Link(  # a row that does not move, then one along a slanting axis
                FreeRow((Move("rotate", "x", Degrees(parse("30").value)),)), "fixed", None, full(2)
            ),
            Link(
                FreeRow(
                    (
                        Move("translate", "y", Symbol("h")),
                        Move("translate", (number(3), number(0), number(4)), Symbol("q3")),
                        Move("rotate", "z", Symbol("beta")),
                    )
                ),
                "prismatic",
                "q3",
                Body(
                    Symbol("m3"),
                    (number(0), number(0), Symbol("c")),
                    Cylinder(Symbol("r"), Symbol("c"), "z"),
                ),
            ),
            Link(
                FreeRow(
                    (
                        Move("translate", "z", Symbol("k")),
                        Move("rotate", (number(2), number(1), number(2)), Symbol("q4")),
                        Move("translate", "x", Symbol("a4")),
                    )
                ),
                "revolute",
                "q4",
                diagonal(4, "x4, 0, 0"),
            ),
        ),
        base=(Move("rotate", "x", Degrees(parse("45").value)), Move("translate", "z", Symbol("b0"))),
    ),
}


@pytest.mark.parametrize("name", ARMS)
def test_both_derivations_have_the_same_normal_forms(name: str) -> None:
    arm = Arm(ARMS[name])
    (D, c, g), (D_of_forces, c_of_forces, g_of_forces) = arm.by_jacobians(), arm.by_forces()
    n = len(arm.robot.variables)
    assert D_of_forces == D
    assert D.shape == (n, n)
    assert len(c) == n**3
    assert c.keys() == c_of_forces.keys()
    assert [key for key in c if c[key] != c_of_forces[key]] == []
    assert [k for k in range(n) if g[k] != g_of_forces[k]] == []


@pytest.mark.parametrize("name", ARMS)
def test_numbers_agree_with_the_normal_forms(name: str) -> None:
    arm = Arm(ARMS[name])
    points = arm.points(POINTS)
    ours = torques(arm.by_jacobians(), arm.robot.variables, points)
    theirs = np.array([arm.in_numbers(at) for at in points])
    assert np.allclose(ours, theirs, rtol=1e-9, atol=1e-9 * max(1, np.abs(theirs).max()))


@pytest.mark.parametrize("name", ["2R, uniform links", "SCARA", "free rows"])
def test_torques_in_one_sweep(name: str) -> None:
    """All at once, with the rates as symbols: D qddot + c qdot qdot + g."""
    arm = Arm(ARMS[name])
    D, c, g = arm.by_jacobians()
    names = arm.robot.variables
    rates = [Scalar.symbol(f"{name}_dot") for name in names]
    rises = [Scalar.symbol(f"{name}_ddot") for name in names]
    gravity = arm.gravity.entries
    oracle = NewtonEuler.of(arm.chain, arm.link_bodies(), (*rates, *rises, *gravity))
    found = oracle.torques(rates, rises, gravity)
    for k, tau in enumerate(found):
        expected = sum((D[k, j] * rise for j, rise in enumerate(rises)), g[k])
        for (i, j, l), symbol in c.items():
            if l == k + 1:
                expected = expected + symbol * rates[i - 1] * rates[j - 1]
        assert tau == expected


def test_a_wrong_body_is_seen() -> None:
    """The comparison can fail: a com a little aside."""
    links = ARMS["SCARA"].links
    last = links[-1]
    moved = Link(last.row, last.joint, last.variable, diagonal(4, "x4, y4 + 1/1000, z4"))
    assert Arm(ARMS["SCARA"]).by_jacobians()[0] != Arm(robot(*links[:-1], moved)).by_forces()[0]
