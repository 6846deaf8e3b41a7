"""What is asked of an arm's dynamics, against what books and mechanics say of small arms."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from derive.algebra.formulas.grammar import parse
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import number_rows, numbers
from derive.build import assemble
from derive.errors import SheetErrors
from derive.kinds.linear_systems import solution_at
from derive.kinds.problem import Problem
from derive.kinds.robot._dynamics.regressor import dependent, standard_parameters
from derive.mechanics.oracle import Oracle
from derive.sheet.load import load_sheet
from derive.writing import render
from tests.kinds.published import matrix, same, same_scalar
from tests.kinds.robot.test_published_dynamics import derived
from tests.mechanics.test_two_derivations import ARMS

PENDULUM = """
    gravity: [0, -g, 0]
    links:
    - {theta: theta*, d: 0, a: 0, alpha: 0, mass: m, com: [l, 0, 0], inertia: [0, 0, I]MORE}
"""
POLAR = """
    gravity: [0, -g, 0]
    links:
    - {theta: theta1* + 90 deg, d: 0, a: 0, alpha: 90 deg, mass: m1, com: [0, 0, 0], inertia: [0, I1, 0]}
    - {theta: 0, d: r*, a: 0, alpha: 0, mass: m, com: [0, 0, 0], inertia: point}
"""
# Craig, Introduction to Robotics, section 6.7: point masses at the ends of two links, modified convention
CRAIG = """
    convention: modified
    gravity: [0, -g, 0]
    links:
    - {theta: theta1*, d: 0, a: 0, alpha: 0, mass: m1, com: [l1, 0, 0], inertia: point}
    - {theta: theta2*, d: 0, a: l1, alpha: 0, mass: m2, com: [l2, 0, 0], inertia: point}
"""


def pendulum(more: str = "") -> str:
    return PENDULUM.replace("MORE", more)


# -- bodies, motors, friction -----------------------------------------------------------------------------


def test_an_inertia_about_the_origin(tmp_path: Path) -> None:
    """The theorem of parallel axes: I_o = I_c + m (c^T c 1 - c c^T)."""
    row = "{theta: x*, d: 0, a: a, alpha: 90 deg, mass: m, com: [p, q, r], "
    last = "{theta: y*, d: 0, a: b, alpha: 0, mass: m, com: [p, q, r], "
    about_com = "inertia: [A_x, A_y, A_z, A_xy, A_yz, A_xz]}"
    about_origin = (
        "about: origin, inertia: [A_x + m*(q^2 + r^2), A_y + m*(p^2 + r^2), A_z + m*(p^2 + q^2), "
        "A_xy - m*p*q, A_yz - m*q*r, A_xz - m*p*r]}"
    )
    (one,), (other,) = (
        derived(tmp_path, f"\n    links:\n    - {row}{said}\n    - {last}{said}\n", "inertia-matrix")
        for said in (about_com, about_origin)
    )
    assert same(one.results["D"], other.results["D"])
    assert all(claim.holds for claim in other.claims)


def test_a_rotor_and_friction(tmp_path: Path) -> None:
    more = ", motor: {inertia: J, ratio: G}, friction: {viscous: b, coulomb: tau_c}"
    inertia, motion = derived(tmp_path, pendulum(more), "inertia-matrix", "dynamics")
    assert same(inertia.results["D"], matrix("m*l^2 + I + G^2*J"))
    expected = "(m*l^2 + I + G^2*J)*theta_ddot + m*g*l*cos(theta) + b*theta_dot + tau_c*sign(theta_dot)"
    assert same(motion.results["tau"], matrix(expected))


def test_the_ratio_is_one_where_it_is_not_given(tmp_path: Path) -> None:
    (inertia,) = derived(tmp_path, pendulum(", motor: {inertia: J}"), "inertia-matrix")
    assert same(inertia.results["D"], matrix("m*l^2 + I + J"))


# -- matrices of the velocity terms -----------------------------------------------------------------------


def test_khatibs_matrices(tmp_path: Path) -> None:
    (found,) = derived(tmp_path, CRAIG, "coriolis-matrices")
    h = "m2*l1*l2*sin(theta2)"
    assert same(found.results["C"], matrix(f"0, -{h}\n{h}, 0"))
    assert same(found.results["B"], matrix(f"-2*{h}\n0"))
    assert same_scalar(found.results["b_112"], f"-{h}")
    assert same_scalar(found.results["b_211"], h)


def test_row_i_of_b_belongs_to_joint_i() -> None:
    """The notes repeat the second row in place of the last; see ERRATA.md."""
    found = Problem("robot", ARMS["anthropomorphic"]).ask("coriolis-matrices").results
    for i in (1, 2, 3):
        for place, jk in enumerate(("12", "13", "23")):
            twice = normal(found[f"b_{i}{jk}"]) * 2
            assert normal(found["B"].rows[i - 1][place]) == twice


def test_one_joint_has_no_coriolis_matrix(tmp_path: Path) -> None:
    (found,) = derived(tmp_path, pendulum(), "coriolis-matrices")
    assert set(found.results) == {"C", "b_111", "v"}


def test_both_notations_give_the_same_equations(tmp_path: Path) -> None:
    spong, khatib = derived(tmp_path, CRAIG, "dynamics", "dynamics, notation: khatib")
    assert same(spong.results["tau"], khatib.results["tau"])
    assert same(spong.results["g"], khatib.results["G"])
    assert {"M", "C", "B", "v", "G", "tau"} == set(khatib.results)


# -- Newton and Euler -------------------------------------------------------------------------------------

CRAIG_TAU = """
m2*l2^2*(theta1_ddot + theta2_ddot) + m2*l1*l2*cos(theta2)*(2*theta1_ddot + theta2_ddot) +\
 (m1 + m2)*l1^2*theta1_ddot - m2*l1*l2*sin(theta2)*theta2_dot^2 -\
 2*m2*l1*l2*sin(theta2)*theta1_dot*theta2_dot + m2*l2*g*cos(theta1 + theta2) + (m1 + m2)*l1*g*cos(theta1)
m2*l1*l2*cos(theta2)*theta1_ddot + m2*l1*l2*sin(theta2)*theta1_dot^2 + m2*l2*g*cos(theta1 + theta2) +\
 m2*l2^2*(theta1_ddot + theta2_ddot)
"""


def test_craigs_two_links(tmp_path: Path) -> None:
    """Equation 6.58, and on the way the accelerations of 6.55."""
    (found,) = derived(tmp_path, CRAIG, "newton-euler")
    assert same(found.results["tau"], matrix(CRAIG_TAU))
    first = "-l1*theta1_dot^2 + g*sin(theta1)\nl1*theta1_ddot + g*cos(theta1)\n0"
    assert same(found.definitions[symbol("o_c1_ddot")], matrix(first))


def symbol(name: str):
    return parse(name)


@pytest.mark.parametrize("name", ["SCARA", "PRP", "free rows"])
def test_all_joints_and_conventions(name: str) -> None:
    found = Problem("robot", ARMS[name]).ask("newton-euler")
    assert [claim.key for claim in found.claims if not claim.holds] == []
    assert {"inertia", "christoffel", "gravity"} <= {claim.key for claim in found.claims}


# a cylinder that turns about its own axis, which stands at an angle to the axis before it
ROUND = """
    gravity: [0, -g, 0]
    convention: modified
    links:
    - {theta: q1*, d: 0, a: 0, alpha: -36 deg, mass: m, com: [0, 0, 0], inertia: point}
    - {theta: q2*, d: 0, a: 0, alpha: -36 deg, mass: m, com: [0, 0, 0],
       inertia: {cylinder: {radius: r, length: h}, axis: AXIS}}
"""


@pytest.mark.parametrize("kind", ["christoffel", "dynamics"])
@pytest.mark.parametrize(("axis", "listed"), [("z", False), ("x", True)])
def test_symbols_that_vanish_with_the_moments_of_a_shape(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, axis: str, listed: bool, kind: str
) -> None:
    """In names c_112 is I_xx2 - I_yy2 times something: zero about z, and about x one that must be listed."""
    arm = ROUND.replace("AXIS", axis)
    (found,) = derived(tmp_path, arm, kind)
    assert ("c_112" in found.facts.numbers) is listed
    module = import_module(f"derive.kinds.robot.{kind}")
    right = module.listed
    monkeypatch.setattr(module, "listed", lambda *given: tuple(n for n in right(*given) if n != "c_112"))
    if listed:
        with pytest.raises(SheetErrors, match="listed"):
            derived(tmp_path, arm, kind)
    else:
        derived(tmp_path, arm, kind)


# -- energies ---------------------------------------------------------------------------------------------


def test_energies_of_a_pendulum(tmp_path: Path) -> None:
    (found,) = derived(tmp_path, pendulum(", motor: {inertia: J, ratio: G}"), "energy")
    assert same_scalar(found.results["K_1"], "(m*l^2 + I)*theta_dot^2/2")
    assert same_scalar(found.results["K_m"], "G^2*J*theta_dot^2/2")
    assert same_scalar(found.results["P"], "m*g*l*sin(theta)")


# -- properties -------------------------------------------------------------------------------------------


def test_skew_symmetry_in_numbers(tmp_path: Path) -> None:
    (found,) = derived(tmp_path, CRAIG, "properties")
    at = {
        "theta1": 0.3,
        "theta2": 0.7,
        "theta1_dot": -0.4,
        "theta2_dot": 1.1,
        "m1": 1,
        "m2": 2,
        "l1": 1,
        "l2": 3,
    }
    N = np.array(number_rows(found.results["N"], at))
    assert np.allclose(N, -N.T)
    assert abs(N).max() > 1
    assert found.facts.definite.key == "by-minors"


def test_an_arm_whose_inertia_is_semidefinite_only(tmp_path: Path) -> None:
    """A point mass on the axis of the last joint."""
    links = (
        pendulum() + "    - {theta: phi*, d: 0, a: 0, alpha: 0, mass: M, com: [0, 0, 0], inertia: point}\n"
    )
    properties = derived(tmp_path, links, "properties")[0]
    assert properties.facts.definite.key == "semidefinite"
    with pytest.raises(SheetErrors) as caught:
        derived(tmp_path, links, "forward-dynamics")
    assert "singular" in caught.value.errors[0].message


def test_the_puma_has_36_base_parameters() -> None:
    """Gautier and Khalil, Direct calculation of minimum set of inertial parameters of serial robots, 1990."""
    problem = Problem("robot", ARMS["PUMA 560"])
    parameters = standard_parameters(problem)
    assert len(parameters) - len(dependent(problem, parameters)) == 36


def test_the_regressor_times_its_parameters(tmp_path: Path) -> None:
    more = ", motor: {inertia: J, ratio: G}, friction: {viscous: b, coulomb: tau_c}"
    (found,) = derived(tmp_path, pendulum(more), "regressor")
    assert same(found.results["base_parameters"], matrix("m*l^2 + I + G^2*J\nm*l\nb\ntau_c"))
    assert same(found.results["Y_b"], matrix("theta_ddot, g*cos(theta), theta_dot, sign(theta_dot)"))


# -- solved and linearised --------------------------------------------------------------------------------


def test_accelerations_of_a_polar_arm(tmp_path: Path) -> None:
    (found,) = derived(tmp_path, POLAR, "forward-dynamics")
    turn = "(tau_1 - 2*m*r*r_dot*theta1_dot - m*g*r*cos(theta1))/(m*r^2 + I1)"
    slide = "tau_2/m + r*theta1_dot^2 - g*sin(theta1)"
    assert same(found.results["qddot"], matrix(f"{turn}\n{slide}"))
    assert same_scalar(found.results["det"], "m*(m*r^2 + I1)")


def test_a_pendulum_upright(tmp_path: Path) -> None:
    (found,) = derived(tmp_path, pendulum(", friction: {viscous: b}"), "state-space, at: {theta: 90 deg}")
    assert same(found.results["A"], matrix("0, 1\nm*g*l/(m*l^2 + I), -b/(m*l^2 + I)"))
    assert same(found.results["B"], matrix("0\n1/(m*l^2 + I)"))
    assert same(found.results["tau_0"], matrix("0"))


def test_a_pendulum_held_level(tmp_path: Path) -> None:
    (found,) = derived(tmp_path, pendulum(), "state-space, at: {theta: 0}")
    assert same(found.results["tau_0"], matrix("m*g*l"))
    assert same(found.results["A"], matrix("0, 1\n0, 0"))


def test_a_point_mass_shows_its_mass(tmp_path: Path) -> None:
    """A hand of mass m on an arm without inertia resists every force with m."""
    links = POLAR.replace("I1", "0")
    (found,) = derived(tmp_path, links, "operational-space-inertia, rows: [vx, vy]")
    assert same(found.results["Lambda"], matrix("m, 0\n0, m"))


def test_results_in_numbers(tmp_path: Path) -> None:
    (found,) = derived(tmp_path, POLAR, "operational-space-inertia, rows: [vx, vy]")
    at = {"theta1": 0.4, "r": 0.7, "m": 2.0, "I1": 0.3}
    along = np.array([np.cos(0.4), np.sin(0.4)])
    across = np.array([-np.sin(0.4), np.cos(0.4)])
    expected = 2 * np.outer(along, along) + (2 + 0.3 / 0.49) * np.outer(across, across)
    assert np.allclose(number_rows(found.results["Lambda"], at), expected)
    assert numbers(found.results["J_inv"], at)


# -- what cannot be derived -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("question", "said"),
    [
        ("state-space, at: {phi: 0}", "phi is no joint variable"),
        ("operational-space-inertia, rows: [vx, vy]", "2 rows are more than the 1 joints"),
        ("operational-space-inertia, rows: [vz]", "dependent everywhere"),
    ],
)
def test_reasons(tmp_path: Path, question: str, said: str) -> None:
    with pytest.raises(SheetErrors) as caught:
        derived(tmp_path, pendulum(), question)
    assert said in caught.value.errors[0].message


def test_a_name_that_means_two_things(tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as caught:
        derived(tmp_path, pendulum().replace("mass: m", "mass: D"), "inertia-matrix")
    assert "also a name of this answer" in caught.value.errors[0].message


def test_a_vector_of_the_recursion_called_as_a_coefficient(tmp_path: Path) -> None:
    with pytest.raises(SheetErrors) as caught:
        derived(tmp_path, pendulum(", friction: {viscous: mu_1}"), "newton-euler")
    assert "'mu_1' is also a name of this answer" in caught.value.errors[0].message


# -- arms out of the ordinary -----------------------------------------------------------------------------

KINDS = (
    "energy", "dynamics, notation: khatib", "coriolis-matrix", "coriolis-matrices", "regressor", "properties",
    "newton-euler", "forward-dynamics", "state-space, at: {q1: 0.3}",
)  # fmt: skip
ODD = {
    "names that stand for others": """
    gravity: [0, -g, 0]
    links:
    - {theta: q1*, d: 0, a: L, alpha: 0, mass: m, com: [L_c - L, 0, 0], inertia: {box: [L, L/10, L/10]},
       motor: {inertia: L_c, ratio: n}, friction: {viscous: L_c}}
    - {theta: q2*, d: 0, a: L, alpha: 0, mass: m, com: center, inertia: {box: [L, L/10, L/10]}}
""",
    "screws": """
    gravity: [0, -g, 0]
    links:
    - {screw: {axis: z}, variable: q1*, com: [L/2, 0, 0], mass: m, inertia: [I_x, I_y, I_z]}
    - {screw: {axis: z, through: [L, 0, 0]}, variable: q2*, com: [3*L/2, 0, 0], mass: m,
       inertia: [I_x, I_y, I_z]}
    home: [{translate: x, by: 2*L}]
""",
    "a slanting base, a tool, a slide": """
    base: [{rotate: x, by: 30 deg}, {translate: z, by: h}]
    tool: [{translate: x, by: 0.1 m}]
    links:
    - {theta: 0, d: q1*, a: 0, alpha: -90 deg, mass: m1, com: [0, h, 0], inertia: {sphere: r}}
    - {theta: q2* + 90 deg, d: 0, a: 0.5 m, alpha: 0, mass: 2 kg, com: [-0.25, 0, 0], inertia: [0, 0.2, 0.2],
       about: origin, friction: {coulomb: 0.3}}
""",
    "a row that does not move": """
    convention: modified
    links:
    - {theta: q1*, d: 0, a: 0, alpha: 0, mass: m1, com: [0, 0, p], inertia: [A1, A1, B1]}
    - {theta: 90 deg, d: k, a: 0, alpha: 0, mass: m2, com: [0, q, 0], inertia: point}
    - {theta: q3*, d: 0, a: b, alpha: 90 deg, mass: m3, com: [u, 0, 0], inertia: point}
""",
}


@pytest.mark.parametrize("arm", ODD)
def test_every_kind_of_an_odd_arm(tmp_path: Path, arm: str) -> None:
    """Built, which they are not where a claim fails."""
    sheet = tmp_path / "sheet.yaml"
    asked = "".join(f"  - {{find: {kind}}}\n" for kind in KINDS)
    text = f"title: t\nwhere: {{L_c: L/2}}\nproblems:\n- robot:{ODD[arm].rstrip()}\n  questions:\n{asked}"
    sheet.write_text(text, encoding="utf-8")
    document = assemble(load_sheet(sheet))
    assert len(list(document.questions())) == len(KINDS)
    assert render(document, "md").count("#### Solution") == len(KINDS)


@pytest.mark.parametrize(
    ("name", "asked"),
    [
        ("B", "find: coriolis-matrices"),
        ("P", "find: gravity"),
        ("g_0", "find: gravity"),
        ("q_dot", "find: energy"),
        ("G", "find: dynamics\n  notation: khatib"),
        ("Lambda", "find: operational-space-inertia\n  rows: [vx]"),
    ],
)
def test_a_name_under_where_that_is_one_of_the_answer(tmp_path: Path, name: str, asked: str) -> None:
    sheet = tmp_path / "sheet.yaml"
    arm = PENDULUM.replace("a: 0", f"a: {name}").replace("MORE", "")
    sheet.write_text(
        f"title: t\nproblems:\n- robot:{arm}  where: {{{name}: 2*L}}\n  {asked}\n", encoding="utf-8"
    )
    with pytest.raises(SheetErrors) as caught:
        assemble(load_sheet(sheet))
    assert "choose another name" in caught.value.errors[0].message


def test_accelerations_of_many_joints_are_told_by_equations() -> None:
    """A PUMA 560: what the torques of a motion bring about are its accelerations (Newton-Euler)."""
    robot = ARMS["PUMA 560"]
    arm = Oracle(robot, {})
    found = Problem("robot", robot).ask("forward-dynamics")
    names = [f"{name}{dots}" for name in robot.variables for dots in ("", "_dot", "_ddot")]
    at = dict.fromkeys(Problem("robot", robot).symbols, 0.4) | {"g": 9.81}
    at |= {name: 0.3 - 0.1 * k for k, name in enumerate(names)}
    forces = {f"tau_{k}": force for k, force in enumerate(arm.torques(at), 1)}
    rises = [at[f"{name}_ddot"] for name in robot.variables]
    assert solution_at(found.results["qddot"], {**at, **forces}) == pytest.approx(rises, rel=1e-8)
    f = Problem("robot", robot).ask("state-space").results["f"]
    rates = [at[f"{name}_dot"] for name in robot.variables]
    assert solution_at(f, {**at, **forces}) == pytest.approx([*rates, *rises], rel=1e-8)


@pytest.mark.parametrize("rows", [(), ("vx", "vz"), ("vx", "vy", "vz", "wx", "wy", "wz")])
def test_the_inertia_at_the_hand_of_many_joints(rows: tuple[str, ...]) -> None:
    """A PUMA 560: (J D^-1 J^T)^-1 of NumPy, D by Newton and Euler and J by differences."""
    robot = ARMS["PUMA 560"]
    problem = Problem("robot", robot)
    at = dict.fromkeys(problem.symbols, 0.4) | {"g": 9.81}
    at |= {name: 0.3 - 0.1 * k for k, name in enumerate(robot.variables)}
    found = problem.ask("operational-space-inertia", rows=rows).results
    J, D = np.array(number_rows(found["J"], at)), Oracle(robot, {}).inertia_matrix(at)
    expected = np.linalg.inv(J @ np.linalg.inv(D) @ J.T)
    assert np.allclose(solution_at(found["Lambda"], at), expected, rtol=1e-8)


def page(robot: str, kind: str, tmp_path: Path) -> str:
    """The page of one question about an arm."""
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(f"title: x\nproblems:\n- find: {kind}\n  robot:{robot}", encoding="utf-8")
    return render(assemble(load_sheet(sheet)), "md")


SPHERICAL = """
    gravity: [0, 0, -g]
    links:
    - {theta: theta1*, d: 0, a: 0, alpha: 90 deg, mass: m1, com: [0, 0, 0], inertia: [0, I1, 0]}
    - {theta: theta2*, d: 0, a: 0, alpha: 90 deg, mass: m2, com: [0, 0, 0], inertia: [I2, OTHER, 0]}
    - {theta: 0, d: d3*, a: 0, alpha: 0, mass: m3, com: [0, 0, 0], inertia: point}
"""


@pytest.mark.parametrize(
    ("other", "told"), [("I2", r"\Theta_2 = \Theta_3"), ("3*I2", r"\Theta_3 = 3 \Theta_2"), ("I3", "")]
)
def test_parameters_that_the_bodies_make_equal_are_told(other: str, told: str, tmp_path: Path) -> None:
    said = page(SPHERICAL.replace("OTHER", other), "regressor", tmp_path)
    assert ("The bodies given here have" in said) == bool(told)
    assert told in said


@pytest.mark.parametrize(("inertia", "told"), [("[I1, I2, I3]", True), ("[I1, I2, I3, I4, I5, I6]", False)])
def test_parameters_that_are_zero_are_told_to_be_known(inertia: str, told: bool, tmp_path: Path) -> None:
    com = "[0, 0, c]" if told else "[a, b, c]"
    arm = f"""
    links:
    - {{theta: theta1*, d: 0, a: 0, alpha: 0, mass: m, com: {com}, inertia: {inertia}}}
"""
    said = page(arm, "regressor", tmp_path)
    assert ("taken as known to be zero" in said) == told


def test_one_thing_is_not_told_in_the_plural(tmp_path: Path) -> None:
    said = page(PENDULUM.replace("MORE", ""), "dynamics", tmp_path)
    assert "The center of mass has the Jacobian" in said
    assert "the link adds its part" in said.lower()
    assert "the potential energy is" in said
