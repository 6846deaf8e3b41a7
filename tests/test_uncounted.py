"""What cannot be compared a second time is counted: told by `--explain`, and at the foot of the page."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace

import pytest

from derive import evaluated_again, json_back
from derive.build import assemble
from derive.derivation import Claim, Derivation, Step
from derive.errors import FormulaError, NotDerivable, SheetErrors
from derive.explaining import explained
from derive.expression import Expr, Symbol, symbols
from derive.kinds.told import Page, with_results_told
from derive.render.document import Document
from derive.render.json_result import render_json
from derive.render.page import render_markdown
from derive.sheet.load import load_sheet

SHEET = """
title: t
problems:
- robot:
    links:
    - {theta: q1*, d: 0, a: l1, alpha: 0}
  find: jacobian
  evaluate: {q1: 30 deg, l1: 0.3}
"""


def built(folder: Path) -> Document:
    path = folder / "sheet.yaml"
    path.write_text(SHEET)
    return assemble(load_sheet(path))


def said(document: Document) -> str:
    return " ".join(" ".join(explained([document])).split())


def test_what_is_compared_is_not_mentioned(tmp_path: Path) -> None:
    document = built(tmp_path)
    assert " could " not in said(document)
    assert "a second time" not in render_markdown(document)


def test_results_without_numbers_are_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Page, "tells", lambda self, name, tree: None)
    document = built(tmp_path)
    assert "results that no line could be compared with: T_1^0" in said(document)
    assert "could not be compared a second time" in render_markdown(document)


def test_numbers_that_are_not_found_again_are_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def undecided(formula: Expr, point: object) -> float:
        raise NotDerivable("no number of bits decides")

    monkeypatch.setattr("derive.evaluated_again.sure", undecided)
    document = built(tmp_path)
    assert "numbers that could not be found again: J" in said(document)
    assert "1 result could not be compared a second time" in render_markdown(document)


def test_a_text_that_cannot_be_read_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def unreadable(text: str) -> Expr:
        raise FormulaError("no formula", 0)

    document = built(tmp_path)
    json_back._same.cache_clear()
    monkeypatch.setattr(json_back, "read", unreadable)
    assert "could not be read in the JSON: J of question 1.1" in said(document)
    json_back._same.cache_clear()


def test_a_result_is_trusted_only_where_its_claim_was_made() -> None:
    x, y = symbols("x y")
    lines = (Step("a", (Symbol("a"), x)),)
    for keys, told in (("put-back", True), ("other|put-back", True), ("other", False)):
        found = Derivation("k", lines, {"a": y}, (Claim("put-back", "normal-form", True),))
        found = with_results_told(found, SimpleNamespace(CLAIMED={"a": keys}), {})
        assert all(claim.holds for claim in found.claims) is told


def test_a_column_in_rows_is_no_list_of_numbers(tmp_path: Path) -> None:
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(SHEET.partition("  find")[0] + "  find: velocity")
    document = assemble(load_sheet(sheet))
    text = render_json(document)
    assert json_back.read_json(document, text) == ()
    rows = json.loads(text)
    results = rows["problems"][0]["questions"][0]["results"]
    results["v"] = [[entry] for entry in results["v"]]
    with pytest.raises(SheetErrors) as refused:
        json_back.read_json(document, json.dumps(rows))
    assert "v as JSON" in refused.value.errors[0].message


def test_numbers_in_the_json_are_those_that_were_evaluated(tmp_path: Path) -> None:
    document = built(tmp_path)
    text = render_json(document)
    number = json.loads(text)["problems"][0]["questions"][0]["evaluated"]["J"][0][0]
    for planted in (str(-number), f"[{number}]", f'"{number}"'):
        wrong = text.replace(str(number), planted)
        with pytest.raises(SheetErrors) as refused:
            json_back.read_json(document, wrong)
        assert "J in numbers as JSON" in refused.value.errors[0].message


def test_numbers_have_the_shape_of_their_result(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    right = evaluated_again.plain
    monkeypatch.setattr(evaluated_again, "plain", lambda value, *more: [right(value, *more)])
    with pytest.raises(SheetErrors) as refused:
        built(tmp_path)
    assert "the numbers at the point" in refused.value.errors[0].message
