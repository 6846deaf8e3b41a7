"""The kinds of the subject `function` against textbooks, SymPy and dense sampling."""

from __future__ import annotations

import math
from typing import Any

import pytest
import sympy

from derive.algebra.formulas.grammar import parse, parse_equation
from derive.algebra.function import Constraint, Function
from derive.algebra.normal import normal
from derive.derivation import Branch, Derivation
from derive.errors import NotDerivable
from derive.expression import Matrix
from derive.kinds.problem import Problem
from derive.render.phrases import spoken
from tests.trees import sympy_of, value


def function(values: str, variables: str, *constraints: str) -> Function:
    trees = tuple(map(parse, values.split(";")))
    equations = tuple(Constraint(*parse_equation(each)) for each in constraints)
    return Function(tuple(variables.split()), trees, equations, ";" in values)


def ask(kind: str, subject: Function, positive: str = "", **options: Any) -> Derivation:
    assumptions = dict.fromkeys(positive.split(), "positive")
    found = Problem("function", subject, assumptions=assumptions).ask(kind, **options)
    assert found.claims
    assert all(claim.holds for claim in found.claims), [c for c in found.claims if not c.holds]
    return found


def points(found: Derivation) -> list[Branch]:
    branches = found.results["solutions"]
    assert isinstance(branches, tuple)
    return [each for each in branches if isinstance(each, Branch)]


def is_at(branch: Branch, **expected: str) -> bool:
    return all(normal(branch.values[name]) == normal(parse(text)) for name, text in expected.items())


def said(branch: Branch) -> str:
    return spoken("function", "stationary-points").when(branch.when)


def kinds(found: Derivation, **expected: str) -> list[str]:
    return [said(branch) for branch in points(found) if is_at(branch, **expected)]


# -- derivatives -----------------------------------------------------------------------------------------

FUNCTIONS = [
    "x^3*y^2 - 2*x", "x*sin(y) + cos(x*y)", "sqrt(x^2 + y^2)", "exp(x*y)/(1 + x^2)", "atan2(y, x)",
    "log(x^2 + y)*x", "acos(x/4) + asin(y/5)", "exp(sin(x))*y^2", "tan(x + y)",
]  # fmt: skip


@pytest.mark.parametrize("text", FUNCTIONS)
def test_gradient_and_hessian_are_those_of_sympy(text: str) -> None:
    subject = function(text, "x y")
    theirs = sympy_of(subject.values[0])
    at = {"x": 0.7, "y": 1.3}
    x, y = sympy.symbols("x y", real=True)
    here = {x: at["x"], y: at["y"]}
    gradient = ask("gradient", subject).results["gradient"]
    assert isinstance(gradient, Matrix)
    for (ours,), by in zip(gradient.rows, (x, y), strict=True):
        assert value(ours, at) == pytest.approx(float(theirs.diff(by).subs(here)))
    H = ask("hessian", subject).results["H"]
    assert isinstance(H, Matrix)
    for row, first in zip(H.rows, (x, y), strict=True):
        for ours, second in zip(row, (x, y), strict=True):
            assert value(ours, at) == pytest.approx(float(theirs.diff(first, second).subs(here)))


def test_jacobian_of_spherical_coordinates() -> None:
    """Stewart, Calculus, section 15.8: r^2 sin(theta)."""
    subject = function("r*sin(theta)*cos(phi); r*sin(theta)*sin(phi); r*cos(theta)", "r theta phi")
    found = ask("jacobian", subject, determinant=True)
    det = found.results["det"]
    assert normal(det) == normal(parse("r^2*sin(theta)"))  # type: ignore[arg-type]


def test_what_has_no_gradient_or_determinant_says_so() -> None:
    with pytest.raises(NotDerivable, match="jacobian"):
        ask("gradient", function("x; y", "x y"))
    with pytest.raises(NotDerivable, match="1 by 2"):
        ask("jacobian", function("x*y", "x y"), determinant=True)


def test_names_of_where_stay_in_the_steps() -> None:
    subject = function("a*x^2", "x")
    found = Problem("function", subject, where={"a": parse("2*b")}).ask("gradient")
    gradient = found.results["gradient"]
    assert isinstance(gradient, Matrix)
    assert normal(gradient.rows[0][0]) == normal(parse("4*b*x"))
    assert all(claim.holds for claim in found.claims)


# -- Lagrange multipliers --------------------------------------------------------------------------------


def test_stewart_on_the_unit_circle() -> None:
    """Stewart, Calculus, section 14.8, example 2: x^2 + 2 y^2 on the unit circle lies between 1 and 2."""
    found = ask("lagrange-multipliers", function("x^2 + 2*y^2", "x y", "x^2 + y^2 = 1"))
    assert kinds(found, x="0", y="1", f="2") == ["global maximum"]
    assert kinds(found, x="0", y="-1", f="2") == ["global maximum"]
    assert kinds(found, x="1", y="0", f="1") == ["global minimum"]
    assert kinds(found, x="-1", y="0", f="1") == ["global minimum"]
    assert len(points(found)) == 4


def test_stewart_nearest_and_farthest_on_a_sphere() -> None:
    """Section 14.8, example 4."""
    subject = function("(x - 3)^2 + (y - 1)^2 + (z + 1)^2", "x y z", "x^2 + y^2 + z^2 = 4")
    found = ask("lagrange-multipliers", subject)
    near = {"x": "6/sqrt(11)", "y": "2/sqrt(11)", "z": "-2/sqrt(11)"}
    far = {"x": "-6/sqrt(11)", "y": "-2/sqrt(11)", "z": "2/sqrt(11)"}
    assert kinds(found, **near) == ["global minimum"]
    assert kinds(found, **far) == ["global maximum"]


def test_stewart_with_two_constraints() -> None:
    """Section 14.8, example 5: the greatest value is 3 + sqrt(29)."""
    subject = function("x + 2*y + 3*z", "x y z", "x - y + z = 1", "x^2 + y^2 = 1")
    found = ask("lagrange-multipliers", subject)
    assert kinds(found, f="3 + sqrt(29)") == ["global maximum"]
    assert kinds(found, f="3 - sqrt(29)") == ["global minimum"]


def test_stewart_largest_box() -> None:
    """Section 14.8, example 1: 12 square metres of cardboard make an open box of 4 cubic metres."""
    subject = function("x*y*z", "x y z", "2*x*z + 2*y*z + x*y = 12")
    found = ask("lagrange-multipliers", subject, positive="x y z")
    assert kinds(found, x="2", y="2", z="1", f="4") == ["local maximum"]
    assert len(points(found)) == 1  # the mirrored one is no box


def test_nocedal_and_wright() -> None:
    """Numerical Optimization, example 12.1: the multiplier is -1/2 at (-1, -1)."""
    found = ask("lagrange-multipliers", function("x + y", "x y", "x^2 + y^2 = 2"))
    assert kinds(found, x="-1", y="-1", **{"lambda": "-1/2"}) == ["global minimum"]


def test_saddles_and_local_extremes_of_the_notes_example() -> None:
    found = ask("lagrange-multipliers", function("x^2*y", "x y", "x^2 + y^2 = 1"))
    assert kinds(found, x="0", y="1") == ["local minimum"]
    assert kinds(found, x="0", y="-1") == ["local maximum"]
    assert kinds(found, f="2*sqrt(3)/9") == ["global maximum"] * 2
    assert kinds(found, f="-2*sqrt(3)/9") == ["global minimum"] * 2


def test_letters_and_their_signs() -> None:
    subject = function("a*x + b*y", "x y", "x^2 + y^2 = r^2")
    found = ask("lagrange-multipliers", subject, positive="r")
    assert kinds(found, f="r*sqrt(a^2 + b^2)", x="a*r/sqrt(a^2 + b^2)") == ["global maximum"]
    product = ask("lagrange-multipliers", function("x*y", "x y", "x + y = c"))
    assert kinds(product, x="c/2", y="c/2", f="c^2/4") == ["global maximum"]
    cube = ask("lagrange-multipliers", function("x*y*z", "x y z", "x + y + z = s"))
    assert kinds(cube, x="s/3", y="s/3", z="s/3") == ["local maximum if s > 0, local minimum if s < 0"]
    assert kinds(cube, x="s", y="0", z="0") == ["saddle point"]


def test_a_singular_point_of_the_constraint_is_not_lost() -> None:
    """On the cusp y^2 = x^3 the least x is at the point where the gradient of the constraint vanishes."""
    found = ask("lagrange-multipliers", function("x", "x y", "y^2 = x^3"))
    (only,) = points(found)
    assert said(only) == "singular point of the constraints"
    assert "lambda" not in only.values


def test_a_whole_circle_of_points() -> None:
    found = ask("lagrange-multipliers", function("x^2 + y^2", "x y z", "x^2 + y^2 + z^2 = 1"))
    assert kinds(found, z="1", x="0", y="0") == ["global minimum"]
    free = [branch for branch in points(found) if is_at(branch, x="x")]
    assert [said(branch).partition(" where")[0] for branch in free] == ["global maximum"] * 2
    assert "1 - x**2 >= 0" in said(free[0])


QUADRATICS = [(3, 1, -2, 1, 0), (1, 4, 1, -2, 3), (0, 2, 0, 1, 1), (5, 0, -1, 0, 2), (2, -3, 2, 1, -1)]


@pytest.mark.parametrize("k", QUADRATICS)
def test_the_extremes_on_an_ellipse_are_those_of_sampling(k: tuple[int, ...]) -> None:
    a, b, c, d, e = k
    text = f"({a})*x^2 + ({b})*x*y + ({c})*y^2 + ({d})*x + ({e})*y"
    found = ask("lagrange-multipliers", function(text, "x y", "x^2/4 + y^2 = 1"))
    angles = [2 * math.pi * i / 20000 for i in range(20000)]
    sampled = [
        a * x * x + b * x * y + c * y * y + d * x + e * y
        for x, y in ((2 * math.cos(t), math.sin(t)) for t in angles)
    ]
    values = {said(branch): value_of(branch) for branch in points(found)}
    assert values["global maximum"] == pytest.approx(max(sampled), abs=1e-5)
    assert values["global minimum"] == pytest.approx(min(sampled), abs=1e-5)


def value_of(branch: Branch) -> float:
    from derive.algebra.numbers.floats import number

    return number(branch.values["f"], {})


def test_what_square_roots_do_not_reach_is_enclosed_and_said() -> None:
    found = ask("lagrange-multipliers", function("x^2 + y", "x y", "x^4 + y^4 = 1"))
    assert found.facts.enclosed is not None
    assert any(claim.by == "ball-arithmetic" for claim in found.claims)
    best = [value_of(branch) for branch in points(found) if said(branch) == "global maximum"]
    # y = t, x^2 = sqrt(1 - t^4): the greatest of sqrt(1 - t^4) + t over a fine grid
    grid = max(math.sqrt(1 - t**4) + t for t in (i / 100000 for i in range(100000)))
    assert best == [pytest.approx(grid, abs=1e-8)] * 2


@pytest.mark.parametrize(
    ("text", "constraints", "reason"),
    [
        ("sin(x)*y", ("x + y = 1",), "polynomials"),
        ("x^5*y + a*y^3 + x", ("x^4 + b*y^4 + x*y = 1",), "degree|too long|eliminated|roots"),
        ("x", (), "no constraint"),
        ("x + y", ("x = 1", "y = 2", "x*y = 2"), "more constraints"),
    ],
)
def test_what_is_out_of_reach_says_why(text: str, constraints: tuple[str, ...], reason: str) -> None:
    with pytest.raises(NotDerivable, match=reason):
        ask("lagrange-multipliers", function(text, "x y" if "y" in text else "x", *constraints))


# -- stationary points -----------------------------------------------------------------------------------


def test_stewart_stationary_points() -> None:
    """Section 14.7, example 3: x^4 + y^4 - 4 x y + 1 has a saddle and two minima."""
    found = ask("stationary-points", function("x^4 + y^4 - 4*x*y + 1", "x y"))
    assert kinds(found, x="0", y="0") == ["saddle point"]
    assert kinds(found, x="1", y="1", f="-1") == ["global minimum"]
    assert kinds(found, x="-1", y="-1", f="-1") == ["global minimum"]


def test_stationary_points_of_one_variable_and_of_a_fraction() -> None:
    found = ask("stationary-points", function("x^3 - 3*x", "x"))
    assert kinds(found, x="1") == ["local minimum"]
    assert kinds(found, x="-1") == ["local maximum"]
    hill = ask("stationary-points", function("x/(1 + x^2)", "x"))
    assert kinds(hill, x="1", f="1/2") == ["local maximum"]
