from __future__ import annotations

import pytest

from derive.render.names import name_latex


@pytest.mark.parametrize(
    ("name", "latex"),
    [
        ("theta1", r"\theta_1"),
        ("theta_1", r"\theta_1"),
        ("a2", "a_2"),
        ("r11", "r_{11}"),
        ("L_c", "L_c"),
        ("K_m", "K_m"),
        ("phi", r"\phi"),
        ("T_1^0", "T_1^0"),
        ("T_12^10", "T_{12}^{10}"),
        ("T_c2", "T_{c2}"),
        ("J_v1", "J_{v_1}"),
        ("J_vc1", "J_{v_{c1}}"),
        ("J_w2", r"J_{\omega_2}"),
        ("o_c1", "o_{c1}"),
        ("c_111", "c_{111}"),
        ("R_AB", "R_{AB}"),
        ("theta1_dot", r"\dot{\theta}_1"),
        ("theta1_ddot", r"\ddot{\theta}_1"),
        ("qdot", r"\dot{q}"),
        ("Ixx", "I_{xx}"),
        ("vx", "v_x"),
        ("tip", r"\mathrm{tip}"),
        ("v_max", r"v_{\mathrm{max}}"),
        ("omega_n", r"\omega_n"),
        ("K_theta", r"K_\theta"),
        ("theta1*", r"\theta_1^\ast"),
        ("0_3x1", r"0_{3 \times 1}"),
        ("v^0", "v^0"),
    ],
)
def test_a_plain_name_prints_as_in_a_textbook(name: str, latex: str) -> None:
    assert name_latex(name) == latex
