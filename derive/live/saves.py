"""What a page is made of, watched."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from derive.sheet.exchange.files import ENDINGS

SOURCES = (".yaml", ".yml", *ENDINGS, ".png", ".jpg", ".jpeg", ".svg")


def saves(sheet: Path, templates: Path | None = None, output: Path | None = None) -> Iterator[None]:
    """Tells whenever the sheet, a file of its folder that it may be made of, or a template is saved; what is
    written to `output` is none of them. Ends with Ctrl-C. Raises OSError where the folder cannot be watched.
    """
    from watchfiles import watch

    for changed in watch(sheet.parent, *filter(None, [templates]), raise_interrupt=False):
        if any(is_source(Path(path), templates, output) for _, path in changed):
            yield


def is_source(path: Path, templates: Path | None = None, output: Path | None = None) -> bool:
    """Whether a page may be made of it."""
    if templates is not None and _inside(path, templates):
        return True
    return path.suffix.lower() in SOURCES and (output is None or not _inside(path, output))


def _inside(path: Path, folder: Path) -> bool:
    return path.resolve().is_relative_to(folder.resolve())
