"""Arms of the textbooks, what is given of their end-effector, and how many solutions they have."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from derive.kinds.problem import Problem
from derive.mechanics.robot import Robot
from tests.mechanics.robots import row

Row = tuple[str, str, str, str]
REACH = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True)
class Arm:
    """DH rows (theta, d, a, alpha) with a star at the joint variable; `given` as on a sheet."""

    rows: tuple[Row, ...]
    given: Any
    solutions: int
    convention: str = "standard"
    positive: tuple[str, ...] = ()
    partial: bool = False  # whether the pose has to fulfil more equations than the joints

    @cached_property
    def robot(self) -> Robot:
        return Robot("", self.convention, tuple(row(*each) for each in self.rows))

    def problem(self) -> Problem:
        return Problem("robot", self.robot, assumptions=dict.fromkeys(self.positive, "positive"))

    @cached_property
    def joints(self) -> tuple[str, ...]:
        return self.robot.variables

    @cached_property
    def slides(self) -> frozenset[str]:
        return frozenset(link.variable for link in self.robot.links if link.joint == "prismatic")

    def pose(self, at: Mapping[str, float]) -> Any:
        """T of the end-effector, multiplied out in NumPy from the rows."""
        T = np.eye(4)
        for each in self.rows:
            theta, d, a, alpha = (value(part, at) for part in each)
            c, s, ca, sa = math.cos(theta), math.sin(theta), math.cos(alpha), math.sin(alpha)
            turn = np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, d], [0, 0, 0, 1]])
            twist = np.array([[1, 0, 0, a], [0, ca, -sa, 0], [0, sa, ca, 0], [0, 0, 0, 1]])
            T = T @ (turn @ twist if self.convention == "standard" else twist @ turn)
        return T

    def known(self, T: Any) -> dict[str, float]:
        """What is given of a pose, by its names."""
        if self.given in ("pose", "orientation"):
            found = {f"r{i + 1}{j + 1}": T[i, j] for i in range(3) for j in range(3)}
            return found | (dict(zip("xyz", T[:3, 3], strict=True)) if self.given == "pose" else {})
        found = {name: T[REACH[name], 3] for name in self.given if name in REACH}
        if "phi" in self.given:
            found["phi"] = math.atan2(T[2 if "z" in self.given and "y" not in self.given else 1, 0], T[0, 0])
        return found


def value(text: str, at: Mapping[str, float]) -> float:
    """A cell of a row: a sum of names, numbers and degrees, the star left out."""
    total = 0.0
    for part in text.replace("*", "").replace(" - ", " + -").split(" + "):
        sign, bare = (-1, part[1:]) if part.startswith("-") else (1, part)
        if bare.endswith(" deg"):
            total += sign * math.radians(float(bare[:-4]))
        else:
            total += sign * (at[bare] if bare in at else float(bare))
    return total


ARMS = {
    "2R": Arm((("theta1*", "0", "a1", "0"), ("theta2*", "0", "a2", "0")), ("x", "y"), 2),
    "3R": Arm(
        (("theta1*", "0", "a1", "0"), ("theta2*", "0", "a2", "0"), ("theta3*", "0", "a3", "0")),
        ("x", "y", "phi"), 2,
    ),
    "RP": Arm((("theta1* + 90 deg", "0", "0", "90 deg"), ("0", "d2*", "0", "0")), ("x", "y"), 2),
    "PR": Arm((("0", "d1*", "0", "-90 deg"), ("theta2*", "0", "a2", "0")), ("x", "z"), 2),
    "RPR": Arm(
        (("theta1*", "0", "0", "90 deg"), ("0", "d2*", "0", "-90 deg"), ("theta3*", "0", "a3", "0")),
        ("x", "y", "phi"), 2,
    ),
    "PRR": Arm(
        (("0", "d1*", "0", "-90 deg"), ("theta2*", "0", "a2", "0"), ("theta3*", "0", "a3", "0")),
        ("x", "z", "phi"), 2,
    ),
    "PRP": Arm(
        (("0", "d1*", "0", "-90 deg"), ("theta2*", "0", "0", "90 deg"), ("0", "d3*", "0", "0")),
        ("x", "z", "phi"), 1,
    ),
    "Cartesian": Arm(
        (("0", "d1*", "0", "-90 deg"), ("90 deg", "d2*", "0", "-90 deg"), ("0", "d3*", "0", "0")),
        ("x", "y", "z"), 1,
    ),
    "cylindrical": Arm(
        (("theta1*", "d1", "0", "0"), ("0", "d2*", "0", "-90 deg"), ("0", "d3*", "0", "0")),
        ("x", "y", "z"), 2,
    ),
    "spherical": Arm(
        (("theta1*", "d1", "0", "-90 deg"), ("theta2*", "d2", "0", "90 deg"), ("0", "d3*", "0", "0")),
        ("x", "y", "z"), 4,
    ),
    "spherical, d3 > 0": Arm(
        (("theta1*", "d1", "0", "-90 deg"), ("theta2*", "0", "0", "90 deg"), ("0", "d3*", "0", "0")),
        ("x", "y", "z"), 2, positive=("d3",),
    ),
    "SCARA, position": Arm(
        (("theta1*", "d1", "a1", "0"), ("theta2*", "0", "a2", "180 deg"), ("0", "d3*", "0", "0")),
        ("x", "y", "z"), 2,
    ),
    "SCARA": Arm(
        (("theta1*", "0", "a1", "0"), ("theta2*", "0", "a2", "180 deg"), ("0", "d3*", "0", "0"),
         ("theta4*", "d4", "0", "0")),
        "pose", 2,
    ),
    "SCARA, angle": Arm(
        (("theta1*", "0", "a1", "0"), ("theta2*", "0", "a2", "180 deg"), ("0", "d3*", "0", "0"),
         ("theta4*", "d4", "0", "0")),
        ("x", "y", "z", "phi"), 2,
    ),
    "anthropomorphic": Arm(
        (("theta1*", "d1", "0", "90 deg"), ("theta2*", "0", "a2", "0"), ("theta3*", "0", "a3", "0")),
        ("x", "y", "z"), 4,
    ),
    "shoulder offset": Arm(
        (("theta1*", "d1", "0", "90 deg"), ("theta2*", "d2", "a2", "0"), ("theta3*", "0", "a3", "0")),
        ("x", "y", "z"), 4,
    ),
    "both offsets": Arm(
        (("theta1*", "d1", "a1", "90 deg"), ("theta2*", "d2", "a2", "0"), ("theta3*", "0", "a3", "90 deg"),
         ("0", "d4", "0", "0")),
        ("x", "y", "z"), 4,
    ),
    "wrist": Arm(
        (("theta4*", "0", "0", "-90 deg"), ("theta5*", "0", "0", "90 deg"), ("theta6*", "0", "0", "0")),
        "orientation", 2,
    ),
    "wrist about x, y, z": Arm(
        (("theta1*", "0", "0", "90 deg"), ("theta2* + 90 deg", "0", "0", "90 deg"),
         ("theta3*", "0", "0", "0")),
        "orientation", 2,
    ),
    "slanted wrist": Arm(
        (("theta1*", "0", "0", "60 deg"), ("theta2*", "0", "0", "-45 deg"), ("theta3*", "d", "0", "0")),
        "orientation", 2,
    ),
    "Stanford": Arm(
        (("theta1*", "0", "0", "-90 deg"), ("theta2*", "d2", "0", "90 deg"), ("0", "d3*", "0", "0"),
         ("theta4*", "0", "0", "-90 deg"), ("theta5*", "0", "0", "90 deg"), ("theta6*", "d6", "0", "0")),
        "pose", 8,
    ),
    "Stanford, d3 > 0": Arm(
        (("theta1*", "0", "0", "-90 deg"), ("theta2*", "0.1", "0", "90 deg"), ("0", "d3*", "0", "0"),
         ("theta4*", "0", "0", "-90 deg"), ("theta5*", "0", "0", "90 deg"), ("theta6*", "0", "0", "0")),
        "pose", 4, positive=("d3",),
    ),
    "PUMA 560": Arm(
        (("theta1*", "0", "0", "90 deg"), ("theta2*", "0", "0.4318", "0"),
         ("theta3*", "0.15005", "0.0203", "-90 deg"), ("theta4*", "0.4318", "0", "90 deg"),
         ("theta5*", "0", "0", "-90 deg"), ("theta6*", "0", "0", "0")),
        "pose", 8,
    ),
    "PUMA 560, modified": Arm(
        (("theta1*", "0", "0", "0"), ("theta2*", "0", "0", "-90 deg"), ("theta3*", "d3", "a2", "0"),
         ("theta4*", "d4", "a3", "-90 deg"), ("theta5*", "0", "0", "90 deg"),
         ("theta6*", "0", "0", "-90 deg")),
        "pose", 8, convention="modified",
    ),
    "elbow arm": Arm(
        (("theta1*", "d1", "0", "90 deg"), ("theta2*", "0", "a2", "0"),
         ("theta3* + 90 deg", "0", "0", "90 deg"),
         ("theta4*", "d4", "0", "-90 deg"), ("theta5*", "0", "0", "90 deg"), ("theta6*", "d6", "0", "0")),
        "pose", 8,
    ),
    "arm of four joints": Arm(
        (("theta1* + 90 deg", "0", "0", "alpha"), ("theta2*", "0", "0.5", "90 deg"),
         ("theta3*", "0", "0.5", "180 deg"), ("theta4*", "l4", "0.5", "-90 deg")),
        "pose", 2, convention="modified", partial=True,
    ),
    "arm of five joints": Arm(
        (("theta1*", "d1", "0", "90 deg"), ("theta2*", "0", "a2", "0"), ("theta3*", "0", "a3", "0"),
         ("theta4*", "0", "0", "90 deg"), ("theta5*", "d5", "0", "0")),
        "pose", 4,
    ),
    "arm of mixed joints": Arm(
        (("theta1* + 90 deg", "l1", "a1", "alpha"), ("theta2*", "l2", "0", "-90 deg"),
         ("90 deg", "d3*", "0.5", "alpha"), ("theta4* + 90 deg", "0", "0.5", "-90 deg"),
         ("90 deg", "d5*", "0.5", "45 deg")),
        "pose", 2, convention="modified", partial=True,
    ),
    "offset shoulder, spherical wrist": Arm(
        (("theta1*", "d1", "a1", "-90 deg"), ("theta2* - 90 deg", "0", "a2", "0"),
         ("theta3*", "0", "a3", "-90 deg"), ("theta4*", "d4", "0", "90 deg"),
         ("theta5*", "0", "0", "-90 deg"), ("theta6* + 180 deg", "d6", "0", "0")),
        "pose", 8,
    ),
    "gantry with a wrist": Arm(
        (("0", "d1*", "0", "-90 deg"), ("90 deg", "d2*", "0", "-90 deg"), ("0", "d3*", "0", "0"),
         ("theta4*", "0", "0", "-90 deg"), ("theta5*", "0", "0", "90 deg"), ("theta6*", "d6", "0", "0")),
        "pose", 2,
    ),
    "UR5": Arm(
        (("theta1*", "0.089159", "0", "90 deg"), ("theta2*", "0", "-0.425", "0"),
         ("theta3*", "0", "-0.39225", "0"), ("theta4*", "0.10915", "0", "90 deg"),
         ("theta5*", "0.09465", "0", "-90 deg"), ("theta6*", "0.0823", "0", "0")),
        "pose", 8,
    ),
    "UR5, symbolic": Arm(
        (("theta1*", "d1", "0", "90 deg"), ("theta2*", "0", "a2", "0"), ("theta3*", "0", "a3", "0"),
         ("theta4*", "d4", "0", "90 deg"), ("theta5*", "d5", "0", "-90 deg"), ("theta6*", "d6", "0", "0")),
        "pose", 8,
    ),
    "spherical shoulder": Arm(
        (("theta1*", "0", "0", "90 deg"), ("theta2*", "0", "0", "-90 deg"), ("theta3*", "d3", "0", "90 deg"),
         ("theta4*", "0", "a4", "0"), ("theta5*", "0", "a5", "90 deg"), ("theta6*", "d6", "0", "0")),
        "pose", 8,
    ),
    "shoulder, two axes after it meet": Arm(
        (("theta1*", "0", "0", "90 deg"), ("theta2*", "0", "0", "-90 deg"),
         ("theta3*", "0.42", "0.1", "90 deg"), ("theta4*", "0.2", "0", "90 deg"),
         ("theta5*", "0.3", "0.2", "90 deg"), ("theta6*", "0.1", "0.1", "0")),
        "pose", 8,
    ),
    "wrist, two axes before it meet": Arm(
        (("theta1*", "d1", "a1", "90 deg"), ("theta2*", "d2", "0", "90 deg"),
         ("theta3*", "d3", "a3", "90 deg"), ("theta4*", "d4", "0", "90 deg"),
         ("theta5*", "0", "0", "-90 deg"), ("theta6*", "0", "0", "0")),
        "pose", 8,
    ),
    "wrist, the first two axes meet": Arm(
        (("theta1*", "0.3", "0", "90 deg"), ("theta2*", "0.2", "0.4", "90 deg"),
         ("theta3*", "0.1", "0.1", "90 deg"), ("theta4*", "0.4", "0", "90 deg"),
         ("theta5*", "0", "0", "-90 deg"), ("theta6*", "0.1", "0", "0")),
        "pose", 8,
    ),
    "R P R P R R": Arm(  # of Bartell, in the table of IKBT
        (("theta1*", "l1", "0", "0"), ("0", "d2*", "0", "90 deg"), ("theta3*", "0", "0", "0"),
         ("0", "d4*", "0", "90 deg"), ("theta5*", "0", "0", "0"), ("theta6*", "0", "0", "90 deg")),
        "pose", 8, convention="modified",
    ),
    "RAVEN II": Arm(  # in the table of IKBT, its twists by name
        (("theta1*", "0", "0", "0"), ("theta2*", "0", "0", "alpha_1"), ("90 deg", "d3*", "0", "alpha_2"),
         ("theta4*", "l_4", "0", "0"), ("theta5*", "0", "0", "90 deg"), ("theta6*", "0", "a_5", "90 deg")),
        "pose", 8, convention="modified",
    ),
    "slide at the end": Arm(
        (("theta1*", "0", "0.3", "90 deg"), ("theta2*", "0", "0", "-90 deg"), ("theta3*", "0", "0", "90 deg"),
         ("theta4*", "d4", "-a4", "90 deg"), ("theta5* + 90 deg", "0.2", "0", "-90 deg"),
         ("0", "d6*", "0", "90 deg")),
        "pose", 8,
    ),
    "UR from its other end": Arm(
        (("theta1*", "0.3", "0", "90 deg"), ("theta2*", "0.1", "0.1", "90 deg"),
         ("theta3*", "0.1", "0.4", "0"), ("theta4*", "0.2", "0.3", "0"),
         ("theta5*", "0.1", "0.1", "90 deg"), ("theta6*", "0.1", "0", "0")),
        "pose", 8,
    ),
    "three parallel axes at the end": Arm(
        (("theta1*", "0.3", "0", "90 deg"), ("theta2*", "0.2", "0.1", "90 deg"),
         ("theta3*", "0.15", "0.25", "90 deg"), ("theta4*", "0.1", "0.4", "0"),
         ("theta5*", "0.2", "0.3", "0"), ("theta6*", "0.1", "0", "0")),
        "pose", 8,
    ),
    "Panda, its last joint fixed": Arm(
        (("theta1*", "d1", "0", "0"), ("theta2*", "0", "0", "-90 deg"), ("theta3*", "d3", "0", "90 deg"),
         ("theta4*", "0", "a4", "90 deg"), ("theta5*", "d5", "-a4", "-90 deg"),
         ("theta6*", "0", "0", "90 deg"), ("q", "d_f", "a7", "90 deg")),
        "pose", 8, convention="modified",
    ),
    "parallelogram": Arm(
        (("theta1*", "d1", "0", "90 deg"), ("theta2*", "0", "a2", "0"),
         ("theta3* - theta2", "0", "a3", "0")),
        ("x", "y", "z"), 4,
    ),
    "planar parallelogram": Arm(
        (("theta1*", "0", "a1", "0"), ("theta2* - theta1", "0", "a2", "0")), ("x", "y"), 2,
    ),
    "planar arm of absolute angles": Arm(
        (("theta1*", "0", "a1", "0"), ("theta2* - theta1", "0", "a2", "0"),
         ("theta3* - theta2", "0", "a3", "0")),
        ("x", "y", "phi"), 2,
    ),
    "palletiser": Arm(
        (("theta1*", "d1", "a1", "90 deg"), ("theta2*", "0", "a2", "0"),
         ("theta3* - theta2", "0", "a3", "0"), ("-theta3", "0", "a4", "-90 deg"),
         ("theta4*", "d5", "0", "0")),
        "pose", 4,
    ),
    "parallelogram with a wrist": Arm(
        (("theta1*", "d1", "a1", "-90 deg"), ("theta2* - 90 deg", "0", "a2", "0"),
         ("theta3* - theta2", "0", "a3", "-90 deg"), ("theta4*", "d4", "0", "90 deg"),
         ("theta5*", "0", "0", "-90 deg"), ("theta6*", "d6", "0", "0")),
        "pose", 8,
    ),
    "RPR in space": Arm(
        (("theta1*", "0", "0", "90 deg"), ("90 deg", "d2*", "0", "90 deg"), ("theta3*", "0", "a3", "0")),
        ("x", "y", "z"), 4,
    ),
}  # fmt: skip
