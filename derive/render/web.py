"""The sheet as one HTML file, its mathematics as MathML."""

from __future__ import annotations

import re
from base64 import b64encode
from functools import cache
from pathlib import Path

from derive.render.document import Document
from derive.render.page import render_html
from derive.render.pdf import metadata
from derive.render.printed import Reader, unread
from derive.render.skin import environment, templates

PICTURE = re.compile(r'<img src="([^"]+)"')
KINDS = {".svg": "image/svg+xml", ".png": "image/png", ".jpg": "image/jpeg", ".jpeg": "image/jpeg"}


def write_html(document: Document, target: Path, read: Reader = unread) -> None:
    """Writes one self-contained file: pictures, style and the font of its mathematics inside. Pictures are
    found relative to the folder of `target`. Raises what `read` raises."""
    ours = {f"{path}.svg" for path in document.plots()}

    def picture(found: re.Match[str]) -> str:
        path = target.parent / found[1]
        data = b64encode(path.read_bytes()).decode()
        kind = ' class="drawn"' if found[1] in ours else ""
        return f'<img{kind} src="data:{KINDS[path.suffix.lower()]};base64,{data}"'

    body = PICTURE.sub(picture, render_html(document, read))
    said = metadata(document)
    page = (
        environment()
        .get_template("html/sheet.j2")
        .render(document=document, body=body, title=said["title"], byline=said["byline"], font=_font())
    )
    target.write_text(page, encoding="utf-8")


@cache
def _font() -> str:
    """The font of mathematics, for a style sheet."""
    return b64encode((templates() / "html" / "mathematics.woff").read_bytes()).decode()
