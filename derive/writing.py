"""Pages on the disk: every format of a document, and the pictures and files beside it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from shutil import copyfile, rmtree
from typing import TYPE_CHECKING

from derive.errors import NotAllWritten, Place, SheetError, SheetErrors
from derive.placing import Made, aside, put_all
from derive.render.document import Document
from derive.render.drawing.paper import Kind
from derive.render.failures import NoGlyphs, PageFailed
from derive.sheet.model import Sheet

if TYPE_CHECKING:
    from concurrent.futures import Future

Progress = Callable[[str], None]
TEXT_FORMATS = ("md", "tex", "json")
BESIDE = {".md", ".tex"}  # pages that show pictures from files beside them; others hold them


def render(document: Document, kind: str) -> str:
    """The page as text, in one of the text formats; read back, its mathematics or its results. Raises
    SheetErrors where it does not say what was derived."""
    if kind == "json":
        from derive.json_back import read_json
        from derive.render.json_result import render_json
        from derive.render.own_templates import undressed

        with undressed():
            text = render_json(document)
        read_json(document, text)
        return text
    from derive.read_back import read_back
    from derive.render.page import render_latex, render_markdown

    if kind == "tex":
        return render_latex(document, read_back)
    return render_markdown(document, read=read_back)


def write(
    sheets: Sequence[Sheet],
    documents: Sequence[Document],
    formats: Sequence[str],
    output: Path,
    pdf_engine: str,
    progress: Progress,
) -> tuple[Path, ...]:
    """Writes pages and pictures: all are made aside, then put in their place at once.

    Raises NotAllWritten where a page cannot be made: an older one of its name is removed, the others are
    written. Raises SheetErrors, with nothing written, where none can.
    """
    with aside(output) as folder:
        made = []
        for sheet, document in zip(sheets, documents, strict=True):
            progress(f"writing {sheet.path.stem}")
            made.append(make(sheet, document, formats, folder, pdf_engine))
        faults = [fault for each in made for fault in each.faults]
        if not any(each.pages for each in made):
            raise SheetErrors(faults)
        files = put_all(made, folder, output)
    if faults:
        raise NotAllWritten(faults, files)
    return files


def make(sheet: Sheet, document: Document, formats: Sequence[str], folder: Path, pdf_engine: str) -> Made:
    """The pages of one sheet and the pictures beside them, in a folder aside. Raises SheetErrors where a page
    says something else than was derived."""
    if set(formats) - {"json"}:
        _place(sheet, document, folder, _picture_kinds(formats, pdf_engine))
    pages, failed, faults = [], [], list[SheetError]()
    with _typesetting(document, folder, "pdf" in formats and pdf_engine != "latex") as pdf:
        for kind in formats:
            page = folder / f"{document.name}.{kind}"
            try:
                _make(document, kind, page, pdf)
                pages.append(page)
            except PageFailed as error:
                failed.append(page)
                faults += _failed(error, page.name, sheet)
    shown = {page.suffix for page in pages}
    if not shown - {".json"}:
        rmtree(folder / document.figures, ignore_errors=True)  # no page shows them
    elif not shown & BESIDE:
        _clear(document, folder)
    beside = sorted(path for path in (folder / document.figures).rglob("*") if path.is_file())
    return Made(tuple(pages), tuple(beside), tuple(failed), tuple(faults))


def _failed(error: PageFailed, page: str, sheet: Sheet) -> list[SheetError]:
    """The faults of a page that could not be made: each line of the sheet whose characters no font has."""
    if not isinstance(error, NoGlyphs):
        return [SheetError(f"{page} could not be made: {error}", None, error.hint)]
    hint = "write it in other letters, or choose --format md,tex,html,docx"
    found = []
    for number, line in enumerate(sheet.path.read_text(encoding="utf-8-sig").splitlines(), 1):
        if lacking := [char for char in line if char in error.characters]:
            place = Place(str(sheet.path), number, line.index(lacking[0]) + 1, line)
            found.append(SheetError(f"{page}: no font of ours has {''.join(lacking)}", place, hint))
    return found or [SheetError(f"{page} could not be made: {error}", None, hint)]


def _picture_kinds(formats: Sequence[str], pdf_engine: str) -> tuple[Kind, ...]:
    """What plots are drawn as for these pages; a docx draws its own."""
    latex = "tex" in formats or ("pdf" in formats and pdf_engine == "latex")
    web = {"md", "html"} & {*formats} or ("pdf" in formats and pdf_engine != "latex")
    wanted: tuple[tuple[Kind, bool], ...] = (("svg", bool(web)), ("pdf", latex))
    return tuple(kind for kind, asked in wanted if asked)


def _place(sheet: Sheet, document: Document, folder: Path, kinds: tuple[Kind, ...]) -> None:
    """Everything a page refers to, beside it."""
    for path, text in document.files().items():
        (folder / path).parent.mkdir(exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")
    for problem, page in zip(sheet.problems, document.problems, strict=True):
        if isinstance(problem.figure, Path) and page.figure:
            _copy(problem.figure, folder / page.figure, kinds)
    if kinds and (plots := document.plots()):
        from derive.render.figures import draw

        for path, plot in plots.items():
            draw(plot, folder / path, kinds)


def _clear(document: Document, folder: Path) -> None:
    """Removes the pictures; the other files of a page stay."""
    drawn = {folder / f"{path}.{kind}" for path in document.plots() for kind in ("svg", "pdf")}
    for picture in drawn | {folder / path for path in document.pictures()}:
        picture.unlink(missing_ok=True)
        picture.with_suffix(".pdf").unlink(missing_ok=True)
    place = folder / document.figures
    if place.is_dir() and not any(place.iterdir()):
        place.rmdir()


def _copy(picture: Path, target: Path, kinds: tuple[Kind, ...]) -> None:
    """The picture of an author, for LaTeX as a PDF where it is an SVG."""
    target.parent.mkdir(exist_ok=True)
    copyfile(picture, target)
    if target.suffix == ".svg" and "pdf" in kinds:
        from derive.render.author_pictures import drawn

        target.with_suffix(".pdf").write_bytes(drawn(picture, "pdf"))


def _typesetting(
    document: Document, folder: Path, wanted: bool
) -> AbstractContextManager[Future[bytes] | None]:
    """The PDF by Typst, which takes its time beside ours; None where it is not wanted."""
    if not wanted:
        return nullcontext()
    from derive.read_back import read_back
    from derive.render.pdf import typesetting

    return typesetting(document, folder, read_back)


def _make(document: Document, kind: str, target: Path, pdf: Future[bytes] | None) -> None:
    if kind in TEXT_FORMATS:
        target.write_text(render(document, kind), encoding="utf-8")
    elif kind == "pdf" and pdf is None:
        _typeset(document, target)
    elif kind == "pdf" and pdf is not None:
        target.write_bytes(pdf.result())
    else:
        from derive.read_back import read_back
        from derive.render.docx import write_docx
        from derive.render.web import write_html

        (write_html if kind == "html" else write_docx)(document, target, read_back)


def _typeset(document: Document, target: Path) -> None:
    from derive.render.pdf import write_pdf_with_latex

    source = target.with_suffix(".tex")
    source.write_text(render(document, "tex"), encoding="utf-8")
    write_pdf_with_latex(source, target)
