"""Newton's method and the gradient on the arm of two links, against its closed form."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import pytest

from derive.mechanics.iteration import iterate

ARM = (1.0, 0.7)


def pose(q: Any) -> tuple[list[float], Any]:
    l1, l2 = ARM
    a, b = q[0], q[0] + q[1]
    s1, c1, s12, c12 = math.sin(a), math.cos(a), math.sin(b), math.cos(b)
    return [l1 * c1 + l2 * c12, l1 * s1 + l2 * s12], [
        [-l1 * s1 - l2 * s12, -l2 * s12],
        [l1 * c1 + l2 * c12, l2 * c12],
    ]


@pytest.mark.parametrize(("method", "left"), [("newton", 1e-8), ("gradient", 1e-3)])
def test_it_comes_to_the_target(method: str, left: float) -> None:
    target, _ = pose((0.4, 0.9))
    found = iterate(pose, target, (0.1, 1.2), method, 200, None)
    assert found.rows[-1].q == pytest.approx((0.4, 0.9), abs=left)


def test_newton_converges_quadratically() -> None:
    target, _ = pose((0.4, 0.9))
    errors = [row.error for row in iterate(pose, target, (0.1, 1.2), "newton", 20, None).rows]
    assert all(after < 3 * before**2 for before, after in pairwise(errors[1:]))


def test_newton_stops_at_a_singular_start() -> None:
    found = iterate(pose, (0.5, 0.5), (0.0, 0.0), "newton", 10, None)
    assert (found.verdict, len(found.rows)) == ("singular", 1)


def test_the_gradient_is_stuck_where_the_error_is_in_the_null_space_of_the_transpose() -> None:
    found = iterate(pose, (0.5, 0.0), (0.0, 0.0), "gradient", 10, None)
    assert (found.verdict, len(found.rows)) == ("stuck", 1)


def test_a_target_out_of_reach() -> None:
    found = iterate(pose, (3.0, 0.0), (0.1, 0.3), "gradient", 50, 0.2)
    assert found.verdict == "unfinished"
    assert found.rows[-1].error > 1.29


def test_h_is_half_the_square_of_the_error() -> None:
    row = iterate(pose, (0.5, 0.5), (0.0, 0.7), "newton", 1, None).rows[0]
    assert pytest.approx(row.error**2 / 2) == row.H
