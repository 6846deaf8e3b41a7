"""Plots drawn to files: PDF for LaTeX, SVG with outlined text for everything
else, the same bytes each time."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from derive.derivation import Plot

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SIZE = (5.6, 3.4)  # inches
MARGINS = {"left": 0.13, "right": 0.97, "bottom": 0.16, "top": 0.96}  # laying them out takes longest
TICKS = "{x:g}"  # plain text: mathtext is parsed anew for each tick of each picture
STYLE: dict[str, Any] = {
    "svg.hashsalt": "derive", "svg.fonttype": "path", "pdf.fonttype": 3, "mathtext.fontset": "cm",
    "font.family": "serif", "font.serif": ["cmr10", "DejaVu Serif"], "axes.formatter.use_mathtext": True,
    "font.size": 11.0, "axes.unicode_minus": True,
}  # fmt: skip
COLOURS = ("#1f4e8c", "#b5461e", "#3b7a3b", "#6b4a8a", "#8a6d1f", "#333333")
STYLES = ("-", "--", "-.", ":")
NO_DATES: dict[str, dict[str, None]] = {
    "svg": {"Date": None, "Creator": None},
    "pdf": {"CreationDate": None, "Producer": None, "Creator": None},
    "png": {"Software": None},
}


def draw(plot: Plot, target: Path, kinds: tuple[str, ...] = ("svg", "pdf")) -> tuple[Path, ...]:
    """Draws a plot to files of these kinds; `target` is their path without suffix. Says what it wrote."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.style import context

    target.parent.mkdir(parents=True, exist_ok=True)
    written = tuple(target.with_name(f"{target.name}.{kind}") for kind in kinds)
    with context(STYLE):
        figure = Figure(figsize=SIZE)
        figure.subplots_adjust(**MARGINS)
        FigureCanvasAgg(figure)
        _fill(figure.add_subplot(), plot)
        for kind, path in zip(kinds, written, strict=True):
            figure.savefig(path, format=kind, metadata=NO_DATES[kind], dpi=200)
    return written


def _fill(axes: Axes, plot: Plot) -> None:
    for place, (name, (x, y)) in enumerate(plot.series.items()):
        style = STYLES[place // len(COLOURS) % len(STYLES)]
        axes.plot(x, y, style, color=COLOURS[place % len(COLOURS)], linewidth=1.6, label=name)
    for name, height in plot.marks.items():
        axes.axhline(height, color="0.55", linewidth=0.9, linestyle=(0, (4, 3)))
        axes.annotate(
            name, (0.99, height), xycoords=("axes fraction", "data"), xytext=(0, 2),
            textcoords="offset points", ha="right", va="bottom", color="0.35", fontsize=9,
        )  # fmt: skip
    axes.set_xlabel(plot.x_label)
    axes.set_ylabel(plot.y_label)
    axes.xaxis.set_major_formatter(TICKS)
    axes.yaxis.set_major_formatter(TICKS)
    axes.grid(True, color="0.9", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    axes.margins(x=0)
    if len(plot.series) > 1:
        axes.legend(frameon=False)
