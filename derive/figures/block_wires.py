"""The wires of a block diagram: from block to block by corners, with the names of signals and the signs of
sums; every wire that branches has a dot there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import pi
from typing import TYPE_CHECKING

from derive.control.diagram import Block, Line
from derive.derivation import Caption, Place, Stroke
from derive.errors import NotDerivable
from derive.figures.block_clear import Wire, corners, is_clear
from derive.figures.view import around

if TYPE_CHECKING:
    from derive.figures.block_layout import Layout

CIRCLE = 28
TAP, OUTER, DOT = 9.0, 23.0, 1.7  # points behind a block where wires branch, and the radius of the dot there
SOURCE, OUT = 22.0, 30.0  # points that a wire leads in from outside, and out
BELOW = 14.0  # points beyond everything that a wire runs which goes round
BACK, ASIDE = 4.5, 5.5  # points from the head of an arrow to the sign with which it is summed


@dataclass(slots=True)
class Wires:
    """What is drawn of a layout."""

    layout: Layout
    strokes: list[Stroke] = field(default_factory=list)
    captions: list[Caption] = field(default_factory=list)
    signs: list[Caption] = field(default_factory=list)
    ways: list[Wire] = field(default_factory=list)
    around: dict[int, int] = field(default_factory=dict)  # how many wires go round above and below

    def drawn(self) -> tuple[list[Stroke], list[Caption]]:
        """Wires first, then what they end at. Raises NotDerivable where that could not be read."""
        named: set[str] = set()
        for line in sorted(self.layout.diagram.lines, key=self._bends):
            self._wire(line, named)
        self._out()
        for block in self.layout.diagram.blocks:
            self._block(block)
        boxes = [corners(stroke.places) for stroke in self.strokes if stroke.role == "box"]
        if not is_clear(self.ways, boxes):
            raise NotDerivable("wires of its block diagram would run through blocks or upon each other")
        return self.strokes, [*self.captions, *self.signs]

    def _bends(self, line: Line) -> bool:
        """Straight wires are named rather than those with corners."""
        (ax, ay), (bx, by) = self.layout.at[line.source], self.layout.at[line.target]
        return ay != by or ax > bx or self._between(ax, bx, ay)

    def _wire(self, line: Line, named: set[str]) -> None:
        diagram = self.layout.diagram
        source, target = diagram.block(line.source), diagram.block(line.target)
        way = self._way(source, target)
        self.ways.append((source.name, way))
        self.strokes.append(Stroke(way, "arrow"))
        if target.shape == "sum":
            self.signs.append(_sign(way, target.signs[line.port - 1]))
        if way[0][0] > self.layout.at[source.name][0] + self.layout.half[source.name]:
            self.strokes.append(Stroke(tuple(_dot(way[0])), "pin"))
        apart = source.shape == "source" and way[0][1] != 0.0  # comes in at each place anew
        if (source.name not in (*named, diagram.output) and self.layout.is_signal(source.name)) or apart:
            named.add(source.name)
            self.captions.append(self._name(source, way))

    def _out(self) -> None:
        output = self.layout.diagram.output
        x, y = self.layout.at[output]
        start = x + self.layout.half[output]
        looped = any(self._back(line) for line in self.layout.diagram.lines)
        end = start + OUT + (OUTER - TAP if looped else 0.0)
        self.strokes.append(Stroke(((start, y), (end, y)), "arrow"))
        self.captions.append(Caption((end - 8.0, y), output, (0.0, 1.0), "signal"))

    def _back(self, line: Line) -> bool:
        """Whether it leads back along the forward path."""
        (ax, ay), (bx, by) = self.layout.at[line.source], self.layout.at[line.target]
        return ay == by and ax > bx

    def _block(self, block: Block) -> None:
        (x, y), half, high = self.layout.at[block.name], self.layout.half[block.name], self.layout.high / 2
        if block.shape == "sum":
            turns = (2 * pi * k / CIRCLE for k in range(CIRCLE))
            self.strokes.append(Stroke(tuple(around((x, y), half, turn) for turn in turns), "box"))
        elif block.shape != "source":
            corners = ((x - half, y - high), (x + half, y - high), (x + half, y + high), (x - half, y + high))
            self.strokes.append(Stroke(corners, "box"))
            self.captions.append(self.layout.label(block))

    def _name(self, block: Block, way: tuple[Place, ...]) -> Caption:
        """The signal that leaves a block, once."""
        (ax, ay), (bx, by) = way[0], way[1]
        if block.shape == "source" and ay != 0:
            return Caption((ax, ay), block.name, (0.0, 1.0 if ay > by else -1.0), "signal")
        if ay == by:
            x = ax + 6.0 if block.shape == "source" else (ax + bx) / 2
            return Caption((x, ay), block.name, (0.0, 1.0 if ay >= 0 else -1.0), "signal")
        return Caption((ax, (ay + by) / 2), block.name, (1.0, 0.0), "signal")

    # -- ways -------------------------------------------------------------------------------------

    def _way(self, source: Block, target: Block) -> tuple[Place, ...]:
        """From the right of a block to the left of another in its row; to and from other rows by corners."""
        layout = self.layout
        (ax, ay), (bx, by) = layout.at[source.name], layout.at[target.name]
        right, left = ax + layout.half[source.name], bx - layout.half[target.name]
        reach = layout.half[target.name] if target.shape == "sum" else layout.high / 2
        if source.shape == "source" and ay != 0:
            side = 1 if ay > by else -1
            return (bx, by + side * (reach + SOURCE)), (bx, by + side * reach)
        if ay == by and ax < bx and not self._between(ax, bx, ay):
            return (right, ay), (left, by)
        if ay == by:
            return self._round(right + (TAP if ax < bx else OUTER), ay, bx, 1 if ax < bx else -1, reach)
        if ay == 0:  # branches off the forward path into a block of another row
            into = left if bx > right + TAP else bx + layout.half[target.name]
            return (right + TAP, 0.0), (right + TAP, by), (into, by)
        out = right if bx > ax else ax - layout.half[source.name]
        return (out, ay), (bx, ay), (bx, by - reach if ay < by else by + reach)

    def _between(self, ax: float, bx: float, y: float) -> bool:
        """Whether a block stands in the way of a straight wire."""
        return any(ax < x < bx and y == row for x, row in self.layout.at.values())

    def _round(self, ax: float, y: float, bx: float, side: int, reach: float) -> tuple[Place, ...]:
        """Along the row and past all blocks: above them forwards, below them backwards, each further out."""
        rows = [row for name, (_, row) in self.layout.at.items() if self.layout.half[name]]
        self.around[side] = self.around.get(side, 0) + 1
        edge = max(side * row for row in rows) + self.layout.high / 2 + BELOW * self.around[side]
        return (ax, y), (ax, side * edge), (bx, side * edge), (bx, y + side * reach)


def _sign(way: tuple[Place, ...], sign: int) -> Caption:
    """Outside the sum, beside the head of the arrow: on its right, and below one that comes from the left,
    above which the name of its signal stands."""
    (sx, sy), (ex, ey) = way[-2:]
    back = (sx > ex) - (sx < ex), (sy > ey) - (sy < ey)
    side = (1, 0) if back[1] else (0, -1)
    at = ex + BACK * back[0] + ASIDE * side[0], ey + BACK * back[1] + ASIDE * side[1]
    return Caption(at, "+" if sign > 0 else "-", role="sign")


def _dot(center: Place) -> Iterator[Place]:
    return (around(center, DOT, 2 * pi * k / CIRCLE) for k in range(CIRCLE))
