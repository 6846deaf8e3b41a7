"""points: the same points measured in two frames."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import Field

from derive.errors import how_many
from derive.expression import Expr
from derive.kinds.fields import OptionsModel, Quantity
from derive.mechanics.fitting import PointPairs
from derive.sheet.source import At, Faults
from derive.sheet.subjects.registry import Known

Coordinates: TypeAlias = Annotated[list[Quantity], Field(max_length=10)]
PointList: TypeAlias = Annotated[list[Coordinates], Field(min_length=1, max_length=200)]


class Given(OptionsModel):
    """Points in two frames."""

    source: PointList = Field(alias="from")
    """The points in frame A."""
    target: PointList = Field(alias="to")
    """The same points in frame B, in the same order."""


def build(given: Given, at: At, known: Known) -> PointPairs:
    """The pairs of a problem. Raises SheetErrors: unequal counts, or not two or three coordinates each."""
    faults = Faults()
    if len(given.source) != len(given.target):
        message = f"{how_many(len(given.source), 'point')} in from:, but {len(given.target)} in to:"
        faults.append(at.fault(message, ("to",), "give each point its partner, in the same order"))
    size = len(given.source[0])
    for key, points in (("from", given.source), ("to", given.target)):
        for index, point in enumerate(points):
            if len(point) not in (2, 3):
                message = f"a point has two or three coordinates, not {len(point)}"
                faults.append(at.fault(message, (key, index), "write [x, y, z]"))
            elif len(point) != size:
                message = f"a point of {len(point)} coordinates among points of {size}"
                faults.append(at.fault(message, (key, index), "give every point as many coordinates"))
    if not faults and len(given.source) < size:
        few = "one point does" if len(given.source) == 1 else f"{len(given.source)} points do"
        faults.append(at.fault(f"{few} not fix a frame", ("from",), f"give at least {size} points"))
    faults.settle()
    return PointPairs(_frozen(given.source), _frozen(given.target))


def _frozen(points: list[list[Expr]]) -> tuple[tuple[Expr, ...], ...]:
    return tuple(tuple(point) for point in points)
