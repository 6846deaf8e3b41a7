"""Files made aside, then put in their place at once: a build that is killed leaves the old ones or the new.

Each build has a folder of its own in the output folder and holds a lock on it while it lives, so that the
next build can tell the leftovers of a dead one. Where there are no such locks (Windows) they are left alone.
"""

from __future__ import annotations

import os
import re
import signal
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from errno import EISDIR
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp

from derive.errors import SheetError

PREFIX = ".derive-"
POSIX = sys.platform != "win32"
ODD = re.compile(r"[^\w.-]+")
NAMESAKES = "rename one, or build them into different folders with --output"


def folder_name(name: str) -> str:
    """The folder of pictures beside a page: a name that links and LaTeX take as it is."""
    return ODD.sub("-", name)


def namesakes(paths: Sequence[Path]) -> list[SheetError]:
    """Sheets whose pages would take each other's place."""
    first: dict[str, Path] = {}
    return [
        SheetError(f"{path}: its pages would have the names of those of {other}", None, NAMESAKES)
        for path in paths
        if (other := first.setdefault(folder_name(path.stem), path)) != path
    ]


@dataclass(frozen=True, slots=True)
class Made:
    """What was made of one sheet, in a folder aside: its pages, the files beside them, and the pages that
    could not be made, with the reasons."""

    pages: tuple[Path, ...] = ()
    beside: tuple[Path, ...] = ()
    failed: tuple[Path, ...] = ()
    faults: tuple[SheetError, ...] = ()


@contextmanager
def aside(output: Path) -> Iterator[Path]:
    """A folder in `output` for the files of one build, gone when it ends. Leftovers of dead builds go
    too, and so do the folders that were made for it and stay empty."""
    new = [folder for folder in (output, *output.parents) if not folder.exists()]
    output.mkdir(parents=True, exist_ok=True)
    with _held(output):
        _sweep(output)
        folder = Path(mkdtemp(dir=output, prefix=PREFIX))
        lock = _lock(folder)
    try:
        yield folder
    finally:
        rmtree(folder, ignore_errors=True)
        _release(lock)
        with suppress(OSError):  # something stands in it
            for empty in new:
                empty.rmdir()


def put_all(made: Sequence[Made], folder: Path, output: Path) -> tuple[Path, ...]:
    """Puts what was made in its place, and removes older pages that failed. Raises OSError."""
    if not any(each.pages for each in made):
        return ()
    files = [
        *(path for each in made for path in each.beside),
        *(path for each in made for path in each.pages),
    ]
    return put(files, folder, output, [page for each in made for page in each.failed])


def put(files: Sequence[Path], folder: Path, output: Path, gone: Sequence[Path] = ()) -> tuple[Path, ...]:
    """Moves files from `folder` to the same places in `output`, and removes those that are `gone` there.

    Raises OSError before anything is moved where one cannot be.
    """
    moves = [(path, output / path.relative_to(folder)) for path in files]
    if taken := next((target for _, target in moves if target.is_dir()), None):
        raise OSError(EISDIR, os.strerror(EISDIR), str(taken))
    for parent in {target.parent: None for _, target in moves}:
        parent.mkdir(parents=True, exist_ok=True)
    with _held(output), _uninterrupted():
        _move(moves, [output / path.relative_to(folder) for path in gone])
    return tuple(target for _, target in moves)


def _move(moves: Sequence[tuple[Path, Path]], gone: Sequence[Path]) -> None:
    """All moves in a process apart, which ends its work though this one be killed. Raises OSError."""
    if not POSIX:
        _rename(moves, gone)
        return
    child = os.fork()
    if child == 0:
        code = 0
        try:
            os.setsid()
            _rename(moves, gone)
        except OSError as error:
            code = error.errno or 1
        finally:
            os._exit(code)
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if code:
        raise OSError(code, os.strerror(code), str(moves[0][1].parent))


def _rename(moves: Sequence[tuple[Path, Path]], gone: Sequence[Path]) -> None:
    for path, target in moves:
        os.replace(path, target)
    for target in gone:
        target.unlink(missing_ok=True)


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Ctrl-C and a request to end wait until this is done."""
    if not POSIX:
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM, signal.SIGHUP))
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


# -- locks ---------------------------------------------------------------------------------------------


@contextmanager
def _held(folder: Path) -> Iterator[None]:
    """One build at a time puts files into a folder."""
    lock = _lock(folder)
    try:
        yield
    finally:
        _release(lock)


def _lock(folder: Path, wait: bool = True) -> int | None:
    """A lock on a folder, for as long as this process lives; None where none can be had."""
    if sys.platform == "win32":
        return None
    from fcntl import LOCK_EX, LOCK_NB, flock

    handle = os.open(folder, os.O_RDONLY)
    try:
        flock(handle, LOCK_EX if wait else LOCK_EX | LOCK_NB)
    except OSError:  # held by another, or a file system without locks
        os.close(handle)
        return None
    return handle


def _release(lock: int | None) -> None:
    if lock is not None:
        os.close(lock)


def _sweep(output: Path) -> None:
    """Removes what dead builds left behind; that of a live one is locked."""
    for left in output.glob(f"{PREFIX}*"):
        if left.is_dir() and not left.is_symlink() and (lock := _lock(left, wait=False)) is not None:
            rmtree(left, ignore_errors=True)
            _release(lock)
