"""A sheet of which nothing has changed is not derived again; one of which anything has is."""

from __future__ import annotations

import os
import sys
from base64 import b64decode
from collections.abc import Callable
from pathlib import Path

import pytest

from derive import build as pipeline
from derive.known import program, stamps
from tests.commands import SHEET, run

ARM = "links:\n- {theta: theta1*, d: 0, a: L, alpha: 0}\n"
BESIDE = "title: t\nproblems:\n- robot: arm.yaml\n  figure: arm.svg\n  find: dh-table\n"
PICTURE = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><rect width="%d" height="9"/></svg>'
DOT = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
UNCHANGED = "week1.yaml is unchanged\n"


@pytest.fixture
def sheet(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A sheet with files beside it, built once."""
    monkeypatch.setenv("DERIVE_CACHE", str(folder / "cache"))
    (folder / "week1.yaml").write_text(BESIDE)
    (folder / "arm.yaml").write_text(ARM)
    (folder / "arm.svg").write_text(PICTURE % 3)
    (folder / "own" / "words").mkdir(parents=True)
    (folder / "own" / "words" / "_mine.j2").write_text("")
    assert run("week1.yaml", "--format", "md").exit_code == 0
    return folder


def again(*options: str) -> str:
    done = run("week1.yaml", *(options or ("--format", "md")))
    assert done.exit_code == 0, done.output
    return done.stderr


def written(page: Path) -> tuple[int, int]:
    """The file and when it was last written; when it was last read is not asked."""
    stat = page.stat()
    return stat.st_ino, stat.st_mtime_ns


def test_nothing_is_derived_again(sheet: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = sheet / "output" / "week1.md"
    before = written(page)
    monkeypatch.setattr(pipeline, "load_sheet", None)
    assert again() == UNCHANGED
    assert written(page) == before
    assert run("week1.yaml", "--format", "md", "--no-cache").exit_code == 1


def swap(path: Path, old: str, new: str) -> None:
    """Another text of the same size at the same time, by the clock of the file."""
    before = path.stat()
    path.write_text(path.read_text().replace(old, new))
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


CHANGES: dict[str, Callable[[Path], object]] = {
    "sheet": lambda folder: swap(folder / "week1.yaml", "title: t", "title: u"),
    "robot": lambda folder: swap(folder / "arm.yaml", "a: L", "a: M"),
    "picture": lambda folder: swap(folder / "arm.svg", 'width="3"', 'width="4"'),
    "page": lambda folder: swap(folder / "output" / "week1.md", "Problem", "problem"),
    "page gone": lambda folder: (folder / "output" / "week1.md").unlink(),
    "picture gone": lambda folder: (folder / "output" / "week1" / "problem-1-figure.svg").unlink(),
    "link": lambda folder: [(folder / "arm.yaml").rename("b.yaml"), os.symlink("b.yaml", "arm.yaml")],
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_what_has_changed_is_built(sheet: Path, change: Callable[[Path], object]) -> None:
    assert again() == UNCHANGED
    page = (sheet / "output" / "week1.md").read_bytes()
    change(sheet)
    assert again() == "output/week1.md\n"
    assert again() == UNCHANGED
    assert run("week1.yaml", "--format", "md", "--output", "new", "--no-cache").exit_code == 0
    assert (sheet / "output" / "week1.md").read_bytes() == (sheet / "new" / "week1.md").read_bytes()
    assert len(page) == (sheet / "output" / "week1.md").stat().st_size


@pytest.mark.parametrize(
    "options", ["--problems", "--steps answers", "--no-figures", "--templates own", "--output other"]
)
def test_other_options_are_another_build(sheet: Path, options: str) -> None:
    asked = ("--format", "md", *options.split())
    assert UNCHANGED not in again(*asked)
    assert again(*asked) == UNCHANGED


def test_a_sheet_of_this_name_elsewhere_is_another(sheet: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Though it be the same file by a link: what it names stands beside the link."""
    output = str(sheet / "output")
    again("--format", "md", "--output", output)
    (sheet / "else").mkdir()
    (sheet / "else" / "week1.yaml").symlink_to(sheet / "week1.yaml")
    (sheet / "else" / "arm.yaml").write_text(ARM.replace("a: L", "a: M"))
    (sheet / "else" / "arm.svg").write_text(PICTURE % 3)
    monkeypatch.chdir(sheet / "else")
    assert again("--format", "md", "--output", output) == f"{output}/week1.md\n"


def test_templates_are_part_of_it(sheet: Path) -> None:
    asked = ("--format", "md", "--templates", "own")
    again(*asked)
    assert again(*asked) == UNCHANGED
    (sheet / "own" / "words" / "_mine.j2").write_text(" ")
    assert UNCHANGED not in again(*asked)


@pytest.mark.skipif(sys.platform == "win32", reason="there are no named pipes")
def test_a_pipe_among_the_templates_is_not_waited_for(sheet: Path) -> None:
    os.mkfifo(sheet / "own" / "words" / "_pipe.j2")
    assert UNCHANGED not in again("--format", "md", "--templates", "own")


def test_the_program_is_part_of_it(sheet: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "code").mkdir()
    (tmp_path / "code" / "first.py").write_text("a")
    monkeypatch.setattr(program, "HERE", tmp_path / "code")
    assert UNCHANGED not in again()
    assert again() == UNCHANGED
    swap(tmp_path / "code" / "first.py", "a", "b")
    assert UNCHANGED not in again()
    monkeypatch.syspath_prepend(str(tmp_path / "site"))
    (tmp_path / "site" / "numpy-9.dist-info").mkdir(parents=True)
    assert UNCHANGED not in again()


def test_a_file_that_is_changed_while_it_is_built_is_not_known(
    sheet: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    derive = pipeline.assemble

    def slow(*arguments: object) -> object:
        swap(sheet / "arm.yaml", "a: L", "a: M")
        return derive(*arguments)  # type: ignore[arg-type]

    swap(sheet / "week1.yaml", "title: t", "title: u")
    with monkeypatch.context() as patched:
        patched.setattr(pipeline, "assemble", slow)
        assert UNCHANGED not in again()
    assert UNCHANGED not in again()


@pytest.mark.parametrize("spoilt", [b"", b"\n", b"{}", b"\xff\xfe\n[]", None])
def test_a_stamp_that_cannot_be_read_is_none(sheet: Path, spoilt: bytes | None) -> None:
    (stamp,) = (sheet / "cache").iterdir()
    whole = stamp.read_bytes()
    stamp.write_bytes(whole[: len(whole) // 2] if spoilt is None else spoilt)
    assert again() == "output/week1.md\n"
    assert again() == UNCHANGED
    for k in range(0, len(whole), 97):
        stamp.write_bytes(whole[:k] + bytes([whole[k] ^ 1]) + whole[k + 1 :])
        found = stamps.Stamps(stamp.parent, Path("output"), "", (), None)
        with pytest.raises(ValueError):
            stamps._read(found.place / stamp.name)


def test_a_folder_that_cannot_be_written_is_none(sheet: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (sheet / "taken").write_text("")
    monkeypatch.setenv("DERIVE_CACHE", str(sheet / "taken"))
    assert again() == again() == "output/week1.md\n"


def test_warnings_are_told_each_time(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DERIVE_CACHE", str(folder / "cache"))
    (folder / "week1.yaml").write_text(SHEET.replace("problems:", "where: {unused: 1}\nproblems:"))
    first = again()
    assert "warning" in first
    assert again() == first.replace("output/week1.md\n", UNCHANGED)


def test_the_audit_and_the_explanation_are_made_each_time(sheet: Path) -> None:
    for asked in ("--audit", "--explain"):
        assert UNCHANGED not in again("--format", "md", asked)
    assert again() == UNCHANGED


def test_a_picture_that_shows_another_is_drawn_each_time(sheet: Path) -> None:
    (sheet / "dot.png").write_bytes(b64decode(DOT))
    shows = (PICTURE % 3).replace("<rect", '<image href="dot.png" width="9" height="9"/><rect')
    (sheet / "arm.svg").write_text(shows)
    assert again() == again() == "output/week1.md\n"


def test_old_stamps_make_room(sheet: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stamps, "MOST", 4)
    for k in range(9):
        again("--format", "md", "--output", f"at{k}")
    assert len(list((sheet / "cache").iterdir())) <= 4
    assert again("--format", "md", "--output", "at8") == UNCHANGED


def test_every_file_that_is_opened_for_a_sheet_is_noted(tmp_path: Path) -> None:
    """Of the exercises and what stands beside them; a hook sees each file that Python opens."""
    from derive.known.files import noting
    from derive.sheet.load import load_sheet
    from tests.sheets import ROOT

    opened: set[str] | None = set()
    watched = str(ROOT / "exercises")

    def hook(event: str, arguments: tuple[object, ...]) -> None:
        if opened is not None and event == "open" and isinstance(arguments[0], str | os.PathLike):
            opened.add(os.path.abspath(os.fspath(arguments[0])))

    sys.addaudithook(hook)
    beside = 0
    for sheet in sorted(Path(watched).glob("*.yaml")):
        opened.clear()
        with noting() as notes:
            load_sheet(sheet)
        inside = {path for path in opened if path.startswith(watched)}
        assert inside <= notes.keys()
        beside += len(inside) - 1
    assert beside
    opened = None  # a hook stays
