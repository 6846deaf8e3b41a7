"""A joint that turns between two that slide: every solution, found otherwise by NumPy."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest

import derive
from tests.random_sheets import STANDARD, dh
from tests.random_sheets import value as expression

LENGTHS = {"a1": 0.3, "a2": 0.25, "d2": 0.15, "a3": 0.1}
Twists = tuple[float, float]


def links(first: object, second: object, lengths: bool = True) -> list[dict[str, object]]:
    at = LENGTHS if lengths else {name: name for name in LENGTHS}
    return [
        {"theta": 0, "d": "d1*", "a": at["a1"], "alpha": first},
        {"theta": "theta2*", "d": at["d2"], "a": at["a2"], "alpha": second},
        {"theta": 0, "d": "d3*", "a": at["a3"], "alpha": 0},
    ]


def tip(twists: Sequence[float], q: Sequence[float]) -> np.ndarray:
    rows = links(*map(math.radians, twists))
    at = dict(zip(("d1", "theta2", "d3"), q, strict=True))
    T = np.eye(4)
    for row in rows:
        T = T @ dh(row, STANDARD, at)
    return np.array(np.real(T[:3, 3]))


def on_the_hyperboloid(twists: Sequence[float], p: np.ndarray) -> list[float]:
    """Every d1 by which the point, carried back, lies where the others bring it: its distance from the second
    axis and its height along it are those of the line of the third joint, sampled densely."""
    first, second = map(math.radians, twists)
    axis = np.array([0, -math.sin(first), math.cos(first)])  # of the second joint
    foot = np.array([LENGTHS["a1"], 0, 0])

    def gap(d1: float) -> float:
        seen = p - foot - [0, 0, d1]
        height = axis @ seen
        d3 = (height - LENGTHS["d2"]) / math.cos(second)
        across = (LENGTHS["a2"] + LENGTHS["a3"]) ** 2 + (d3 * math.sin(second)) ** 2
        return float(seen @ seen - height**2 - across)

    places = np.array([-1.0, 0.0, 1.0])
    found = np.roots(np.polyfit(places, list(map(gap, places)), 2))  # gap is of the second degree
    return sorted(float(each.real) for each in found if abs(each.imag) < 1e-9 and abs(each) < 1e6)


@pytest.mark.parametrize("twists", [(37, 64), (60, 120.5), (-20, 75), (45, 45), (45, 135), (90, 30)])
def test_every_solution_is_found(twists: Twists) -> None:
    draw = np.random.default_rng(7)
    arm = derive.robot(links=links(*(f"{each} deg" for each in twists)))
    for _ in range(3):
        q = draw.uniform((-0.6, -2.5, -0.6), (0.6, 2.5, 0.6))
        p = tip(twists, q)
        at = {name: round(float(value), 12) for name, value in zip("xyz", p, strict=True)}
        answer = arm.inverse_kinematics(given=["x", "y", "z"], evaluate=at)
        found = [[each[name] for name in ("d1", "theta2", "d3")] for each in answer.evaluated["solutions"]]
        for each in found:
            assert tip(twists, each) == pytest.approx(p, abs=1e-9)
        assert any(each == pytest.approx(list(q), abs=1e-8) for each in found)
        assert sorted(each[0] for each in found) == pytest.approx(on_the_hyperboloid(twists, p), abs=1e-7)


def test_letters_tell_where_there_is_none() -> None:
    arm = derive.robot(links=links("alpha1", "alpha2", lengths=False))
    solutions = arm.inverse_kinematics(given=["x", "y", "z"]).results["solutions"]
    assert len(solutions) == 2


@pytest.mark.parametrize("twists", [(37, 64), (64, 37), (20, 110)])
def test_what_is_reached_is_where_the_line_meets_the_hyperboloid(twists: Twists) -> None:
    described = links(*(f"{each} deg" for each in twists))
    under = derive.robot(links=described).workspace().results["reached"]
    draw, met = np.random.default_rng(1), set()
    for _ in range(40):
        p = draw.normal(0, 0.6, 3)
        value = float(np.real(expression(str(under), dict(zip("xyz", p, strict=True)))))
        if abs(value) > 1e-6:
            assert bool(on_the_hyperboloid(twists, p)) == (value > 0)
            met.add(value > 0)
    assert met == {True, False}


def test_with_equal_twists_all_but_a_plane_is_reached() -> None:
    results = derive.robot(links=links("45 deg", "45 deg")).workspace().results
    assert "reached" not in results
    assert results["description"].startswith("the whole space, but")
