"""What the audit says: of right answers, of wrong ones, and of those that it cannot judge."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import pytest
import sympy
from sympy.core.cache import clear_cache
from sympy.core.random import seed as seed_of_sympy

from derive.audit.asked import Asked
from derive.audit.engine import Audited, Contradicted, NotAudited, audit
from derive.audit.points import Irrational, Point
from derive.audit.text import Unreadable, sympy_of_text
from derive.auditing import answers
from derive.build import assemble
from derive.sheet.load import load_sheet
from derive.writing import render

ARM = """
title: An arm
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: a1, alpha: 90 deg}
    - {theta: theta2*, d: 0, a: a2, alpha: 0}
  find: forward-kinematics
  evaluate: {theta1: 30 deg, theta2: 0.5, a1: 1, a2: 2}
"""


@pytest.fixture(scope="module")
def right(tmp_path_factory: pytest.TempPathFactory) -> Asked:
    path = tmp_path_factory.mktemp("audit") / "arm.yaml"
    path.write_text(ARM, encoding="utf-8")
    sheet = load_sheet(path)
    ((_, found),) = answers(sheet, render(assemble(sheet), "json"))
    return found


def test_a_right_answer_is_audited(right: Asked) -> None:
    assert audit(right) == Audited(3)


def test_a_wrong_entry_is_told_with_its_place(right: Asked) -> None:
    rows = [list(row) for row in right.results["T_2^1"]]
    rows[0][1] = "sin(theta2)"
    wrong = audit(replace(right, results={**right.results, "T_2^1": rows}))
    assert isinstance(wrong, Contradicted)
    assert wrong.name == "T_2^1[1][2]"


def test_wrong_numbers_under_evaluate_are_told(right: Asked) -> None:
    rows = [list(row) for row in right.evaluated["T_2^0"]]
    rows[2][3] += 1e-6
    wrong = audit(replace(right, evaluated={**right.evaluated, "T_2^0": rows}))
    assert isinstance(wrong, Contradicted)
    assert wrong.name == "evaluated T_2^0[3][4]"


def test_what_nobody_audits_and_what_nobody_tests_is_said(right: Asked) -> None:
    assert isinstance(audit(replace(right, kind="no-such-kind")), NotAudited)
    more = audit(replace(right, results={**right.results, "X": "theta1"}))
    assert more == NotAudited("X: not tested")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-2**2", "-4"),
        ("2**-1", "1/2"),
        ("6/3/2", "1"),
        ("1 - 2 - 3", "-4"),
        ("-(1 + 2)*3", "-9"),
        ("2*-3", "-6"),
        ("a/2", "1/4"),
    ],
)
def test_texts_are_read_as_sympy_writes_them(text: str, value: str) -> None:
    names = {"a": sympy.Rational(1, 2)}
    assert sympy_of_text(text, names) == sympy.Rational(value)


@pytest.mark.parametrize("text", ["", "1 +", "(1", "1)", "a b", "__import__('os')", "f(x)", "1 = 1", "a.b"])
def test_what_is_no_formula_is_unreadable(text: str) -> None:
    with pytest.raises(Unreadable):
        sympy_of_text(text, {})


def test_sympy_is_not_asked_whether_a_number_is_zero(monkeypatch: pytest.MonkeyPatch) -> None:
    def asked(number: sympy.Expr) -> None:
        raise AssertionError(number)

    monkeypatch.setattr("sympy.polys.numberfields.minimal_polynomial", asked)
    size = "sqrt(2**(1/3) + (3**(123/1000))**2)"
    text = f"atan2(sqrt((3**(123/1000)/{size})**2 + (sqrt(2**(1/3))/{size})**2), sqrt(3))"
    for seed in range(30):  # SymPy asks in an order that it draws
        seed_of_sympy(seed)
        clear_cache()
        assert float(Point(0, False).at(sympy_of_text(text, {}))) == pytest.approx(math.pi / 6)


def test_angles_have_rational_sines() -> None:
    a, b = sympy.symbols("a b")
    point = Point(1, angles=("a", "b"))
    c, s = point.turn(2 * a - b + sympy.pi / 2)
    assert isinstance(c, Fraction) and c**2 + s**2 == 1
    assert float(c) == pytest.approx(
        float(
            sympy.cos(2 * a - b + sympy.pi / 2).subs(
                {n: float(Point(1, False, "ab")[n.name]) for n in (a, b)}
            )
        )
    )
    with pytest.raises(Irrational):
        point.at(a)
    with pytest.raises(Irrational):
        point.turn(a / 2)
