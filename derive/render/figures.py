"""Figures drawn to files by Typst: PDF for LaTeX, SVG with outlined text for everything else, the same bytes
each time."""

from __future__ import annotations

from pathlib import Path

from derive.derivation import Drawing, Figure
from derive.render.drawing import plots, subjects
from derive.render.drawing.paper import Kind


def draw(figure: Figure, target: Path, kinds: tuple[Kind, ...] = ("svg", "pdf")) -> tuple[Path, ...]:
    """Draws a figure to files of these kinds; `target` is their path without suffix. Says what it wrote."""
    paper = subjects.on_paper(figure) if isinstance(figure, Drawing) else plots.on_paper(figure)
    return paper.write(target, kinds)
