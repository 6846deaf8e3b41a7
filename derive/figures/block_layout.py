"""A block diagram laid out on paper: the forward path in a row, what feeds back below, disturbances above."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from derive.control.diagram import Block, Diagram
from derive.derivation import Caption, Drawing, Phrase, Place, Stroke, Words
from derive.errors import NotDerivable
from derive.expression import ONE, Expr, Symbol, add, multiply
from derive.figures.block_wires import Wires
from derive.figures.extent import extent

S = Symbol("s")
GAP, ROOM = 16.0, 11.0  # points between blocks, at least, and beside the name of a signal there
PADDING = 5.0  # round a label
LEAST = 20.0  # a block is not smaller
SUM = 10.0  # the radius of a sum
BETWEEN = 20.0  # rows
WIDEST = 640.0  # points: on the page letters would be too small
UP, DOWN = (0.0, 1.0), (0.0, -1.0)


@dataclass(slots=True)
class Layout:
    """Where everything stands, in points: columns from left to right, rows from 0 (the forward path) down
    and up. `signals` have names of their own; `labels` stand for transfer functions, by block."""

    diagram: Diagram
    signals: frozenset[str]
    labels: Mapping[str, str] = field(default_factory=dict)
    at: dict[str, Place] = field(default_factory=dict)
    half: dict[str, float] = field(default_factory=dict)  # of the width of each block
    high: float = LEAST  # of every block

    def drawing(
        self, name: str, caption: Phrase | None, seen: Phrase | None, framed: Framed | None = None
    ) -> Drawing:
        """The diagram drawn, blocks upon wires. Raises NotDerivable where that could not be read."""
        for block in self.diagram.blocks:
            wide, high = self._label_size(block)
            self.half[block.name] = SUM if block.shape == "sum" else max(LEAST, wide + 2 * PADDING) / 2
            self.high = max(self.high, high + 2 * PADDING if block.shape not in ("sum", "source") else 0.0)
            if block.shape == "source":
                self.half[block.name] = 0.0
        self._place_path()
        self._place_others()
        if max(x + self.half[name] for name, (x, _) in self.at.items()) > WIDEST:
            raise NotDerivable("its block diagram would be too wide for a page")
        strokes, captions = Wires(self).drawn()
        if framed:
            frame, title = framed.drawn(self)
            strokes, captions = [frame, *strokes], [*captions, title]
        return Drawing(name, tuple(strokes), tuple(captions), caption, seen, unit=1.0)

    def label(self, block: Block) -> Caption:
        """What stands in a block."""
        said = self.labels.get(block.name)
        return Caption(
            self.at[block.name], Words(f"${said}$") if said else transfer_label(block), role="block"
        )

    def is_signal(self, name: str) -> bool:
        """Whether it has a name, or is the derivative of what has one."""
        return name in self.signals or name.removesuffix("_dot").removesuffix("_ddot") in self.signals

    def _label_size(self, block: Block) -> tuple[float, float]:
        if block.name in self.labels:
            return 5.6 * len(self.labels[block.name]), 11.0
        return extent(transfer_label(block))

    # -- places -----------------------------------------------------------------------------------

    def path(self) -> list[str]:
        """The longest way from the input to the output without going round; through what adds up, the first
        of several ways."""
        best: list[str] = []
        stack = [[self.diagram.input]]
        while stack:
            way = stack.pop()
            if way[-1] == self.diagram.output:
                best = max(best, way, key=len)
                continue
            stack += [[*way, name] for name in reversed(self.diagram.targets(way[-1])) if name not in way]
        return best

    def _place_path(self) -> None:
        x = 0.0
        for name in self.path():
            slot = max(self.half[beside] for beside in self._beside(name))
            x += slot
            self.at[name] = (x, 0.0)
            named = extent(Symbol(name))[0] + ROOM if self.is_signal(name) else 0.0
            taps = 6.0 if len(self.diagram.targets(name)) > 1 else 0.0
            x += slot + max(GAP, named) + taps

    def _beside(self, name: str) -> list[str]:
        """The blocks between the same two, which stand above and below each other."""
        block = self.diagram.block(name)
        ends = self.diagram.into(block), self.diagram.targets(name)
        return [
            b.name
            for b in self.diagram.blocks
            if (self.diagram.into(b), self.diagram.targets(b.name)) == ends
        ]

    def _place_others(self) -> None:
        """Beside what they feed: sources above it, what feeds back below, between where they start and end;
        what goes forward beside the path below and above it in turn."""
        waiting = [block for block in self.diagram.blocks if block.name not in self.at]
        rows: dict[int, list[tuple[float, float, int]]] = {1: [], -1: []}
        while waiting:
            ready = [
                b for b in waiting if any(t in self.at for t in self.diagram.targets(b.name))
            ] or waiting[:1]
            for block in ready:
                waiting.remove(block)
                self._place(block, rows)

    def _place(self, block: Block, rows: dict[int, list[tuple[float, float, int]]]) -> None:
        placed = [n for n in (*self.diagram.targets(block.name), *self.diagram.into(block)) if n in self.at]
        ends = [self.at[name][0] for name in placed]
        x = sum(ends) / len(ends) if ends else 0.0
        spread = (max(ends) - min(ends)) / 2 if ends else 0.0  # its wires need room too
        half = max(self.half[block.name], spread) + GAP / 2
        side = self._side(block, x, half, rows)
        level = 1
        while any(row == level and abs(x - other) < half + width for other, width, row in rows[side]):
            level += 1
        rows[side].append((x, half, level))
        self.at[block.name] = (x, side * level * (self.high + BETWEEN))

    def _side(
        self, block: Block, x: float, half: float, rows: Mapping[int, Iterable[tuple[float, float, int]]]
    ) -> int:
        below = any(self.at[n][1] < 0 for n in self.diagram.targets(block.name) if n in self.at)
        driven = all(self.diagram.block(name).shape == "source" for name in self.diagram.into(block))
        if driven:
            return -1 if below else 1
        forward = any(self.at[n][0] < x for n in self.diagram.into(block) if n in self.at)
        taken = any(abs(x - other) < half + width for other, width, _ in rows[-1])
        return 1 if forward and taken and not below else -1


@dataclass(frozen=True, slots=True)
class Framed:
    """Blocks drawn as one system, with its name."""

    names: frozenset[str]
    label: str

    def drawn(self, layout: Layout) -> tuple[Stroke, Caption]:
        """The frame round them, and its name inside it."""
        blocks = [b for b in layout.diagram.blocks if b.name in self.names and b.shape != "source"]
        left = min(layout.at[b.name][0] - layout.half[b.name] for b in blocks) - 9.0
        right = max(layout.at[b.name][0] + layout.half[b.name] for b in blocks) + 17.0
        low = min(layout.at[b.name][1] for b in blocks) - layout.high / 2 - 8.0
        high = max(layout.at[b.name][1] for b in blocks) + layout.high / 2 + 10.0
        edge = ((left, low), (right, low), (right, high), (left, high), (left, low))
        name = Words(f"${self.label}$")
        corner = 14.0  # from the middle of the name
        others = (((right - corner, high), UP), ((right - corner, low), DOWN), ((left + corner, low), DOWN))
        return Stroke(edge, "hidden"), Caption((left + corner, high), name, UP, "frame", others)


def transfer_label(block: Block) -> Expr:
    """The transfer function of a block."""
    top, bottom = _polynomial(block.num), _polynomial(block.den)
    return ONE if top == bottom else top if bottom == ONE else top / bottom


def _polynomial(coefficients: tuple[Expr, ...]) -> Expr:
    powers = (ONE, S, *(S**k for k in range(2, len(coefficients))))
    return add(*(multiply(c, powers[k]) for k, c in reversed(list(enumerate(reversed(coefficients))))))
