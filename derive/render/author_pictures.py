"""Pictures of authors, which every format must hold: PNG, JPEG, and SVG drawn anew where it must be."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

FORMATS = {".png": "png", ".jpg": "jpg", ".jpeg": "jpg", ".svg": "svg"}  # suffix -> what must be inside
MOST_BYTES = 20_000_000
PAGE = """\
#set page(width: auto, height: auto, margin: 0pt, fill: none)
#image(sys.inputs.name, format: sys.inputs.format)
"""
DENSITY = 200.0  # pixels an inch
Drawn = Literal["pdf", "png"]


class NoPicture(Exception):
    """A file that no page could show; the message says why."""


def drawn(picture: Path, kind: Drawn = "png") -> bytes:
    """The picture alone on a page of its size, the same bytes each time. Raises NoPicture."""
    wanted = FORMATS.get(picture.suffix.lower())
    if wanted is None:
        raise NoPicture(f"it ends in {picture.suffix or 'nothing'}, not in {', '.join(FORMATS)}")
    if picture.stat().st_size > MOST_BYTES:
        raise NoPicture(f"it is larger than {MOST_BYTES // 1_000_000} MB")
    from typst import Compiler, TypstError

    names = {"name": picture.name, "format": wanted}
    try:
        compiler = Compiler(PAGE.encode(), picture.parent, ignore_system_fonts=True, sys_inputs=names)
        page = compiler.compile(format=kind, ppi=DENSITY, timestamp=0)
    except TypstError as error:
        raise NoPicture(error.message) from error
    return page if isinstance(page, bytes) else b"".join(page or ())
