"""The example of every kind, derived again by SymPy."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from derive.audit.asked import Asked
from derive.audit.engine import Audited, audit
from derive.auditing import answers
from derive.build import assemble
from derive.kinds.registry import kinds_of
from derive.render.questions import example_of
from derive.writing import render
from tests.sheets import sheet_from

SUBJECTS = ("motion", "frames")


def asked(text: str) -> Iterator[Asked]:
    """The questions of a sheet and our answers."""
    sheet = sheet_from(text)
    return (found for _, found in answers(sheet, render(assemble(sheet), "json")))


@pytest.mark.parametrize("module", sorted({m for s in SUBJECTS for m in kinds_of(s).values()}))
def test_the_example_is_audited(module: str) -> None:
    outcomes = [audit(each) for each in asked(example_of(module)) if each.subject_name in SUBJECTS]
    assert outcomes
    assert all(isinstance(outcome, Audited) for outcome in outcomes), outcomes
