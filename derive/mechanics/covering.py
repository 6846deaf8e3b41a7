"""How often a plane is covered by a map of it: a grid of values, its squares cut into triangles, and how many
of these lie over each place."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

CELLS = 240  # of a side of a frame
THIN, SLIM = 8.0, 100.0  # times as long as wide, from which on cells are too, and up to which
ROOM = 3  # cells around what is covered
SMALLEST = 12  # cells of a region that is told of
BETWEEN = 6  # places that are looked at on the way from one value to the next


@dataclass(frozen=True)
class Covering:
    """The image (x, y: n by m each) of a grid; x is never below zero. `beside` are places (x, y) on the way
    to the axis, where lines between those of the grid miss it."""

    x: Array
    y: Array
    beside: tuple[Array, Array] | None = None

    @cached_property
    def size(self) -> tuple[float, float]:
        """That of a cell: square, unless what is covered is so thin that few would lie across it."""
        x, y = (float(each.max() - each.min()) / CELLS for each in (self.x, self.y))
        if max(x, y) < THIN * min(x, y):
            return max(x, y), max(x, y)
        return max(x, y / SLIM), max(y, x / SLIM)

    @cached_property
    def corner(self) -> tuple[float, float]:
        """The lower left one of the frame."""
        x, y = self.size
        return float(self.x.min()) - ROOM * x, float(self.y.min()) - ROOM * y

    def middle(self, i: int, j: int) -> tuple[float, float]:
        """Of a cell."""
        return self.corner[0] + (i + 0.5) * self.size[0], self.corner[1] + (j + 0.5) * self.size[1]

    @cached_property
    def counts(self) -> Array:
        """How many triangles lie over the middle of each cell (counted along x, then along y); -1 where x is
        below zero."""
        import numpy as np

        shape = [
            int(np.ceil((e.max() - e.min()) / s)) + 2 * ROOM
            for e, s in zip((self.x, self.y), self.size, strict=True)
        ]
        found = np.zeros(shape, dtype=int)
        u, v = (each - 0.5 for each in self._cells)
        corners = [(each[:-1, :-1], each[1:, :-1], each[:-1, 1:], each[1:, 1:]) for each in (u, v)]
        for a, b, c in ((0, 1, 2), (3, 2, 1)):
            xs, ys = (np.stack([each[k].ravel() for k in (a, b, c)]) for each in corners)
            _add(found, xs, ys)
        beyond = [i for i in range(shape[0]) if self.middle(i, 0)[0] < 0]
        found[beyond] = -1
        return found

    @property
    def _cells(self) -> Iterator[Array]:
        """x and y in cells from the corner."""
        return self._in_cells(self.x, self.y)

    def _in_cells(self, *places: Array) -> Iterator[Array]:
        return ((each - low) / size for each, low, size in zip(places, self.corner, self.size, strict=True))

    @cached_property
    def met(self) -> Array:
        """The cells in which values of the grid lie, or a line from one to the next."""
        import numpy as np

        found = np.zeros(self.counts.shape, dtype=bool)
        x, y = self._cells
        for one, other in ((np.s_[:-1], np.s_[1:]), (np.s_[:, :-1], np.s_[:, 1:])):
            for k in range(BETWEEN + 1):
                share = k / BETWEEN
                i, j = ((each[one] + share * (each[other] - each[one])).astype(int) for each in (x, y))
                found[i, j] = True
        if self.beside:
            i, j = (each.astype(int) for each in self._in_cells(*self.beside))
            found[i, j] = True
        return found

    @cached_property
    def regions(self) -> tuple[tuple[int, Array], ...]:
        """Connected cells with one count, and that count, none too few of them; the largest first. What is
        covered may be narrower than a cell where it comes to the axis: no way leads out of a void there."""
        import numpy as np

        left = (self.counts > 0) | ((self.counts == 0) & ~self.met)
        found = []
        while left.any():
            start = np.unravel_index(int(left.argmax()), left.shape)
            part = _grown(start, left & (self.counts == self.counts[start]))
            left &= ~part
            if int(part.sum()) >= SMALLEST:
                found.append((int(self.counts[start]), part))
        return tuple(sorted(found, key=lambda each: -int(each[1].sum())))

    def innermost(self, part: Array) -> tuple[float, float]:
        """The middle of the cell of a region that is furthest from what is not of it."""
        import numpy as np

        here = part
        while (inner := _shrunk(here)).any():
            here = inner
        cells = np.argwhere(here)
        i, j = (int(k) for k in cells[len(cells) // 2])
        return self.middle(i, j)


def _add(found: Array, xs: Array, ys: Array) -> None:
    """Counts the cells whose middles, which are whole numbers here, lie in triangles (corners 3 by N)."""
    import numpy as np

    area = (xs[1] - xs[0]) * (ys[2] - ys[0]) - (xs[2] - xs[0]) * (ys[1] - ys[0])
    keep = np.abs(area) > 0
    xs, ys, area = xs[:, keep], ys[:, keep], area[keep]
    low = [np.ceil(each.min(axis=0)).astype(int) for each in (xs, ys)]
    spread = [
        np.floor(each.max(axis=0)).astype(int) - start for each, start in zip((xs, ys), low, strict=True)
    ]
    for i in range(int(spread[0].max(initial=-1)) + 1):
        wide = spread[0] >= i
        for j in range(int(spread[1][wide].max(initial=-1)) + 1):
            some = wide & (spread[1] >= j)
            px, py = low[0][some] + i, low[1][some] + j
            inside = np.ones(len(px), dtype=bool)
            sign = np.sign(area[some])
            for k in range(3):
                n = (k + 1) % 3
                ax, ay, bx, by = xs[k][some], ys[k][some], xs[n][some], ys[n][some]
                side = ((bx - ax) * (py - ay) - (by - ay) * (px - ax)) * sign
                # an edge belongs to one of the two triangles beside it
                own = (by - ay) * sign > 0
                own |= (by == ay) & ((bx - ax) * sign < 0)
                inside &= (side > 0) | ((side == 0) & own)
            np.add.at(found, (px[inside], py[inside]), 1)


def _grown(start: tuple[Any, ...], like: Array) -> Array:
    """All that hangs together with a cell, side by side."""
    import numpy as np

    part = np.zeros(like.shape, dtype=bool)
    part[start] = True
    front = [(int(start[0]), int(start[1]))]
    while front:
        i, j = front.pop()
        for a, b in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
            inside = 0 <= a < like.shape[0] and 0 <= b < like.shape[1]
            if inside and like[a, b] and not part[a, b]:
                part[a, b] = True
                front.append((a, b))
    return part


def _shrunk(part: Array) -> Array:
    """Without its outermost cells."""
    inner = part.copy()
    inner[0], inner[-1], inner[:, 0], inner[:, -1] = False, False, False, False
    inner[1:-1, 1:-1] &= part[:-2, 1:-1] & part[2:, 1:-1] & part[1:-1, :-2] & part[1:-1, 2:]
    return inner
