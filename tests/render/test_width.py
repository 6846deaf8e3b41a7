from __future__ import annotations

import pytest

from derive.render.width import BRACKETS, COLUMN_GAP, width

# In em, as pdflatex measures a box of it in `\displaystyle` Latin Modern (`\showthe\wd0`).
MEASURED = [
    (r"a + b", 2.18),
    (r"\frac{a + b}{c}", 2.42),
    (r"\cos \phi \sin \psi", 4.36),
    (r"x_{12}^2", 1.42),
    (r"\begin{bmatrix} 1 & 0 \\ 0 & 1 \end{bmatrix}", 3.06),
    (r"-\frac{m L^2}{2} s_2", 3.94),
    (r"T_2^0 = T_1^0 T_2^1", 4.85),
    (r"\mathrm{atan2}(y, x) - \dot{\theta}_1", 6.90),
    (r"\sqrt{a_1^2 + a_2^2}", 4.18),
    (r"c_1 (c_2 (c_4 c_5 c_6 - s_4 s_6) - c_6 s_2 s_5) - s_1 (c_4 s_6 + c_5 c_6 s_4)", 21.58),
    (r"\begin{bmatrix} a_1 c_1 + a_2 c_{12} & -a_2 s_{12} \\ 0 & \frac{m}{2} \end{bmatrix}", 10.46),
    (r"z_0 = \begin{bmatrix} 0 \\ 0 \\ 1 \end{bmatrix}", 3.95),
    (r"\left( a_2 + \sqrt{a_3^2 + d_4^2} \right) s_2", 8.65),
    (r"\frac{\partial d_{11}}{\partial \theta_1} = -0.35", 6.08),
]


@pytest.mark.parametrize(("latex", "measured"), MEASURED)
def test_widths_are_close_to_tex(latex: str, measured: float) -> None:
    assert width(latex) == pytest.approx(measured, rel=0.09)


def test_a_matrix_is_as_wide_as_its_widest_entries() -> None:
    wide = width(r"\begin{bmatrix} a & b \\ a + b + c + d & b \end{bmatrix}")
    assert wide == pytest.approx(width("a + b + c + d") + width("b") + BRACKETS + COLUMN_GAP)
