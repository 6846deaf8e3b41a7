"""The files that a sheet is read from, and what they hold."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from hashlib import blake2b
from pathlib import Path
from stat import S_ISREG
from typing import TypeAlias

Digests: TypeAlias = tuple[tuple[str, str], ...]
"""Paths, each with the digest of what is there."""
Seen: TypeAlias = tuple[int, ...]
"""What the system says of a file; empty where there is none."""
LINK = re.compile(rb"""href\s*=\s*["']\s*([^"']*)""")
NOTHING = ""  # the digest of a file that is not there

_NOTES: ContextVar[dict[str, Seen] | None] = ContextVar("notes", default=None)


def lies_below(path: Path, folder: Path) -> bool:
    """Whether it is in a folder or below it, links followed; they may lead in a circle."""
    return Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))


@contextmanager
def noting() -> Iterator[Mapping[str, Seen]]:
    """The files that are read within, as they were just before."""
    notes: dict[str, Seen] = {}
    token = _NOTES.set(notes)
    try:
        yield notes
    finally:
        _NOTES.reset(token)


def noted(path: Path) -> None:
    """Says that what comes of a sheet depends on this file, before it is read; or on that it is not there."""
    notes = _NOTES.get()
    if notes is not None:
        notes.setdefault(os.path.abspath(path), seen(path))


def seen(path: str | Path) -> Seen:
    """Differs where a file was written in between, whatever was done to its times."""
    try:
        found = os.stat(path)
    except OSError:
        return ()
    return found.st_size, found.st_mtime_ns, found.st_ctime_ns, found.st_ino, found.st_dev


def as_read(notes: Mapping[str, Seen]) -> Digests | None:
    """What the files held when they were read; None where one has changed since, or shows another."""
    found = digests(notes)
    same = all(seen(path) == before for path, before in notes.items())
    return found if same and not any(map(_shows_another, notes)) else None


def _shows_another(path: str) -> bool:
    """Whether it is a picture that refers to other files, of which nothing is known here."""
    if not path.lower().endswith(".svg"):
        return False
    with suppress(OSError):
        return any(not link.startswith((b"#", b"data:")) for link in LINK.findall(Path(path).read_bytes()))
    return False


def digests(paths: Iterable[str]) -> Digests:
    """What each file holds now, and where it stands, links followed."""
    return tuple((path, f"{digest(path)} {os.path.realpath(path)}") for path in paths)


def digest(path: str | Path) -> str:
    """Of what a file holds; a pipe or a device holds nothing, and might never end."""
    try:
        if not S_ISREG(os.stat(path).st_mode):
            return NOTHING
        with open(path, "rb") as file:
            found = blake2b(digest_size=16)
            while part := file.read(1 << 20):
                found.update(part)
    except OSError:
        return NOTHING
    return found.hexdigest()
