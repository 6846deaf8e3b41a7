"""Systems of polynomial equations against systems whose solutions are known, and against SymPy."""

from __future__ import annotations

import pytest
import sympy
from flint import arb

from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.algebra.solving.polynomial_systems import solve
from derive.algebra.solving.polynomials import coefficients, known_sign, odd_part
from derive.algebra.solving.real_roots import real_roots
from derive.errors import NotDerivable


def scalar(text: str) -> Scalar:
    return normal(parse(text))


def solutions(equations: list[str], unknowns: str, positive: str = "") -> list[dict[str, Scalar | arb]]:
    case = solve(map(scalar, equations), unknowns.split(), positive.split())
    return [dict(each.values) for each in case.all_solutions()]


def numbers(found: list[dict[str, Scalar | arb]]) -> list[dict[str, float]]:
    from derive.algebra.numbers.floats import scalar_number

    return [
        {n: float(v.mid()) if isinstance(v, arb) else scalar_number(v, {}) for n, v in each.items()}
        for each in found
    ]


@pytest.mark.parametrize(
    ("equations", "unknowns"),
    [
        (["x^2 + y^2 - 5", "x*y - 2"], "x y"),
        (["x^2 - y", "y^2 - x"], "x y"),
        (["x + y + z - 6", "x*y + y*z + z*x - 11", "x*y*z - 6"], "x y z"),  # permutations of 1, 2, 3
        (["x^2 + y^2 + z^2 - 3", "x*y - z", "x - y"], "x y z"),
        (["x^3 - 2*x + y", "y^2 - x*y"], "x y"),
        (["x^2 + x*y - 3", "y^2 + x*y - 1"], "x y"),
        (["(x - 1)*(y + 2)", "(x + 3)*(y - 4)*(x - y)"], "x y"),
    ],
)
def test_every_real_solution_is_found(equations: list[str], unknowns: str) -> None:
    symbols = sympy.symbols(unknowns)
    theirs = sympy.solve([sympy.sympify(each.replace("^", "**")) for each in equations], symbols, dict=True)
    expected = [
        {str(n): complex(v) for n, v in each.items()}
        for each in theirs
    ]  # fmt: skip
    real = [{n: v.real for n, v in each.items()} for each in expected if _is_real(each)]
    ours = numbers(solutions(equations, unknowns))
    for each in real:
        assert any(all(mine[n] == pytest.approx(v, abs=1e-9) for n, v in each.items()) for mine in ours)
    for mine in ours:
        assert any(all(mine[n] == pytest.approx(v, abs=1e-9) for n, v in each.items()) for each in real)


def _is_real(values: dict[str, complex]) -> bool:
    return all(abs(value.imag) < 1e-12 for value in values.values())


def test_no_solution_is_said_so() -> None:
    assert solutions(["x^2 + y^2 + 1"], "x y") == []
    assert solutions(["x + y - 1", "x + y - 2"], "x y") == []


def test_a_sum_of_squares_is_one_point() -> None:
    assert numbers(solutions(["x^2 + (y - 1)^2 - 2*y*0", "y - 1"], "x y")) == [{"x": 0.0, "y": 1.0}]


def test_parameters_stay() -> None:
    (only,) = solutions(["a*x - b", "x + y - c"], "x y")
    assert only["x"] == scalar("b/a")
    assert only["y"] == scalar("c - b/a")


def test_a_root_may_depend_on_the_parameters() -> None:
    case = solve([scalar("x^2 - c")], ["x"])
    assert [each.real_if[0] == scalar("c") for each in case.all_solutions()] == [True, True]
    case = solve([scalar("x^2 - c")], ["x"], ["c"])
    assert [each.real_if for each in case.all_solutions()] == [(), ()]


def test_what_is_left_is_free() -> None:
    (only,) = solve([scalar("x + y - 1")], ["x", "y"]).all_solutions()
    assert only.free == ("x",)


def test_out_of_reach_is_refused_with_the_equation() -> None:
    with pytest.raises(NotDerivable, match="degree 5"):
        solutions(["x^5 - a*x - 1"], "x")


@pytest.mark.parametrize(
    ("text", "count"),
    [("x^4 - 10*x^2 + 1", 4), ("x^3 - 2", 1), ("x^5 - x - 1", 1), ("x^4 + 1", 0), ("x^3 - 3*x + 1", 3)],
)
def test_real_roots_are_roots(text: str, count: int) -> None:
    found = real_roots(coefficients(scalar(text), "x"))
    assert len(found) == count
    for each in found:
        if isinstance(each.value, Scalar):
            assert scalar(text).substitute({"x": each.value}) == 0
        else:
            value = sum(
                (each.value**k * int(c.constant or 0) for k, c in enumerate(coefficients(scalar(text), "x"))),
                arb(0),
            )
            assert value.contains(0)


def test_nested_roots_are_taken_apart() -> None:
    """sqrt(5 + 2 sqrt(6)) = sqrt(2) + sqrt(3)."""
    roots = [each.value for each in real_roots(coefficients(scalar("x^4 - 10*x^2 + 1"), "x"))]
    assert any(each == scalar("sqrt(2) + sqrt(3)") for each in roots)


@pytest.mark.parametrize(
    ("text", "positive", "sign"),
    [
        ("sqrt(2) - 3/2", "", -1), ("a^2 + b^2", "", 1), ("a*b", "a b", 1), ("a - b", "a b", None),
        ("a^2 + 2*a*b + b^2", "", 1), ("-(a - b)^2*c", "c", -1), ("a/(b^2 + 1)", "a", 1), ("0*a", "", 0),
        ("2*exp(a - b)", "", 1),
    ],
)  # fmt: skip
def test_signs(text: str, positive: str, sign: int | None) -> None:
    assert known_sign(scalar(text), positive.split()) == sign


def test_the_part_that_decides_a_sign() -> None:
    assert odd_part(scalar("-2*s*(a - b)^2/(1 + a^2)")) == scalar("-s")
