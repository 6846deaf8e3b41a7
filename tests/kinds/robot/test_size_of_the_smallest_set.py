"""The smallest set of parameters has as many as the torques depend on, whatever values the bodies give them:
the rank of a regressor that is made here, by NumPy, from the motion of each body."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from ruamel.yaml import YAML

from tests.sheets import pages

G = np.array([0.0, 0.0, 9.81])
PUMA = Path("exercises/robots/puma560-dynamics.yaml")
# Two equal moments of the last body cancel in what they are grouped to; no parameter of it does.
WRIST = """
gravity: [0, 0, -9.81 m/s^2]
links:
- {theta: q1*, d: 0, a: 0, alpha: 90 deg, mass: 2, com: [0, 0, 0], inertia: [0.3, 0.2, 0.1]}
- {theta: q2*, d: 0.2, a: 0.1, alpha: -90 deg, mass: 1, com: [0.1, 0, 0], inertia: [0.05, 0.05, 0.05]}
- {theta: q3*, d: 0, a: 0, alpha: 0, mass: 1, com: [0, 0, 0.1], inertia: [0.02, 0.02, 0.01]}
"""


@pytest.mark.parametrize("robot", [PUMA.read_text(encoding="utf-8"), WRIST], ids=["puma", "wrist"])
def test_the_smallest_set_is_as_large_as_the_rank(robot: str, tmp_path: Path) -> None:
    sheet = tmp_path / "sheet.yaml"
    (tmp_path / "arm.yaml").write_text(robot, encoding="utf-8")
    sheet.write_text("title: An arm\nproblems:\n- {robot: arm.yaml, find: regressor}\n", encoding="utf-8")
    (page,) = pages(sheet, tmp_path / "out", "json")
    told = json.loads(page.read_text())["problems"][0]["questions"][0]["results"]
    links = YAML(typ="safe").load(robot)["links"]
    rank = np.linalg.matrix_rank(regressor(links), tol=1e-7)
    assert len(told["base_parameters"]) == len(told["groups"]) == rank
    assert "0" in told["base_parameters"]


def regressor(links: list[dict[str, Any]]) -> Any:
    """Of the parameters that are not zero, about the origin of the frame before and in the axes of their
    own, at random motions; and of the rotors."""
    draw, n = np.random.default_rng(3), len(links)
    rotors = [i for i, link in enumerate(links) if "motor" in link]
    blocks = []
    for _ in range(60):
        q, rates, rises = draw.uniform(-2, 2, (3, n))
        Y = np.zeros((n, 10 * n + len(rotors)))
        R, w, rise, o, a = np.eye(3), np.zeros(3), np.zeros(3), np.zeros(3), G
        axes, origins = [], []
        for i, link in enumerate(links):
            z = R[:, 2]
            axes.append(z)
            origins.append(o)
            rise = rise + z * rises[i] + np.cross(w, z * rates[i])
            w = w + z * rates[i]
            step = pose(link, q[i])
            R, arm = R @ step[:3, :3], R @ step[:3, 3]
            for j, force, moment in wrenches(R, w, rise, a):
                for k in range(i + 1):
                    Y[k, 10 * i + j] = axes[k] @ (moment + np.cross(o - origins[k], force))
            o, a = o + arm, a + np.cross(rise, arm) + np.cross(w, np.cross(w, arm))
        for column, i in enumerate(rotors):
            Y[i, 10 * n + column] = rises[i]
        blocks.append(Y)
    values = np.concatenate([*(parameters(link) for link in links), np.ones(len(rotors))])
    return np.vstack(blocks)[:, np.abs(values) > 1e-12]


def wrenches(R: Any, w: Any, rise: Any, a: Any) -> Any:
    """Force, and moment about the point of acceleration a, for each of ten parameters of a body alone."""
    yield 0, a, np.zeros(3)
    for j in range(3):
        s = R[:, j]
        yield 1 + j, np.cross(rise, s) + np.cross(w, np.cross(w, s)), np.cross(s, a)
    for j, (row, across) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))):
        unit = np.zeros((3, 3))
        unit[row, across] = unit[across, row] = 1
        inertia = R @ unit @ R.T
        yield 4 + j, np.zeros(3), inertia @ rise + np.cross(w, inertia @ w)


def parameters(link: dict[str, Any]) -> Any:
    """Mass, first moments, XX, YY, ZZ, XY, YZ, XZ about the origin of the frame before."""
    mass = size(link["mass"])
    own = pose(link, 0.3)
    com = np.array([size(each) for each in link["com"]]) + own[:3, :3].T @ own[:3, 3]
    inertia = np.diag([size(each) for each in link["inertia"]])
    J = inertia + mass * (com @ com * np.eye(3) - np.outer(com, com))
    return np.array([mass, *mass * com, J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[1, 2], J[0, 2]])


def pose(link: dict[str, Any], q: float) -> Any:
    """A row of Denavit and Hartenberg."""
    (c, s), twist = (np.cos(q), np.sin(q)), np.deg2rad(size(link["alpha"]))
    t, u, a = np.cos(twist), np.sin(twist), size(link["a"])
    rows = [[c, -s * t, s * u, a * c], [s, c * t, -c * u, a * s], [0, u, t, size(link["d"])], [0, 0, 0, 1]]
    return np.array(rows)


def size(typed: str | float) -> float:
    """The number of a quantity."""
    return float(str(typed).split()[0])
