"""fit-transform against SciPy and NumPy."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy
import pytest
from scipy.spatial.transform import Rotation

from derive.algebra.formulas.grammar import parse
from derive.algebra.numbers.floats import number, numbers
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import Approximate, Expr, Matrix, Number
from derive.kinds.problem import Problem
from derive.mechanics.fitting import PointPairs


def tree(value: float) -> Number:
    return Number(Fraction(round(value * 10**6), 10**6), decimal=True)


def pairs(a: Any, b: Any) -> PointPairs:
    source, target = (tuple(tuple(map(tree, row)) for row in points) for points in (a, b))
    return PointPairs(source, target)


def ask(subject: PointPairs, method: str = "svd") -> Derivation:
    found = Problem("points", subject).ask("fit-transform", method=method)
    assert found.claims
    assert all(claim.holds for claim in found.claims), [c for c in found.claims if not c.holds]
    return found


def value(found: Derivation, name: str) -> Any:
    result = found.results[name]
    assert not isinstance(result, tuple | str | float)
    return numpy.array(numbers(result, {}))


def cloud(seed: int, count: int, noise: float, mirrored: bool = False) -> tuple[Any, Any]:
    draw = numpy.random.default_rng(seed)
    a = draw.uniform(-2, 2, (count, 3))
    R = Rotation.random(random_state=seed).as_matrix()
    b = a @ R.T + draw.uniform(-1, 1, 3) + noise * draw.normal(size=(count, 3))
    if mirrored:
        b = b * [1, 1, -1]
    return numpy.round(a, 6), numpy.round(b, 6)


def scipy_fit(a: Any, b: Any) -> tuple[Any, Any, float]:
    mean_a, mean_b = a.mean(axis=0), b.mean(axis=0)
    rotation, _ = Rotation.align_vectors(b - mean_b, a - mean_a)
    R = rotation.as_matrix()
    p = mean_b - R @ mean_a
    rms = float(numpy.sqrt(((a @ R.T + p - b) ** 2).sum(axis=1).mean()))
    return R, p, rms


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("noise", [0.0, 0.02, 0.3])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_it_is_what_scipy_fits(seed: int, noise: float, mirrored: bool) -> None:
    a, b = cloud(seed, 6, noise, mirrored)
    found = ask(pairs(a, b))
    R, p, rms = scipy_fit(a, b)
    assert value(found, "R") == pytest.approx(R, abs=1e-9)
    assert value(found, "p") == pytest.approx(p, abs=1e-9)
    assert value(found, "rms") == pytest.approx(rms, abs=1e-9)
    assert (found.facts.svd.best.key == "best-reflected") is mirrored


def test_points_of_a_plane_have_their_rotation() -> None:
    a, b = cloud(5, 5, 0.05)
    a[:, 2] = 0
    found = ask(pairs(a, b))
    R, _, _ = scipy_fit(a, b)
    assert value(found, "R") == pytest.approx(R, abs=1e-9)
    assert found.facts.svd.best.key != "best-reflected"


def test_in_the_plane_the_angle_is_that_of_the_sums() -> None:
    a = numpy.array([[0, 0], [2, 0], [0, 1.5]])
    b = numpy.array([[1, 1], [1.05, 3.02], [-0.48, 1.1]])
    found = ask(pairs(a, b))
    ca, cb = a - a.mean(axis=0), b - b.mean(axis=0)
    angle = numpy.arctan2((ca[:, 0] * cb[:, 1] - ca[:, 1] * cb[:, 0]).sum(), (ca * cb).sum())
    R = value(found, "R")
    assert (
        pytest.approx(
            numpy.array([[numpy.cos(angle), -numpy.sin(angle)], [numpy.sin(angle), numpy.cos(angle)]])
        )
        == R
    )


SQUARE = [(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3)]
TURNED = [(1, 2, 0), (1, 3, 0), (-1, 2, 0), (1, 2, 3)]


def entries(matrix: Any) -> list[Expr]:
    assert isinstance(matrix, Matrix)
    return [entry for row in matrix.rows for entry in row]


@pytest.mark.parametrize("method", ["svd", "rows"])
def test_a_perfect_fit_is_exact(method: str) -> None:
    found = ask(pairs(SQUARE, TURNED), method)
    assert not any(isinstance(entry, Approximate) for entry in entries(found.results["R"]))
    assert value(found, "R").tolist() == [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    assert value(found, "p").tolist() == [1, 2, 0]
    assert value(found, "rms") == 0


def test_a_perfect_fit_may_hold_roots() -> None:
    """Turned by 30 degrees about z: the rotation comes out with its square roots."""
    source = tuple(tuple(map(parse, map(str, point))) for point in SQUARE)
    target = tuple(
        (parse(f"sqrt(3)/2*({x}) - ({y})/2"), parse(f"({x})/2 + sqrt(3)/2*({y})"), parse(str(z)))
        for x, y, z in SQUARE
    )
    found = ask(PointPairs(source, target))
    assert found.facts.svd.left.key == "nothing-left"
    assert number(entries(found.results["R"])[0], {}) == pytest.approx(3**0.5 / 2)


@pytest.mark.parametrize("seed", [1, 4])
def test_the_rows_are_those_of_least_squares(seed: int) -> None:
    a, b = cloud(seed, 7, 0.2)
    found = ask(pairs(a, b), "rows")
    A = numpy.column_stack([a, numpy.ones(len(a))])
    x = numpy.linalg.lstsq(A, b, rcond=None)[0].T
    assert value(found, "T")[:3] == pytest.approx(x, abs=1e-9)
    R = x[:, :3] / numpy.linalg.norm(x[:, :3], axis=1, keepdims=True)
    assert value(found, "R") == pytest.approx(R, abs=1e-9)
    assert found.facts.rows.verdict.key == "rows-neither"
    assert numpy.abs(R @ R.T - numpy.eye(3)).max() > 1e-3


def test_by_singular_values_less_is_left_over_than_by_any_turn_nearby() -> None:
    a, b = cloud(7, 6, 0.3)
    found = ask(pairs(a, b))
    R, p, rms = value(found, "R"), value(found, "p"), float(value(found, "rms"))
    for seed in range(20):
        turn = Rotation.from_rotvec(numpy.random.default_rng(seed).normal(size=3) * 0.05).as_matrix()
        mean = a.mean(axis=0) @ R.T + p
        moved = (a @ R.T + p - mean) @ turn.T + mean
        assert float(numpy.sqrt(((moved - b) ** 2).sum(axis=1).mean())) >= rms


@pytest.mark.parametrize(
    ("a", "b", "method", "reason"),
    [
        ([(0, 0, 0), (1, 1, 1), (2, 2, 2)], SQUARE[:3], "svd", "line"),
        (SQUARE[:3], [(0, 0, 0), (1, 1, 1), (2, 2, 2)], "svd", "second frame all lie on a line"),
        ([(1, 1), (1, 1), (1, 1)], [(0, 0), (1, 0), (0, 1)], "svd", "coincide"),
        (SQUARE[:3], TURNED[:3], "rows", "in a plane"),
        (SQUARE, [(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 0)], "rows", "vanishes"),
        (
            [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)],
            [(-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1)],
            "svd",
            "several rotations",
        ),
    ],
)
def test_what_leaves_the_rotation_open_is_refused(a: Any, b: Any, method: str, reason: str) -> None:
    with pytest.raises(NotDerivable, match=reason):
        ask(pairs(a, b), method)


def test_letters_are_refused() -> None:
    subject = PointPairs(
        ((parse("a"), parse("0")), (parse("1"), parse("0"))), ((parse("0"),) * 2, (parse("1"),) * 2)
    )
    with pytest.raises(NotDerivable, match="a has no value"):
        ask(subject)
