"""The kinds of the subject `lagrange` against textbooks, the dynamics of robots, and integration."""

from __future__ import annotations

from typing import Any

import numpy
import pytest
from scipy.integrate import solve_ivp

from derive.algebra.formulas.grammar import parse, parse_equation
from derive.algebra.function import Constraint
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Matrix, Symbol, add
from derive.kinds.problem import Problem
from derive.mechanics.lagrangian import LagrangianSystem, MovingBody


def body(mass: str, position: str, inertia: str = "", angle: str = "") -> MovingBody:
    turning = (parse(inertia), parse(angle)) if inertia else (None, None)
    return MovingBody(parse(mass), tuple(map(parse, position.split(";"))), *turning)


def system(
    coordinates: str, *bodies: MovingBody, constraints: tuple[str, ...] = (), **given: str
) -> LagrangianSystem:
    size = len(bodies[0].position) if bodies else 0
    forces = {key[2:]: parse(text) for key, text in given.items() if key.startswith("Q_")}
    return LagrangianSystem(
        tuple(coordinates.split()),
        bodies,
        parse(given.get("kinetic", "0")),
        parse(given.get("potential", "0")),
        tuple([ZERO] * (size - 1) + [parse("-g")]) if size else (),
        tuple(forces.items()),
        parse(given.get("dissipation", "0")),
        tuple(Constraint(*parse_equation(each)) for each in constraints),
    )


def ask(
    subject: LagrangianSystem, kind: str = "equations-of-motion", positive: str = "", **options: Any
) -> Derivation:
    assumptions = dict.fromkeys(positive.split(), "positive")
    found = Problem("lagrange", subject, assumptions=assumptions).ask(kind, **options)
    assert found.claims
    assert all(claim.holds for claim in found.claims), [c for c in found.claims if not c.holds]
    return found


def entries(found: Derivation, name: str) -> list[Expr]:
    result = found.results[name]
    assert isinstance(result, Matrix)
    return [entry for row in result.rows for entry in row]


def are(found: Derivation, name: str, *texts: str) -> bool:
    pairs = zip(entries(found, name), texts, strict=True)
    return all(normal(ours) == normal(parse(theirs)) for ours, theirs in pairs)


CART_POLE = system("x theta", body("m_c", "x; 0"), body("m_p", "x + l*sin(theta); -l*cos(theta)"), Q_x="f")


def test_the_cart_and_pole_of_underactuated_robotics() -> None:
    """Tedrake, Underactuated Robotics (MIT 6.832), chapter 3, the cart-pole system."""
    found = ask(CART_POLE, solve=True)
    assert are(
        found,
        "tau",
        "(m_c + m_p)*x_ddot + m_p*l*theta_ddot*cos(theta) - m_p*l*theta_dot^2*sin(theta)",
        "m_p*l*x_ddot*cos(theta) + m_p*l^2*theta_ddot + m_p*g*l*sin(theta)",
    )
    assert are(
        found,
        "accelerations",
        "(f + m_p*sin(theta)*(l*theta_dot^2 + g*cos(theta)))/(m_c + m_p*sin(theta)^2)",
        "(-f*cos(theta) - m_p*l*theta_dot^2*cos(theta)*sin(theta) - (m_c + m_p)*g*sin(theta))"
        "/(l*(m_c + m_p*sin(theta)^2))",
    )
    assert are(found, "M", "m_c + m_p", "m_p*l*cos(theta)", "m_p*l*cos(theta)", "m_p*l^2")


def test_a_ladder_against_a_smooth_wall() -> None:
    """The angular acceleration is 3 g sin(theta)/(2 l) (Kleppner and Kolenkow, problem 7.11)."""
    ladder = system("theta", body("m", "l/2*sin(theta); l/2*cos(theta)", "m*l^2/12", "theta"))
    assert are(ask(ladder, solve=True), "accelerations", "3*g*sin(theta)/(2*l)")


def test_the_hoop_of_goldstein_rolls_down_an_incline() -> None:
    """Goldstein et al., section 2.4: xddot = g sin(phi)/2, lambda = M g sin(phi)/2."""
    rolling = system(
        "x theta", kinetic="1/2*M*x_dot^2 + 1/2*M*r^2*theta_dot^2", potential="M*g*(l - x)*sin(phi)",
        constraints=("r*theta = x",),
    )  # fmt: skip
    found = ask(rolling)
    assert are(found, "accelerations", "g*sin(phi)/2", "g*sin(phi)/(2*r)")
    (force,) = entries(found, "multipliers")
    assert normal(force) == normal(parse("M*g*sin(phi)/2"))


def test_the_tension_of_atwoods_machine() -> None:
    """a = (m1 - m2) g/(m1 + m2), and a tension of 2 m1 m2 g/(m1 + m2)."""
    machine = system("x y", body("m1", "0; -x"), body("m2", "0; -y"), constraints=("x + y = l",))
    found = ask(machine)
    a = "(m1 - m2)*g/(m1 + m2)"
    assert are(found, "accelerations", a, f"-{a}")
    assert are(found, "multipliers", "-2*m1*m2*g/(m1 + m2)")


def test_the_bead_on_a_turning_hoop() -> None:
    """Goldstein et al., exercise 2.18: thetaddot = sin(theta) (Omega^2 cos(theta) - g/R)."""
    hoop = system(
        "theta",
        body("m", "R*sin(theta)*cos(Omega*t); R*sin(theta)*sin(Omega*t); -R*cos(theta)"),
    )
    found = ask(hoop, solve=True)
    assert are(found, "accelerations", "sin(theta)*(Omega^2*cos(theta) - g/R)")


def test_what_is_conserved_of_the_hoop_is_not_its_energy() -> None:
    """Goldstein et al., section 2.7: Jacobi's integral is T_2 - T_0 + V."""
    hoop = system("theta", body("m", "R*sin(theta)*cos(Omega*t); R*sin(theta)*sin(Omega*t); -R*cos(theta)"))
    conserved = ask(hoop).results["E"]
    expected = "m/2*R^2*(theta_dot^2 - Omega^2*sin(theta)^2) - m*g*R*cos(theta)"
    assert normal(conserved) == normal(parse(expected))  # type: ignore[arg-type]
    assert "E" not in ask(CART_POLE).results


def test_a_spherical_pendulum_keeps_its_angular_momentum() -> None:
    position = "l*sin(theta)*cos(phi); l*sin(theta)*sin(phi); -l*cos(theta)"
    found = ask(system("theta phi", body("m", position)))
    ((name, momentum),) = found.facts.cyclic
    assert name == Symbol("phi")
    assert normal(momentum) == normal(parse("m*l^2*phi_dot*sin(theta)^2"))
    assert are(
        found,
        "tau",
        "m*l^2*theta_ddot - m*l^2*phi_dot^2*sin(theta)*cos(theta) + m*g*l*sin(theta)",
        "m*l^2*phi_ddot*sin(theta)^2 + 2*m*l^2*theta_dot*phi_dot*sin(theta)*cos(theta)",
    )


def test_a_planet_in_polar_coordinates() -> None:
    kepler = system("r theta", kinetic="1/2*m*(r_dot^2 + r^2*theta_dot^2)", potential="-k/r")
    found = ask(kepler, solve=True)
    assert are(found, "accelerations", "r*theta_dot^2 - k/(m*r^2)", "-2*r_dot*theta_dot/r")


def test_a_pivot_that_is_shaken() -> None:
    """Kapitza's pendulum (Landau and Lifshitz, Mechanics, section 5, problem 3c)."""
    shaken = system("theta", body("m", "l*sin(theta); a*cos(Omega*t) - l*cos(theta)"))
    found = ask(shaken, solve=True)
    assert are(found, "accelerations", "(a*Omega^2*cos(Omega*t) - g)*sin(theta)/l")


def test_a_disc_rolling_upright_is_driven_along_its_heading() -> None:
    """Siciliano et al., section 11.3: the unicycle; its mass moves with r phi_dot."""
    disc = system(
        "x y theta phi",
        kinetic="1/2*m*(x_dot^2 + y_dot^2) + 1/2*I*theta_dot^2 + 1/2*J*phi_dot^2",
        constraints=("x_dot = r*cos(theta)*phi_dot", "y_dot = r*sin(theta)*phi_dot"),
        Q_theta="tau_1", Q_phi="tau_2",
    )  # fmt: skip
    found = ask(disc)
    assert normal(entries(found, "accelerations")[3]) == normal(parse("tau_2/(J + m*r^2)"))
    assert normal(entries(found, "accelerations")[2]) == normal(parse("tau_1/I"))


def test_it_is_the_dynamics_of_the_same_arm() -> None:
    """Two links as a robot and as bodies with positions: tau is `==`."""
    from pathlib import Path

    from derive.sheet.load import load_sheet

    sheet = load_sheet(Path(__file__).parents[2] / "exercises" / "week6.yaml")
    (given, *_) = sheet.problems
    robot = Problem("robot", given.subject, given.where).ask("dynamics").results["tau"]
    assert isinstance(robot, Matrix)
    first = "L_c*cos(theta1); L_c*sin(theta1)"
    second = "L*cos(theta1) + L_c*cos(theta1 + theta2); L*sin(theta1) + L_c*sin(theta1 + theta2)"
    moment = "m*L^2/12 + m*(L/10)^2/12"
    bodies = (body("m", first, moment, "theta1"), body("m", second, moment, "theta1 + theta2"))
    found = Problem("lagrange", system("theta1 theta2", *bodies), given.where).ask("equations-of-motion")
    names = {Symbol(name): tree for name, tree in given.where.items()}
    for (ours,), (theirs,) in zip(found.results["tau"].rows, robot.rows, strict=True):  # type: ignore[union-attr]
        assert normal(ours, names) == normal(theirs, names)


def test_the_energy_is_kept_along_the_integrated_motion() -> None:
    double = system(
        "a b",
        body("m1", "p*sin(a); -p*cos(a)"),
        body("m2", "p*sin(a) + q*sin(b); -p*cos(a) - q*cos(b)"),
    )
    found = ask(double, solve=True)
    known = {"m1": 1.0, "m2": 0.7, "p": 1.1, "q": 0.8, "g": 9.81}
    accelerations = entries(found, "accelerations")
    total = add(found.results["T"], found.results["P"])  # type: ignore[arg-type]

    def at(state: Any) -> dict[str, float]:
        return {**known, **dict(zip(("a", "b", "a_dot", "b_dot"), map(float, state), strict=True))}

    def motion(_: float, state: Any) -> list[float]:
        return [*state[2:], *(number(each, at(state)) for each in accelerations)]

    path = solve_ivp(motion, (0, 1), [1.0, 0.4, 0.0, 2.0], rtol=1e-10, atol=1e-10)
    energies = [number(total, at(state)) for state in path.y.T]
    assert numpy.ptp(energies) < 1e-7 * max(1.0, abs(energies[0]))


def test_energies_may_hold_other_functions() -> None:
    found = ask(system("q", kinetic="1/2*m*exp(2*q)*q_dot^2", potential="k*log(1 + q^2)"))
    assert are(found, "tau", "m*exp(2*q)*(q_ddot + q_dot^2) + 2*k*q/(1 + q^2)")


def test_friction_takes_what_rayleigh_says() -> None:
    found = ask(
        system("x", kinetic="1/2*m*x_dot^2", potential="1/2*k*x^2", dissipation="1/2*b*x_dot^2", Q_x="F")
    )
    assert are(found, "equations", "m*x_ddot + b*x_dot + k*x - F")


def test_names_of_where_that_move_are_replaced() -> None:
    where = {"h": parse("l*cos(theta)"), "l": parse("2*a")}
    pendulum = system("theta", body("m", "l*sin(theta); -h"))
    found = Problem("lagrange", pendulum, where).ask("equations-of-motion")
    assert all(claim.holds for claim in found.claims)
    assert are(found, "tau", "4*m*a^2*theta_ddot + 2*m*g*a*sin(theta)")


def test_letters_that_are_taken_give_way() -> None:
    """A length L and a radius r: the Lagrangian and the position are called otherwise."""
    found = ask(system("r", body("T", "r; L*r^2")))
    names = {step.name for step in found.steps}
    assert {"calL", "p", "K"} <= names
    assert {"L", "T"} <= set(found.results)


@pytest.mark.parametrize(
    ("subject", "reason"),
    [
        (system("x y", kinetic="1/2*m*x_dot^2", potential="k*y^2"), "no inertia"),
        (
            system("x y", kinetic="x_dot^2 + y_dot^2", constraints=("x = y", "2*x = 2*y")),
            "depend on each other",
        ),
    ],
)
def test_what_has_no_unique_motion_is_refused(subject: LagrangianSystem, reason: str) -> None:
    with pytest.raises(NotDerivable, match=reason):
        ask(subject, solve=True)


# -- states of rest --------------------------------------------------------------------------------------


def test_the_cart_and_pole_linearised_upright() -> None:
    """Ogata, Modern Control Engineering, example 3.5 with a point mass; theta from the downward direction."""
    found = ask(CART_POLE, "linearisation", positive="l", at={"x": "0", "theta": "180 deg"})
    A, B = (numpy.array(_rows(found, name), dtype=object) for name in ("A", "B"))
    assert normal(A[2][1]) == normal(parse("m_p*g/m_c"))
    assert normal(A[3][1]) == normal(parse("(m_c + m_p)*g/(m_c*l)"))
    assert [
        normal(row[0]) == normal(parse(text))
        for row, text in zip(B, ("0", "0", "1/m_c", "1/(m_c*l)"), strict=True)
    ]
    assert found.facts.stability.key == "not-definite"


def _rows(found: Derivation, name: str) -> list[list[Expr]]:
    result = found.results[name]
    assert isinstance(result, Matrix)
    return [list(row) for row in result.rows]


def test_a_pendulum_held_up_by_a_torque() -> None:
    pendulum = system("theta", body("m", "l*sin(theta); -l*cos(theta)"), Q_theta="tau")
    found = ask(pendulum, "linearisation", at={"theta": "30 deg", "tau": "m*g*l/2"})
    assert are(found, "K_0", "sqrt(3)/2*m*g*l")
    with pytest.raises(NotDerivable, match="no state of rest"):
        ask(pendulum, "linearisation", at={"theta": "30 deg"})
    with pytest.raises(NotDerivable, match="neither a coordinate nor an input"):
        ask(pendulum, "linearisation", at={"phi": "0"})


def states(found: Derivation) -> list[tuple[str, ...]]:
    from derive.algebra.infix import text
    from derive.derivation import Branch
    from derive.render.phrases import spoken

    branches = found.results["solutions"]
    assert isinstance(branches, tuple)
    said = spoken("lagrange", "equilibria").when
    return [(*map(text, b.values.values()), said(b.when)) for b in branches if isinstance(b, Branch)]


def test_where_a_bead_on_a_turning_hoop_rests() -> None:
    """Strogatz, Nonlinear Dynamics and Chaos, section 3.5: a pitchfork where Omega^2 R = g."""
    hoop = system("theta", body("m", "R*sin(theta)*cos(Omega*t); R*sin(theta)*sin(Omega*t); -R*cos(theta)"))
    problem = Problem("lagrange", hoop, assumptions={"R": "positive", "Omega": "positive"})
    found = problem.ask("equilibria")
    assert all(claim.holds for claim in found.claims)
    assert states(found) == [
        ("0", "stable if g > R*Omega**2, unstable if g < R*Omega**2"),
        ("pi", "unstable"),
        ("acos(g/(R*Omega**2))", "stable where R*Omega**2 > g"),
        ("-acos(g/(R*Omega**2))", "stable where R*Omega**2 > g"),
    ]


def test_a_double_pendulum_rests_in_four_ways() -> None:
    first, second = "sin(p); -cos(p)", "sin(p) + sin(p + q); -cos(p) - cos(p + q)"
    found = ask(system("p q", body("m1", first), body("m2", second)), "equilibria")
    assert sorted(states(found)) == [
        ("0", "0", "stable"), ("0", "pi", "unstable"), ("pi", "0", "unstable"), ("pi", "pi", "unstable"),
    ]  # fmt: skip


def test_a_cart_may_rest_anywhere() -> None:
    found = ask(CART_POLE, "equilibria", positive="l")
    assert states(found) == [("x", "0", "in theta stable, in x indifferent"), ("x", "pi", "unstable")]


def test_a_buckled_spring() -> None:
    """The potential a x^4/4 - k x^2/2 has two wells."""
    well = system("x", kinetic="1/2*m*x_dot^2", potential="1/4*a*x^4 - 1/2*k*x^2")
    found = Problem("lagrange", well, assumptions={"a": "positive", "k": "positive"}).ask("equilibria")
    assert [when for _, when in states(found)] == ["unstable", "stable", "stable"]


def test_a_turning_frame_may_hold_a_mass_on_a_hill() -> None:
    """A mass on springs, seen from a frame that turns faster than it swings: K is negative, and yet it only
    swings."""
    turning = system(
        "x y", kinetic="1/2*((x_dot - 2*y)^2 + (y_dot + 2*x)^2)", potential="1/2*(x^2 + y^2)"
    )  # fmt: skip
    ((*_, said),) = states(ask(turning, "equilibria"))
    assert said == "stability not decided by the terms of second order"


@pytest.mark.parametrize(
    ("subject", "reason"),
    [
        (system("x", kinetic="x_dot^2", potential="x^2 + sin(x)"), "inside a sine or cosine and outside"),
        (system("x", kinetic="x_dot^2", potential="x*cos(w*t)"), "change with the time"),
        (system("x y", kinetic="x_dot^2 + y_dot^2", constraints=("x = y",)), "under constraints"),
    ],
)
def test_states_of_rest_out_of_reach(subject: LagrangianSystem, reason: str) -> None:
    with pytest.raises(NotDerivable, match=reason):
        ask(subject, "equilibria")
