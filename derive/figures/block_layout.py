"""A block diagram laid out on paper: the forward path in a row, what feeds back below, disturbances above."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import pi

from derive.algebra.readable.terms import Style
from derive.control.diagram import Block, Diagram
from derive.control.rational import Rational
from derive.control.system import System
from derive.derivation import Caption, Drawing, Place, Stroke
from derive.expression import ONE, Expr, Quotient, Symbol, add, multiply
from derive.figures.block_diagram import drawn
from derive.figures.view import around

S = Symbol("s")
GAP, ROW = 1.0, 1.6  # between blocks, and between rows
HIGH = 1.05  # a block
SUM = 0.2  # the radius of a sum
LETTER = 0.23  # the width of a letter
CIRCLE = 28


def drawn_blocks(system: System, whole: Rational, style: Style) -> Drawing:
    """The diagram of a system as a teacher draws it. Raises NotDerivable where none can be built."""
    diagram, _ = drawn(system, whole, None, style)
    return Layout(diagram, system.names).drawing()


@dataclass(slots=True)
class Layout:
    """Where everything stands; columns from left to right, rows from 0 (the forward path) down and up."""

    diagram: Diagram
    signals: frozenset[str]  # with a name of their own in the equations
    at: dict[str, Place] = field(default_factory=dict)
    size: dict[str, float] = field(default_factory=dict)  # half the width of each block

    def drawing(self) -> Drawing:
        """The diagram drawn, blocks upon wires."""
        for block in self.diagram.blocks:
            self.size[block.name] = _half(block)
        self._place_path()
        self._place_others()
        strokes, captions = [], []
        for part in (*self._wires(), *self._blocks()):
            strokes += part[0]
            captions += part[1]
        return Drawing("figure", tuple(strokes), tuple(captions))

    # -- places -----------------------------------------------------------------------------------

    def path(self) -> list[str]:
        """The longest way from the input to the output without going round."""
        follows: dict[str, list[str]] = {}
        for line in self.diagram.lines:
            follows.setdefault(line.source, []).append(line.target)
        best: list[str] = []
        stack = [[self.diagram.input]]
        while stack:
            way = stack.pop()
            if way[-1] == self.diagram.output:
                best = max(best, way, key=len)
                continue
            stack += [[*way, name] for name in follows.get(way[-1], ()) if name not in way]
        return best

    def _place_path(self) -> None:
        x = 0.0
        for name in self.path():
            x += self.size[name]
            self.at[name] = (x, 0.0)
            x += self.size[name] + GAP

    def _place_others(self) -> None:
        """Beside what they feed: sources above it, all others below, between where they start and end."""
        waiting = [block for block in self.diagram.blocks if block.name not in self.at]
        rows: dict[int, list[tuple[float, float, int]]] = {1: [], -1: []}
        while waiting:
            ready = [b for b in waiting if any(t in self.at for t in self._targets(b.name))] or waiting[:1]
            for block in ready:
                waiting.remove(block)
                self._place(block, rows)

    def _place(self, block: Block, rows: dict[int, list[tuple[float, float, int]]]) -> None:
        ends = [
            self.at[n][0] for n in (*self._targets(block.name), *self.diagram.into(block)) if n in self.at
        ]
        x = sum(ends) / len(ends) if ends else 0.0
        below = any(self.at[n][1] < 0 for n in self._targets(block.name) if n in self.at)
        driven = all(self.diagram.block(name).shape == "source" for name in self.diagram.into(block))
        side = 1 if driven and not below else -1
        spread = (max(ends) - min(ends)) / 2 if ends else 0.0  # its wires need room too
        half = max(self.size[block.name], spread) + GAP / 2
        level = 1
        while any(row == level and abs(x - other) < half + width for other, width, row in rows[side]):
            level += 1
        rows[side].append((x, half, level))
        self.at[block.name] = (x, side * level * ROW)

    def _targets(self, name: str) -> list[str]:
        return [line.target for line in self.diagram.lines if line.source == name]

    # -- what is drawn ----------------------------------------------------------------------------

    def _blocks(self) -> Iterator[tuple[list[Stroke], list[Caption]]]:
        for block in self.diagram.blocks:
            x, y = self.at[block.name]
            if block.shape == "source":
                continue
            if block.shape == "sum":
                turns = (2 * pi * k / CIRCLE for k in range(CIRCLE))
                yield [Stroke(tuple(around((x, y), SUM, turn) for turn in turns), "box")], []
                continue
            half = self.size[block.name]
            corners = (
                (x - half, y - HIGH / 2),
                (x + half, y - HIGH / 2),
                (x + half, y + HIGH / 2),
                (x - half, y + HIGH / 2),
            )
            yield [Stroke(corners, "box")], [Caption((x, y), _label(block), role="block")]

    def _wires(self) -> Iterator[tuple[list[Stroke], list[Caption]]]:
        named: set[str] = set()
        for line in self.diagram.lines:
            source, target = self.diagram.block(line.source), self.diagram.block(line.target)
            sign = target.signs[line.port - 1] if target.shape == "sum" else 1
            way = self._way(source, target)
            captions = [] if sign > 0 else [Caption(_before(way), "-", self._aside(way), "sign")]
            if source.name not in (*named, self.diagram.output) and self._is_signal(source.name):
                named.add(source.name)
                captions.append(self._name(source, way))
            yield [Stroke(way, "arrow")], captions
        x, y = self.at[self.diagram.output]
        half = self.size[self.diagram.output]
        end = (x + half + 0.9, y)
        name = Caption((x + half + 0.75, y), self.diagram.output, (0.0, 1.0))
        yield [Stroke(((x + half, y), end), "arrow")], [name]

    def _is_signal(self, name: str) -> bool:
        """Whether it is one of the author's, or a derivative of one."""
        return name in self.signals or name.removesuffix("_dot").removesuffix("_ddot") in self.signals

    def _name(self, block: Block, way: tuple[Place, ...]) -> Caption:
        """The signal that leaves a block, once."""
        (ax, ay), (bx, by) = way[0], way[1]
        if block.shape == "source" and ay != by:
            return Caption((ax, ay), block.name, (0.0, 1.0 if ay > by else -1.0))
        middle = ((ax + bx) / 2, (ay + by) / 2) if block.shape != "source" else (ax + 0.1, ay)
        return Caption(middle, block.name, (1.0, 0.0) if ay != by else (0.0, 1.0 if ay >= 0 else -1.0))

    def _way(self, source: Block, target: Block) -> tuple[Place, ...]:
        """From the right of a block to the left of another in its row; to and from other rows by corners."""
        (ax, ay), (bx, by) = self.at[source.name], self.at[target.name]
        right, left = ax + self.size[source.name], bx - self.size[target.name]
        if ay == by and ax < bx:
            return (right, ay), (left, by)
        if source.shape == "source":
            reach = SUM if target.shape == "sum" else HIGH / 2
            return (ax, ay), (bx, by + (reach if ay > by else -reach))
        tap = right + GAP / 2
        if ay == 0:  # branches off the forward path into a block of another row, entered from the right
            return (tap, 0.0), (tap, by), (bx + self.size[target.name], by)
        reach = SUM if target.shape == "sum" else HIGH / 2
        return (ax - self.size[source.name], ay), (bx, ay), (bx, by - reach if ay < by else by + reach)

    def _aside(self, way: tuple[Place, ...]) -> Place:
        (ax, _), (bx, _) = way[-2], way[-1]
        return (-1.0, 0.2) if ax == bx else (-0.2, -1.0)


def _half(block: Block) -> float:
    if block.shape == "source":
        return 0.0
    if block.shape == "sum":
        return SUM
    return max(0.5, LETTER * _letters(_label(block)))


def _letters(label: Expr) -> float:
    from derive.algebra.infix import text

    if isinstance(label, Quotient):
        return max(_letters(label.numerator), _letters(label.denominator))
    plain = text(label).replace("*", "").replace("**", "").replace("_", "")
    return 0.5 + 0.5 * len(plain)


def _label(block: Block) -> Expr:
    """The transfer function of a block."""
    top, bottom = _polynomial(block.num), _polynomial(block.den)
    return ONE if top == bottom else top if bottom == ONE else top / bottom


def _polynomial(coefficients: tuple[Expr, ...]) -> Expr:
    powers = (ONE, S, *(S**k for k in range(2, len(coefficients))))
    return add(*(multiply(c, powers[k]) for k, c in reversed(list(enumerate(reversed(coefficients))))))


def _before(way: tuple[Place, ...]) -> Place:
    """Just before the end of a line."""
    (ax, ay), (bx, by) = way[-2], way[-1]
    size = max(abs(bx - ax), abs(by - ay)) or 1.0
    return bx + (ax - bx) * 0.28 / size, by + (ay - by) * 0.28 / size
