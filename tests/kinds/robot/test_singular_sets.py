"""Singular sets against plain NumPy: the rank of the Jacobian at points of each set, and zeros of its
singular values that are searched from random starts, each of which has to lie in a set of that rank.

The Jacobian is written out here from the DH rows; the search is SciPy's.
"""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from scipy.optimize import least_squares

from derive.algebra.formulas.grammar import parse
from derive.algebra.numbers.floats import number
from derive.derivation import Branch
from derive.errors import NotDerivable
from derive.mechanics.task import ROWS
from tests.kinds.robot.test_singularities import ELBOW, NAMES, SPHERICAL, STANFORD, THREE_R, asked, said

Rows = tuple[tuple[str, str, str, str], ...]
ORTHOGONAL = (("q1*", "0", "1", "-90 deg"), ("q2*", "1", "2", "90 deg"), ("q3*", "0", "3/2", "0"))
OFFSET = (("q1*", "d1", "a1", "90 deg"), ("q2*", "0", "a2", "0"), ("q3*", "0", "a3", "0"))
EQUAL = (("q1*", "0", "1", "0"), ("q2*", "0", "1", "0"), ("q3*", "0", "1", "0"))
YOUBOT = (
    ("q1*", "0.147", "0.033", "90 deg"), ("q2*", "0", "0.155", "0"), ("q3*", "0", "0.135", "0"),
    ("q4*", "0", "0", "90 deg"), ("q5*", "0.2175", "0", "0"),
)  # fmt: skip
PLANAR_6R = tuple((f"q{k}*", "0", f"l{k}", "0") for k in range(1, 7))
ARMS = {
    "anthropomorphic": (ELBOW, ("vx", "vy", "vz")),
    "offset": (OFFSET, ("vx", "vy", "vz")),
    "spherical": (SPHERICAL, ("vx", "vy", "vz")),
    "Stanford": (STANFORD, ROWS),
    "orthogonal": (ORTHOGONAL, ("vx", "vy", "vz")),
    "planar 3R": (THREE_R, ("vx", "vy")),
    "equal links": (EQUAL, ("vx", "vy")),
}


@pytest.mark.parametrize("name", ARMS)
def test_ranks_are_those_of_numpy_and_no_zero_is_missed(name: str) -> None:
    rows, which = ARMS[name]
    compare(rows, which, random.Random(name))


@pytest.mark.parametrize("seed", range(12))
def test_of_random_arms_of_three_joints(seed: int) -> None:
    draw = random.Random(seed)
    rows = tuple(_row(draw, k) for k in range(1, 4))
    try:
        compare(rows, ("vx", "vy", "vz"), draw)
    except NotDerivable as error:
        assert "dependent in every configuration" in str(error)
        assert _rank(jacobian(rows, _anywhere(rows, draw))[:3]) < 3


def test_all_links_in_one_line_are_one_set() -> None:
    (only,) = asked(PLANAR_6R, ("vx", "vy")).results["solutions"]
    assert sorted(only.facts["equations"]) == [f"sin(q{k})" for k in range(2, 7)]
    assert only.facts["rank"] == 1


def test_a_factor_without_real_zeros_is_left_out() -> None:
    """Orthogonal arms and the youBot with numbers: 4 + 3 c_3 is never zero."""
    for rows in (ORTHOGONAL, YOUBOT):
        found = asked(rows)
        assert found.results["complete"] is True
        assert all(claim.holds for claim in found.claims)


def test_where_the_elbow_meets_the_shoulder_the_rank_is_one() -> None:
    (inner,) = [each for each in asked(ELBOW).results["solutions"] if said(each).startswith("inside")]
    assert (sorted(inner.facts["equations"]), inner.facts["rank"]) == (["cos(q2)", "sin(q3)"], 1)


def test_ranks_that_are_too_long_to_be_split_leave_the_sets() -> None:
    """Of an arm with offsets in letters and a tool beyond its wrist."""
    rows = (
        ("q1*", "d1", "a1", "-90 deg"), ("q2*", "0", "a2", "0"), ("q3*", "0", "a3", "-90 deg"),
        ("q4*", "d4", "0", "90 deg"), ("q5*", "0", "0", "-90 deg"), ("q6*", "d6", "0", "0"),
    )  # fmt: skip
    found = asked(rows)
    assert all(claim.holds for claim in found.claims)
    bounds = [each.facts.get("rank_at_most") for each in found.results["solutions"]]
    assert bounds.count(5) == 6  # the elbow, the shoulder and the wrist, two of each


def test_what_is_too_long_is_refused_before_it_is_worked_out() -> None:
    with pytest.raises(NotDerivable, match="too long to be taken apart"):
        asked(tuple((f"q{k}*", "0", f"l{k}", "90 deg") for k in range(1, 9)))


def test_a_sum_of_squares_is_no_set_of_rank_zero() -> None:
    """a c_2 + b s_2 = 0 with a^2 + b^2 = 0 has no real points but a = b = 0: it was given as a set."""
    rows = (
        ("q1*", "0", "a1", "-90 deg"), ("q2*", "1", "0", "-90 deg"),
        ("q3*", "0", "0", "90 deg"), ("q4*", "1/2", "1", "180 deg"),
    )  # fmt: skip
    assert all(each.facts.get("rank", 1) for each in asked(rows, ("vx", "vy", "wz")).results["solutions"])


def test_parallel_axes_are_no_wrist() -> None:
    words = " ".join(said(each) for each in asked(EQUAL, ("vx", "vy")).results["solutions"])
    assert "wrist" not in words


# -- the second route ------------------------------------------------------------------------------------


def compare(rows: Rows, which: tuple[str, ...], draw: random.Random) -> None:
    found = asked(rows, which)
    assert all(claim.holds for claim in found.claims)
    sets, lines = found.results["solutions"], [ROWS.index(row) for row in which]
    for each in sets:
        for _ in range(4):
            at = _zero(lambda here, each=each: _distances(each, here), rows, _anywhere(rows, draw))
            if at:
                assert _rank(jacobian(rows, at)[lines]) <= each.facts.get(
                    "rank", each.facts.get("rank_at_most")
                )
    assert found.results["complete"] is True
    for _ in range(12):
        at = _anywhere(rows, draw)
        for level in range(len(lines) - 1, -1, -1):
            lower = _zero(lambda here, k=level: _singular_values(rows, lines, here)[k:], rows, at)
            if lower is None:
                break
            at, rank = lower, _rank(jacobian(rows, lower)[lines])
            here = [each for each in sets if max(map(abs, _distances(each, at)), default=0) < 1e-4]
            assert min(each.facts["rank"] for each in here) == rank


def jacobian(rows: Rows, at: Mapping[str, float]) -> Any:
    T, axes = np.eye(4), []
    for theta, d, a, alpha in rows:
        if theta.endswith("*") or d.endswith("*"):
            axes.append((T[:3, 2].copy(), T[:3, 3].copy(), d.endswith("*")))
        t, s, length, twist = (_number(entry, at) for entry in (theta, d, a, alpha))
        ct, st, ca, sa = math.cos(t), math.sin(t), math.cos(twist), math.sin(twist)
        T = T @ np.array(
            [
                [ct, -st * ca, st * sa, length * ct],
                [st, ct * ca, -ct * sa, length * st],
                [0, sa, ca, s],
                [0, 0, 0, 1],
            ]
        )
    p = T[:3, 3]
    columns = [np.r_[z, 0, 0, 0] if slides else np.r_[np.cross(z, p - o), z] for z, o, slides in axes]
    return np.array(columns).T


def _number(entry: str, at: Mapping[str, float]) -> float:
    if entry.endswith(" deg"):
        return math.radians(float(entry.removesuffix(" deg")))
    return number(parse(entry.removesuffix("*")), at)


def _variables(rows: Rows) -> list[str]:
    return [entry[:-1] for row in rows for entry in row[:2] if entry.endswith("*")]


def _anywhere(rows: Rows, draw: random.Random) -> dict[str, float]:
    lengths = {name: draw.uniform(0.3, 1.8) for name in NAMES}
    return lengths | {name: draw.uniform(-3, 3) for name in _variables(rows)}


def _distances(each: Branch, at: Mapping[str, float]) -> list[float]:
    """How far a configuration is from a set: its equations, or the differences from its values."""
    if "equations" in each.facts and not (each.values and said(each).startswith("inside")):
        return [number(parse(equation), at) for equation in each.facts["equations"]]
    angles = [2 * math.sin((at[name] - number(value, at)) / 2) for name, value in each.values.items()]
    return [*angles, *(number(parse(equation), at) for equation in each.facts.get("equations", []))]


def _zero(function: Any, rows: Rows, start: Mapping[str, float]) -> dict[str, float] | None:
    names = _variables(rows)

    def at(x: Any) -> dict[str, float]:
        return {**start, **dict(zip(names, x, strict=True))}

    def padded(x: Any) -> list[float]:
        return [*function(at(x)), *[0.0] * len(names)]

    best = least_squares(
        padded, [start[name] for name in names], xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=80
    )
    return at(best.x) if best.cost < 1e-22 else None


def _singular_values(rows: Rows, lines: list[int], at: Mapping[str, float]) -> Any:
    return np.linalg.svd(jacobian(rows, at)[lines], compute_uv=False)


def _rank(J: Any) -> int:
    values = np.linalg.svd(J, compute_uv=False)
    return int((values > 1e-6 * max(1.0, values[0])).sum())


def _row(draw: random.Random, k: int) -> tuple[str, str, str, str]:
    twist = draw.choice(["0", "90 deg", "-90 deg", "180 deg"])
    a, d = draw.choice(["0", f"a{k}"]), draw.choice(["0", f"d{k}"])
    return ("0", f"q{k}*", a, twist) if draw.random() < 0.2 else (f"q{k}*", d, a, twist)
