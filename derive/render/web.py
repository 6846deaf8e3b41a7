"""The sheet as one HTML file with MathML, and as a docx, both from the Markdown."""

from __future__ import annotations

import re
from os import pathsep
from pathlib import Path
from tempfile import TemporaryDirectory

from derive.render.author_pictures import drawn
from derive.render.document import Document
from derive.render.figures import draw
from derive.render.page import render_markdown
from derive.render.pandoc import pandoc
from derive.render.pdf import metadata
from derive.render.printed import Reader, unread
from derive.render.skin import templates

CELL = re.compile(r"<mtd\b[^>]*>")
THIN = '<mspace width="0.17em"></mspace>'
LETTER = r"m(?:i|n|sub|sup|subsup|over)"
AFTER_FUNCTION = re.compile(rf"<mo>\u2061</mo>(?:</mrow>)?(?=<{LETTER}>)")
BEFORE_FUNCTION = re.compile(
    rf"</{LETTER}>(?=(?:<mrow>|<msup>)*<mi[^>]*>[a-z]+[a-z0-9]+</mi>(?:<mn>\d+</mn></msup>)?<mo>\u2061)"
)


def write_html(document: Document, target: Path, read: Reader = unread) -> None:
    """Writes one self-contained file, pictures and style inside. Pictures are found relative to the folder of
    `target`. Raises PandocFailed, and what `read` raises."""
    template = templates() / "html" / "sheet.html"
    arguments = [
        f"--template={template}", "--mathml", "--embed-resources", "--shift-heading-level-by=-1",
        f"--resource-path={target.parent}",
    ]  # fmt: skip
    markdown = render_markdown(document, False, read)
    page = pandoc(markdown, "html5", arguments, metadata(document)).decode()
    target.write_text(mended(page), encoding="utf-8")


def mended(page: str) -> str:
    """Pandoc's MathML as browsers space and centre it: they give a function's name no room and leave the
    cells of a matrix to the left unless each is one box of its own."""
    wrapped = CELL.sub(r"\g<0><mrow>", page).replace("</mtd>", "</mrow></mtd>")
    return BEFORE_FUNCTION.sub(rf"\g<0>{THIN}", AFTER_FUNCTION.sub(rf"\g<0>{THIN}", wrapped))


def write_docx(document: Document, target: Path, read: Reader = unread) -> None:
    """Writes a docx; its equations are native ones, its plots are drawn as PNG. Raises PandocFailed, and what
    `read` raises."""
    markdown = render_markdown(document, False, read)
    with TemporaryDirectory() as folder:
        for path, plot in document.plots().items():
            draw(plot, Path(folder, path), ("png",))
            markdown = markdown.replace(f"{path}.svg", f"{path}.png")
        for path in document.pictures():
            if path.endswith(".svg"):
                Path(folder, path).parent.mkdir(exist_ok=True)
                Path(folder, path).with_suffix(".png").write_bytes(drawn(target.parent / path))
                markdown = markdown.replace(path, f"{path.removesuffix('.svg')}.png")
        found = f"--resource-path={folder}{pathsep}{target.parent}"
        arguments = ["--shift-heading-level-by=-1", found]
        target.write_bytes(pandoc(markdown, "docx", arguments, metadata(document)))
