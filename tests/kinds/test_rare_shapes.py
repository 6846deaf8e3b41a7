"""Shapes of problems that no exercise has: their words say all that they are given, and nothing else."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from derive.build import derive_all
from derive.read_back import read_back
from derive.render.page import render_markdown
from derive.sheet.load import load_sheet

RARE = Path(__file__).with_name("rare.yaml")
PROBLEMS = YAML(typ="safe").load(RARE)["problems"]


@pytest.mark.parametrize("problem", PROBLEMS, ids=[problem["find"] for problem in PROBLEMS])
def test_the_page_is_written(problem: dict[str, Any], tmp_path: Path) -> None:
    sheet = tmp_path / "sheet.yaml"
    sheet.write_text(json.dumps({"title": "x", "problems": [problem]}), encoding="utf-8")
    (document,) = derive_all([load_sheet(sheet)], True, lambda _: None)
    assert "Verified" in render_markdown(document, read=read_back)
