"""Random sheets as texts, and plain NumPy formulas for what they ask, written out here once more.

Nothing of derive is used: rows are the sixteen entries of the books, bodies their moments from a table,
derivatives complex steps (Squire and Trapp, 1998), which have no rounding to speak of. A sheet is drawn
as the data of its YAML file, with formulas as texts; `value` evaluates such a text at a point.
"""

from __future__ import annotations

import math
import random
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

Array = Any
Point = dict[str, Any]
STEP = 1e-30  # of complex derivatives
DIFFERENCE = 1e-4  # of central ones, of fourth order
STANDARD, MODIFIED = "standard", "modified"
DEGREES = re.compile(r"([\d.]+) deg")


def value(text: Any, at: Point) -> Any:
    """A formula of a sheet, or of a result in SymPy's syntax, as a number."""
    source = DEGREES.sub(r"(\1*pi/180)", str(text)).replace("^", "**").replace("*-", "*(-1)*")
    names = {"pi": math.pi, "sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt, "atan2": np.arctan2}
    return eval(source.replace("**(-1)*", "**-"), {"__builtins__": {}}, {**names, **at})


# ----------------------------------------------------------------------------------------------- sheets


@dataclass
class Drawn:
    """A robot as the YAML has it, the names of its variables in order, and values for its letters."""

    robot: dict[str, Any]
    variables: list[str] = field(default_factory=list)
    letters: dict[str, float] = field(default_factory=dict)


@dataclass
class Dice:
    """Choices of one sheet."""

    roll: random.Random

    def one(self, *choices: Any) -> Any:
        return self.roll.choice(choices)

    def decimal(self, low: float, high: float, digits: int = 2) -> str:
        return f"{self.roll.uniform(low, high):.{digits}f}"

    def angle(self) -> str:
        """Zero, quarter turns, odd degrees, fractions of degrees, radians."""
        sign = self.one("", "-")
        return str(
            self.one(
                "0", "0", "90 deg", "-90 deg", f"{sign}{self.one(30, 45, 60, 15, 72, 36)} deg",
                f"{sign}{self.roll.randrange(1, 180)} deg", f"{sign}{self.roll.randrange(1, 180)} deg",
                f"{sign}{self.decimal(0, 180)} deg", f"{sign}{self.decimal(0.1, 3)}",
                f"{sign}{self.decimal(0.1, 3, 3)}", f"{sign}pi/{self.roll.randrange(2, 9)}",
            )
        )  # fmt: skip

    def length(self, drawn: Drawn, name: str) -> str:
        if self.one(True, False):
            return str(self.one("0", "0", self.decimal(-0.6, 0.9), self.decimal(0.1, 0.9, 3)))
        drawn.letters[name] = self.roll.uniform(0.2, 0.9)
        return name

    def axis(self) -> Any:
        return self.one("x", "y", "z", [1, 1, 0], [2, -1, 2])


def robot(dice: Dice, joints: int, bodies: bool) -> Drawn:
    """An arm of so many joints, sometimes with a base, a tool, fixed rows and coupled ones."""
    drawn = Drawn({"convention": dice.one(STANDARD, STANDARD, MODIFIED), "links": []})
    for i in range(1, joints + 1):
        row = _free_row(dice, drawn, i) if dice.roll.random() < 0.15 else _dh_row(dice, drawn, i)
        if bodies:
            row |= _body(dice, drawn, i)
            if row["com"] == "center" and not _has_center(row, drawn.robot["convention"]):
                row["com"] = [0, 0, "0.15"]
        drawn.robot["links"].append(row)
    for place in ("base", "tool"):
        if dice.roll.random() < 0.25:
            drawn.robot[place] = [
                {"rotate": dice.axis(), "by": dice.angle()},
                {"translate": dice.one("x", "y", "z"), "by": dice.length(drawn, f"h_{place}")},
            ]
    if bodies:
        drawn.robot["gravity"] = dice.one([0, 0, "-g"], [0, "-g", 0], ["9.81", 0, 0], [0, "-9.81", 0])
        drawn.letters["g"] = 9.81
    return drawn


def _has_center(row: dict[str, Any], convention: str) -> bool:
    """Whether the middle to the origin before is a point of the link."""
    return "theta" in row and convention == STANDARD and _is_star(row["theta"]) and "q" not in str(row["d"])


def _dh_row(dice: Dice, drawn: Drawn, i: int) -> dict[str, Any]:
    name = f"q{i}"
    coupled = dice.roll.random() < 0.15 and drawn.variables
    row = {"theta": dice.angle(), "d": dice.length(drawn, f"d{i}")}
    if dice.roll.random() < 0.25:
        row["d"] = _starred(dice, name, dice.decimal(0.1, 0.5))
        slides = True
    else:
        row["theta"] = _starred(dice, name, dice.angle())
        slides = False
    if coupled:
        _couple(dice, row, dice.one(*drawn.variables), slides)
    drawn.variables.append(name)
    return {**row, "a": dice.length(drawn, f"a{i}"), "alpha": dice.angle()}


def _starred(dice: Dice, name: str, offset: str) -> str:
    return f"{name}*" if dice.one(True, True, False) or offset == "0" else f"{name}* + {offset}"


def _couple(dice: Dice, row: dict[str, Any], other: str, slides: bool) -> None:
    """An earlier joint moves this row too: a parallelogram, a belt, a screw."""
    if slides:
        row["theta"] = f"{other} + 10 deg" if dice.one(True, False) else row["theta"]
        row["d"] += f" + 0.2*{other}" if row["theta"] == "0" else ""
    elif dice.one(True, True, False):
        row["theta"] += dice.one(f" - {other}", f" + {other}", f" - 2*{other}")
    else:
        row["d"] = f"0.1*{other}"


def _free_row(dice: Dice, drawn: Drawn, i: int) -> dict[str, Any]:
    name = f"q{i}"
    drawn.variables.append(name)
    moves = [
        {"translate": dice.one("x", "y", "z"), "by": dice.length(drawn, f"b{i}")},
        {dice.one("rotate", "rotate", "translate"): dice.axis(), "by": f"{name}*"},
        {"rotate": dice.axis(), "by": dice.angle()},
    ]
    return {"motion": moves[dice.roll.randrange(2) :]}


def _body(dice: Dice, drawn: Drawn, i: int) -> dict[str, Any]:
    mass = dice.one(f"m{i}", dice.decimal(0.5, 9))
    drawn.letters[f"m{i}"] = dice.roll.uniform(0.5, 3)
    com = dice.one(
        "center", [0, 0, 0], [dice.length(drawn, f"c{i}"), 0, 0],
        [dice.decimal(-0.3, 0.3), dice.decimal(-0.3, 0.3), dice.decimal(-0.3, 0.3)],
    )  # fmt: skip
    x, y, z = (dice.decimal(0.1, 0.6) for _ in range(3))
    drawn.letters[f"I{i}"] = dice.roll.uniform(0.1, 0.5)
    inertia = dice.one(
        "point", {"box": [x, y, z]}, {"rod": x, "axis": dice.one("x", "y", "z")}, {"sphere": x},
        {"cylinder": {"radius": x, "length": y}, "axis": dice.one("x", "y", "z")},
        [0, 0, f"I{i}"], [f"I{i}", f"I{i}", "0.2"], ["0.31", "0.42", "0.53", "0.02", "-0.03", "0.01"],
    )  # fmt: skip
    found: dict[str, Any] = {"mass": mass, "com": com, "inertia": inertia}
    if dice.roll.random() < 0.2:
        found["motor"] = {"inertia": dice.decimal(0.001, 0.01, 4), "ratio": dice.one(50, "n")}
        drawn.letters["n"] = 30.0
    return found


# ------------------------------------------------------------------------------------------ kinematics


def dh(row: dict[str, Any], convention: str, at: Point) -> Array:
    """The sixteen entries (Spong et al., eq. 3.10; Craig, eq. 3.6)."""
    theta, d, a, alpha = (value(str(row[key]).replace("*", "", 1) if _is_star(row[key]) else row[key], at)
                          for key in ("theta", "d", "a", "alpha"))  # fmt: skip
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    if convention == STANDARD:
        return np.array(
            [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
        )
    return np.array(
        [[c, -s, 0, a], [s * ca, c * ca, -sa, -sa * d], [s * sa, c * sa, ca, ca * d], [0, 0, 0, 1]]
    )


def _is_star(text: Any) -> bool:
    """Whether the star of a joint variable stands in it, `q2* + 90 deg`, and no product."""
    return re.search(r"\*(?!\s*[\w(])", str(text)) is not None


def move(step: dict[str, Any], at: Point) -> Array:
    """Rodrigues' formula, or a shift."""
    axis = step.get("rotate", step.get("translate"))
    k = np.eye(3)["xyz".index(axis)] if isinstance(axis, str) else np.array(axis) / np.linalg.norm(axis)
    by = value(str(step["by"]).replace("*", "", 1) if _is_star(step["by"]) else step["by"], at)
    T = np.eye(4, dtype=complex)
    if "translate" in step:
        T[:3, 3] = by * k
    else:
        K = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
        T[:3, :3] = np.eye(3) + np.sin(by) * K + (1 - np.cos(by)) * (K @ K)
    return T


def moves(steps: list[dict[str, Any]], at: Point) -> Array:
    T = np.eye(4)
    for step in steps:
        T = T @ move(step, at)
    return T


def poses(arm: dict[str, Any], at: Point) -> list[Array]:
    """Frame 0, then those of the rows in the base frame, `base` included, the last with the tool."""
    found = [moves(arm.get("base", []), at)]
    for row in arm["links"]:
        local = moves(row["motion"], at) if "motion" in row else dh(row, arm["convention"], at)
        found.append(found[-1] @ local)
    return [np.eye(4), *found[1:], found[-1] @ moves(arm.get("tool", []), at), found[0]]


def slope(function: Callable[[Point], Array], at: Point, name: str) -> Array:
    """The derivative of an analytic function by a complex step."""
    return np.imag(function({**at, name: at[name] + 1j * STEP})) / STEP


def spin(S: Array) -> Array:
    return np.array([S[2, 1], S[0, 2], S[1, 0]])


def jacobian(arm: dict[str, Any], variables: list[str], at: Point) -> Array:
    """Of the end-effector, linear rows first."""
    T = np.real(poses(arm, at)[-2])
    columns = []
    for name in variables:
        rate = slope(lambda q: poses(arm, q)[-2], at, name)
        columns.append([*rate[:3, 3], *spin(rate[:3, :3] @ T[:3, :3].T)])
    return np.array(columns).T


# -------------------------------------------------------------------------------------------- dynamics


def moments(body: dict[str, Any], at: Point) -> Array:
    """I about the com in the link's axes (Beer and Johnston, inside back cover)."""
    m, given = value(body["mass"], at), body["inertia"]
    if given == "point":
        return np.zeros((3, 3))
    if isinstance(given, list):
        xx, yy, zz, xy, yz, xz = [value(part, at) for part in [*given, 0, 0, 0][:6]]
        return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    if "sphere" in given:
        return np.eye(3) * 2 / 5 * m * value(given["sphere"], at) ** 2
    if "box" in given:
        x, y, z = (value(side, at) for side in given["box"])
        return np.diag([y * y + z * z, x * x + z * z, x * x + y * y]) * m / 12
    k = "xyz".index(given["axis"])
    if "rod" in given:
        along, across = 0.0, m * value(given["rod"], at) ** 2 / 12
    else:
        r, h = (value(given["cylinder"][key], at) for key in ("radius", "length"))
        along, across = m * r * r / 2, m * (3 * r * r + h * h) / 12
    return np.diag([along if i == k else across for i in range(3)])


def com(arm: dict[str, Any], i: int, at: Point) -> Array:
    """Of link i, counted from 1, in the base frame."""
    T = poses(arm, at)
    before = T[-1] if i == 1 else T[i - 1]
    given = arm["links"][i - 1]["com"]
    if given == "center":
        return (before[:3, 3] + T[i][:3, 3]) / 2
    return T[i][:3, :3] @ np.array([value(part, at) for part in given]) + T[i][:3, 3]


def inertia(arm: dict[str, Any], variables: list[str], at: Point) -> Array:
    """D of twice the kinetic energy."""
    D = np.zeros((len(variables), len(variables)))
    moving = -1
    for i, row in enumerate(arm["links"], 1):
        moving += any(_is_star(part) for part in _parts(row))
        if "motor" in row:
            rotor = row["motor"]
            D[moving, moving] += value(rotor["inertia"], at) * value(rotor["ratio"], at) ** 2
        if "mass" not in row:
            continue
        R = np.real(poses(arm, at)[i][:3, :3])
        J_v = np.array([slope(lambda q, i=i: com(arm, i, q), at, name) for name in variables]).T
        J_w = np.array(
            [spin(slope(lambda q, i=i: poses(arm, q)[i][:3, :3], at, name) @ R.T) for name in variables]
        ).T
        D += value(row["mass"], at) * J_v.T @ J_v + J_w.T @ R @ moments(row, at) @ R.T @ J_w
    return D


def _parts(row: dict[str, Any]) -> list[Any]:
    return [step["by"] for step in row["motion"]] if "motion" in row else [row["theta"], row["d"]]


def weight(arm: dict[str, Any], variables: list[str], at: Point) -> Array:
    """g of the potential energy."""
    field_ = np.array([value(part, at) for part in arm["gravity"]])

    def potential(q: Point) -> Any:
        bodies = [i for i, row in enumerate(arm["links"], 1) if "mass" in row]
        return -sum(value(arm["links"][i - 1]["mass"], q) * field_ @ com(arm, i, q) for i in bodies)

    return np.array([slope(potential, at, name) for name in variables])


def torques(arm: dict[str, Any], variables: list[str], at: Point) -> Array:
    """Lagrange: d/dt (D qdot) - 1/2 d(qdot^T D qdot)/dq + g."""
    rates = np.array([at[f"{name}_dot"] for name in variables])
    accelerations = np.array([at[f"{name}_ddot"] for name in variables])
    turned = [_difference(lambda q: inertia(arm, variables, q), at, name) for name in variables]
    D_dot = sum(rate * change for rate, change in zip(rates, turned, strict=True))
    force = np.array([rates @ change @ rates for change in turned]) / 2
    return inertia(arm, variables, at) @ accelerations + D_dot @ rates - force + weight(arm, variables, at)


def _difference(function: Callable[[Point], Array], at: Point, name: str) -> Array:
    h = DIFFERENCE
    f = [function({**at, name: at[name] + k * h}) for k in (-2, -1, 1, 2)]
    return (f[0] - 8 * f[1] + 8 * f[2] - f[3]) / (12 * h)
