"""Random coupled arms against plain NumPy: poses from the columns of a table written out here, energies from
the poses by complex differences, and Lagrange's equations from the energies."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from derive.algebra.formulas.grammar import parse
from derive.algebra.numbers import floats as numeric
from derive.expression import ZERO, Symbol
from derive.kinds.problem import Problem
from derive.mechanics.bodies import Body, Moments
from derive.mechanics.chain import chain
from derive.mechanics.jacobian import jacobian
from derive.mechanics.motion import Move
from derive.mechanics.poses import position_part
from derive.mechanics.robot import Convention, DHRow, JointType, Link, Robot

Array = NDArray[Any]
Values = dict[str, Any]
STEP = 1e-30  # of complex differences, which lose no digits
COUPLINGS = ("{q} - {p}", "{q} + {p}", "{q} - {p}/2", "{q} + 2*{p}", "{q} + k*{p}", "{q} + k*{p}^2")
COLUMNS: dict[str, tuple[str, ...]] = {
    "standard": ("theta", "d", "a", "alpha"),
    "modified": ("alpha", "a", "theta", "d"),
}


def text(expr: str, at: Values) -> Any:
    """The value of a formula, of complex numbers too."""
    return eval(expr.replace("^", "**"), {"sin": np.sin, "cos": np.cos, "pi": np.pi}, at)


def move(column: str, by: Any) -> Array:
    """T (4 by 4) of one column of a table."""
    T = np.eye(4, dtype=complex)
    if column in ("d", "a"):
        T[2 if column == "d" else 0, 3] = by
        return T
    c, s = np.cos(by), np.sin(by)
    if column == "theta":
        T[:2, :2] = [[c, -s], [s, c]]
    else:
        T[1:3, 1:3] = [[c, -s], [s, c]]
    return T


class Arm:
    """A random arm in texts, for both routes."""

    def __init__(self, seed: int) -> None:
        draw = random.Random(seed)
        self.convention: Convention = draw.choice(("standard", "modified"))
        self.joints: list[JointType] = [
            draw.choice(("revolute", "revolute", "prismatic")) for _ in range(draw.choice((2, 3)))
        ]
        names = [f"q{i}" for i in range(1, len(self.joints) + 1)]
        self.names = names
        self.rows: list[dict[str, str]] = []
        for i, joint in enumerate(self.joints, 1):
            own, other = names[i - 1], draw.choice([n for n in names if n != names[i - 1]])
            by = draw.choice(COUPLINGS).format(q=own, p=other) if draw.random() < 0.7 else own
            row = {
                "theta": draw.choice(("0", "pi/2")), "d": draw.choice(("0", f"d{i}")),
                "a": draw.choice((f"a{i}", f"a{i} + {other}")),
                "alpha": draw.choice(("0", "pi/2", "-pi/2")),
            }  # fmt: skip
            row["theta" if joint == "revolute" else "d"] = by
            if joint == "revolute" and draw.random() < 0.2:
                row["d"] = f"k*{own}"
            row["com"] = draw.choice(("0", "0", other, f"k*{own}"))
            row["inertia"] = draw.choice(("0", "0", "0", f"{other}^2"))
            self.rows.append(row)
        self.tool = draw.choice(("l", f"l + {names[0]}"))

    @property
    def robot(self) -> Robot:
        links = []
        for i, (row, joint) in enumerate(zip(self.rows, self.joints, strict=True), 1):
            com = (parse(f"-b{i} + {row['com']}"), parse(f"e{i}"), ZERO)
            moments = (f"X{i}", f"Y{i}", f"Z{i} + {row['inertia']}", "0", f"F{i}", "0")
            body = Body(Symbol(f"m{i}"), com, Moments(tuple(map(parse, moments))))
            table = DHRow(*(parse(row[column]) for column in COLUMNS["standard"]))
            links.append(Link(table, joint, self.names[i - 1], body))
        tool = (Move("translate", "x", parse(self.tool)),)
        gravity = (ZERO, parse("-g"), parse("g/2"))
        return Robot("", self.convention, tuple(links), tool=tool, gravity=gravity)

    def poses(self, at: Values) -> list[Array]:
        T = [np.eye(4, dtype=complex)]
        for row in self.rows:
            here = T[-1]
            for column in COLUMNS[self.convention]:
                here = here @ move(column, text(row[column], at))
            T.append(here)
        return [*T, T[-1] @ move("a", text(self.tool, at))]

    def inertia_matrix(self, at: Values) -> Array:
        """D (n by n) by velocities of unit rates; complex in a complex point."""
        n = len(self.names)
        D = np.zeros((n, n), dtype=complex)
        for i, row in enumerate(self.rows, 1):
            J_v, J_w = self._rates(i, at)
            local = [f"X{i}", f"Y{i}", f"Z{i} + {row['inertia']}", f"F{i}"]
            xx, yy, zz, yz = (text(each, at) for each in local)
            I = np.array([[xx, 0, 0], [0, yy, yz], [0, yz, zz]])
            D += at[f"m{i}"] * J_v.T @ J_v + J_w.T @ I @ J_w
        return D

    def _rates(self, i: int, at: Values) -> tuple[Array, Array]:
        """J_v of the com in the base frame and J_w in that of link i (3 by n), by real differences."""
        h, columns = 1e-4, []
        R = self._placed(i, at)[1]
        for name in self.names:
            shots = [self._placed(i, {**at, name: at[name] + k * h}) for k in (-2, -1, 1, 2)]
            c, turned = (np.array(each) for each in zip(*shots, strict=True))
            weights = np.array([1, -8, 8, -1]) / (12 * h)
            S = R.T @ np.tensordot(weights, turned, axes=1)
            columns.append((weights @ c, np.array([S[2, 1], S[0, 2], S[1, 0]])))
        return np.array([c[0] for c in columns]).T, np.array([c[1] for c in columns]).T

    def _placed(self, i: int, at: Values) -> tuple[Array, Array]:
        T = self.poses(at)[i]
        c = np.array([text(f"-b{i} + {self.rows[i - 1]['com']}", at), at[f"e{i}"], 0])
        return T[:3, :3] @ c + T[:3, 3], T[:3, :3]

    def potential(self, at: Values) -> Any:
        gravity = np.array([0, -at["g"], at["g"] / 2])
        return -sum(at[f"m{i}"] * gravity @ self._placed(i, at)[0] for i in range(1, len(self.rows) + 1))


def slope(function: Callable[[Values], Any], at: Values, name: str) -> Any:
    """By a complex step."""
    return np.imag(function({**at, name: at[name] + 1j * STEP})) / STEP


def point(arm: Arm, seed: int) -> Values:
    draw = random.Random(seed)
    letters = ["d", "a", "b", "e", "m", "X", "Y", "Z", "F"]
    named = [f"{letter}{i}" for letter in letters for i in range(1, 4)]
    rates = [f"{name}_{dots}" for name in arm.names for dots in ("dot", "ddot")]
    return {name: draw.uniform(0.3, 1.4) for name in (*arm.names, *named, *rates, "k", "l", "g")}


def numbers(problem: Problem, kind: str, name: str, at: Values) -> Any:
    result = problem.ask(kind).results[name]
    assert not isinstance(result, tuple | str | float)
    return np.array(numeric.numbers(result, at))


@pytest.mark.parametrize("seed", range(24))
def test_jacobians(seed: int) -> None:
    arm, at = Arm(seed), point(Arm(seed), seed)
    found = chain(arm.robot)
    J = jacobian(found, position_part(found.T_tool), len(arm.rows) + 1)
    ours = np.array(numeric.matrix_numbers(J, at))
    R = arm.poses(at)[-1][:3, :3].real
    for k, name in enumerate(arm.names):
        rate = slope(lambda here: arm.poses(here)[-1], at, name)
        S = rate[:3, :3] @ R.T
        assert np.allclose(ours[:, k], [*rate[:3, 3], S[2, 1], S[0, 2], S[1, 0]], atol=1e-11)


@pytest.mark.parametrize("seed", range(24))
def test_dynamics(seed: int) -> None:
    """D, c_ijk, g and tau by Lagrange's equations."""
    arm, at = Arm(seed), point(Arm(seed), seed)
    problem = Problem("robot", arm.robot)
    n, names = range(len(arm.names)), arm.names
    D = arm.inertia_matrix(at).real
    assert np.allclose(numbers(problem, "inertia-matrix", "D", at), D, rtol=1e-8, atol=1e-8)
    by = [slope(arm.inertia_matrix, at, name) for name in names]
    g = [slope(arm.potential, at, name) for name in names]
    assert np.allclose(numbers(problem, "gravity", "g", at), g, atol=1e-9)
    rate = np.array([at[f"{name}_dot"] for name in names])
    rise = np.array([at[f"{name}_ddot"] for name in names])
    tau = D @ rise + sum(by[k] * rate[k] for k in n) @ rate
    tau += [g[k] - rate @ by[k] @ rate / 2 for k in n]
    assert np.allclose(numbers(problem, "dynamics", "tau", at), tau, rtol=1e-7, atol=1e-7)
    for i, j, k in np.ndindex(len(n), len(n), len(n)):
        c = (by[i][k, j] + by[j][k, i] - by[k][i, j]) / 2
        ours = numbers(problem, "christoffel", f"c_{i + 1}{j + 1}{k + 1}", at)
        assert np.isclose(ours, c, rtol=1e-7, atol=1e-7)


@pytest.mark.parametrize("seed", range(24))
def test_every_claim_holds(seed: int) -> None:
    """Of the kinds that rest on rates."""
    problem = Problem("robot", Arm(seed).robot)
    for kind in ("jacobian", "space-jacobian", "product-of-exponentials", "dynamics", "energy"):
        assert all(claim.holds for claim in problem.ask(kind).claims), kind
