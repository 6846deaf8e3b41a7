"""Files that a sheet names: what is wrong with one, whatever stands at its path."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from derive.known.files import noted


def missing(path: Path, typed: str, what: str) -> str:
    """What is wrong with a path at which an ordinary file is wanted, empty where there is one. What comes of
    the sheet depends on it in any case."""
    noted(path)
    if os.path.isfile(path):
        return ""
    return f"{typed} is no ordinary file" if os.path.lexists(path) else f"there is no {what} {typed}"


def neighbours(path: Path, folder: Path, endings: tuple[str, ...]) -> list[str]:
    """The files beside it that end so, as a sheet names them; none where their folder cannot be read."""
    with suppress(OSError):
        files = (file for file in path.parent.iterdir() if file.suffix in endings and os.path.isfile(file))
        return sorted(str(file.relative_to(folder)) for file in files)
    return []
