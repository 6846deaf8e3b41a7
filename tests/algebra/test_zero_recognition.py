"""Relations between fixed angles, and with the roots of numbers."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from derive.algebra.exact_values import fixed_trig
from derive.algebra.fixed_angles.addition_theorems import independent
from derive.algebra.normal import normal
from tests.trees import formula

TURNS = st.fractions(0, 2, max_denominator=12)


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("cos(36 deg)", "(1 + sqrt(5))/4"),
        ("sin(18 deg)", "(sqrt(5) - 1)/4"),
        ("cos(35 deg)", "cos(45 deg) cos(10 deg) + sin(45 deg) sin(10 deg)"),
        ("cos(22.5 deg)", "sqrt(2 + sqrt(2))/2"),
        ("tan(22.5 deg)", "sqrt(2) - 1"),
        ("tan(20 deg) tan(40 deg) tan(80 deg)", "sqrt(3)"),
        ("sin(20 deg) sin(40 deg) sin(80 deg)", "sqrt(3)/8"),
        ("cos(pi/7) - cos(2 pi/7) + cos(3 pi/7)", "1/2"),
        ("tan(3 pi/11) + 4 sin(2 pi/11)", "sqrt(11)"),
        ("cos(1 deg)", "sin(89 deg)"),
        ("sqrt(6) cos(24 deg)", "sqrt(3) sqrt(2) sin(66 deg)"),
        ("cos(x + 20 deg) + cos(x + 140 deg) + cos(x - 100 deg)", "0"),
        ("x cos(20 deg) + x cos(100 deg) + x cos(140 deg)", "0"),
    ],
)
def test_known_relations(left: str, right: str) -> None:
    assert normal(formula(left)) == normal(formula(right))
    assert not normal(formula(f"{left} - ({right})"))


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("cos(20 deg)", "cos(21 deg)"),
        ("cos(36 deg)", "(1 - sqrt(5))/4"),
        ("cos(72 deg)", "cos(144 deg)"),
        ("tan(3 pi/11) + 4 sin(2 pi/11)", "-sqrt(11)"),
        ("cos(22.5 deg)", "-sqrt(2 + sqrt(2))/2"),
        ("cos(20 deg) + cos(40 deg)", "sqrt(3)"),
    ],
)
def test_conjugates_differ(left: str, right: str) -> None:
    assert normal(formula(left)) != normal(formula(right))


@given(TURNS, TURNS)
def test_the_addition_theorem(p: Fraction, q: Fraction) -> None:
    (c, s), (d, t) = fixed_trig(p), fixed_trig(q)
    assert fixed_trig(p + q) == (c * d - s * t, s * d + c * t)


def test_division_by_what_is_zero() -> None:
    with pytest.raises(ZeroDivisionError):
        1 / normal(formula("cos(36 deg) - (1 + sqrt(5))/4"))


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("sin(36 deg)", "sqrt(10 - 2 sqrt(5))/4"),
        ("sin(72 deg)", "sqrt(10 + 2 sqrt(5))/4"),
        ("cos(22.5 deg)", "sqrt(2 + sqrt(2))/2"),
        ("sqrt(3 + 2 sqrt(2))", "1 + sqrt(2)"),
        ("sqrt(3 - 2 sqrt(2))", "sqrt(2) - 1"),
        ("sqrt(5 + 2 sqrt(6))", "sqrt(2) + sqrt(3)"),
        ("sqrt(2 + sqrt(3))", "(sqrt(6) + sqrt(2))/2"),
        ("x sqrt(7 + 4 sqrt(3)) - y", "x (2 + sqrt(3)) - y"),
        ("sqrt(16 - 2 sqrt(29) + 2 sqrt(55 - 10 sqrt(29)))", "sqrt(5) + sqrt(11 - 2 sqrt(29))"),
    ],
)
def test_a_root_of_a_sum(left: str, right: str) -> None:
    assert normal(formula(left)) == normal(formula(right))


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("sin(36 deg)", "-sqrt(10 - 2 sqrt(5))/4"),
        ("sqrt(3 - 2 sqrt(2))", "1 - sqrt(2)"),
        ("sqrt(3 + sqrt(2))", "1 + sqrt(2)"),
        ("abs(x) sqrt(3 + 2 sqrt(2))", "x (1 + sqrt(2))"),
        ("sqrt(1 + sqrt(2))", "sqrt(2 + sqrt(2))"),
    ],
)
def test_a_root_of_a_sum_that_differs(left: str, right: str) -> None:
    assert normal(formula(left)) != normal(formula(right))


def test_two_angles_in_radians_have_only_the_relation_of_their_common_part() -> None:
    assert normal(formula("cos(0.3) cos(0.4) - sin(0.3) sin(0.4)")) == normal(formula("cos(0.7)"))
    assert normal(formula("cos(1.2)")) == normal(formula("2 cos(0.6)^2 - 1"))
    assert normal(formula("cos(0.3)")) != normal(formula("cos(0.3000000000000000001)"))
    assert normal(formula("sin(25 deg + 0.3)")) == normal(
        formula("sin(0.3) cos(25 deg) + cos(0.3) sin(25 deg)")
    )


@pytest.mark.parametrize("angle", ["sqrt(2)", "exp(1)", "sqrt(2) pi", "2 sqrt(3) + 1/7"])
def test_an_angle_of_any_constant(angle: str) -> None:
    half = f"({angle})/2"
    assert normal(formula(f"cos({angle})")) == normal(formula(f"2 cos({half})^2 - 1"))
    assert normal(formula(f"cos(x + {angle})")) == normal(
        formula(f"cos(x) cos({angle}) - sin(x) sin({angle})")
    )
    assert normal(formula(f"cos({angle})")) != 0


@given(st.lists(st.tuples(st.integers(-36000, 36000), st.booleans()), min_size=2, max_size=4))
def test_fixed_angles_add_however_many_digits_they_have(angles: list[tuple[int, bool]]) -> None:
    typed = [f"{n}/100 deg" if degrees else f"{n}/1000" for n, degrees in angles]
    added = normal(formula(f"cos({' + '.join(f'({each})' for each in typed)})"))
    c, s = normal(formula("1")), normal(formula("0"))
    for each in typed:
        d, t = normal(formula(f"cos({each})")), normal(formula(f"sin({each})"))
        c, s = c * d - s * t, s * d + c * t
    assert c == added
    assert c + Fraction(1, 10**30) != added


def test_roots_of_expressions_with_fixed_angles_in_them() -> None:
    one = normal(formula("sqrt(2 + cos(61 deg) cos(x))"))
    other = normal(formula("sqrt(2 + (cos(25 deg) cos(36 deg) - sin(25 deg) sin(36 deg)) cos(x))"))
    assert one == other
    assert one * normal(formula("y")) == other * normal(formula("y"))
    assert one != -other
    assert one != normal(formula("sqrt(2 + cos(62 deg) cos(x))"))


def test_a_relation_between_angles_of_many_digits() -> None:
    assert normal(formula("cos(12.3457 deg) + cos(132.3457 deg) + cos(252.3457 deg)")) == 0
    assert normal(formula("cos(12.3457 deg) + cos(132.3457 deg) + cos(252.3456 deg)")) != 0


def test_sums_with_multiples_of_fifteen_degrees_are_written_out() -> None:
    found = normal(formula("cos(85 deg) x - cos(25 deg) x/2 + sqrt(3) sin(25 deg) x/2"))
    assert independent(found.numerator, found.ring)[0] == 0
    assert found == 0
