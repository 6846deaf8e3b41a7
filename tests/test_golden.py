"""The pages of exercises/, against those kept in output/; and every page read by the programs that print it.

`pytest tests/test_golden.py --update-golden` writes output/ anew after a change that is meant.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.render.test_markdown_math import CODE, as_read, as_written
from tests.sheets import NAMES, OUTPUT, SHEETS, pages

every_sheet = pytest.mark.parametrize("sheet", SHEETS, ids=NAMES)
PICTURES = (".svg", ".pdf", ".png")


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> dict[Path, list[Path]]:
    """Markdown and LaTeX of a sheet, built when it is first asked for."""
    folder = tmp_path_factory.mktemp("pages")
    return _Built(folder)


class _Built(dict[Path, list[Path]]):
    def __init__(self, folder: Path) -> None:
        super().__init__()
        self.folder = folder

    def __missing__(self, sheet: Path) -> list[Path]:
        self[sheet] = pages(sheet, self.folder, "md", "tex")
        return self[sheet]


def page(built: dict[Path, list[Path]], sheet: Path, suffix: str) -> Path:
    return next(path for path in built[sheet] if path.suffix == suffix)


@every_sheet
def test_the_page_is_the_one_that_is_kept(
    built: dict[Path, list[Path]], sheet: Path, update_golden: bool
) -> None:
    folder = page(built, sheet, ".md").parent
    if update_golden:
        shutil.rmtree(OUTPUT / sheet.stem, ignore_errors=True)
        _keep(built[sheet], folder)
    beside = {path.name for path in built[sheet] if path.parent.name == sheet.stem}
    assert {path.name for path in (OUTPUT / sheet.stem).glob("*")} <= beside
    for path in built[sheet]:
        kept = OUTPUT / path.relative_to(folder)
        assert kept.is_file(), f"{kept.name} is not kept: run pytest tests/test_golden.py --update-golden"
        if path.suffix not in PICTURES:
            assert path.read_text(encoding="utf-8") == kept.read_text(encoding="utf-8")


def _keep(paths: list[Path], folder: Path) -> None:
    for path in paths:
        target = OUTPUT / path.relative_to(folder)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, target)


def test_nothing_else_is_kept(update_golden: bool) -> None:
    kept = {path.name.split(".")[0] for path in OUTPUT.iterdir()} if OUTPUT.is_dir() else set()
    assert kept - {""} <= set(NAMES)


@every_sheet
def test_latex_compiles_it_without_a_warning(
    built: dict[Path, list[Path]], sheet: Path, tmp_path: Path
) -> None:
    _compile(page(built, sheet, ".tex"), "-pdf", tmp_path)


def test_lualatex_too(built: dict[Path, list[Path]], tmp_path: Path) -> None:
    sheet = next(sheet for sheet in SHEETS if sheet.stem == "dc-motor")  # plots, diagrams and programs
    _compile(page(built, sheet, ".tex"), "-pdflua", tmp_path)


def _compile(source: Path, engine: str, folder: Path) -> None:
    options = [engine, "-interaction=nonstopmode", "-halt-on-error", "-file-line-error", "-no-shell-escape"]
    done = subprocess.run(
        ["latexmk", *options, f"-output-directory={folder}", source.name],
        cwd=source.parent,
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
    )
    log = (folder / f"{source.stem}.log").read_text(encoding="utf-8", errors="replace")
    assert done.returncode == 0, [line for line in log.splitlines() if re.match(r"(!|\S+:\d+:)", line)]
    assert re.findall(r".*(?:\b[Ww]arning(?!/)|full \\hbox|full \\vbox|Missing character).*", log) == []


@every_sheet
def test_pandoc_reads_every_formula(built: dict[Path, list[Path]], sheet: Path) -> None:
    import pypandoc

    arguments = ["--fail-if-warnings", "--mathml"]
    html = pypandoc.convert_file(
        str(page(built, sheet, ".md")), "html", format="markdown", extra_args=arguments
    )
    assert "<math" in html
    assert "$" not in re.sub(r"<annotation.*?</annotation>|<[^>]*>", "", html, flags=re.DOTALL)


@every_sheet
def test_the_problem_sheet_tells_no_solution(sheet: Path, tmp_path: Path) -> None:
    from derive.build import build

    (made,) = (Path(p) for p in build([sheet], ["md"], tmp_path, problems=True) if str(p).endswith(".md"))
    assert made.stem == f"{sheet.stem}-problems"
    assert "Solution" not in made.read_text(encoding="utf-8")


@every_sheet
def test_commonmark_leaves_every_formula(built: dict[Path, list[Path]], sheet: Path) -> None:
    text = page(built, sheet, ".md").read_text(encoding="utf-8")
    assert as_read(text) == as_written(text)
    glued = r"(?<![\\$])\$[^$\n]+\$(?=[A-Za-z0-9])|(?<=[A-Za-z0-9/])\$[^$\n]+\$"
    assert not re.search(glued, re.sub(r"\$[^$]+\$(?![A-Za-z0-9])", "", CODE.sub("", text)))
