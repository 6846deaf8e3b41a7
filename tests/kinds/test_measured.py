"""Answers that rest on rounded data stand in decimals, each with the number that it had."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from derive.algebra.infix import text
from derive.build import assemble
from derive.errors import NotAsWritten, SheetErrors
from derive.expression import Expr, Number, add, cos, multiply, negate, symbols
from derive.kinds import measured
from derive.kinds.measured import InDecimals, decimals
from derive.sheet.load import load_sheet

LONG = 3**40
x, y = symbols("x y")
SHEET = Path(__file__).parents[1] / "outside" / "rounded-home.yaml"


def test_a_long_number_before_a_sum_is_in_each_of_its_terms() -> None:
    terms = add(multiply(Number(Fraction(LONG)), cos(x)), negate(multiply(Number(Fraction(LONG // 2)), y)))
    found = decimals(multiply(Number(Fraction(1, LONG)), terms))
    assert text(found) == "cos(x) - 0.5*y"


def test_what_is_rounded_to_something_else_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    long = multiply(Number(Fraction(LONG + 1, 3 * LONG)), x)
    right = decimals

    def wrong(expr: Expr) -> Expr:
        found = right(expr)
        return found if found is expr else negate(found)

    monkeypatch.setattr(measured, "decimals", wrong)
    with pytest.raises(NotAsWritten):
        InDecimals()(long)
    with pytest.raises(SheetErrors) as refused:
        assemble(load_sheet(SHEET))
    assert "read as it is written" in refused.value.errors[0].message
