"""The sheet as PDF: by Typst from plain pip, or by a TeX installation where there is one."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from shutil import which
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from derive.render.document import Document
from derive.render.failures import NoGlyphs, PdfFailed
from derive.render.page import render_typst
from derive.render.plain_text import typographic
from derive.render.printed import Reader, unread
from derive.render.skin import english

if TYPE_CHECKING:
    from typst import Compiler

TIMESTAMP = 0  # the same sheet makes the same bytes
LATEX_MODES = ["-interaction=nonstopmode", "-halt-on-error", "-file-line-error"]
# The first that is installed is used; each is told to run no shell.
LATEX_ENGINES = {
    "latexmk": ["latexmk", "-pdf", "-no-shell-escape", *LATEX_MODES],
    "pdflatex": ["pdflatex", "-no-shell-escape", *LATEX_MODES],
    "lualatex": ["lualatex", "--no-shell-escape", *LATEX_MODES],
    "tectonic": ["tectonic", "--untrusted"],
}

NO_GLYPH = re.compile(r'the text `"(.+?)"` could not be displayed')


PAPERS = {"a4": "a4", "letter": "us-letter"}  # as Typst calls them


def metadata(document: Document) -> dict[str, str]:
    """What a page template prints outside the body."""
    total = f"{document.marks} {english('marks')}" if document.marks and document.solutions else ""
    byline = " · ".join(filter(None, (document.course, document.author, document.date, total)))
    return {
        "title": typographic(document.title), "author": document.author, "byline": byline,
        "lang": document.language,
        "course": typographic(document.course), "paper": PAPERS[document.paper],
    }  # fmt: skip


@contextmanager
def typesetting(document: Document, folder: Path, read: Reader = unread) -> Iterator[Future[bytes]]:
    """The PDF, which Typst makes while other pages are written; pictures are found relative to the folder.

    Raises what `read` raises; its result raises PdfFailed. It has come to an end when this has: nothing is
    put in its place, which forks, while a thread is at work.
    """
    source = render_typst(document, read).encode()
    with ThreadPoolExecutor(1) as beside:
        yield beside.submit(_typeset, source, folder, metadata(document))


def _typeset(source: bytes, folder: Path, values: dict[str, str]) -> bytes:
    from typst import TypstError

    try:
        # Plain texts go in as values, so that nothing in them is read as Typst. Held to PDF/UA, it refuses a
        # formula or a figure that is not told in words; held to PDF/A, letters that no font has.
        page = compiler().compile(
            input=source, format="pdf", root=folder, sys_inputs=values,
            pdf_standards=["ua-1", "a-2a"], timestamp=TIMESTAMP,
        )  # fmt: skip
    except TypstError as error:
        if missing := NO_GLYPH.findall(error.diagnostic):
            raise NoGlyphs("".join(dict.fromkeys("".join(missing)))) from error
        raise PdfFailed("\n".join((error.message, *error.hints))) from error
    return page if isinstance(page, bytes) else b"".join(page or ())


@cache
def compiler() -> Compiler:
    """Typst with its fonts read, one for all the pages of a process."""
    from typst import Compiler

    return Compiler(ignore_system_fonts=True)


def write_pdf_with_latex(source: Path, target: Path) -> None:
    """Compiles a `.tex` file with the TeX installation found. Raises PdfFailed."""
    engine = next((name for name in LATEX_ENGINES if which(name)), None)
    if engine is None:
        hint = "leave --pdf-engine out to do without a TeX installation"
        raise PdfFailed(f"no TeX installation found (looked for {', '.join(LATEX_ENGINES)})", hint)
    with TemporaryDirectory() as folder:
        flag = "--outdir" if engine == "tectonic" else "-output-directory"
        command = [*LATEX_ENGINES[engine], f"{flag}={folder}", source.name]
        done = subprocess.run(command, cwd=source.parent, capture_output=True, text=True, check=False)
        made = Path(folder) / f"{source.stem}.pdf"
        if done.returncode or not made.exists():
            raise PdfFailed(_complaint(done.stdout + done.stderr))
        target.write_bytes(made.read_bytes())


def _complaint(log: str) -> str:
    """The lines of a TeX log that say what is wrong."""
    told = [line for line in log.splitlines() if line.startswith("!") or ".tex:" in line]
    return "\n".join(told[:10]) or log[-2000:]
