"""Scalars stay as typed, and every value knows its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from derive.errors import SheetErrors
from derive.sheet.reader import read, read_text
from derive.sheet.source import At

TEXT = """\
a: 0.10
b: [1e3, "q:uoted", ~, yes]
c:
  d: |
    first
    second
"""


def test_scalars_stay_as_typed() -> None:
    source = read_text(TEXT, Path("x.yaml"))
    assert source.data == {
        "a": "0.10",
        "b": ["1e3", "q:uoted", None, "yes"],
        "c": {"d": "first\nsecond\n"},
    }


def test_places() -> None:
    at = At(read_text(TEXT, Path("x.yaml")))
    assert str(at.place(("b", 1), 2)) == "x.yaml:2:13"
    assert str(at.key(("c", "d"))) == "x.yaml:4:3"
    assert str(at.place(("c", "d"), 9)) == "x.yaml:6:8"
    assert str(at.place(("c", "nothing"))) == "x.yaml:4:3"
    assert at.place(("a",)).text == "a: 0.10"


@pytest.mark.parametrize(
    "content",
    [
        b"", b"\xff\xfe\x00", b"a: \x01", b"a: " + b"[" * 5000, b"a: !!python/object:os.system x",
        b"a: 1\n---\nb: 2", b"? [1]\n: 2", b"a: &a [*a]", b"x" * 1_000_001,
        b"a: {b: c", b"a: 'b", b"a: @b", b'a: "\\q"', b"%TAG",
    ],
)  # fmt: skip
def test_what_cannot_be_read_is_a_fault(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "sheet.yaml"
    path.write_bytes(content)
    with pytest.raises(SheetErrors) as caught:
        read(path)
    assert all(error.message for error in caught.value.errors)


def test_a_missing_file_is_a_fault(tmp_path: Path) -> None:
    with pytest.raises(SheetErrors):
        read(tmp_path / "nothing.yaml")
