"""A build that is killed leaves the old set of files or the new one, and the next clears up behind it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from derive.placing import aside, put
from tests.commands import LONGEST, started, until

posix = pytest.mark.skipif(sys.platform == "win32", reason="locks and signals of POSIX")
SLOW = """\
import os, sys, time
from pathlib import Path
from derive import placing
output, replace = Path(sys.argv[1]), os.replace
def slow(*paths):
    time.sleep(0.1)
    replace(*paths)
os.replace = slow
with placing.aside(output) as folder:
    files = [folder / name for name in ("a", "b", "c", "d")]
    for file in files:
        file.write_text("new")
    print("ready", flush=True)
    placing.put(files, folder, output)
"""


def contents(folder: Path) -> list[str]:
    return [(folder / name).read_text() for name in "abcd"]


@posix
@pytest.mark.parametrize("sign", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_a_killed_build_ends_what_it_has_begun(tmp_path: Path, sign: signal.Signals) -> None:
    for name in "abcd":
        (tmp_path / name).write_text("old")
    build = started(
        [sys.executable, "-c", SLOW, tmp_path], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    assert build.stdout is not None
    build.stdout.readline()
    until(lambda: contents(tmp_path)[0] == "new")
    build.send_signal(sign)
    build.wait(LONGEST)
    with aside(tmp_path):  # waits for the moves to end
        assert contents(tmp_path) == ["new"] * 4
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "b", "c", "d"]


@posix
def test_leftovers_of_a_dead_build_are_removed_and_no_others(tmp_path: Path) -> None:
    dead = tmp_path / ".derive-dead"
    dead.mkdir()
    (dead / "page.md").write_text("half a page")
    with aside(tmp_path) as living:
        assert not dead.exists()
        with aside(tmp_path) as other:
            assert living.is_dir()
            assert other != living
    assert not list(tmp_path.iterdir())


def test_nothing_is_moved_where_something_cannot_be(tmp_path: Path) -> None:
    (tmp_path / "b" / "inside").mkdir(parents=True)
    with aside(tmp_path) as folder:
        for name in "ab":
            (folder / name).write_text("new")
        with pytest.raises(OSError, match="b"):
            put([folder / "a", folder / "b"], folder, tmp_path)
    assert not (tmp_path / "a").exists()


def test_a_page_that_failed_takes_its_older_one_along(tmp_path: Path) -> None:
    for name in "ab":
        (tmp_path / name).write_text("old")
    with aside(tmp_path) as folder:
        (folder / "a").write_text("new")
        put([folder / "a"], folder, tmp_path, [folder / "b"])
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("a", "new")]
    assert os.listdir(tmp_path) == ["a"]
