"""Pandoc, run as a program on our own Markdown; nothing in the Markdown can carry another language."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from shutil import which

from derive.render.failures import PandocFailed

# Strict Markdown and what our pages use beyond it. No raw HTML, no raw TeX, no attributes.
READER = (
    "markdown_strict-raw_html+all_symbols_escapable+intraword_underscores+space_in_atx_header"
    "+tex_math_dollars+pipe_tables+startnum+backtick_code_blocks"
)
NEVER_FOLD = "100000"  # a table row longer than `--columns` would be given fixed column widths


def pandoc(markdown: str, writer: str, arguments: Sequence[str], metadata: Mapping[str, str]) -> bytes:
    """What pandoc makes of a page. A warning is a failure: what it cannot read would come out raw.

    Raises PandocFailed.
    """
    values = [f"--metadata={name}={value}" for name, value in metadata.items() if value]
    return _run(markdown, READER, writer, [*arguments, *values])


def pandoc_from_tree(tree: str, writer: str, arguments: Sequence[str]) -> bytes:
    """What pandoc makes of a page that it has read already. Raises PandocFailed."""
    return _run(tree, "json", writer, arguments)


def _run(page: str, reader: str, writer: str, arguments: Sequence[str]) -> bytes:
    command = [pandoc_path(), f"--from={reader}", f"--to={writer}", "--fail-if-warnings"]
    options = ["--standalone", "--wrap=preserve", f"--columns={NEVER_FOLD}", *arguments]
    done = subprocess.run([*command, *options], input=page.encode(), capture_output=True, check=False)
    if done.returncode:
        raise PandocFailed(done.stderr.decode(errors="replace").strip())
    return done.stdout


def pandoc_path() -> str:
    """The pandoc that came with the `pypandoc-binary` distribution, or the one on the path.

    Raises PandocFailed where there is none.
    """
    package = find_spec("pypandoc")
    bundled = Path(package.origin or "").parent / "files" if package else Path()
    found = which("pandoc", path=str(bundled)) or which("pandoc")
    if found is None:
        raise PandocFailed("pandoc was not found; `python3 -m pip install pypandoc-binary` brings it")
    return found
