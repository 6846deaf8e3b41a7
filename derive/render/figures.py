"""Plots drawn to files: PDF for LaTeX, SVG with outlined text for everything
else, the same bytes each time."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from derive.derivation import Drawing, Panels, Plot
from derive.derivation import Figure as Picture
from derive.render.drawing.paper import Kind
from derive.render.drawing.subjects import on_paper

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIZE = (5.6, 3.4)  # inches
PANEL = 1.2  # inches, the height of one plot among several
MARGINS = {"left": 0.13, "right": 0.97, "bottom": 0.16, "top": 0.96}  # laying them out takes longest
BESIDE = {"right": 0.66}  # leaves room for a legend beside the picture
TICKS = "{x:g}"  # plain text: mathtext is parsed anew for each tick of each picture
STYLE: dict[str, Any] = {
    "svg.hashsalt": "derive", "svg.fonttype": "path", "pdf.fonttype": 3, "mathtext.fontset": "cm",
    "font.family": ["cmr10", "DejaVu Serif"], "axes.formatter.use_mathtext": True,
    "font.size": 11.0, "axes.unicode_minus": True,
}  # fmt: skip
COLOURS = ("#1f4e8c", "#b5461e", "#3b7a3b", "#6b4a8a", "#8a6d1f", "#333333")
STYLES = ("-", "--", "-.", ":")
NO_DATES: dict[str, dict[str, None]] = {
    "svg": {"Date": None, "Creator": None},
    "pdf": {"CreationDate": None, "Producer": None, "Creator": None},
    "png": {"Software": None},
}


def draw(plot: Picture, target: Path, kinds: tuple[Kind, ...] = ("svg", "pdf")) -> tuple[Path, ...]:
    """Draws a plot to files of these kinds; `target` is their path without suffix. Says what it wrote."""
    if isinstance(plot, Drawing):
        return on_paper(plot).write(target, kinds)
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.style import context

    target.parent.mkdir(parents=True, exist_ok=True)
    written = tuple(target.with_name(f"{target.name}.{kind}") for kind in kinds)
    with context(STYLE):
        figure = Figure(figsize=SIZE)
        FigureCanvasAgg(figure)
        _compose(figure, plot)
        for kind, path in zip(kinds, written, strict=True):
            figure.savefig(path, format=kind, metadata=NO_DATES[kind], dpi=200)
    return written


def _compose(figure: Figure, picture: Plot | Panels) -> None:
    """Everything of a picture, on the figure made large enough for it."""
    match picture:
        case Plot():
            figure.subplots_adjust(**{**MARGINS, **(BESIDE if picture.equal else {})})
            _fill(figure.add_subplot(), picture)
        case Panels(_, plots):
            _stack(figure, plots)


def _stack(figure: Figure, plots: tuple[Plot, ...]) -> None:
    """One above the other; what the horizontal axis is, is said below the last."""
    height = PANEL * len(plots) + 0.55
    figure.set_size_inches(SIZE[0], height)
    figure.subplots_adjust(left=0.13, right=0.97, bottom=0.5 / height, top=1 - 0.08 / height, hspace=0.16)
    rows = figure.subplots(len(plots), 1, sharex=True)
    for place, (axes, plot) in enumerate(zip(rows, plots, strict=True)):
        _fill(axes, plot, legend=place == 0)
        axes.margins(y=0.12)
        axes.yaxis.label.set_size(9)
        axes.tick_params(labelsize=9)
        if place < len(plots) - 1:
            axes.set_xlabel("")
            axes.tick_params(labelbottom=False)
    figure.align_ylabels(rows)


def _fill(axes: Axes, plot: Plot, legend: bool = True) -> None:
    for name, (x, y) in plot.regions.items():
        axes.fill(x, y, color="#1f4e8c", alpha=0.15, linewidth=0, label=name)
    for place, (name, (x, y)) in enumerate(plot.series.items()):
        style = STYLES[place // len(COLOURS) % len(STYLES)]
        axes.plot(x, y, style, color=COLOURS[place % len(COLOURS)], linewidth=1.6, label=name)
    for name, height in plot.marks.items():
        axes.axhline(height, color="0.55", linewidth=0.9, linestyle=(0, (4, 3)))
        axes.annotate(
            str(name), (0.99, height), xycoords=("axes fraction", "data"), xytext=(0, 2),
            textcoords="offset points", ha="right", va="bottom", color="0.35", fontsize=9,
        )  # fmt: skip
    axes.set_xlabel(str(plot.x_label))
    axes.set_ylabel(str(plot.y_label))
    axes.xaxis.set_major_formatter(TICKS)
    axes.yaxis.set_major_formatter(TICKS)
    axes.grid(True, color="0.9", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    axes.margins(x=0)
    if plot.equal:
        axes.margins(0.05)
        axes.set_aspect("equal", anchor="W")
    if legend and len(plot.series) + len(plot.regions) > 1:
        beside = {"loc": "upper left", "bbox_to_anchor": (1.02, 1.0)} if plot.equal else {}
        axes.legend(frameon=False, **beside)
