from __future__ import annotations

import pytest

from derive.render.conditions import condition
from derive.render.latex import Printer
from derive.render.notation import Notation
from derive.render.plain_text import markdown_text


@pytest.mark.parametrize(
    ("words", "typeset"),
    [
        ("elbow up, theta2 > 0", r"elbow up, $\theta_2 > 0$"),
        ("cos(theta) > 0", r"$\cos \theta > 0$"),
        ("theta = 90 deg, where psi is free", r"$\theta = 90^\circ$, where $\psi$ is free"),
        ("x^2 + y^2 <= 4", r"$x^2 + y^2 \leq 4$"),
        ("what is <this> = ", r"what is \<this\> = "),
        ("always", "always"),
        ("only psi - theta is determined", r"only $\psi - \theta$ is determined"),
    ],
)
def test_the_mathematics_of_a_condition_is_typeset(words: str, typeset: str) -> None:
    assert condition(words, {"psi", "theta"}, Printer(Notation()), markdown_text) == typeset
