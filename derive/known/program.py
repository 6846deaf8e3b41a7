"""What reads sheets and makes pages: the code and the templates, and what else is installed beside them."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from hashlib import blake2b
from importlib.util import find_spec
from pathlib import Path
from shutil import which

from derive.known.files import seen

HERE = Path(__file__).resolve().parent.parent
KINDS = "[derive.kinds]"  # other packages bring kinds by entry points of this group
WRITES = {"docx": "pandoc"}  # pages that a program of the system may write


def program(formats: tuple[str, ...]) -> str:
    """A digest that another version of the code has not, nor one with other packages around it."""
    found = blake2b(digest_size=16)
    for part in _parts(formats):
        found.update(os.fsencode(part) + b"\0")
    return found.hexdigest()


def _parts(formats: tuple[str, ...]) -> Iterator[str]:
    yield sys.version
    for folder in (HERE, HERE.parent / "templates"):
        yield from _files(str(folder))
    for entry in sys.path:
        try:
            inside = sorted(name for name in os.listdir(entry or ".") if name.endswith("-info"))
        except OSError:
            continue
        yield from (entry, *inside) if inside else ()
        for each in inside:
            yield from _kinds(Path(entry, each, "entry_points.txt"))
    for each in formats:
        if (name := WRITES.get(each)) and (where := which(name)):
            yield f"{where} {seen(where)} {os.environ.get('PYPANDOC_PANDOC')}"


def _kinds(path: Path) -> Iterator[str]:
    """The files of the packages whose kinds a distribution brings."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, ValueError):
        return
    if KINDS not in text:
        return
    for line in text.partition(KINDS)[2].partition("[")[0].splitlines():
        package = line.partition("=")[2].strip().partition(".")[0].partition(":")[0]
        spec = find_spec(package) if package.isidentifier() else None
        for folder in spec.submodule_search_locations or () if spec else ():
            yield from _files(folder)


def _files(folder: str) -> Iterator[str]:
    """Every file in a folder, with what says that it was written anew."""
    try:
        entries = sorted(os.scandir(folder), key=lambda entry: entry.name)
    except OSError:
        return
    for entry in entries:
        if entry.is_dir():
            if entry.name != "__pycache__":
                yield from _files(entry.path)
        else:
            yield f"{entry.path} {seen(entry.path)}"
