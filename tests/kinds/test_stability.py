"""The kind `stability` against textbooks, numpy and what it must refuse."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

import numpy
import pytest

from derive.algebra.formulas.grammar import parse, parse_equation
from derive.algebra.normal import normal
from derive.control.motor import motor
from derive.control.rational import polynomial
from derive.control.system import Equation, System
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import ZERO, Relation, Symbol
from derive.kinds.problem import Problem
from derive.kinds.system._stability_proofs import CALLED
from derive.render.phrases import spoken

POINT = {"J": "2", "K_m": "10", "R_a": "1", "L_a": "1", "b": "0.5", "K_b": "0.1"}


def said(found: Derivation) -> tuple[str, ...]:
    """The conditions for stability as texts."""
    return spoken("system", "stability").results(found.results)["conditions"]


def system(*equations: str, source: str = "u", output: str = "y") -> System:
    return System(tuple(Equation(*parse_equation(e)) for e in equations), Symbol(source), Symbol(output))


def ask(
    subject: System, positive: str = "", where: dict[str, str] | None = None, **options: Any
) -> Derivation:
    assumed = dict.fromkeys(positive.split(), "positive")
    names = {name: parse(value) for name, value in (where or {}).items()}
    found = Problem("system", subject, names, assumed).ask("stability", **options)
    assert found.claims and all(claim.holds for claim in found.claims)
    return found


def plain(polynomial: str) -> System:
    return system(f"({polynomial})*y = u")


@pytest.mark.parametrize(
    ("polynomial", "right", "verdict"),
    [
        ("s^4 + 2*s^3 + 3*s^2 + 4*s + 5", 2, "unstable"),
        ("s^5 + 2*s^4 + 24*s^3 + 48*s^2 - 25*s - 50", 1, "unstable"),
        ("s^3 + 2*s^2 + s + 2", 0, "oscillator"),
        ("s^5 + s^4 + 2*s^3 + 2*s^2 + 3*s + 15", 2, "unstable"),
        ("s^5 + s^4 + 2*s^3 + 2*s^2 + s + 1", 0, "unstable"),  # a pair on the axis, twice
        ("s^3 + 3*s^2 + 2*s", 0, "integrator"),
        ("s^2", 0, "unstable"),
        ("(s + 1)*(s + 2)*(s + 3)*(s + 4)", 0, "stable"),
        ("s + 2", 0, "stable"),
    ],
)
def test_polynomials_in_numbers(polynomial: str, right: int, verdict: str) -> None:
    found = ask(plain(polynomial))
    assert normal(found.results["unstable_poles"]) == right
    assert found.facts.said(*CALLED[verdict]) is not None
    assert (said(found) == ()) == (verdict == "stable")


def test_the_limit_of_a_loop() -> None:
    """s (s + 1) (s + 5) under a P controller swings at K = 30 with sqrt(5)."""
    found = ask(system("s*(s + 1)*(s + 5)*y = u"), controller="P")
    assert said(found) == ("K_p > 0", "K_p < 30")
    (gain, value), omega = found.facts.critical
    assert (gain, normal(value)) == (Symbol("K_p"), normal(parse("30")))
    assert normal(omega[1]) == normal(parse("sqrt(5)"))
    roots = numpy.roots([1, 6, 5, 30])
    assert sorted(abs(roots.imag))[-1] == pytest.approx(5**0.5)


def test_assumptions_shorten_the_conditions() -> None:
    subject = plain("m*s^2 + b*s + k")
    assert said(ask(subject)) == ("m*b > 0", "m*k > 0")
    assert said(ask(subject, "m b k")) == ()
    assert said(ask(subject, "m")) == ("b > 0", "k > 0")


def test_the_motor_under_control() -> None:
    found = ask(motor("armature", "angle"), "J K_m R_a L_a b K_b", controller="P")
    assert said(found)[0] == "K_p > 0"
    assert len(said(found)) == 2
    numbers = ask(motor("armature", "angle"), controller={"P": "1"}, evaluate=POINT).evaluated
    expected = numpy.roots([2, 2.5, 1.5, 10])
    assert numbers["unstable_poles"] == sum(expected.real > 0) == 2
    assert numbers["stable"] is False
    assert numbers["routh"][0] == [2, 1.5]
    assert numbers["conditions"] == [True, True, False]


def test_a_motor_without_control_integrates() -> None:
    found = ask(motor("armature", "angle"), "J K_m R_a L_a b K_b")
    assert said(found) == ("0 > 0",)
    assert found.facts.marginal == ()


def test_what_cancels_still_counts() -> None:
    found = ask(system("(s - 1)*(s + 2)*y = (s - 1)*u"))
    assert normal(found.results["unstable_poles"]) == 1
    controlled = ask(system("(s - 1)*(s + 2)*y = (s - 1)*u"), controller={"P": "3"})
    assert normal(controlled.results["unstable_poles"]) == 1


def test_values_of_where_are_put_in() -> None:
    found = ask(plain("s^3 + 2*k*s^2 + c*s + 3"), where={"c": "2*K", "k": "1/2"}, evaluate={"K": "2"})
    assert said(found) == ("K > 3/2",)
    assert found.evaluated["stable"] is True


def test_symbols_may_be_left_without_a_value() -> None:
    found = ask(plain("s^2 + b*s + K"), evaluate={"b": "sqrt(2)"})
    assert found.evaluated["routh"] == [[1, "K"], [pytest.approx(2**0.5), 0], ["K", 0]]
    assert found.evaluated["conditions"] == [True, Relation(Symbol("K"), ">", ZERO)]
    assert "poles" not in found.evaluated


def test_a_point_where_the_array_breaks_off() -> None:
    found = ask(plain("s^3 + a*s^2 + b*s + K"), evaluate={"a": "1", "b": "2", "K": "2"})
    assert found.evaluated["routh"] == [[1, 2], [1, 2], [0, 0], [2, 0]]
    assert found.evaluated["conditions"] == [True, True, False]
    assert found.evaluated["stable"] is False
    assert found.evaluated["unstable_poles"] == 0


def test_roots_in_coefficients() -> None:
    found = ask(plain("s^3 + sqrt(k)*s^2 + b*s + 2"), "k")
    assert said(found) == ("b*sqrt(k) > 2",)


def test_names_of_the_page_give_way() -> None:
    found = ask(plain("s^3 + rho_1*s^2 + epsilon*s + A_2"))
    names = {step.chain[0] for step in found.steps if step.rule == "entry"}
    assert Symbol("q_31") in names
    assert said(found) == ("rho_1 > 0", "A_2 > 0", "rho_1*epsilon > A_2")


def test_what_is_refused() -> None:
    with pytest.raises(NotDerivable, match="no poles"):
        ask(system("y = 2*u"))
    with pytest.raises(NotDerivable, match="degree 24"):
        ask(plain("s^25 + 1"))
    with pytest.raises(NotDerivable, match="degree 8"):
        ask(plain("s^9 + a"))
    with pytest.raises(NotDerivable, match="symmetric to the origin"):
        ask(plain("s^6 + s^5 + 3*s^4 + 3*s^3 + 3*s^2 + 2*s + 1"))  # Gantmacher, chapter XV


@pytest.mark.parametrize("seed", range(12))
def test_margins_are_decided_exactly(seed: int) -> None:
    """Polynomials made of factors whose roots are known, on the axis too, some coefficients as symbols."""
    draw = random.Random(seed)
    whole, right, axis = normal(parse("1")), 0, []
    for _ in range(draw.randint(2, 4)):
        q = Fraction(draw.randint(1, 40), draw.choice((1, 2, 5, 10)))
        kind = draw.choice(("left", "left", "axis", "axis", "right", "pair"))
        factor = {"left": f"s + {q}", "axis": f"s^2 + {q}", "right": f"s - {q}", "pair": f"s^2 + s + {q}"}[
            kind
        ]
        whole, right = whole * normal(parse(factor)), right + (kind == "right")
        axis += [q] * (kind == "axis")
    terms, place = [], {}
    for power, k in enumerate(reversed(polynomial(whole))):
        name = f"a_{power}"
        free = draw.random() < 0.3 and k.constant not in (None, 1)
        terms.append(f"{name if free else k.constant or 0}*s^{power}")
        place |= {name: str(k.constant)} if free else {}
    found = ask(plain(" + ".join(terms)), evaluate=place or True)
    stable = not right and not axis
    assert found.evaluated["stable"] is stable
    assert all(found.evaluated["conditions"]) is stable
    assert found.evaluated["unstable_poles"] == right
    swings = not right and len(set(axis)) == len(axis)
    assert found.facts.at.verdict.key == ("stable" if stable else "oscillator" if swings else "unstable")
