"""Letter in place of A4: the size of the pages of every format that has pages."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path
from zipfile import ZipFile

import pytest

from derive.build import build

SIZES = {"a4": (595, 842), "letter": (612, 792)}  # points


@pytest.mark.parametrize("paper", SIZES)
def test_the_size_of_a_page(paper: str, tmp_path: Path) -> None:
    sheet = tmp_path / "paper.yaml"
    drive = "{rotor: J_m, load: J_l, gear: G}"
    sheet.write_text(
        f"title: Paper\npaper: {paper}\nproblems:\n- drive: {drive}\n  find: reflected-inertia\n"
    )
    build([sheet], ["pdf", "docx", "tex"], tmp_path)
    said = subprocess.run(
        ["pdfinfo", tmp_path / "paper.pdf"], capture_output=True, text=True, check=True
    ).stdout
    found = re.search(r"Page size:\s+([\d.]+) x ([\d.]+)", said)
    assert found and (round(float(found[1])), round(float(found[2]))) == SIZES[paper]
    with ZipFile(tmp_path / "paper.docx") as archive:
        size = re.search(r'<w:pgSz w:h="(\d+)" w:w="(\d+)"', archive.read("word/document.xml").decode())
    assert size and (round(int(size[2]) / 20), round(int(size[1]) / 20)) == SIZES[paper]
    assert f"{paper}paper]" in (tmp_path / "paper.tex").read_text()
