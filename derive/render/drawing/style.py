"""What every picture looks like: colours that grey print keeps apart, dashes, widths and sizes, in points.

The text of a page is 160 mm wide and 11 pt high; letters in a picture are a little smaller.
A line is known by its dash or its width as well as by its colour, so that it is found again in grey.
"""

from __future__ import annotations

from dataclasses import dataclass

TEXT_WIDE, TEXT_HIGH = 453.5, 680.0  # points: the text of a page
WIDEST, HIGHEST = 0.75 * TEXT_WIDE, 0.38 * TEXT_HIGH  # of a picture; a page allows 0.4 of its height
LETTERS, SMALL = 10.5, 9.0  # captions, and what stands at the ticks of an axis

INK, GREY, FAINT, PALE = "#1c1c1c", "#707070", "#a0a0a0", "#e4e4e4"
RED, GREEN, BLUE = "#b3261e", "#2f8f3a", "#173f8a"  # 0.27, 0.45 and 0.22 as grey
SERIES = (BLUE, "#c4561b", "#3f9a4a", "#7a4fa3", "#9a7a1c", GREY)
DASHES: tuple[tuple[float, ...], ...] = ((), (6, 2.5), (1.2, 2), (6, 2, 1.2, 2), (3, 1.8), (9, 2.5))
REGION = "#dfe7f2"


@dataclass(frozen=True, slots=True)
class Pen:
    """A line: its colour, its width, and its dash (lengths of strokes and gaps; () is a whole line)."""

    colour: str = INK
    width: float = 0.8
    dash: tuple[float, ...] = ()
    cap: str = "butt"


def series_pen(place: int) -> Pen:
    """The line of a curve among several, known by its dash as well as by its colour."""
    return Pen(SERIES[place % len(SERIES)], 1.5, DASHES[place % len(DASHES)])


# What strokes of drawings stand for, by their roles. An arrow has a head at its end.
LINES = {
    "link": Pen("#b4b4b4", 5.5, cap="round"),
    "rod": Pen("#8a8a8a", 2.6),
    "gripper": Pen(INK, 1.6),
    "bar": Pen(INK, 1.4, cap="round"),
    "thin": Pen(INK, 0.8),
    "hidden": Pen(GREY, 0.6, (3, 2)),
    "edge": Pen(INK, 0.9, cap="round"),
    "leader": Pen(GREY, 0.4),
    "wire": Pen(INK, 0.9),
    "other": Pen("#cfcfcf", 4.0, cap="round"),
}
ARROWS = {
    "x": Pen(RED, 1.2),
    "y": Pen(GREEN, 1.2),
    "z": Pen(BLUE, 1.2),
    "before": Pen(FAINT, 1.0),
    "arc": Pen(INK, 0.8),
    "turn": Pen(INK, 0.8),
    "measure": Pen(INK, 0.6),
    "way": Pen(GREY, 0.7, (3, 2)),
    "arrow": Pen(INK, 0.9),
    "lost": Pen(RED, 1.2, (4, 2)),
}
AREAS = {
    "body": ("#dcdcdc", Pen(INK, 0.7)),
    "cap": ("#f6f6f6", Pen(INK, 0.7)),
    "pin": (INK, Pen(INK, 0.4)),
    "ground": ("#ececec", Pen(GREY, 0.6)),
    "box": ("#ffffff", Pen(INK, 0.9)),
    "face": ("#f3f3f3", Pen(INK, 0.8)),
}
LETTER_COLOURS = {"x": RED, "y": GREEN, "z": BLUE, "before": GREY}
HEAD_LONG, HEAD_WIDE = 5.0, 4.0  # of an arrow
