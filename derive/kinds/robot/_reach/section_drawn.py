"""A section as it is drawn against places in numbers: each lies in its part, and the parts are no larger."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from derive.derivation import Curve, Phrase, Plot
from derive.kinds.robot._reach.swept import Sample

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

SQUARES, THROWN, MOSTLY = 60, 200, 0.9


def in_its_part(plot: Plot, sample: Sample) -> bool:
    """Whether a place lies in the part of a figure that is drawn for its number, and in no other."""
    drawn = {
        label.about["count"]: _is_within(curve, sample)
        for label, curve in plot.regions.items()
        if isinstance(label, Phrase)
    }
    wanted = drawn.pop(sample.count, sample.count == 0)
    return wanted and not any(drawn.values())


def _is_within(curve: Curve, sample: Sample) -> bool:
    """Whether a way from it to the right crosses the outline an odd number of times."""
    inside = False
    for (x, y), (u, v) in pairwise(zip(*curve, strict=True)):
        if (y > sample.z) != (v > sample.z) and sample.rho < x + (sample.z - y) * (u - x) / (v - y):
            inside = not inside
    return inside


def fills(curve: Curve, x: Array, y: Array) -> Iterator[bool]:
    """Whether an outline encloses what places cover, up to cells at its border that have none: as much, and
    nearly all of them."""
    import numpy as np

    u, v = (np.array(each) for each in curve)
    area = abs(float(u[:-1] @ v[1:] - u[1:] @ v[:-1]) / 2)
    size = max(float(np.ptp(x)), float(np.ptp(y))) / SQUARES
    cells = np.zeros((SQUARES + 1, SQUARES + 1), dtype=bool)
    cells[((x - x.min()) / size).astype(int), ((y - y.min()) / size).astype(int)] = True
    edges = sum(int((a != b).sum()) for a, b in ((cells[1:], cells[:-1]), (cells[:, 1:], cells[:, :-1])))
    yield float(cells.sum()) - edges <= area / size**2 <= float(cells.sum()) + edges / 2
    some = np.random.default_rng(0).integers(0, x.size, THROWN)
    inside = [_is_within(curve, Sample(float(x[k]), float(y[k]), 1)) for k in some]
    yield float(np.mean(inside)) > MOSTLY
