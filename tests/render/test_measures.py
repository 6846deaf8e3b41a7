"""What a value is said as is held to what was found: the same number, in what its name measures."""

from __future__ import annotations

from fractions import Fraction

import pytest

from derive.errors import NotAsWritten
from derive.expression import Approximate, Degrees, Expr, Matrix, Measured, Product, number, symbols
from derive.render.measures import hold_as_said

L, x, theta, T = symbols("L x theta T")
HALF = number("1/2")
COLUMN = Matrix(((HALF * x,), (HALF * theta,)))
UNITS: dict[Expr, str] = {T: "s", theta: "rad"}


@pytest.mark.parametrize(
    ("found", "said"),
    [
        ((x, COLUMN), (x, Product((HALF, Matrix(((x,), (theta,))))))),
        ((theta, number(2)), (theta, Product((Approximate(114.59155902616465), Degrees(Fraction(1)))))),
        ((T, number(2)), (T, Measured(number(2), "s"))),
        ((L, Degrees(Fraction(90))), (L, Degrees(Fraction(90)))),
    ],
)
def test_what_is_the_same_is_held(found: tuple[Expr, ...], said: tuple[Expr, ...]) -> None:
    hold_as_said(found, said, UNITS)


@pytest.mark.parametrize(
    ("found", "said"),
    [
        ((x, COLUMN), (x, Product((HALF, Matrix(((theta,), (x,))))))),
        ((x, COLUMN), (x, Matrix(((number(0),), (number(0),))))),
        ((L, number(2)), (L, Product((Approximate(114.59155902616465), Degrees(Fraction(1)))))),
        ((T, x, number(2)), (T, Measured(x, "s"), Measured(number(2), "s"))),
        ((T, number(2)), (T, Measured(number(2), "m"))),
    ],
    ids=["entries changed", "all zero", "no angle in degrees", "a unit behind a name", "another unit"],
)
def test_what_differs_is_not_written(found: tuple[Expr, ...], said: tuple[Expr, ...]) -> None:
    with pytest.raises(NotAsWritten):
        hold_as_said(found, said, UNITS)
