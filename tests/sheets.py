"""The sheets of exercises/, built once a test session and worker."""

from __future__ import annotations

from pathlib import Path

from derive.build import build

ROOT = Path(__file__).parents[1]
OUTPUT = ROOT / "output"
SHEETS = sorted((ROOT / "exercises").glob("*.yaml"))
NAMES = [sheet.stem for sheet in SHEETS]


def pages(sheet: Path, folder: Path, *formats: str) -> list[Path]:
    """The files of one sheet: its pages in these formats and its pictures."""
    return [Path(path) for path in build([sheet], formats, folder)]
