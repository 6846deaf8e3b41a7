"""Every kind asks its question where the author wrote none, on every subject it serves."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.build import assemble
from derive.kinds import registry
from derive.render.questions import example_of
from derive.sheet.load import sheet_of
from derive.sheet.reader import read_text
from derive.sheet.source import At
from derive.sheet.subjects.registry import subjects
from derive.sheet.tex import check_text

KINDS = [(subject, kind) for subject in subjects() for kind in registry.kinds_of(subject)]


@pytest.mark.parametrize(("subject", "kind"), KINDS)
def test_default_question(subject: str, kind: str) -> None:
    example = example_of(registry.module_name(subject, kind))
    document = assemble(sheet_of(At(read_text(example, Path("example.yaml")))), solutions=False)
    for problem, question in document.questions():
        if not problem.text:
            assert question.text.endswith((".", "?"))
            assert check_text(question.text) == question.text
            assert "  " not in question.text
