"""The notebook in docs/ runs from top to bottom, and every text that it keeps comes out again."""

from __future__ import annotations

from typing import Any

import nbformat
from nbclient import NotebookClient

from tests.sheets import ROOT

NOTEBOOK = ROOT / "docs" / "lecture.ipynb"


def test_the_notebook_shows_what_it_keeps() -> None:
    kept = nbformat.read(NOTEBOOK, as_version=4)
    nbformat.validate(kept)
    fresh = nbformat.read(NOTEBOOK, as_version=4)
    place = {"metadata": {"path": str(NOTEBOOK.parent)}}
    NotebookClient(fresh, timeout=120, kernel_name="python3", resources=place).execute()
    assert len(_texts(kept)) > 10
    assert _texts(fresh) == _texts(kept)
    pages = [shown["data"]["text/html"] for shown in _outputs(fresh) if "text/html" in shown.get("data", {})]
    assert any("<iframe" in page and "Solution" in page for page in pages)


def _outputs(notebook: Any) -> list[Any]:
    return [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]


def _texts(notebook: Any) -> list[str]:
    """What was printed or shown, less what only a browser shows."""
    shown = [output.get("text") or output["data"]["text/plain"] for output in _outputs(notebook)]
    return [*shown, *(each["data"].get("text/latex", "") for each in _outputs(notebook) if "data" in each)]
