"""Drawings of subjects: strokes by what they stand for, and captions that keep clear of each other."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, cos, sin
from typing import TYPE_CHECKING, Any

from derive.derivation import Caption, Drawing, Stroke
from derive.expression import Number
from derive.render.latex import Printer
from derive.render.names import name_latex
from derive.render.notation import Notation

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDEST, HIGHEST = 4.4, 3.4  # inches
INK, RED, GREEN, BLUE, FAINT = "0.15", "#b5301e", "#3b7a3b", "#1f4e8c", "0.6"
LINES: dict[str, dict[str, Any]] = {
    "link": {"color": "0.72", "linewidth": 6.5, "solid_capstyle": "round"},
    "rod": {"color": "0.55", "linewidth": 3.0, "solid_capstyle": "butt"},
    "gripper": {"color": INK, "linewidth": 1.8, "solid_joinstyle": "miter"},
    "thin": {"color": INK, "linewidth": 0.9},
    "hidden": {"color": FAINT, "linewidth": 0.8, "linestyle": (0, (4, 3))},
    "wire": {"color": INK, "linewidth": 1.0},
}
ARROWS: dict[str, dict[str, Any]] = {
    "x": {"color": RED, "lw": 1.3}, "y": {"color": GREEN, "lw": 1.3}, "z": {"color": BLUE, "lw": 1.3},
    "before": {"color": FAINT, "lw": 1.1}, "arc": {"color": INK, "lw": 0.9},
    "way": {"color": FAINT, "lw": 0.9, "linestyle": (0, (4, 3))}, "arrow": {"color": INK, "lw": 1.0},
}  # fmt: skip
AREAS: dict[str, dict[str, Any]] = {
    "body": {"facecolor": "0.86", "edgecolor": INK, "linewidth": 0.9},
    "cap": {"facecolor": "0.97", "edgecolor": INK, "linewidth": 0.9},
    "pin": {"facecolor": INK, "edgecolor": INK, "linewidth": 0.5},
    "ground": {"facecolor": "0.93", "edgecolor": "0.5", "linewidth": 0.8, "hatch": "////"},
    "box": {"facecolor": "white", "edgecolor": INK, "linewidth": 1.0},
}
COLOURS = {"x": RED, "y": GREEN, "z": BLUE, "before": "0.45"}
SIZES = {"x": 9.5, "y": 9.5, "z": 9.5, "before": 9.5}
POINTS = 72  # in an inch
SWINGS = (0.0, 0.5, -0.5, 1.0, -1.0, 1.6, -1.6, 2.3, -2.3, 3.14)  # rad, from where a caption should stand


def draw_drawing(figure: Figure, drawing: Drawing) -> None:
    """Fills a figure, made as large as the drawing needs."""
    left, right, low, high = _bounds(drawing)
    scale = POINTS * min(WIDEST / (right - left), HIGHEST / (high - low))
    frames = _placed(drawing, scale)
    left, right = (
        min([left, *(f.left / scale for f in frames)]),
        max([right, *(f.right / scale for f in frames)]),
    )
    low, high = (min([low, *(f.low / scale for f in frames)]), max([high, *(f.high / scale for f in frames)]))
    figure.set_size_inches(scale / POINTS * (right - left), scale / POINTS * (high - low))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set_aspect("equal")
    axes.set_xlim(left, right)
    axes.set_ylim(low, high)
    for depth, stroke in enumerate(drawing.strokes):
        _stroke(axes, stroke, depth)
    for caption, frame in zip(drawing.captions, frames, strict=True):
        at = ((frame.left + frame.right) / 2 / scale, (frame.low + frame.high) / 2 / scale)
        colour, size = COLOURS.get(caption.role, "black"), SIZES.get(caption.role, 10.5)
        axes.text(*at, _text(caption), ha="center", va="center", fontsize=size, color=colour, zorder=10_000)


def _bounds(drawing: Drawing) -> tuple[float, float, float, float]:
    """Of all strokes, with room for what is written beside them."""
    places = [place for stroke in drawing.strokes for place in stroke.places]
    places += [caption.at for caption in drawing.captions]
    left, right = min(p[0] for p in places), max(p[0] for p in places)
    low, high = min(p[1] for p in places), max(p[1] for p in places)
    room = 0.03 * max(right - left, high - low)
    return left - room, right + room, low - room, high + room


def _stroke(axes: Axes, stroke: Stroke, depth: int) -> None:
    x, y = [p[0] for p in stroke.places], [p[1] for p in stroke.places]
    if stroke.role in AREAS:
        axes.fill(x, y, zorder=10 + depth, **AREAS[stroke.role])
    elif stroke.role in ARROWS:
        style = ARROWS[stroke.role]
        line = {"color": style["color"], "linewidth": style["lw"], "linestyle": style.get("linestyle", "-")}
        axes.plot(x, y, zorder=10 + depth, solid_capstyle="butt", **line)
        head = {"arrowstyle": "-|>,head_width=0.16,head_length=0.38", "shrinkA": 0, "shrinkB": 0}
        start = (x[-1] + 0.02 * (x[-2] - x[-1]), y[-1] + 0.02 * (y[-2] - y[-1]))
        axes.annotate(
            "", (x[-1], y[-1]), start, zorder=11 + depth,
            arrowprops={**head, "color": style["color"], "lw": style["lw"]},
        )  # fmt: skip
    else:
        axes.plot(x, y, zorder=10 + depth, **LINES[stroke.role])


# -- captions -----------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Frame:
    """A rectangle on paper, in points."""

    left: float
    low: float
    right: float
    high: float

    def common(self, other: _Frame) -> float:
        """The area that both cover."""
        width = min(self.right, other.right) - max(self.left, other.left)
        height = min(self.high, other.high) - max(self.low, other.low)
        return max(0.0, width) * max(0.0, height)


def _placed(drawing: Drawing, scale: float) -> list[_Frame]:
    """Each caption on its side of its place, or as near to that as others leave room."""
    taken = [frame for stroke in drawing.strokes for frame in _covered(stroke, scale)]
    placed: list[_Frame] = []
    for caption in drawing.captions:
        placed.append(_free(caption, placed, taken, scale))
    return placed


def _free(caption: Caption, placed: list[_Frame], taken: list[_Frame], scale: float) -> _Frame:
    width, height = _extent(_text(caption), SIZES.get(caption.role, 10.5))
    x, y = caption.at[0] * scale, caption.at[1] * scale
    if caption.towards == (0.0, 0.0):
        return _about(x, y, width, height)
    towards, clear = atan2(caption.towards[1], caption.towards[0]), _clear(caption, scale)
    frames = [_beside(x, y, width, height, towards + swing, clear) for swing in SWINGS]
    return min(frames, key=lambda frame: _crowded(frame, placed, taken))


def _clear(caption: Caption, scale: float) -> float:
    """How far from its place a caption begins, in points; beside a joint as far as the joint reaches."""
    if caption.role == "joint":
        return float(3.0 + scale * (caption.towards[0] ** 2 + caption.towards[1] ** 2) ** 0.5)
    return 1.0 if caption.role == "sign" else 4.0 if caption.role in COLOURS else 7.0


def _crowded(frame: _Frame, placed: list[_Frame], taken: list[_Frame]) -> float:
    """How much a place is in the way of others; the earlier of equal places is preferred."""
    return 3 * sum(frame.common(other) for other in placed) + sum(frame.common(other) for other in taken)


def _beside(x: float, y: float, width: float, height: float, angle: float, gap: float) -> _Frame:
    """A frame that touches a circle round a place, in a direction."""
    away = gap + abs(cos(angle)) * width / 2 + abs(sin(angle)) * height / 2
    return _about(x + away * cos(angle), y + away * sin(angle), width, height)


def _about(x: float, y: float, width: float, height: float) -> _Frame:
    return _Frame(x - width / 2, y - height / 2, x + width / 2, y + height / 2)


def _covered(stroke: Stroke, scale: float) -> list[_Frame]:
    """Small squares along a stroke."""
    found = []
    half = 3.5 if stroke.role == "link" else 1.2
    for (ax, ay), (bx, by) in pairwise(stroke.places):
        steps = max(1, round(max(abs(bx - ax), abs(by - ay)) * scale / 4))
        for k in range(steps + 1):
            x, y = (ax + (bx - ax) * k / steps) * scale, (ay + (by - ay) * k / steps) * scale
            found.append(_Frame(x - half, y - half, x + half, y + half))
    return found


def _text(caption: Caption) -> str:
    if isinstance(caption.text, str):
        return f"${name_latex(caption.text)}$"
    written = Printer(Notation()).write(caption.text)
    if caption.role == "block":
        written = written.replace(r"\frac", r"\dfrac")
    unit = caption.text.unit if isinstance(caption.text, Number) else ""
    return f"${written}\\,\\mathrm{{{unit}}}$" if unit else f"${written}$"


def _extent(text: str, size: float) -> tuple[float, float]:
    """The width and height of mathematics in points, by its letters: good enough to keep it clear."""
    tall = 1.9 if "frac" in text else 1.25
    plain = re.sub(
        r"\\(frac|left|right|mathrm)|[{}$^_\\ ]",
        "",
        re.sub(r"\\(?!frac|left|right|mathrm)[a-zA-Z]+", "M", text),
    )
    letters = len(plain) / (1.7 if "frac" in text else 1.0)
    return 0.55 * size * max(1.0, letters), tall * size
