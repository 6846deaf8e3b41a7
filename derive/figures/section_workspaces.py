"""Pictures of workspaces in section through the first axis: how often each position is reached, or the curve
on which the point goes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from derive.derivation import Curve, Label, Phrase, Plot
from derive.figures.axes import short
from derive.figures.workspaces import with_unit
from derive.mechanics.covering import Covering

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

Place = tuple[float, float]


def covered(covering: Covering, told: Mapping[str, float], unit: str) -> Plot:
    """The section with the number of configurations that reach each part."""
    counts = sorted({count for count, _ in covering.regions if count > 0})
    called = (Phrase("just-one" if count == 1 else "so-many", {"count": count}) for count in counts)
    drawn = (_filled(covering, covering.counts == count) for count in counts)
    regions: dict[Label, Curve] = dict(zip(called, drawn, strict=True))
    return _in_section({}, regions, told, unit)


def carried(rho: Array, z: Array, told: Mapping[str, float], unit: str) -> Plot:
    """The curve of one joint."""
    curve = tuple(map(float, rho)), tuple(map(float, z))
    return _in_section({Phrase("curve"): curve}, {}, told, unit)


def _in_section(
    series: dict[Label, Curve], regions: dict[Label, Curve], told: Mapping[str, float], unit: str
) -> Plot:
    about = {name: short(value) for name, value in told.items() if name != "r_min"}
    return Plot(
        "workspace", with_unit("distance", unit), with_unit("height-on-axis", unit), series, regions=regions,
        equal=True, caption=Phrase("drawn-through-axis"), alt=Phrase("seen-through-axis", about),
    )  # fmt: skip


def _filled(covering: Covering, part: Array) -> Curve:
    places = outlines(part)
    (x, y), (wide, high) = covering.corner, covering.size
    return tuple(x + wide * i for i, _ in places), tuple(y + high * j for _, j in places)


def outlines(part: Array, straight: bool = True) -> list[Place]:
    """Of cells, one after the other, with a way there and back that fills nothing; where lines of cells are
    not `straight` in the figure, with every corner."""
    places: list[Place] = []
    for loop in _loops(part):
        outline = [*_smooth(loop, straight)]
        places += [*outline, outline[0], *places[:1]]
    return places


def _loops(part: Array) -> Iterator[list[tuple[int, int]]]:
    """The corners around cells, with them to the left."""
    ends: dict[tuple[int, int], list[tuple[int, int]]] = {}
    n, m = part.shape

    def is_in(i: int, j: int) -> bool:
        return 0 <= i < n and 0 <= j < m and bool(part[i, j])

    for i, j in ((int(a), int(b)) for a, b in zip(*part.nonzero(), strict=True)):
        for beside, start, end in (
            ((i, j - 1), (i, j), (i + 1, j)),
            ((i + 1, j), (i + 1, j), (i + 1, j + 1)),
            ((i, j + 1), (i + 1, j + 1), (i, j + 1)),
            ((i - 1, j), (i, j + 1), (i, j)),
        ):
            if not is_in(*beside):
                ends.setdefault(start, []).append(end)
    while ends:
        start = next(iter(ends))
        loop = [start]
        while True:
            following = ends[loop[-1]]
            there = following.pop()
            if not following:
                del ends[loop[-1]]
            if there == start:
                break
            loop.append(there)
        yield loop


def _smooth(loop: list[tuple[int, int]], straight: bool) -> Iterator[Place]:
    """The middles of its edges, those in one straight line left out."""
    middles = [
        ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in zip(loop, [*loop[1:], loop[0]], strict=True)
    ]
    for before, here, after in zip(
        [middles[-1], *middles[:-1]], middles, [*middles[1:], middles[0]], strict=True
    ):
        turn = (here[0] - before[0]) * (after[1] - here[1]) - (here[1] - before[1]) * (after[0] - here[0])
        if turn or not straight:
            yield here
