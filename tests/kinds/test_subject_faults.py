"""Wrong functions, points and systems of Lagrange: `faults/x.yaml` is reported as `x.txt` says."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.errors import SheetErrors
from derive.messages import written
from derive.sheet.load import load_sheet

CASES = Path(__file__).parent / "faults"


@pytest.mark.parametrize("case", sorted(path.stem for path in CASES.glob("*.yaml")))
def test_report(case: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(CASES)
    with pytest.raises(SheetErrors) as caught:
        load_sheet(Path(f"{case}.yaml"))
    report = [line for error in caught.value.errors for line in written(error).splitlines()]
    assert report == Path(f"{case}.txt").read_text(encoding="utf-8").splitlines()
