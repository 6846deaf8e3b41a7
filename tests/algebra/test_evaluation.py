"""What a normal form is worth: the same as its tree, in floats, in balls and in a domain of one's own."""

from __future__ import annotations

import cmath
from fractions import Fraction

import pytest
from flint import arb, ctx

from derive.algebra.ball_arithmetic import balls
from derive.algebra.evaluation import Evaluation
from derive.algebra.fold import Domain, fold
from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import scalar_number

AT = {"a": 0.7, "b": 1.9, "q": 0.4, "t": 1.1}
TEXTS = [
    "3/7", "a - b/3", "cos(q + 25 deg)*sin(36 deg)", "sqrt(2) + sqrt(3 + sqrt(5))", "sqrt(a^2 + b^2)/(a - b)",
    "exp(2*a)*log(b)", "cos(a*t^2 + q)", "sin(cos(q))", "a^(1/3) + 2^a", "atan2(b, a) - acos(a/2)",
    "cos(1)*sin(b - a)", "abs(a - b)",
]  # fmt: skip


class Complex(Domain[complex]):
    def number(self, value: Fraction) -> complex:
        return complex(float(value))

    def symbol(self, name: str) -> complex:
        return cmath.pi if name == "pi" else complex(AT[name])

    def degrees(self, value: Fraction) -> complex:
        return self.number(value) * cmath.pi / 180

    def call(self, function: str, arguments: list[complex]) -> complex:
        if function == "atan2":
            return complex(cmath.phase(complex(arguments[1].real, arguments[0].real)))
        return abs(arguments[0]) if function == "abs" else getattr(cmath, function)(*arguments)


@pytest.mark.parametrize("text", TEXTS)
def test_a_normal_form_is_worth_what_its_tree_is(text: str) -> None:
    tree, domain = parse(text), Complex()
    expected = fold(tree, domain)
    assert Evaluation(domain).quotient(normal(tree)) == pytest.approx(expected)
    assert scalar_number(normal(tree), AT) == pytest.approx(expected.real)
    with ctx.workprec(100):
        ball = Evaluation(balls({name: arb(value) for name, value in AT.items()})).quotient(normal(tree))
    assert float(ball.mid()) == pytest.approx(expected.real)
    assert float(ball.rad()) < 1e-25


def test_a_letter_without_a_value_is_missing_even_deep_inside() -> None:
    for text in ("x", "sqrt(1 + x^2)", "exp(cos(x))", "cos(x*t)"):
        with pytest.raises(KeyError):
            scalar_number(normal(parse(text)), AT)
