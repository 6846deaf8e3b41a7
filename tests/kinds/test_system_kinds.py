"""The kinds of the subject `system` against the course sheet, textbook numbers and python-control."""

from __future__ import annotations

from typing import Any

import numpy
import pytest
from scipy import signal

from derive.algebra.formulas.grammar import parse, parse_equation
from derive.algebra.normal import normal
from derive.control.motor import motor
from derive.control.system import Equation, System
from derive.derivation import Derivation, Phrase
from derive.errors import NotDerivable
from derive.expression import Symbol
from derive.kinds.problem import Problem

POINT = {"J": "2", "K_m": "10", "R_a": "1", "L_a": "1", "b": "0.5", "K_b": "0.1"}
PD = {"PD": {"K_p": "0.1", "K_d": "0.15"}}


def ask(kind: str, subject: System | None = None, **options: Any) -> Derivation:
    return Problem("system", subject or motor("armature", "angle")).ask(kind, **options)


def simple(equation: str, source: str = "u", output: str = "y") -> System:
    return System((Equation(*parse_equation(equation)),), Symbol(source), Symbol(output))


def all_hold(derivation: Derivation) -> bool:
    return bool(derivation.claims) and all(claim.holds for claim in derivation.claims)


def complexes(values: list[Any]) -> list[complex]:
    return [complex(v["re"], v["im"]) if isinstance(v, dict) else complex(v) for v in values]


def test_transfer_function_of_the_course_sheet() -> None:
    found = ask("transfer-function", evaluate=POINT)
    published = parse("K_m/((J*s^2 + b*s)*(R_a + L_a*s) + K_m*K_b*s)")
    assert normal(found.results["G"]) == normal(published)
    assert found.evaluated["G"]["num"] == [10.0]
    assert found.evaluated["G"]["den"] == [2.0, 2.5, 1.5, 0.0]
    expected = numpy.roots([2.0, 2.5, 1.5, 0.0])
    assert numpy.allclose(sorted(complexes(found.evaluated["poles"]), key=abs), sorted(expected, key=abs))
    assert all_hold(found)


@pytest.mark.parametrize("source", [None, "T_d"])
@pytest.mark.parametrize("output", ["angle", "speed"])
@pytest.mark.parametrize("control", ["armature", "field"])
def test_every_motor_holds(control: Any, output: Any, source: str | None) -> None:
    assert all_hold(ask("transfer-function", motor(control, output), source=source))


@pytest.mark.parametrize(
    ("controller", "num", "den"),
    [
        ({"P": {"K_p": "20"}}, [20], [1]),
        ({"PI": {"K_p": "20", "K_i": "5"}}, [20, 5], [1, 0]),
        ({"PD": {"K_p": "20", "K_d": "10"}}, [10, 20], [1]),
        ({"PID": {"K_p": "20", "K_i": "5", "K_d": "10"}}, [10, 20, 5], [1, 0]),
    ],
)
def test_closed_loops_are_those_of_python_control(
    controller: Any, num: list[float], den: list[float]
) -> None:
    control = pytest.importorskip("control")
    found = ask("closed-loop", controller=controller, evaluate=POINT)
    plant = control.tf([10], [2, 2.5, 1.5, 0])
    other = control.feedback(control.tf(num, den) * plant, 1)
    T = found.evaluated["T"]
    for s in (0.3 + 1j, 2.0, 1j):
        assert numpy.polyval(T["num"], s) / numpy.polyval(T["den"], s) == pytest.approx(complex(other(s)))
    assert all_hold(found)


def test_gains_may_stay_symbolic() -> None:
    for typed in ("PID", {"PID": {"K_p": None, "K_i": None, "K_d": None}}, {"PID": {"K_p": "K_p"}}):
        found = ask("closed-loop", controller=typed)
        assert normal(found.results["C"]) == normal(parse("K_p + K_i/s + K_d*s"))


@pytest.mark.parametrize(
    "typed", [{"PIDD": {}}, {"PD": {"K_i": "1"}}, {"PID": "20"}, ["P"], {"P": {}, "I": {}}]
)
def test_wrong_controllers_are_faults(typed: Any) -> None:
    with pytest.raises(ValueError, match=r"controller"):
        ask("closed-loop", controller=typed)


def test_step_response_by_scipy() -> None:
    found = ask("step-response", controller=PD, evaluate=POINT)
    times, values = found.plots[0].series[Phrase("response")]
    _, other = signal.step(([1.5, 1.0], [2, 2.5, 3.0, 1.0]), T=numpy.array(times))
    assert numpy.allclose(values, other, atol=1e-8)
    assert found.evaluated["steady_state"] == 1
    assert found.evaluated["overshoot"] == pytest.approx(100 * (max(other) - 1), abs=0.01)
    assert all_hold(found)


def test_an_unstable_loop_is_said_to_be_so() -> None:
    gains = {"PID": {"K_p": "20", "K_i": "5", "K_d": "10"}}
    found = ask("step-response", controller=gains, evaluate=POINT)
    assert found.facts.course.key == "grows"
    assert found.results["rise_time"] == "none"
    assert all_hold(found)


def test_an_integrator_ends_in_a_ramp() -> None:
    found = ask("step-response", evaluate=POINT)
    assert found.facts.course.key == "drifts"
    assert normal(found.facts.course.about["slope"]) == normal(parse("20/3"))
    assert ask("step-response", motor("armature", "speed"), evaluate=POINT).evaluated["steady_state"] == (
        pytest.approx(20 / 3)
    )


def test_cancellation_is_noticed() -> None:
    found = ask("closed-loop", simple("(s - 1)*(s + 2)*y = (s - 1)*u"), controller={"P": "1"})
    assert ask("transfer-function", simple("(s^2 + s - 2)*y = (s - 1)*u")).facts.cancelled.about["count"] == 1
    assert all_hold(found)


def test_improper_systems_have_no_step_response() -> None:
    assert ask("transfer-function", simple("y = s*u")).facts.nature.key == "improper"
    with pytest.raises(NotDerivable, match="improper"):
        ask("step-response", simple("y = s*u"), evaluate=True)


def test_missing_values_are_named() -> None:
    with pytest.raises(NotDerivable, match="K_b"):
        ask("step-response", evaluate={name: value for name, value in POINT.items() if name != "K_b"})


def test_a_loop_without_response_is_said() -> None:
    with pytest.raises(NotDerivable, match="1 \\+ C G is zero"):
        ask("closed-loop", simple("y = -u"), controller={"P": "1"})
    with pytest.raises(NotDerivable, match="every gain"):
        ask("closed-loop", controller={"P": "0"})


def test_where_is_replaced_at_the_end() -> None:
    problem = Problem("system", simple("m*s^2*y = u - k*y"), {"k": parse("4*m")})
    found = problem.ask("transfer-function")
    assert normal(found.results["G"]) == normal(parse("1/(m*s^2 + 4*m)"))
    assert all_hold(found)


def test_names_of_results_may_be_parameters() -> None:
    loop = System(
        tuple(Equation(*parse_equation(text)) for text in ("E = R - Y", "U = C*E", "Y = G*U")),
        Symbol("R"),
        Symbol("Y"),
    )
    found = ask("transfer-function", loop)
    assert normal(found.results["G"]) == normal(parse("C*G/(1 + C*G)"))
    assert all_hold(found)
