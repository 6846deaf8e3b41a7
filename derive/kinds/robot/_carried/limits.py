"""Whether joints on a path keep their ranges."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

from derive.algebra.numbers.floats import Point, number
from derive.derivation import Phrase
from derive.expression import Approximate, Measured, Symbol
from derive.kinds.robot._carried.sampled import Sampled
from derive.kinds.robot._carried.setting import Setting

SLACK = 1e-9
Ranges = Mapping[str, tuple[float, float]]


def ranges_of(given: Setting) -> Ranges:
    """Of the joints that have one, in numbers."""
    found = given.problem.subject.ranges.items()
    return {name: (number(low, given.point), number(high, given.point)) for name, (low, high) in found}


def leaves(found: Sampled, ranges: Ranges) -> tuple[str, float] | None:
    """The joint that is beyond its range first, and when; None where all keep theirs."""
    for t, row in zip(found.times, found.values[0], strict=True):
        for name, q in zip(found.robot.variables, row, strict=True):
            low, high = ranges.get(name, (q, q))
            if not low - SLACK <= q <= high + SLACK:
                return name, float(t)
    return None


def said_of_ranges(found: Sampled | None, ranges: Ranges) -> Phrase | None:
    """What the page says of them; None where no joint has one."""
    if found is None or not ranges:
        return None
    if (first := leaves(found, ranges)) is None:
        return Phrase("keeps-ranges" if len(ranges) > 1 else "keeps-range")
    name, t = first
    when = Measured(Approximate(t), "s")
    return (
        Phrase("leaves-range", {"joint": Symbol(name), "t": when})
        if t
        else Phrase("begins-beyond", {"joint": Symbol(name)})
    )


def holds(said: Phrase, found: Sampled, ranges: Ranges, at: Any) -> Iterator[bool]:
    """Whether that is so of the joints worked out anew (`at` a time), between the samples too."""
    beyond = []
    for low, high in pairwise(map(float, found.times)):
        q: Point = at((low + high) / 2)
        out = [name for name, (least, most) in ranges.items() if not least <= q[name] <= most]
        beyond += [(high, name) for name in out]
    if said.key.startswith("keeps"):
        yield not beyond
        return
    told = said.about["joint"]
    first, names = beyond[0][0], {name for when, name in beyond if when == beyond[0][0]}
    yield isinstance(told, Symbol) and told.name in names
    when = said.about.get("t", Approximate(0.0))
    value = when.value if isinstance(when, Measured) else when
    yield isinstance(value, Approximate) and abs(value.value - first) < 2 * (found.times[1] - found.times[0])
