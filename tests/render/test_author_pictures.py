"""The picture of an author stands on the page of every format, or is a fault where it is named."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from derive.build import build
from derive.errors import SheetErrors

SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="60" height="40"><circle cx="20" cy="20" r="9"/></svg>'
PNG = bytes.fromhex(
    "89504e470d0a1a0a0000000d4948445200000001000000010802000000907753de0000000c49444154789c63f8cfc000000301"
    "010018dd8db00000000049454e44ae426082"
)
SHEET = "title: t\nproblems:\n- motion: [{{rotate: x, by: a}}]\n  find: transform\n  figure: {}\n"


def test_svg_stands_on_every_page(tmp_path: Path) -> None:
    (tmp_path / "a picture.svg").write_text(SVG, encoding="utf-8")
    sheet = tmp_path / "my sheet (1).yaml"
    sheet.write_text(SHEET.format("a picture.svg"), encoding="utf-8")
    out = tmp_path / "out"
    build([sheet], ["md", "tex", "html", "docx", "pdf"], out)
    folder = "my-sheet-1-"
    assert f"![Figure 1]({folder}/problem-1-figure.svg)" in (out / "my sheet (1).md").read_text("utf-8")
    assert f"{{{folder}/problem-1-figure.pdf}}" in (out / "my sheet (1).tex").read_text("utf-8")
    assert (out / folder / "problem-1-figure.pdf").read_bytes().startswith(b"%PDF")
    assert "<circle" in (out / "my sheet (1).html").read_text("utf-8") or "data:image/svg" in (
        out / "my sheet (1).html"
    ).read_text("utf-8")
    inside = zipfile.ZipFile(out / "my sheet (1).docx").namelist()
    assert [name for name in inside if name.startswith("word/media/") and name.endswith(".png")]


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("fake.png", b"no", "failed to decode"),
        ("cut.png", PNG[:40], "failed to decode"),
        ("other.jpg", PNG, "failed to decode"),
        ("broken.svg", b"<svg><x", "failed to parse SVG"),
        ("sheet.yaml", b"a: 1", "it ends in .yaml"),
        ("moving.gif", b"GIF89a", "it ends in .gif"),
    ],
)
def test_what_is_no_picture(tmp_path: Path, name: str, content: bytes, said: str) -> None:
    (tmp_path / name).write_bytes(content)
    sheet = tmp_path / "x.yaml"
    sheet.write_text(SHEET.format(name), encoding="utf-8")
    with pytest.raises(SheetErrors) as caught:
        build([sheet], ["md"], tmp_path / "out")
    (fault,) = caught.value.errors
    assert str(fault.place).endswith("x.yaml:5:11")
    assert said in fault.message


def test_two_pictures_of_one_name(tmp_path: Path) -> None:
    """Each problem has its own, though their files have one name in two folders."""
    for folder, width in (("a", 60), ("b", 70)):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "x.svg").write_text(SVG.replace("60", str(width)), encoding="utf-8")
    sheet = tmp_path / "x.yaml"
    problem = SHEET.partition("problems:\n")[2]
    sheet.write_text(SHEET.format("a/x.svg") + problem.format("b/x.svg"), encoding="utf-8")
    build([sheet], ["md"], tmp_path / "out")
    widths = [(tmp_path / "out" / "x" / f"problem-{k}-figure.svg").read_text("utf-8") for k in (1, 2)]
    assert 'width="60"' in widths[0] and 'width="70"' in widths[1]
