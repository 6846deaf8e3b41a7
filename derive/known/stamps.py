"""Stamps: of each sheet that was built, what it was made of, by what, and what was made.

They lie in the user's folder for such things (`DERIVE_CACHE` names another) and hold digests, no pages. A
sheet is known where all that its stamp says is still true. What cannot be read or written is no stamp.
"""

from __future__ import annotations

import json
import os
import sys
from contextlib import suppress
from hashlib import blake2b
from pathlib import Path
from typing import Any

from derive.errors import Place, SheetError
from derive.known.files import NOTHING, Digests, digest, digests
from derive.known.program import program

MOST = 5_000  # stamps that are kept


def folder() -> Path | None:
    """Where stamps lie; None where there is no such place."""
    if own := os.environ.get("DERIVE_CACHE"):
        return Path(own)
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA", "")
    elif sys.platform == "darwin":
        base = os.path.expanduser("~/Library/Caches")
    else:
        base = os.environ.get("XDG_CACHE_HOME", "")
        base = base if os.path.isabs(base) else os.path.expanduser("~/.cache")
    return Path(base, "derive") if os.path.isabs(base) else None


class Stamps:
    """Those of the sheets that are built into one folder with the same options."""

    def __init__(
        self, place: Path, output: Path, options: str, formats: tuple[str, ...], templates: Path | None
    ) -> None:
        self.place = place
        self.output = output
        self.options = options
        self.formats = formats
        self.templates = templates
        self.made_by = self._made_by()  # now: what is loaded later may be newer, and is held to this

    def known(self, sheet: Path) -> tuple[SheetError, ...] | None:
        """The warnings about a sheet of which nothing has changed, nor of its pages; None for any other."""
        try:
            stamp = _read(self._file(sheet))
            if stamp["by"] != self.made_by or not _still(stamp["read"]):
                return None
            for name, before in stamp["made"]:
                if digest(self.output / name) != before or before == NOTHING:
                    return None
            return tuple(map(_warning, stamp["warnings"]))
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            return None

    def sure(self) -> bool:
        """Whether all that was built was built by what was there at the beginning."""
        return self._made_by() == self.made_by

    def remember(self, sheet: Path, read: Digests, made: Digests, warnings: tuple[SheetError, ...]) -> None:
        """Of a sheet that was built: the files that it was read from and those that were made, by their names
        in the output folder."""
        told = [[each.message, _told(each.place), each.hint] for each in warnings]
        stamp = {"by": self.made_by, "read": read, "made": made, "warnings": told}
        with suppress(OSError, ValueError):
            _write(self._file(sheet), stamp)

    def _file(self, sheet: Path) -> Path:
        """A file for each sheet, as it was typed, with these options and this folder."""
        typed = (os.path.abspath(sheet), str(sheet), os.path.realpath(self.output), self.options)
        return self.place / f"{_digest(json.dumps(typed).encode())}.json"

    def _made_by(self) -> str:
        """The program, and the author's templates."""
        own = () if self.templates is None else sorted(map(str, self.templates.rglob("*")))
        return _digest(json.dumps([program(self.formats), digests(own)]).encode())


def _still(read: list[tuple[str, str]]) -> bool:
    return bool(read) and digests(path for path, _ in read) == tuple((path, held) for path, held in read)


def _told(place: Place | None) -> tuple[str, int, int, str] | None:
    return (place.file, place.line, place.column, place.text) if place else None


def _warning(told: list[Any]) -> SheetError:
    message, place, hint = told
    return SheetError(message, place and Place(*place), hint)


def _digest(content: bytes) -> str:
    return blake2b(content, digest_size=16).hexdigest()


def _read(path: Path) -> Any:
    """What was written there. Raises OSError, ValueError where it is not that."""
    held, _, content = path.read_bytes().partition(b"\n")
    if held.decode("ascii") != _digest(content):
        raise ValueError("this is no stamp")
    return json.loads(content)


def _write(path: Path, stamp: object) -> None:
    """Writes it at once, so that no other process reads half of it. Raises OSError."""
    content = json.dumps(stamp).encode()
    path.parent.mkdir(parents=True, exist_ok=True)
    _make_room(path.parent)
    half = path.with_suffix(f".{os.getpid()}")
    try:
        half.write_bytes(_digest(content).encode() + b"\n" + content)
        os.replace(half, path)
    except OSError:
        half.unlink(missing_ok=True)
        raise


def _make_room(place: Path) -> None:
    """Removes the older half of the stamps where there are too many."""
    stamps = [entry for entry in os.scandir(place) if entry.is_file()]
    if len(stamps) >= MOST:
        for entry in sorted(stamps, key=lambda each: each.stat().st_mtime)[: MOST // 2]:
            os.unlink(entry.path)
