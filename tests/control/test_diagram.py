"""Block diagrams against the transfer functions their equations have."""

from __future__ import annotations

from typing import Any

import numpy
import pytest

from derive.algebra.formulas.grammar import parse, parse_equation
from derive.algebra.numbers.floats import scalar_number
from derive.algebra.readable.terms import Style
from derive.control.controllers import Controller
from derive.control.diagram import Diagram
from derive.control.elimination import solve
from derive.control.motor import motor
from derive.control.rational import Rational
from derive.control.system import Equation, System
from derive.errors import NotDerivable
from derive.expression import Symbol
from derive.figures.block_diagram import drawn

POINT = {"J": 2.0, "K_m": 10.0, "R_a": 1.0, "L_a": 1.5, "R_f": 0.7, "L_f": 0.4, "b": 0.5, "K_b": 0.1}
S = 0.4 + 1.3j


def system(*equations: str, disturbance: str | None = None) -> System:
    read = tuple(Equation(*parse_equation(equation)) for equation in equations)
    return System(read, Symbol("u"), Symbol("y"), Symbol(disturbance) if disturbance else None)


def draw(subject: System, controller: Controller | None = None) -> Diagram:
    return drawn(subject, Rational.of(solve(subject).ratio), controller, Style())[0]


def at(rational: Rational, point: dict[str, float]) -> complex:
    num, den = (
        [scalar_number(c, point) if c else 0.0 for c in side] for side in (rational.num, rational.den)
    )
    return complex(numpy.polyval(num, S) / numpy.polyval(den, S))


@pytest.mark.parametrize("output", ["angle", "speed"])
@pytest.mark.parametrize("control", ["armature", "field"])
def test_the_blocks_of_a_motor_make_up_its_transfer_function(control: Any, output: Any) -> None:
    subject = motor(control, output)
    expected = at(Rational.of(solve(subject).ratio), POINT)
    assert draw(subject).gain(S, POINT) == pytest.approx(expected)


def test_a_motor_is_drawn_as_in_the_textbooks() -> None:
    diagram = draw(motor("armature", "angle"))
    shapes = {block.name: block.shape for block in diagram.blocks}
    assert shapes == {
        "V_a": "source", "T_d": "source", "sum_I_a": "sum", "I_a": "transfer", "V_b": "gain", "T_m": "gain",
        "T_L": "sum", "theta_dot": "transfer", "theta": "integrator",
    }  # fmt: skip
    assert diagram.into(diagram.block("V_b")) == ("theta_dot",)
    assert diagram.disturbances == ("T_d",)


@pytest.mark.parametrize(
    "equations",
    [
        ("(s + 2)*y = (s + 3)*u",),
        ("s^2*y = u - 3*s*y - 2*y",),
        ("y = x/(s + 1)", "x = (u - y)/(2*s + 1)"),
        ("v = s*y", "a = s*v", "2*a = u - v - y"),
        ("y = -u",),
        ("y = x + u", "x = u - y/2"),
    ],
)
def test_other_systems_are_drawn_too(equations: tuple[str, ...]) -> None:
    subject = system(*equations)
    expected = at(Rational.of(solve(subject).ratio), {})
    diagram = draw(subject)
    assert not diagram.looped
    assert diagram.gain(S, {}) == pytest.approx(expected)


def test_a_loop_closes_around_the_drawing() -> None:
    subject = motor("armature", "angle")
    gains = tuple(parse(name) for name in ("K_p", "K_i", "K_d"))
    diagram = draw(subject, Controller("PID", gains))
    G = at(Rational.of(solve(subject).ratio), POINT)
    C = 2 + 0.3 / S + 0.7 * S / (0.01 * S + 1)
    point = {**POINT, "K_p": 2.0, "K_i": 0.3, "K_d": 0.7, "tau_f": 0.01}
    assert diagram.gain(S, point) == pytest.approx(C * G / (1 + C * G))


def test_what_cannot_be_built_is_said() -> None:
    with pytest.raises(NotDerivable, match="improper"):
        draw(system("y = s*u"))
    with pytest.raises(NotDerivable, match="algebraic"):
        draw(system("y = 2*u"), Controller("P", (parse("K_p"),)))
