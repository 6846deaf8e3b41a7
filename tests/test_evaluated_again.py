"""Numbers under `evaluate` are found a second time, from the text of the results, with sure digits."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from derive.algebra.infix import Infix
from derive.build import derive_all
from derive.errors import DivisionByZero, NotReal, SheetErrors
from derive.expression import Degrees, Expr, negate, number, symbols
from derive.kinds import values_at
from derive.kinds.sure import rounding, sure
from derive.render import evaluated
from derive.sheet.load import load_sheet
from derive.writing import render

(A,) = symbols("a")
POINT: dict[str, Expr] = {"q": Degrees(Fraction(90)), "a": number(2), "b": A * 3}
PLANAR = """
title: t
problems:
- robot:
    links:
    - {theta: q1*, d: 0, a: l1, alpha: 0}
    - {theta: q2*, d: 0, a: l2, alpha: 0}
  questions:
"""
FORWARD = f"{PLANAR}  - {{find: forward-kinematics, evaluate: {{q1: 30 deg, q2: 0.4, l1: 0.3, l2: 0.2}}}}\n"
PARTLY = f"{PLANAR}  - {{find: jacobian, evaluate: {{q1: 30 deg, l1: 0.3}}}}\n"
BRANCHES = """
title: t
problems:
- function: {value: x^4/4 - x^2/2 + a*x^2, variables: [x]}
  find: stationary-points
  evaluate: {a: 2}
"""


ALL_REAL = BRANCHES.replace("a: 2", "a: 0.1")


def built(text: str, folder: Path) -> dict[str, Any]:
    """The first answer of a sheet, as JSON."""
    path = folder / "sheet.yaml"
    path.write_text(text)
    (document,) = derive_all([load_sheet(path)], True, lambda _: None)
    question: dict[str, Any] = json.loads(render(document, "json"))["problems"][0]["questions"][0]
    return question


@pytest.mark.parametrize(
    ("formula", "value"),
    [
        ("cos(q)", 0.0),
        ("atan2(cos(q), -1)", math.pi),
        ("acos(sin(q))", 0.0),
        ("b**-1", 1 / 6),
        ("1e16 + 1 - 1e16", 1.0),
        ("Abs(-a)", 2.0),
    ],
)
def test_a_number_is_sure(formula: str, value: float) -> None:
    assert float(sure(formula, POINT)) == value
    assert rounding(formula, POINT) >= 0


@pytest.mark.parametrize(
    ("formula", "error"), [("acos(a)", NotReal), ("(-a)**(1/2)", NotReal), ("1/cos(q)", DivisionByZero)]
)
def test_where_there_is_no_number(formula: str, error: type[Exception]) -> None:
    with pytest.raises(error):
        sure(formula, POINT)


@pytest.mark.parametrize("text", [FORWARD, PARTLY, BRANCHES, ALL_REAL])
def test_the_numbers_are_claimed_and_counted(text: str, tmp_path: Path) -> None:
    claims = built(text, tmp_path)["checks"]
    assert [claim["by"] for claim in claims].count("ball arithmetic") == 1


def turned(entry: Callable[..., Any]) -> Callable[..., Any]:
    """With the sign of every value turned."""

    def wrong(*given: Any) -> Any:
        return -entry(*given)

    return wrong


@pytest.mark.parametrize(("text", "name"), [(FORWARD, "number"), (PARTLY, "put_in"), (ALL_REAL, "number")])
def test_a_wrong_number_is_refused(
    text: str, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(values_at, name, turned(getattr(values_at, name)))
    with pytest.raises(SheetErrors) as refused:
        built(text, tmp_path)
    assert "the numbers at the point" in refused.value.errors[0].message


def test_a_branch_that_is_real_cannot_be_said_not_to_be(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = built(BRANCHES, tmp_path)["evaluated"]["solutions"]
    assert {branch.get("real", True) for branch in found} == {True, False}
    monkeypatch.setattr(values_at, "_branch", lambda branch, _: {"when": branch.when, "real": False})
    with pytest.raises(SheetErrors):
        built(BRANCHES, tmp_path)


ANGLES = """
title: t
problems:
- motion: [{rotate: z, by: phi}, {rotate: x, by: theta}]
  find: axis-angle
  evaluate: {phi: 40 deg, theta: 20 deg}
"""


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("_degrees", lambda made, angle: made(2 * angle)),
        ("numeric", lambda made, value: made(value[::-1] if isinstance(value, list) else value)),
        ("_real", lambda made, value: negate(made(value))),
    ],
)
def test_the_page_prints_the_numbers_of_the_json(
    name: str, wrong: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "sheet.yaml"
    path.write_text(ANGLES)
    (document,) = derive_all([load_sheet(path)], True, lambda _: None)
    assert "44.5^\\circ" in render(document, "md")
    made = getattr(evaluated, name)
    monkeypatch.setattr(evaluated, name, lambda *given: wrong(made, *given))
    with pytest.raises(SheetErrors) as refused:
        render(document, "md")
    assert "these are not the numbers that were evaluated" in refused.value.errors[0].message


def test_a_result_that_is_written_wrongly_in_the_json_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "sheet.yaml"
    path.write_text(f"{PLANAR}  - find: jacobian\n  - find: inverse-kinematics\n")
    (document,) = derive_all([load_sheet(path)], True, lambda _: None)
    right = Infix.sum
    monkeypatch.setattr(Infix, "sum", lambda self, terms: right(self, (negate(terms[0]), *terms[1:])))
    with pytest.raises(SheetErrors) as refused:
        render(document, "json")
    assert len(refused.value.errors) == 2
    assert "J as JSON" in refused.value.errors[0].message
