"""The kind `state-space` of systems against SciPy, python-control and the forms of the books."""

from __future__ import annotations

from typing import Any

import numpy
import pytest
from scipy import signal

from derive.algebra.formulas.grammar import parse, parse_equation
from derive.algebra.normal import normal
from derive.control.motor import motor
from derive.control.system import Equation, System
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import Matrix, Symbol, column
from derive.kinds.problem import Problem

POINT = {"J": "2", "K_m": "10", "R_a": "1", "L_a": "1", "b": "0.5", "K_b": "0.1"}
NAMES = ("A", "B", "C", "D")


def system(*equations: str, source: str = "u", output: str = "y") -> System:
    return System(tuple(Equation(*parse_equation(e)) for e in equations), Symbol(source), Symbol(output))


def ask(subject: System, **options: Any) -> Derivation:
    found = Problem("system", subject).ask("state-space", **options)
    assert found.claims and all(claim.holds for claim in found.claims)
    return found


def is_matrix(found: Derivation, name: str, rows: list[list[str]]) -> bool:
    matrix = found.results[name]
    assert isinstance(matrix, Matrix)
    return [[normal(entry) for entry in row] for row in matrix.rows] == [
        [normal(parse(entry)) for entry in row] for row in rows
    ]


def test_the_motor_as_every_tutorial_has_it() -> None:
    """x = (omega, i): A = [-b/J K/J; -K/L -R/L], B = [0; 1/L] (Control Tutorials, DC motor speed)."""
    found = ask(motor("armature", "speed"))
    assert is_matrix(found, "A", [["-b/J", "K_m/J"], ["-K_b/L_a", "-R_a/L_a"]])
    assert is_matrix(found, "B", [["0"], ["1/L_a"]])
    assert is_matrix(found, "C", [["1", "0"]])
    assert is_matrix(found, "D", [["0"]])
    assert found.matrices == frozenset(NAMES)


def test_the_angle_is_one_state_more() -> None:
    found = ask(motor("armature", "angle"), evaluate=POINT)
    assert found.step("x").result == column((Symbol("theta"), Symbol("theta_dot"), Symbol("I_a")))
    A, B, C, D = (numpy.array(found.evaluated[name]) for name in NAMES)
    num, den = signal.ss2tf(A, B, C, D)
    assert numpy.allclose(num, [[0, 0, 0, 5]])
    assert numpy.allclose(den, [1, 1.25, 0.75, 0])
    assert found.evaluated["poles"][0] == 0


@pytest.mark.parametrize("output", ["angle", "speed"])
@pytest.mark.parametrize("control", ["armature", "field"])
def test_every_motor(control: Any, output: Any) -> None:
    assert ask(motor(control, output)).facts.physical


def test_canonical_form_has_the_transfer_function_of_scipy() -> None:
    found = ask(system("(2*s^3 + 3*s^2 + 4*s + 5)*y = (s^3 + 6*s + 7)*u"), evaluate=True)
    assert not found.facts.physical
    A, B, C, D = (numpy.array(found.evaluated[name]) for name in NAMES)
    num, den = signal.ss2tf(A, B, C, D)
    assert numpy.allclose(num * 2, [[1, 0, 6, 7]])
    assert numpy.allclose(den * 2, [2, 3, 4, 5])
    assert is_matrix(found, "A", [["0", "1", "0"], ["0", "0", "1"], ["-5/2", "-2", "-3/2"]])


def test_two_masses() -> None:
    found = ask(
        system(
            "m1*s^2*x1 = F - c*s*(x1 - x2) - k*(x1 - x2)",
            "m2*s^2*x2 = c*s*(x1 - x2) + k*(x1 - x2)",
            source="F",
            output="x2",
        )
    )
    assert found.step("x").chain[0] == Symbol("z")  # for x1 is taken
    assert [name.name for (name,) in found.step("x").result.rows] == ["x2", "x2_dot", "x1", "x1_dot"]
    assert is_matrix(found, "B", [["0"], ["0"], ["0"], ["1/m1"]])


def test_a_circuit_whose_output_jumps() -> None:
    found = ask(system("V = R*I + V_c", "I = C*s*V_c", "V_o = V - V_c", source="V", output="V_o"))
    assert is_matrix(found, "C", [["-1"]])
    assert is_matrix(found, "D", [["1"]])


def test_signals_that_answer_each_other_at_once() -> None:
    assert ask(system("y = u/(s - 1) + w", "w = -2/(s + 1)*v", "v = y - w/(s + 3)")).facts.physical
    assert ask(system("e = u - y", "y = 3*e + x", "s*x = e")).facts.physical


def test_what_is_refused() -> None:
    with pytest.raises(NotDerivable, match="improper"):
        ask(system("y = s*u"))
    with pytest.raises(NotDerivable, match="no memory"):
        ask(system("y = 2*u"))


def test_symbols_may_be_left_without_a_value() -> None:
    found = ask(motor("armature", "speed"), evaluate={"J": "2", "K_m": "10", "L_a": "1", "R_a": "4"})
    assert found.evaluated["A"] == [["-b/2", 5], ["-K_b", -4]]
    assert "poles" not in found.evaluated
