"""The example of every kind, derived again by SymPy."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from derive.audit import subjects
from derive.audit.asked import Asked
from derive.audit.engine import Audited, audit
from derive.auditing import answers
from derive.build import assemble
from derive.kinds.registry import kinds_of
from derive.render.questions import example_of
from derive.sheet.load import load_sheet
from derive.writing import render

SUBJECTS = sorted(path.stem for path in Path(subjects.__path__[0]).glob("[!_]*"))


def asked(text: str, folder: Path) -> Iterator[Asked]:
    """The questions of a sheet and our answers."""
    path = folder / "sheet.yaml"
    path.write_text(text, encoding="utf-8")
    sheet = load_sheet(path)
    return (found for _, found in answers(sheet, render(assemble(sheet), "json")))


@pytest.mark.parametrize("module", sorted({m for s in SUBJECTS for m in kinds_of(s).values()}))
def test_the_example_is_audited(module: str, tmp_path: Path) -> None:
    outcomes = [audit(each) for each in asked(example_of(module), tmp_path) if each.subject_name in SUBJECTS]
    assert outcomes
    assert all(isinstance(one, Audited) for one in outcomes), outcomes
