"""The sheet as a docx: pandoc's, with equations written by us and the styles of `templates/docx`."""

from __future__ import annotations

import json
import re
import struct
from functools import cache
from io import BytesIO
from os import pathsep
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo
from zlib import crc32

from derive.render.author_pictures import DENSITY, drawn
from derive.render.document import Document
from derive.render.figures import draw
from derive.render.page import render_for_pandoc
from derive.render.pandoc import pandoc, pandoc_from_tree
from derive.render.plain_text import typographic
from derive.render.printed import Reader, unread
from derive.render.skin import Dressing, environment
from derive.render.word_tree import in_word

TABLE = re.compile(rb'(?<=<w:tblStyle w:val="Table" />)(<w:tblW [^>]*/>)')
CENTRE = rb'\1<w:jc w:val="center"/>'
WHOLE = re.compile(rb'<w:tbl><w:tblPr><w:tblStyle w:val="Table" />.*?</w:tbl>', re.DOTALL)
ROW, MOST_ROWS = b"</w:tr>", 12  # of a table that stands on one page
CELL, KEPT = b'<w:pStyle w:val="Compact" />', b'<w:pStyle w:val="Compact" /><w:keepNext/>'
PARTS = {  # of the document whose styles and footer are taken, and where they are kept
    "[Content_Types].xml": "content-types.xml", "_rels/.rels": "package.rels",
    "word/document.xml": "document.xml", "word/_rels/document.xml.rels": "document.rels",
    "word/styles.xml": "styles.xml", "word/footer.xml": "footer.xml",
}  # fmt: skip

SIZES = {"a4": 'w:w="11906" w:h="16838"', "letter": 'w:w="12240" w:h="15840"'}  # twentieths of a point


def write_docx(document: Document, target: Path, read: Reader = unread) -> None:
    """Writes a docx; its equations are native ones, its plots are drawn as PNG. Raises PandocFailed, and what
    `read` raises."""
    markdown = render_for_pandoc(document, read)
    with TemporaryDirectory() as folder:
        for path, plot in document.plots().items():
            for picture in draw(plot, Path(folder, path), ("png",)):
                picture.write_bytes(with_density(picture.read_bytes()))
            markdown = markdown.replace(f"{path}.svg", f"{path}.png")
        for path in document.pictures():
            if path.endswith(".svg"):
                Path(folder, path).parent.mkdir(exist_ok=True)
                Path(folder, path).with_suffix(".png").write_bytes(with_density(drawn(target.parent / path)))
                markdown = markdown.replace(path, f"{path.removesuffix('.svg')}.png")
        styles = Path(folder, "styles.docx")
        styles.write_bytes(_reference(document.paper))
        arguments = [f"--reference-doc={styles}", f"--resource-path={folder}{pathsep}{target.parent}"]
        tree = json.loads(pandoc(markdown, "json", ["--shift-heading-level-by=-1"], _metadata(document)))
        tree["blocks"] = [*in_word(tree["blocks"])]
        target.write_bytes(_centred(pandoc_from_tree(json.dumps(tree), "docx", arguments)))


def _metadata(document: Document) -> dict[str, str]:
    return {
        "title": typographic(document.title), "subtitle": document.course, "author": document.author,
        "date": document.date, "lang": document.language,
    }  # fmt: skip


def _reference(paper: str) -> bytes:
    """A document of no pages that has our styles, its paper and our footer."""
    return _made_of(paper, environment())


@cache
def _made_of(paper: str, templates: Dressing) -> bytes:
    file = BytesIO()
    with ZipFile(file, "w", ZIP_DEFLATED) as archive:
        for name, kept in PARTS.items():
            part = templates.text(f"docx/{kept}")
            archive.writestr(ZipInfo(name), part.replace(SIZES["a4"], SIZES[paper]))
    return file.getvalue()


def _centred(docx: bytes) -> bytes:
    """The document with its tables in the middle, which LibreOffice does not take from their style, the short
    ones on one page."""
    made = BytesIO()
    with ZipFile(BytesIO(docx)) as archive, ZipFile(made, "w", ZIP_DEFLATED) as centred:
        for name in archive.namelist():
            part = archive.read(name)
            if name == "word/document.xml":
                part = TABLE.sub(CENTRE, WHOLE.sub(_on_one_page, part))
            centred.writestr(ZipInfo(name), part)
    return made.getvalue()


def _on_one_page(table: re.Match[bytes]) -> bytes:
    """A short table with every row kept with the next."""
    *rows, last, end = table[0].split(ROW)
    if len(rows) >= MOST_ROWS:
        return table[0]
    return ROW.join((*(row.replace(CELL, KEPT) for row in rows), last, end))


def with_density(png: bytes, density: float = DENSITY) -> bytes:
    """A PNG that says how many pixels an inch has, which gives it its size on the page (its chunk `pHYs`)."""
    metre = round(density / 0.0254)
    chunk = b"pHYs" + struct.pack(">IIB", metre, metre, 1)
    size = 8 + 25  # the signature and the head
    return png[:size] + struct.pack(">I", 9) + chunk + struct.pack(">I", crc32(chunk)) + png[size:]
