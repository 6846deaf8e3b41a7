from __future__ import annotations

import pytest

from derive.algebra.infix import text
from derive.answers.latex.letters import Letters
from derive.answers.reading import read_text
from derive.errors import FormulaError

TYPED = "theta1 theta2 q4 d3 L L_c a1 a2 m g phi omega t theta1_dot T_1^0 J_w1 I_xx theta2*"
NAMES = frozenset(TYPED.split(" "))
LETTERS = Letters(NAMES, xy=True, own=NAMES)


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("c1 s_12", "cos(theta1)*sin(theta1 + theta2)"),
        ("c_phi", "cos(phi)"),
        ("theta_1", "theta1"),
        ("c_4", "cos(q4)"),
        (r"\cos\theta_1\sin\theta_2", "cos(theta1)*sin(theta2)"),
        (r"\cos\omega t", "cos(omega*t)"),
        (r"\cos 2\phi", "cos(2*phi)"),
        (r"\cos^2\phi", "cos(phi)**2"),
        (r"\cos^{-1}(a_1)", "acos(a1)"),
        (r"\frac12 m", "1/2*m"),
        (r"L_cs_{12}", "L_c*sin(theta1 + theta2)"),
        (r"c_{\theta_1+\theta_2}", "cos(theta1 + theta2)"),
        (r"\dot{\theta}_1^2", "theta1_dot**2"),
        (r"\dot{\theta_1}", "theta1_dot"),
        (r"T^0_1 + T_1^0", "T_1^0 + T_1^0"),
        (r"J_{\omega_1} I_{xx}", "J_w1*I_xx"),
        (r"\mathrm{Atan2}(a_1, a_2)", "atan2(a2, a1)"),
        (r"\operatorname{atan2}(a_1, a_2)", "atan2(a1, a2)"),
        ("$a_1 = a_2 = L$".replace("$a_1", "$ a_1"), "L"),
        (r"\left[ 30^\circ \right]", "pi/6"),
        (r"2\begin{pmatrix} 1 \\ a_1 \end{pmatrix}", "Matrix([[2], [2*a1]])"),
        (r"\begin{bmatrix} 1 & a_1 \\ \end{bmatrix}^T", "Matrix([[1], [a1]])"),
        (r"\begin{array}{cc} 1 & 2 \\[1ex] 3 & 4 \end{array}", "Matrix([[1, 2], [3, 4]])"),
        ("θ₁ + φ", "theta1 + phi"),
        (r"a_1 k \quad \text{where } k = 2 h, \ h = a_2/L", "a1*2*a2/L"),
        (r"\begin{align} J &= a_1 \\ &\quad + a_2. \end{align}", "a1 + a2"),
        (r"\boxed{J := a_1} \tag{3} \label{eq:J}", "a1"),
        (r"a_1 s_{12} = 0", "a1*sin(theta1 + theta2)"),
        ("a_1 + % first\n a_2 % second", "a1 + a2"),
        (r"{a_1 \over 2} + \frac{d\theta_1}{\mathrm{d}t}", "a1/2 + theta1_dot"),
        (r"\left[a_1,\ a_2\right]^\top", "Matrix([[a1], [a2]])"),
        (r"\operatorname{atan}_{2}{\left(a_{1},a_{2} \right)}", "atan2(a2, a1)"),
        (r"s\varphi C\theta_1", "sin(phi)*cos(theta1)"),
        (r"a_1 \in \mathbb{R}, \quad (2.3a)", "a1"),
        (r"\det\begin{bmatrix} a_1 & 1 \\ 0 & a_2 \end{bmatrix}", "a1*a2"),
        (r"\mathrm{adj}\begin{bmatrix} a_1 & 1 \\ 0 & a_2 \end{bmatrix}", "Matrix([[a2, -1], [0, a1]])"),
        (r"\frac{\partial}{\partial a_1} (a_1^2 m)", "Derivative(a1**2*m, a1)"),
        (r"\theta_2^* + \theta_2^\ast", "theta2* + theta2*"),
    ],
)
def test_it_is_read(typed: str, meant: str) -> None:
    assert text(read_text(typed, LETTERS).tree) == meant


@pytest.mark.parametrize(
    "typed",
    [
        "", "{", "}", "\\", "\\foo", "_", "^", "a_", "a_1^", "\\frac", "\\frac{1}", "\\sqrt[", "|a_1\\,",
        "c_{7}", "\\begin", "\\begin{", "\\begin{foo}1\\end{foo}", "\\begin{bmatrix}",
        "\\begin{bmatrix}1&2\\\\3\\end{bmatrix}",
        "\\dot", "\\mathrm{", "\\pm a_1", "\\cos", "{" * 5000, "\\frac{1}" * 3000, "a_1^{65}",
        "c_{+}", "-" * 9000 + "\\pi",
        "\\sqrt" * 3000, "\\cos" * 3000, "{}" * 4000, "\\dot" * 4000, "a_1^T", "\\begin" * 100,
        "\\sqrt{" * 2000,
        "(a_1 + a_2 + L + m + g)^{60}", "9" * 50 + "\\,", "a_1 \\",
        "\\begin{bmatrix} \\begin{bmatrix} 1 \\end{bmatrix} \\end{bmatrix}",
        "__import__('os')", "lambda: 1", "\\input{/etc/passwd}", "\\def\\a{1}", "1/0",
        "\\frac10", "a_1 (2)", r"a_1, \quad a_2", r"a_1 \quad \det J = a_2", r"a_1, \quad a_2 = 2",
        "a_1 % + a_2", r"a_1 + \M", r"\frac{\partial^2 m}{\partial a_1}", r"\frac{\partial m}{\partial 2}",
        r"a_1 \neq 0", r"a_1 k, \quad k = 2 k", r"\theta_1(t)", "a_1 & a_2", r"a_1 \text{ in metres}",
        "a_1 k_0, " + ", ".join(f"k_{{{i}}} = k_{{{i + 1}}}^2 k_{{{i + 1}}}" for i in range(40)),
    ],
)  # fmt: skip
def test_nonsense_is_a_fault(typed: str) -> None:
    with pytest.raises(FormulaError) as caught:
        read_text(typed, LETTERS)
    assert 0 <= caught.value.offset <= len(typed)


def test_a_quotient_has_both_its_readings() -> None:
    for typed in ("a_1/L g", r"a_1 / L\,g", "a1/L g"):
        read = read_text(typed, LETTERS)
        assert read.tight is not None
        assert (text(read.tree), text(read.tight)) == ("a1/L*g", "a1/(L*g)")
    assert read_text(r"1/2 m g", LETTERS).tight is None


def test_a_chain_has_all_its_parts() -> None:
    read = read_text("J = a_1 + a_2 = L = g", LETTERS)
    assert text(read.tree) == "g"
    assert [text(part.tree) for part in read.chain] == ["a1 + a2", "L"]


def test_the_names_of_a_derivation_do_not_hide_sines() -> None:
    letters = Letters(NAMES | {"S_2", "c_112", "c_12"}, own=NAMES)
    assert text(read_text("S_2 c_12 c_{112}", letters).tree) == "sin(theta2)*cos(theta1 + theta2)*c_112"


def test_did_you_mean() -> None:
    with pytest.raises(FormulaError) as caught:
        read_text("a1 + thta1", LETTERS)
    assert caught.value.offset == 5
    assert caught.value.hint == "did you mean theta1?"


def test_no_load_is_meant_by_g() -> None:
    names = (NAMES - {"g"}) | {"g_1", "g_2"}
    with pytest.raises(FormulaError) as caught:
        read_text("m*g", Letters(names, own=names))
    assert caught.value.hint.startswith("gravity: of the robot")
