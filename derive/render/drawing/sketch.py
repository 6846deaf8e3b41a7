"""Things drawn in points before the size of the paper is known, and the room that they take."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, TypeAlias

from derive.derivation import Caption, Place, Words
from derive.render.drawing.lettering import Written, written
from derive.render.drawing.paper import Paper
from derive.render.drawing.placing import Box
from derive.render.drawing.style import INK, SMALL, Pen

Shape: TypeAlias = Literal["line", "area", "arrow"]


@dataclass(frozen=True, slots=True)
class Ink:
    """A line, an arrow, or an area (filled with `fill`)."""

    shape: Shape
    places: tuple[Place, ...]
    pen: Pen | None
    fill: str = ""


@dataclass(frozen=True, slots=True)
class Text:
    """Words in their box; `turned` ones read upwards."""

    what: Written
    box: Box
    turned: bool = False
    colour: str = INK


@dataclass(slots=True)
class Sketch:
    """What has been drawn so far, from back to front; texts stand upon everything."""

    inks: list[Ink] = field(default_factory=list)
    texts: list[Text] = field(default_factory=list)

    def line(self, places: Sequence[Place], pen: Pen) -> None:
        self.inks.append(Ink("line", tuple(places), pen))

    def arrow(self, places: Sequence[Place], pen: Pen) -> None:
        self.inks.append(Ink("arrow", tuple(places), pen))

    def area(self, places: Sequence[Place], fill: str, pen: Pen | None = None) -> None:
        self.inks.append(Ink("area", tuple(places), pen, fill))

    def text(self, what: Written, left: float, low: float, turned: bool = False) -> None:
        """With the lower left corner of its ink there."""
        wide, high = (what.high, what.wide) if turned else (what.wide, what.high)
        self.texts.append(Text(what, Box(left, low, left + wide, low + high), turned))

    def add(self, other: Sketch, dx: float, dy: float) -> None:
        """Another sketch, moved."""
        for ink in other.inks:
            self.inks.append(replace(ink, places=tuple((x + dx, y + dy) for x, y in ink.places)))
        for text in other.texts:
            b = text.box
            self.texts.append(replace(text, box=Box(b.left + dx, b.low + dy, b.right + dx, b.high + dy)))

    @property
    def whole(self) -> Box:
        """The room that everything takes."""
        places = [place for ink in self.inks for place in ink.places]
        places += [place for text in self.texts for place in _corners(text.box)]
        xs, ys = [x for x, _ in places], [y for _, y in places]
        return Box(min(xs), min(ys), max(xs), max(ys))

    def paper(self, margin: float) -> Paper:
        """On a sheet of its size."""
        whole = self.whole.grown(margin)
        paper = Paper(whole.right - whole.left, whole.high - whole.low)
        for ink in self.inks:
            places = [(x - whole.left, y - whole.low) for x, y in ink.places]
            if ink.shape == "area":
                paper.area(places, ink.fill, ink.pen)
            elif ink.pen:
                (paper.line if ink.shape == "line" else paper.arrow)(places, ink.pen)
        for text in self.texts:
            left, high = text.box.left - whole.left, text.box.high - whole.low
            if text.turned:
                paper.turned(left, high, text.what.content, text.what.size)
            else:
                paper.letters(left, high, text.what.content, text.colour, text.what.size)
        return paper


def said(texts: Sequence[str], size: float = SMALL) -> list[Written]:
    """Words with mathematics between dollars, measured: one question to Typst for all."""
    return written((Caption((0.0, 0.0), Words(text)), size) for text in texts)


def _corners(box: Box) -> tuple[Place, Place]:
    return (box.left, box.low), (box.right, box.high)
