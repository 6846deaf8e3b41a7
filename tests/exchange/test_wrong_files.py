"""Wrong and hostile files: each `cases/x.urdf` (.xacro, .csv) is reported as `cases/x.urdf.txt` says."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.errors import SheetErrors
from derive.messages import written
from derive.sheet.exchange.files import as_yaml

CASES = Path(__file__).parent / "cases"


@pytest.mark.parametrize("case", sorted(path.name for path in CASES.iterdir() if path.suffix != ".txt"))
def test_report(case: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(CASES)
    with pytest.raises(SheetErrors) as caught:
        as_yaml(Path(case))
    report = [line for error in caught.value.errors for line in written(error).splitlines()]
    assert report == Path(f"{case}.txt").read_text(encoding="utf-8").splitlines()


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("<robot>" + "<a>" * 10_000, "too much is nested"),
        ("<robot>" + "<link name='a'/>" * 60_000, "too much is nested or repeated"),
        ("<robot>" + " " * 5_000_001, "larger than 5 MB"),
        ("\0", "no XML"),
        ("", "no XML"),
    ],
    ids=["deep", "many", "large", "binary", "empty"],
)
def test_what_is_too_much_is_refused(text: str, fault: str, tmp_path: Path) -> None:
    (tmp_path / "arm.urdf").write_text(text)
    with pytest.raises(SheetErrors) as caught:
        as_yaml(tmp_path / "arm.urdf")
    assert fault in str(caught.value)
