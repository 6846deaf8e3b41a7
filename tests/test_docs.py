"""The examples of the language page build."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from derive.build import derive_all
from derive.sheet.load import load_sheet
from derive.writing import render
from tests.sheets import ROOT

PAGE = (ROOT / "docs" / "language.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"^```yaml\n(title:.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("text", EXAMPLES, ids=[text.splitlines()[0] for text in EXAMPLES])
def test_example_builds(text: str, tmp_path: Path) -> None:
    path = tmp_path / "sheet.yaml"
    path.write_text(text, encoding="utf-8")
    (document,) = derive_all([load_sheet(path)], True, lambda _: None)
    assert render(document, "md")
    assert render(document, "tex")
