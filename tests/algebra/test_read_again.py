"""Numbers with units, read a second time."""

from __future__ import annotations

from fractions import Fraction

import pytest
from pydantic import TypeAdapter, ValidationError

from derive.algebra.formulas import grammar, quantities
from derive.algebra.formulas.read_again import is_as_typed
from derive.algebra.formulas.units import ANY, Unit
from derive.kinds.fields import Quantity

TYPED = ("30 deg", "-0.25 m", "12 mm", "3e-3 kg", "2 m/s", "45 deg/s", "9.81 m/s^2", "7", ".5", "1e3 ohm")


@pytest.mark.parametrize("text", TYPED)
def test_as_typed(text: str) -> None:
    assert is_as_typed(text, grammar.parse(text, dimension=ANY))
    assert not is_as_typed(text, grammar.parse(f"1.001*({text})", dimension=ANY))


@pytest.mark.parametrize("text", ["pi/3", "2*l_1", "m", "sqrt(2) m", "1/2 m"])
def test_other_formulas_are_left(text: str) -> None:
    assert is_as_typed(text, grammar.parse(text, dimension=ANY))


def test_a_misread_unit_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    right = quantities.measured

    def doubled(quantity: quantities.Quantity, unit: Unit, at: int) -> quantities.Quantity:
        return right(quantity, Unit(unit.dimension, unit.size * Fraction(2), unit.degrees), at)

    monkeypatch.setattr(grammar, "measured", doubled)
    with pytest.raises(ValidationError, match="another number"):
        TypeAdapter(Quantity).validate_python("30 deg")
