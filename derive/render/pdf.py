"""The sheet as PDF: by pandoc and Typst from plain pip, or by a TeX installation where there is one."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path
from shutil import which
from tempfile import TemporaryDirectory

from derive.render.document import Document
from derive.render.failures import NoGlyphs, PdfFailed
from derive.render.page import render_markdown
from derive.render.pandoc import pandoc
from derive.render.printed import Reader, unread
from derive.render.skin import templates

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

# A sign that continues a sum after an indent: something before it makes Typst space it as binary.
CONTINUED = re.compile(r"(&\s*quad)\s+([+\-])")

# A fraction that is all of a denominator: pandoc writes a / b / c for it, which Typst reads from the left.
FRACTION_BELOW = re.compile(r"\}\{(?=\\d?frac\{)")

# The paragraph that leads to a display stays on its page; the template says how.
LEAD_IN = re.compile(r"(?<=\n\n)(?![#=+\-\s]|\$\s)((?:(?!`{3}).+\n)+)(?=\n\$ )")


def metadata(document: Document) -> dict[str, str]:
    """What a page template prints outside the body."""
    byline = " · ".join(filter(None, (document.course, document.author, document.date)))
    return {
        "title": document.title, "author": document.author, "byline": byline, "lang": document.language,
    }  # fmt: skip


def write_pdf(document: Document, target: Path, read: Reader = unread) -> None:
    """Writes the PDF. Pictures are found relative to the folder of `target`.

    Raises PdfFailed, PandocFailed, and what `read` raises.
    """
    from typst import Compiler, TypstError

    try:
        # Plain texts go in as values, so that nothing in them is read as Typst.
        source = render_typst(document, read).encode()
        compiler = Compiler(source, target.parent, ignore_system_fonts=True, sys_inputs=metadata(document))
        compiler.compile(output=str(target), format="pdf", pdf_standards=["a-2b"], timestamp=TIMESTAMP)
    except TypstError as error:
        if missing := NO_GLYPH.findall(error.diagnostic):
            raise NoGlyphs("".join(dict.fromkeys("".join(missing)))) from error
        raise PdfFailed("\n".join((error.message, *error.hints))) from error


def render_typst(document: Document, read: Reader = unread) -> str:
    """The page as Typst source."""
    template = templates() / "typst" / "sheet.typ"
    # Headings move up one level: the title of the sheet is no heading of the body.
    arguments = [f"--template={template}", "--shift-heading-level-by=-1"]
    markdown = with_fractions_below(render_markdown(document, False, read))
    page = pandoc(markdown, "typst", arguments, metadata(document)).decode()
    return LEAD_IN.sub(r"#lead-in[\1]\n", CONTINUED.sub(r'\1 "" \2', page))


def with_fractions_below(markdown: str) -> str:
    """The same Markdown, with something beside each fraction that is all of a denominator."""
    return FRACTION_BELOW.sub(r"}{{}", markdown)


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
