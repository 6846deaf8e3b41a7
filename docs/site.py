"""Pages of the site that are made: from the README, from the models and the command, and the gallery.

A hook of MkDocs (mkdocs.yml). Mathematics becomes MathML by our own writer, so that the site needs no script.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree.ElementTree import Element, fromstring

from markdown import Extension, Markdown
from markdown.inlinepatterns import InlineProcessor
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

from derive import catalogue
from derive.build import build
from derive.cli import main
from derive.kinds import registry
from derive.render.formula.mathml import math
from derive.render.formula.tex import boxes
from derive.render.questions import example_of
from derive.sheet.subjects.registry import subjects

ROOT = Path(__file__).parents[1]
MOVED = {"README.md": "index.md", "CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changelog.md"}
LINK = re.compile(r"(?<!!)\[([^\]]+)\]\((?!https?:|#)([^)#\s]+)(#[^)\s]*)?\)")


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Pages are read with mathematics in $...$."""
    config.markdown_extensions.append(_Mathematics())
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Adds the pages that are made."""
    made = {name: _moved(ROOT / source) for source, name in MOVED.items()}
    made["reference/kinds.md"] = _kinds()
    made["reference/command.md"] = _command()
    made["notebook.md"] = _notebook(ROOT / "docs" / "lecture.ipynb")
    made |= dict(_gallery(config.extra["gallery"]))
    for name, text in made.items():
        files.append(File.generated(config, name, content=text))
    return files


def on_page_markdown(markdown: str, page: object, config: MkDocsConfig, files: Files) -> str:
    """Links out of docs/ lead to the pages that were made of what is there."""
    return re.sub(r"\]\(\.\./([A-Z]+\.md)\)", lambda found: f"]({MOVED[found[1]]})", markdown)


# -- mathematics ------------------------------------------------------------------------------------------


class _Inline(InlineProcessor):
    def handleMatch(self, m: re.Match[str], data: str) -> tuple[Element, int, int]:
        return fromstring(math(boxes(m[1])).replace("&nbsp;", "\xa0")), m.start(0), m.end(0)


class _Mathematics(Extension):
    def extendMarkdown(self, md: Markdown) -> None:
        md.inlinePatterns.register(_Inline(r"\$([^$\n]+)\$", md), "mathematics", 185)  # behind code


# -- pages ------------------------------------------------------------------------------------------------


def _moved(source: Path) -> str:
    """A page from the root of the repository; what is no page of the site is named and not linked."""

    def led(found: re.Match[str]) -> str:
        target = found[2].removeprefix("docs/")
        target = MOVED.get(target, target)
        there = target in MOVED.values() or (ROOT / "docs" / target).is_file()
        return f"[{found[1]}]({target}{found[3] or ''})" if there else found[1]

    return LINK.sub(led, source.read_text(encoding="utf-8")).replace('src="docs/', 'src="')


def _kinds() -> str:
    """All that `derive kinds` says, a heading a subject and a kind."""
    lines = ["# What can be asked", "", "As `derive kinds` tells it.", ""]
    for subject in subjects():
        lines += [f"## {subject}", "", *_told(catalogue.describe(subject))]
        for kind in registry.kinds_of(subject):
            lines += [f"### {kind} of {subject}", "", *_told(catalogue.describe(subject, kind))]
    return "\n".join(lines)


def _command() -> str:
    """What every command says under --help."""
    lines = ["# The command", ""]
    with main.make_context("derive", [], resilient_parsing=True) as context:
        lines += _told(main.get_help(context))
        for name, command in main.commands.items():
            lines += [f"## derive {name}", ""]
            with command.make_context(name, [], parent=context, resilient_parsing=True) as inner:
                lines += _told(command.get_help(inner))
    return "\n".join(lines)


def _notebook(source: Path) -> str:
    """A notebook with what its cells print; pages that only a notebook shows are left out."""
    lines = []
    for cell in json.loads(source.read_text(encoding="utf-8"))["cells"]:
        text = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            lines += [text, ""]
            continue
        lines += ["```python", text, "```", ""]
        for output in cell["outputs"]:
            printed = "".join(output.get("text") or output["data"]["text/plain"])
            lines += [*(f">     {line}" for line in printed.rstrip().splitlines()), ""]
    return "\n".join([*lines, "The notebook itself: [lecture.ipynb](lecture.ipynb)."])


def _told(text: str) -> list[str]:
    return ["```text", text.rstrip(), "```", ""]


# -- gallery ----------------------------------------------------------------------------------------------


def _gallery(wanted: str) -> Iterator[tuple[str, str]]:
    """A page for every kind, of its example, and for every exercise sheet; the page that leads to them."""
    kinds = [(subject, kind) for subject in subjects() for kind in registry.kinds_of(subject)]
    sheets = sorted((ROOT / "exercises").glob("*.yaml"))
    with TemporaryDirectory() as folder:
        made = {}
        for subject, kind in kinds:
            made[f"{subject}-{kind}"] = path = Path(folder) / f"{subject}-{kind}.yaml"
            path.write_text(example_of(registry.module_name(subject, kind)), encoding="utf-8")
        made |= {f"sheet-{path.stem}": path for path in sheets}
        chosen = made if wanted == "every" else {name: made[name] for name in wanted.split()}
        for name, path in chosen.items():
            yield f"gallery/{name}.html", _page(path, Path(folder))
    lines = ["# Gallery", "", "Every page here is made, as it stands, from a sheet of a few lines.", ""]
    for subject in subjects():
        lines += [f"## {subject}", "", "| `find` | what is answered |", "|---|---|"]
        lines += [_row(subject, kind, chosen) for kind in registry.kinds_of(subject)] + [""]
    lines += ["## Whole sheets", "", "Those in `exercises/`.", ""]
    lines += [f"- {_link(path.stem, f'sheet-{path.stem}', chosen)}" for path in sheets]
    yield "gallery/index.md", "\n".join(lines)


def _page(path: Path, folder: Path) -> str:
    (page,) = build([path], ("html",), folder / "made")[-1:]
    assert isinstance(page, Path)
    return page.read_text(encoding="utf-8")


def _row(subject: str, kind: str, chosen: dict[str, Path]) -> str:
    answers = (registry.load(subject, kind).__doc__ or "").splitlines()[0]
    return f"| {_link(kind, f'{subject}-{kind}', chosen)} | {answers} |"


def _link(text: str, name: str, chosen: dict[str, Path]) -> str:
    return f"[{text}]({name}.html)" if name in chosen else text
