"""Elimination against published transfer functions and against numeric solutions of the equations."""

from __future__ import annotations

import cmath

import pytest

from derive.algebra.formulas.grammar import parse, parse_equation
from derive.algebra.normal import normal
from derive.algebra.readable.operation_count import operations
from derive.control.elimination import solve
from derive.control.motor import motor
from derive.control.oracle.equations import Numeric, value
from derive.control.signals import signals
from derive.control.system import Equation, System
from derive.errors import NotDerivable
from derive.expression import Symbol

SOURCE = "K_m/((J*s^2 + b*s)*(R_a + L_a*s) + K_m*K_b*s)"  # as the course sheet prints it
POINT = {"J": 2.0, "K_m": 10.0, "R_a": 1.0, "L_a": 1.0, "b": 0.5, "K_b": 0.1}


def system(equations: list[str], source: str, output: str, disturbance: str | None = None) -> System:
    return System(
        tuple(Equation(*parse_equation(text)) for text in equations),
        Symbol(source),
        Symbol(output),
        Symbol(disturbance) if disturbance else None,
    )


def transfer(given: System, source: str | None = None) -> object:
    return solve(given, Symbol(source) if source else None).ratio.expr()


def test_armature_motor_is_the_published_one_and_no_longer() -> None:
    found = solve(motor("armature", "angle")).ratio.expr()
    assert normal(found) == normal(parse(SOURCE))
    assert operations(found) <= operations(parse(SOURCE))


@pytest.mark.parametrize(
    ("control", "output", "source", "published"),
    [
        ("armature", "speed", None, "K_m/((J*s + b)*(R_a + L_a*s) + K_m*K_b)"),
        ("armature", "angle", "T_d", "-(R_a + L_a*s)/(s*((J*s + b)*(R_a + L_a*s) + K_m*K_b))"),
        ("field", "angle", None, "K_m/(s*(J*s + b)*(R_f + L_f*s))"),  # Dorf and Bishop, eq. 2.61
        ("field", "angle", "T_d", "-1/(s*(J*s + b))"),
    ],
)
def test_other_motors(control: str, output: str, source: str | None, published: str) -> None:
    assert normal(transfer(motor(control, output), source)) == normal(parse(published))


@pytest.mark.parametrize(
    ("equations", "source", "output", "published"),
    [
        (["E = R - Y", "U = C*E", "Y = G*U"], "R", "Y", "C*G/(1 + C*G)"),
        (["m*s^2*x = F - b*s*x - k*x"], "F", "x", "1/(m*s^2 + b*s + k)"),
        (["I = (V - V_c)/R", "V_c = I/(C*s)"], "V", "V_c", "1/(1 + R*C*s)"),
        (  # two masses coupled by a spring: neither equation gives one signal alone
            ["F = m_1*s^2*x_1 + k*(x_1 - x_2)", "m_2*s^2*x_2 = k*(x_1 - x_2)"],
            "F",
            "x_1",
            "(m_2*s^2 + k)/(s^2*(m_1*m_2*s^2 + k*(m_1 + m_2)))",
        ),
    ],
)
def test_systems_of_other_fields(equations: list[str], source: str, output: str, published: str) -> None:
    assert normal(transfer(system(equations, source, output))) == normal(parse(published))


def test_every_signal_satisfies_the_equations() -> None:
    given = motor("armature", "angle")
    found = solve(given)
    for equation in given.equations:
        assert normal(equation.left, found.values) == normal(equation.right, found.values)


def test_numeric_solution_of_the_equations_agrees() -> None:
    s = 0.7 + 1.3j
    ours = value(solve(motor("armature", "angle")).ratio.expr(), {**POINT, "s": s})
    assert cmath.isclose(ours, Numeric.of(motor("armature", "angle"), Symbol("V_a"), POINT).gain(s))


def test_loops_through_each_other_agree_with_numbers() -> None:
    given = system(["a = u - p*b - q*c", "b = a/s - c", "c = k*b + r*a"], "u", "c")
    point, s = {"p": 0.7, "q": 1.1, "k": 0.4, "r": 0.9}, 0.3 - 0.8j
    ours = value(solve(given).ratio.expr(), {**point, "s": s})
    assert cmath.isclose(ours, Numeric.of(given, Symbol("u"), point).gain(s))


def test_the_order_is_from_the_output_to_the_input() -> None:
    found = solve(motor("armature", "angle"))
    assert [step.signal.name for step in found.steps] == ["T_L", "T_m", "V_b", "I_a"]
    assert found.relation.equation == 1


def test_signals_are_told_from_parameters() -> None:
    assert {each.name for each in signals(motor("armature", "angle"))} == {
        "V_a", "I_a", "V_b", "theta", "T_m", "T_L", "T_d",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("equations", "source", "output", "said"),
    [
        (["y = u*y"], "u", "y", "linear|signal"),
        (["y = u + w", "w = z"], "u", "y", "unknown signal"),
        (["y = k*u", "y = 2*u"], "u", "y", "unknown signal"),
    ],
)
def test_what_has_no_answer_is_said(equations: list[str], source: str, output: str, said: str) -> None:
    with pytest.raises(NotDerivable, match=said):
        solve(system(equations, source, output))


def test_only_inputs_can_be_asked_from() -> None:
    with pytest.raises(NotDerivable, match="no input"):
        solve(motor("armature", "angle"), Symbol("I_a"))


def test_a_sum_that_equals_a_factor_beside_it_is_one_more_of_it() -> None:
    """s + 1 + 2 - 2 + 2 comes about beside s + 3 here, and both are one base."""
    equations = ["x1 = 1/(s + 3)*(u - x1 - x2)", "(s + 1)*x2 = 2*(x1 - x2)", "x4 = 1/(s + 3)*x3",
                 "(s + 4)*x3 = x1 + x3 - x2"]  # fmt: skip
    system_ = system(equations, "u", "x4")
    s = 0.3 + 1.1j
    ours = value(solve(system_).ratio.expr(), {"s": s})
    assert cmath.isclose(ours, Numeric.of(system_, Symbol("u"), {}).gain(s), rel_tol=1e-12)


def test_a_signal_that_comes_in_with_what_is_put_in_is_found_without_a_line_of_its_own() -> None:
    """x2 is not in the equation of x4 that it is found by: it comes with x3."""
    equations = ["x2 = 1/(s + 2)*(x1 - x2 - x3)", "x4 = 2/(s + 3)*(x3 + x1)", "x3 = 1/(s + 2)*x2",
                 "(s^2 + s + 4)*x1 = u + x1 - x2"]  # fmt: skip
    chains = {step.signal.name: step.chain for step in solve(system(equations, "u", "x4")).steps}
    assert len(chains["x2"]) == 2
