"""A matrix that is given as such: in numbers at a point."""

from __future__ import annotations

from collections.abc import Iterator

from derive.audit.asked import Asked, Test
from derive.audit.points import Point
from derive.audit.spaces import spaces
from derive.mechanics.matrices import GivenMatrix


def rank(asked: Asked, point: Point) -> Iterator[Test]:
    """The matrix in the configuration of the question."""
    given: GivenMatrix = asked.subject
    there = asked.here if asked.options.evaluate else point.in_digits()
    rows = [[there.at(asked.formula(entry)) for entry in row] for row in given.value.rows]
    yield from spaces(asked, rows, there)


KINDS = {"rank": rank}
