"""What a page is made of, watched."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from derive.known.files import lies_below
from derive.sheet.exchange.files import ENDINGS

TEXTS = (".yaml", ".yml", *ENDINGS)
SOON = 50  # milliseconds, after which it is told that they are watched
PICTURES = (".png", ".jpg", ".jpeg", ".svg")


def saves(sheet: Path, templates: Path | None = None, output: Path | None = None) -> Iterator[None]:
    """Tells once they are watched, and whenever the sheet, a file of its folder that it may be made of, or a
    template is saved; pictures that are written to `output` are none of them. Raises OSError where the folder
    cannot be watched.
    """
    from watchfiles import watch

    told = False
    watched = filter(None, [sheet.parent, templates])
    for changed in watch(*watched, rust_timeout=SOON, yield_on_timeout=True):
        if not told or any(is_source(Path(path), templates, output) for _, path in changed):
            told = True
            yield


def is_source(path: Path, templates: Path | None = None, output: Path | None = None) -> bool:
    """Whether a page may be made of it."""
    if templates is not None and _inside(path, templates):
        return True
    ours = output is not None and _inside(path, output)
    return path.suffix.lower() in (TEXTS if ours else TEXTS + PICTURES)


def _inside(path: Path, folder: Path) -> bool:
    return lies_below(path, folder)
