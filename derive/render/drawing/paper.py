"""A sheet of paper to draw on, in points from the lower left; Typst makes SVG, PDF or PNG of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import dist, hypot
from pathlib import Path
from typing import Literal, TypeAlias

from derive.derivation import Place
from derive.render.drawing.style import HEAD_LONG, HEAD_WIDE, INK, LETTERS, Pen

Kind: TypeAlias = Literal["svg", "pdf", "png"]
DENSITY = 200.0  # pixels an inch
LEAST = 2.2  # lengths of its head that an arrow has at least
# Letters are as large as their ink: what `lettering` measures is what is covered.
FONTS = """\
#set text(font: "New Computer Modern", top-edge: "bounds", bottom-edge: "bounds")
#show math.equation: set text(font: "New Computer Modern Math", top-edge: "bounds", bottom-edge: "bounds")
"""


@dataclass(slots=True)
class Paper:
    """What has been drawn so far, from back to front."""

    wide: float
    high: float
    drawn: list[str] = field(default_factory=list)

    def line(self, places: Sequence[Place], pen: Pen) -> None:
        """A line through places."""
        self._curve(places, f"stroke: {_stroke(pen)}", closed=False)

    def area(self, places: Sequence[Place], fill: str, pen: Pen | None = None) -> None:
        """A filled shape, with or without its outline."""
        stroke = _stroke(pen) if pen else "none"
        self._curve(places, f'fill: rgb("{fill}"), stroke: {stroke}', closed=True)

    def arrow(self, places: Sequence[Place], pen: Pen) -> None:
        """A line with a head at its end, a smaller one where it is short."""
        (ax, ay), (bx, by) = _before_end(places), places[-1]
        size = hypot(bx - ax, by - ay) or 1.0
        dx, dy = (bx - ax) / size, (by - ay) / size
        short = min(1.0, sum(dist(a, b) for a, b in pairwise(places)) / (LEAST * HEAD_LONG))
        long, half = short * HEAD_LONG, short * HEAD_WIDE / 2
        foot = (bx - long * dx, by - long * dy)
        self.line((*_cut(places, 0.8 * long), (bx - 0.8 * long * dx, by - 0.8 * long * dy)), pen)
        wings = ((foot[0] - half * dy, foot[1] + half * dx), (foot[0] + half * dy, foot[1] - half * dx))
        self.area((wings[0], (bx, by), wings[1]), pen.colour)

    def letters(
        self, left: float, high: float, written: str, colour: str = INK, size: float = LETTERS
    ) -> None:
        """Typst content whose ink has its upper left corner there."""
        text = f'text(size: {size}pt, fill: rgb("{colour}"), {written})'
        self.drawn.append(f"#place(top + left, dx: {left:.2f}pt, dy: {self.high - high:.2f}pt, {text})")

    def turned(self, left: float, high: float, written: str, size: float = LETTERS) -> None:
        """Typst content turned to read upwards, its ink from there."""
        text = f"rotate(-90deg, reflow: true, text(size: {size}pt, {written}))"
        self.drawn.append(f"#place(top + left, dx: {left:.2f}pt, dy: {self.high - high:.2f}pt, {text})")

    def _curve(self, places: Sequence[Place], look: str, closed: bool) -> None:
        at = [f"({x:.2f}pt, {self.high - y:.2f}pt)" for x, y in places]
        path = [f"curve.move({at[0]})", *(f"curve.line({place})" for place in at[1:])]
        path += ["curve.close()"] if closed else []
        self.drawn.append(f"#place(top + left, curve({look}, {', '.join(path)}))")

    def source(self) -> str:
        """The page in Typst."""
        page = f"width: {self.wide:.2f}pt, height: {self.high:.2f}pt, margin: 0pt, fill: none"
        return "\n".join((f"#set page({page})", FONTS, *self.drawn))

    def write(self, target: Path, kinds: Sequence[Kind]) -> tuple[Path, ...]:
        """Writes files of these kinds, the same bytes each time; `target` is their path without suffix."""
        target.parent.mkdir(parents=True, exist_ok=True)
        source = self.source().encode()
        written = tuple(target.with_name(f"{target.name}.{kind}") for kind in kinds)
        for kind, path in zip(kinds, written, strict=True):
            path.write_bytes(compiled(source, kind))
        return written


def compiled(source: bytes, kind: Kind) -> bytes:
    """A page of Typst as a file of this kind."""
    from typst import Compiler

    page = Compiler(source, ignore_system_fonts=True).compile(format=kind, ppi=DENSITY, timestamp=0)
    return page if isinstance(page, bytes) else b"".join(page or ())


def _stroke(pen: Pen) -> str:
    dash = f", dash: ({', '.join(f'{part}pt' for part in pen.dash)})" if pen.dash else ""
    look = f'paint: rgb("{pen.colour}"), thickness: {pen.width}pt, cap: "{pen.cap}", join: "round"'
    return f"({look}{dash})"


def _before_end(places: Sequence[Place]) -> Place:
    """A place on the line as far before its end as a head is long, which gives the head its direction."""
    x, y = places[-1]
    return next((p for p in reversed(places) if hypot(x - p[0], y - p[1]) >= 0.9 * HEAD_LONG), places[0])


def _cut(places: Sequence[Place], short: float) -> tuple[Place, ...]:
    """The line without what lies under its head."""
    x, y = places[-1]
    kept = tuple(p for p in places[:-1] if hypot(x - p[0], y - p[1]) > short)
    return kept or (places[0],)
