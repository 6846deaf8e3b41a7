"""Numbers of equations: those of answers and of what a later sentence refers to, alike in every format."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from derive.build import build
from derive.derivation import Derivation
from derive.expression import Symbol
from derive.render.so_far import Equation, SoFar

A, B, C = map(Symbol, "ABC")
ARM = """
title: An arm
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a_1, alpha: 0}
    - {theta: theta2*, d: 0, a: a_2, alpha: 0}
  questions:
  - {find: jacobian, rows: [vx, vy]}
  - {find: velocity}
"""


def test_what_is_framed_or_referred_to_has_a_number() -> None:
    so_far = SoFar(problem=1)
    here, other = Derivation("k", (), {}, definitions={A: B}), Derivation("k", (), {}, definitions={A: C})
    told = [
        so_far.marked(f"\n{name}\n", Equation(1, ((Symbol(name), B),), here, k, False), name == "B")
        for k, name in enumerate("ABC")
    ]
    page = "".join(told) + f"by {so_far.value(A, here)}"
    assert so_far.settled(page, lambda text, number: f"{text}#{number}") == "\nA#1\n\nB#2\n\nC\nby (1)"
    assert so_far.value(A, other) is None  # it is something else there
    so_far.problem = 2
    assert so_far.value(A, here) is None


@pytest.mark.parametrize(
    ("written", "tag", "cited"),
    [("md", r"\\tag\{(\d+)\}", r"Jacobian \((\d+)\)"), ("tex", r"\\tag\{(\d+)\}", r"Jacobian \((\d+)\)"),
     ("html", r'class="number">\((\d+)\)', r"Jacobian \((\d+)\)")],
)  # fmt: skip
def test_a_page_has_them_in_every_format(tmp_path: Path, written: str, tag: str, cited: str) -> None:
    sheet = tmp_path / "arm.yaml"
    sheet.write_text(ARM)
    build([sheet], [written], tmp_path)
    text = (tmp_path / f"arm.{written}").read_text()
    assert re.findall(tag, text) == ["1", "2", "3"] and re.findall(cited, text) == ["1"]
