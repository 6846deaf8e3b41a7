"""Pages on the disk: every format of a document, and the pictures and files beside it."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from shutil import copyfile
from tempfile import TemporaryDirectory

from derive.errors import SheetError, SheetErrors
from derive.render.document import Document
from derive.sheet.model import Sheet

Progress = Callable[[str], None]
TEXT_FORMATS = ("md", "tex", "json")


def render(document: Document, kind: str) -> str:
    """The page as text, in one of the text formats."""
    if kind == "json":
        from derive.render.json_result import render_json

        return render_json(document)
    from derive.render.page import render_latex, render_markdown

    return render_latex(document) if kind == "tex" else render_markdown(document)


def write(
    sheets: Sequence[Sheet],
    documents: Sequence[Document],
    formats: Sequence[str],
    output: Path,
    pdf_engine: str,
    progress: Progress,
) -> tuple[Path, ...]:
    """Writes pages and pictures: all are made aside, then each is put in its place at once.

    Raises SheetErrors, with nothing written, where a page cannot be made into a PDF.
    """
    output.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(dir=output, prefix=".derive-") as folder:
        aside = Path(folder)
        pages = []
        for sheet, document in zip(sheets, documents, strict=True):
            progress(f"writing {sheet.path.stem}")
            if set(formats) - {"json"}:
                _place(sheet, document, aside, _picture_kinds(formats, pdf_engine))
            for kind in formats:
                pages.append(aside / f"{document.figures}.{kind}")
                _make(document, kind, pages[-1], pdf_engine)
        pictures = [path for path in sorted(aside.glob("*/**/*")) if path.is_file()]
        return tuple(_put(path, aside, output) for path in (*pictures, *pages))


def _picture_kinds(formats: Sequence[str], pdf_engine: str) -> tuple[str, ...]:
    """What plots are drawn as for these pages; a docx draws its own."""
    latex = "tex" in formats or ("pdf" in formats and pdf_engine == "latex")
    web = {"md", "html"} & {*formats} or ("pdf" in formats and pdf_engine != "latex")
    return (*(["svg"] if web else []), *(["pdf"] if latex else []))


def _place(sheet: Sheet, document: Document, folder: Path, kinds: tuple[str, ...]) -> None:
    """Everything a page refers to, beside it."""
    for path, text in document.files().items():
        (folder / path).parent.mkdir(exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")
    for problem in sheet.problems:
        if isinstance(problem.figure, Path):
            (folder / document.figures).mkdir(exist_ok=True)
            copyfile(problem.figure, folder / document.figures / problem.figure.name)
    if kinds and (plots := document.plots()):
        from derive.render.figures import draw

        for path, plot in plots.items():
            draw(plot, folder / path, kinds)


def _make(document: Document, kind: str, target: Path, pdf_engine: str) -> None:
    if kind in TEXT_FORMATS:
        target.write_text(render(document, kind), encoding="utf-8")
    elif kind == "pdf" and pdf_engine == "latex":
        _typeset(document, target)
    elif kind == "pdf":
        from derive.render.pdf import write_pdf

        write_pdf(document, target)
    else:
        from derive.render import web

        (web.write_html if kind == "html" else web.write_docx)(document, target)


def _typeset(document: Document, target: Path) -> None:
    from derive.render.pdf import PdfFailed, write_pdf_with_latex

    source = target.with_suffix(".tex")
    source.write_text(render(document, "tex"), encoding="utf-8")
    try:
        write_pdf_with_latex(source, target)
    except PdfFailed as error:
        hint = "leave --pdf-engine out to do without a TeX installation"
        raise SheetErrors([SheetError(str(error), None, hint)]) from error


def _put(path: Path, aside: Path, output: Path) -> Path:
    target = output / path.relative_to(aside)
    target.parent.mkdir(parents=True, exist_ok=True)
    os.replace(path, target)
    return target
