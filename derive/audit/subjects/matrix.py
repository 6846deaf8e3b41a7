"""A matrix that is given as such: in numbers at a point."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from derive.audit.asked import Asked, Test
from derive.audit.given_inertia import christoffel, properties
from derive.audit.linear import Rows
from derive.audit.points import Point
from derive.audit.redundant import rates
from derive.audit.singular_sets import singular_sets
from derive.audit.spaces import spaces
from derive.mechanics.matrices import GivenMatrix


def rank(asked: Asked, point: Point) -> Iterator[Test]:
    """The matrix in the configuration of the question."""
    there = asked.here if asked.options.evaluate else point.in_digits()
    yield from spaces(asked, _rows(asked, asked.subject.value.rows, there), there)


def redundancy(asked: Asked, point: Point) -> Iterator[Test]:
    """The rates that give a velocity."""
    given: GivenMatrix = asked.subject
    there = asked.here if asked.options.evaluate else point.in_digits()
    J, second = _rows(asked, given.value.rows, there), asked.options.second
    names = tuple(f"v_{k}" for k, _ in enumerate(J, 1))
    joints = given.variables or tuple(f"q{k}" for k, _ in enumerate(J[0], 1))
    yield from rates(asked, J, there, names, joints, _rows(asked, second.matrix, there) if second else [])


def singularities(asked: Asked, point: Point) -> Iterator[Test]:
    """Where the matrix loses rank."""
    yield from singular_sets(asked, point, lambda at: _rows(asked, asked.subject.value.rows, at))


def _rows(asked: Asked, rows: Any, there: Point) -> Rows:
    return [[there.at(asked.formula(entry)) for entry in row] for row in rows]


KINDS = {
    "rank": rank,
    "redundancy": redundancy,
    "singularities": singularities,
    "christoffel": christoffel,
    "properties": properties,
}
