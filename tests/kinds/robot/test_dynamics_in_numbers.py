"""The equations of motion in numbers, where they are too long in letters: against those in letters of short
arms, and against energies in NumPy of a long one."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from derive.algebra.numbers.floats import numbers
from derive.errors import SheetErrors
from derive.kinds.robot._chain import chain_of
from derive.kinds.robot._dynamics.at_a_point import AtAPoint
from tests.mechanics.robots import body, problem, robot, row
from tests.sheets import pages

ROWS = [  # theta, d, a, alpha
    ("q1*", "0.1", "0.2", "30 deg"), ("q2*", "0.15", "0.3", "50 deg"), ("q3*", "0.2", "0.25", "-40 deg"),
    ("q4*", "0.12", "0.1", "70 deg"), ("q5*", "0.05", "0.15", "35 deg"), ("q6*", "0.1", "0.05", "20 deg"),
]  # fmt: skip
BODY = ", mass: {m}, com: [-0.05, 0.02, 0.03], inertia: [0.3, 0.4, 0.5, 0.01, 0.02, 0.03]"
Q, RATES = np.array([0.3, -0.4, 0.5, 0.6, -0.7, 0.8]), np.array([0.5, 0.4, -0.3, 0.2, 0.1, -0.6])
FORCES = np.array([1.0, -2.0, 3.0, 0.5, -0.4, 0.2])


def sheet(find: str, more: dict[str, float] | None) -> str:
    links = "\n".join(
        f"    - {{theta: {theta}, d: {d}, a: {a}, alpha: {alpha}{BODY.format(m=k)}}}"
        for k, (theta, d, a, alpha) in enumerate(ROWS, 1)
    )
    asked = f"  evaluate: {{{', '.join(f'{name}: {value}' for name, value in more.items())}}}" if more else ""
    return f"title: A test\nproblems:\n- robot:\n    links:\n{links}\n  find: {find}\n{asked}\n"


def told(find: str, more: dict[str, float], folder: Path) -> dict[str, Any]:
    path = folder / "sheet.yaml"
    path.write_text(sheet(find, more), encoding="utf-8")
    (found,) = (each for each in pages(path, folder, "json") if each.suffix == ".json")
    (question,) = json.loads(found.read_text(encoding="utf-8"))["problems"][0]["questions"]
    assert all(check["holds"] for check in question["checks"])
    return {name: np.array(value) for name, value in question["evaluated"].items()}


def place(q: np.ndarray) -> list[np.ndarray]:
    """T of each link, from the rows above (Spong et al., eq. 3.10)."""
    found, T = [], np.eye(4)
    for angle, (_, d, a, twist) in zip(q, ROWS, strict=True):
        c, s = np.cos(angle), np.sin(angle)
        ca, sa = (f(np.radians(float(twist.split()[0]))) for f in (np.cos, np.sin))
        x, z = float(a), float(d)
        T = T @ np.array(
            [[c, -s * ca, s * sa, x * c], [s, c * ca, -c * sa, x * s], [0, sa, ca, z], [0, 0, 0, 1]]
        )
        found.append(T)
    return found


def energies(q: np.ndarray, rates: np.ndarray) -> tuple[float, float]:
    """Kinetic and potential energy, velocities by differences of the poses."""
    I = np.array([[0.3, 0.01, 0.03], [0.01, 0.4, 0.02], [0.03, 0.02, 0.5]])
    kinetic = potential = 0.0
    h = 1e-5
    for m, (T, after, before) in enumerate(
        zip(place(q), place(q + h * rates), place(q - h * rates), strict=True), 1
    ):
        c = np.array([-0.05, 0.02, 0.03, 1])
        v = ((after - before) @ c)[:3] / (2 * h)
        S = T[:3, :3].T @ (after - before)[:3, :3] / (2 * h)
        w = np.array([S[2, 1], S[0, 2], S[1, 0]])
        kinetic += (m * v @ v + w @ I @ w) / 2
        potential += m * 9.81 * (T @ c)[2]
    return kinetic, potential


def test_accelerations_of_six_general_joints_keep_the_power(tmp_path: Path) -> None:
    point = {f"q{k}": v for k, v in enumerate(Q, 1)} | {f"q{k}_dot": v for k, v in enumerate(RATES, 1)}
    point |= {f"tau_{k}": v for k, v in enumerate(FORCES, 1)} | {"g": 9.81}
    found = told("forward-dynamics", point, tmp_path)
    D = found["D"]
    assert pytest.approx(energies(Q, RATES)[0], rel=1e-6) == RATES @ D @ RATES / 2
    # d/dt (K + P) = tau^T qdot
    t = 1e-4
    ends = (
        sum(energies(Q + s * t * RATES + t**2 / 2 * found["qddot"], RATES + s * t * found["qddot"]))
        for s in (1, -1)
    )
    after, before = ends
    assert (after - before) / (2 * t) == pytest.approx(FORCES @ RATES, rel=1e-4)
    assert D @ found["qddot"] + found["h"] == pytest.approx(FORCES)


def test_what_the_hand_shows_of_it(tmp_path: Path) -> None:
    point = {f"q{k}": v for k, v in enumerate(Q, 1)}
    found = told("operational-space-inertia", point, tmp_path)
    J, D, shown = (found[name] for name in ("J", "D", "Lambda"))
    assert J.T @ shown @ J == pytest.approx(D, rel=1e-6, abs=1e-9)


def test_missing_values_are_named(tmp_path: Path) -> None:
    for more, said in (
        (None, "under evaluate its numbers are found"),
        ({"q1": 1.0}, "g, q1_dot, q2, q2_dot"),
    ):
        with pytest.raises(SheetErrors) as caught:
            path = tmp_path / "sheet.yaml"
            path.write_text(sheet("forward-dynamics", more), encoding="utf-8")
            pages(path, tmp_path, "json")
        assert said in str(caught.value.errors[0])


def test_numbers_are_those_of_the_letters() -> None:
    """Of an arm with a slide, by the Christoffel symbols."""
    rows = [("q1*", "0", "a1", "30 deg"), ("20 deg", "q2*", "a2", "-70 deg"), ("q3*", "d3", "a3", "0")]
    bodies = (body(f"m{k}", f"b{k}, 0, c{k}", f"I{k}, J{k}, L{k}, 0, 0, 0") for k in (1, 2, 3))
    asked = problem(robot(*(row(*each, one) for each, one in zip(rows, bodies, strict=True))))
    names = {*asked.symbols, "g"} | {f"q{k}_dot" for k in (1, 2, 3)} | {f"tau_{k}" for k in (1, 2, 3)}
    draw = np.random.default_rng(4)
    at = {name: float(draw.uniform(0.3, 1.5)) for name in sorted(names)}
    ours = AtAPoint(asked, chain_of(asked), at)
    letters = asked.ask("forward-dynamics").results
    assert ours.accelerations == pytest.approx(np.ravel(numbers(letters["qddot"], at)))
    assert ours.motion.h == pytest.approx(np.ravel(numbers(letters["h"], at)))


def test_the_page_of_two_joints_has_its_numbers(tmp_path: Path) -> None:
    """det D is no name that stands alone."""
    links = "".join(
        f"    - {{theta: q{k}*, d: 0, a: 1, alpha: 0, mass: 1, com: [0, 0, 0], inertia: point}}\n"
        for k in (1, 2)
    )
    point = "{q1: 0, q2: 90 deg, q1_dot: 0, q2_dot: 0, tau_1: 1, tau_2: 0}"
    path = tmp_path / "sheet.yaml"
    path.write_text(
        "title: A test\nproblems:\n- robot:\n    gravity: [0, 0, 0]\n    links:\n"
        f"{links}  find: forward-dynamics\n  evaluate: {point}\n",
        encoding="utf-8",
    )
    (page,) = (each for each in pages(path, tmp_path, "md") if each.suffix == ".md")
    assert "\\det D" in page.read_text(encoding="utf-8")
