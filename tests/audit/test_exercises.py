"""Every exercise, audited whole; and what an audit costs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from derive.audit.engine import NotAudited
from derive.auditing import Found, audited
from derive.build import assemble
from derive.sheet.load import load_sheet
from tests.sheets import NAMES, ROOT, SHEETS

COST = """
from time import process_time as now
start = now()
import sympy
imported = now()
from pathlib import Path
from derive.auditing import audited
from derive.build import assemble
from derive.sheet.load import load_sheet
sheet = load_sheet(Path("exercises/week6.yaml"))
document = assemble(sheet)
built = now()
audited([sheet], [document], lambda _: None)
print((now() - built) / (imported - start))
"""


def outcomes(path: Path) -> tuple[Found, ...]:
    sheet = load_sheet(path)
    return audited([sheet], [assemble(sheet)], lambda _: None)


@pytest.mark.parametrize("sheet", SHEETS, ids=NAMES)
def test_an_exercise_is_audited(sheet: Path) -> None:
    found = outcomes(sheet)
    assert found
    assert [(str(one.place), one.outcome) for one in found if isinstance(one.outcome, NotAudited)] == []


def test_an_audit_costs_no_more_than_ten_times_the_import_of_sympy() -> None:
    done = subprocess.run([sys.executable, "-c", COST], cwd=ROOT, capture_output=True, text=True, check=True)
    assert float(done.stdout) < 10
