"""Arrays of Routh and what follows from them, against textbooks and the roots themselves."""

from __future__ import annotations

import operator
import random

import numpy
import pytest

from derive.algebra.formulas.grammar import parse, parse_equation
from derive.algebra.infix import text
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number, scalar_number
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.control.elimination import hidden
from derive.control.hurwitz import conditions, is_impossible, written
from derive.control.motor import motor
from derive.control.rational import polynomial
from derive.control.ratios import PLAIN
from derive.control.routh import leading, remainder, routh, sign_changes
from derive.control.system import Equation, System
from derive.errors import NotDerivable
from derive.expression import Symbol

EPSILON = "epsilon"


def rows(typed: str) -> list[list[str]]:
    from derive.algebra.readable.form import readable

    found = routh(polynomial(normal(parse(typed))), EPSILON)
    return [[text(readable(entry)) for entry in row.entries[: row.power // 2 + 1]] for row in found]


def column(typed: str) -> list[Scalar]:
    return [leading(row.entries[0], EPSILON) for row in routh(polynomial(normal(parse(typed))), EPSILON)]


def said(typed: str, *positive: str) -> list[str]:
    found = (written(each, Style()) for each in conditions(column(typed), positive))
    return [f"{text(c.left)} {c.sign} {text(c.right)}" for c in found]


def test_ogata_example_5_11() -> None:
    assert rows("s^4 + 2*s^3 + 3*s^2 + 4*s + 5") == [["1", "3", "5"], ["2", "4"], ["1", "5"], ["-6"], ["5"]]


def test_ogata_example_5_13_has_a_row_of_zeros() -> None:
    found = rows("s^5 + 2*s^4 + 24*s^3 + 48*s^2 - 25*s - 50")
    assert found == [["1", "24", "-25"], ["2", "48", "-50"], ["8", "96"], ["24", "-50"], ["338/3"], ["-50"]]


@pytest.mark.parametrize(
    ("typed", "right"),
    [
        ("s^5 + 2*s^4 + 2*s^3 + 4*s^2 + 11*s + 10", 2),  # Dorf and Bishop, section 6.2, case 2
        ("s^5 + 3*s^4 + 2*s^3 + 6*s^2 + 6*s + 9", 2),  # Franklin, Powell and Emami-Naeini, section 3.6
        ("s^5 + s^4 + 2*s^3 + 2*s^2 + 3*s + 15", 2),
        ("s^6 + 4*s^5 + 3*s^4 + 2*s^3 + s^2 + 4*s + 4", 2),  # Franklin, section 3.6
        ("s^5 + 5*s^4 + 11*s^3 + 23*s^2 + 28*s + 12", 0),  # Franklin, section 3.6: roots at +-2j
        ("s^5 + s^4 + 4*s^3 + 24*s^2 + 3*s + 63", 2),  # Dorf and Bishop, example 6.5
        ("s^3 - 3*s + 2", 2),  # Ogata, section 5.6: a root at 1 counted twice
        ("s^4 + 4", 2),
    ],
)
def test_sign_changes_are_those_of_the_books_and_of_the_roots(typed: str, right: int) -> None:
    signs = [scalar_number(entry, {}) for entry in column(typed)]
    coefficients = [scalar_number(k, {}) if k else 0.0 for k in polynomial(normal(parse(typed)))]
    assert sign_changes(signs) == right
    assert sum(numpy.roots(coefficients).real > 1e-3) == right


def test_random_polynomials_by_numpy() -> None:
    draw = random.Random(4)
    for _ in range(60):
        k = [draw.randint(1, 9), *(draw.randint(-9, 9) or 1 for _ in range(draw.randint(1, 8)))]
        found = routh([Scalar.of(each) for each in k], EPSILON)
        if any(row.origin in ("epsilon", "derivative") for row in found):
            continue
        signs = [scalar_number(row.entries[0], {}) for row in found]
        assert sign_changes(signs) == sum(numpy.roots(k).real > 0)


@pytest.mark.parametrize(
    ("typed", "positive", "expected"),
    [
        ("m*s^2 + b*s + k", (), ["m*b > 0", "m*k > 0"]),
        ("m*s^2 + b*s + k", ("m", "b"), ["k > 0"]),
        ("s^3 + a*s^2 + b*s + K", (), ["a > 0", "K > 0", "a*b > K"]),
        ("s^4 + 3*s^3 + 3*s^2 + 2*s + K", (), ["K > 0", "K < 14/9"]),  # Ogata, section 5.6
        ("s^3 + 5*s^2 + (K - 6)*s + K", (), ["K > 15/2"]),  # Franklin, example 3.33
        ("s^3 + K*s^2 + K*s + 1", (), ["K > 1"]),
        ("s^2 + 2*s + K^2", (), ["K**2 > 0"]),
        ("(s + 1)*(s + 2)*(s + 3)", (), []),
    ],
)
def test_conditions(typed: str, positive: tuple[str, ...], expected: list[str]) -> None:
    assert said(typed, *positive) == expected


def test_dorf_example_6_6_by_the_roots() -> None:
    """The tracked vehicle: K < 126 and K a > 0 and (K + 10)(126 - K) - 64 K a > 0."""
    found = conditions(column("s^4 + 8*s^3 + 17*s^2 + (K + 10)*s + K*a"), ())
    draw = random.Random(6)
    for _ in range(100):
        point = {"K": draw.uniform(-5, 140), "a": draw.uniform(-0.2, 1.5)}
        stable = max(numpy.roots([1, 8, 17, point["K"] + 10, point["K"] * point["a"]]).real) < 0
        assert all(scalar_number(each, point) > 0 for each in found) == stable
        holds = {">": operator.gt, "<": operator.lt}
        sides = [written(each, Style()) for each in found]
        assert all(holds[c.sign](number(c.left, point), number(c.right, point)) for c in sides) == stable


def test_contradictions_are_seen() -> None:
    assert is_impossible(conditions(column("s^3 + K*s^2 - K*s + 1"), ()), ())
    assert is_impossible(conditions(column("s^4 + K*s^3 + s^2 + s + 1"), ()), ())
    assert not is_impossible(conditions(column("s^3 + K*s^2 + K*s + 1"), ()), ())


def test_remainders() -> None:
    whole, part = (polynomial(normal(parse(typed))) for typed in ("s^3 + 2*s^2 + s + 2", "s^2 + 1"))
    assert not any(remainder(whole, part))


def test_conditions_that_exclude_each_other() -> None:
    """A product of signs no one of which is known."""
    found = conditions(column("a*s^4 + c*s^3 + K*a*s^2 + 1"), ())
    assert is_impossible(found, ())


def test_an_entry_that_no_page_holds() -> None:
    letters = " + ".join(f"(a{k} + b{k} + c{k})*s^{k}" for k in range(7))
    with pytest.raises(NotDerivable, match="at most 150"):
        routh(polynomial(normal(parse(letters))), EPSILON)


def test_what_cancels_is_hidden() -> None:
    equation = Equation(*parse_equation("(s - 1)*(s + 2)*y = (s - 1)*u"))
    system = System((equation,), Symbol("u"), Symbol("y"))
    found = hidden(system, polynomial(normal(parse("s + 2"))), PLAIN)
    assert [scalar_number(k, {}) for k in found] == [1, -1]


def test_the_motor_hides_nothing() -> None:
    system = motor("armature", "angle")
    den = polynomial(normal(parse("(J*s^2 + b*s)*(R_a + L_a*s) + K_m*K_b*s")))
    assert len(hidden(system, den, PLAIN)) == 1
