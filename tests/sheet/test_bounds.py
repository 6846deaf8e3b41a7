"""Sheets of a megabyte: refused before the work is done, and no close match for each of many keys."""

from __future__ import annotations

from difflib import get_close_matches
from pathlib import Path
from typing import Any

import pytest

from derive.errors import SheetErrors
from derive.sheet import faults
from derive.sheet.load import load_sheet

MOTION = "- motion: [{rotate: x, by: a}]\n"
FIND = "  find: transform\n"
KEYS = "".join(f"  k{k}: 1\n" for k in range(19_000))
MOST_SEARCHES = 300  # for close matches; one for each of the 19,000 keys took 20 s


@pytest.mark.parametrize(
    ("sheet", "count"),
    [
        (KEYS.replace("  k", "k") + "title: t\nproblems: []\n", 101),
        (f"title: t\nproblems:\n{MOTION}{FIND}{KEYS}", 101),
        (f"title: t\nproblems:\n{MOTION}  questions: [{{find: transform}}]\n{KEYS}", 101),
        (f"title: t\nproblems:\n{MOTION}{KEYS}", 1),
        (f"title: t\nproblems:\n- nothing: 1\n{KEYS}", 1),
        ("title: t\nproblems: [" + "{}," * 300_000 + "{}]\n", 1),
        ("title: t\nproblems:\n" + (MOTION + FIND) * 4_000, 1),
        (f"title: t\nproblems:\n{MOTION}{FIND}  evaluate:\n" + KEYS.replace("  k", "    k"), 1),
        ("title: t\nwhere:\n" + KEYS + f"problems:\n{MOTION}{FIND}", 1),
    ],
)
def test_many_of_something(sheet: str, count: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "x.yaml"
    path.write_text(sheet, encoding="utf-8")
    searched: list[str] = []

    def close(word: str, *rest: Any, **more: Any) -> list[str]:
        searched.append(word)
        return get_close_matches(word, *rest, **more)

    monkeypatch.setattr(faults, "get_close_matches", close)
    with pytest.raises(SheetErrors) as caught:
        load_sheet(path)
    assert len(searched) <= MOST_SEARCHES
    assert len(caught.value.errors) == count


def test_a_sheet_may_have_four_hundred_problems(tmp_path: Path) -> None:
    path = tmp_path / "x.yaml"
    path.write_text("title: t\nproblems:\n" + (MOTION + FIND) * 400, encoding="utf-8")
    assert len(load_sheet(path).problems) == 400


def test_too_many_problems_are_counted(tmp_path: Path) -> None:
    path = tmp_path / "x.yaml"
    path.write_text("title: t\nproblems:\n" + (MOTION + FIND) * 1_001, encoding="utf-8")
    with pytest.raises(SheetErrors) as caught:
        load_sheet(path)
    assert [error.message for error in caught.value.errors] == ["at most 1000 can stand here, not 1001"]
