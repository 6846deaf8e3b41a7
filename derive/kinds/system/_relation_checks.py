"""Whether relations hold at a point, where floats tell."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from derive.algebra.numbers.floats import number
from derive.expression import Relation
from derive.kinds.fields import TREES

CLEAR = 1e-7  # of the sides of a relation: closer ones are not told apart


def holds(relation: Relation, at: Mapping[str, float]) -> bool | None:
    """Whether it holds; None where its sides are too close."""
    if not isinstance(relation.left, TREES):
        return None
    left, right = number(relation.left, at), number(relation.right, at)
    if left == right:
        return False
    if abs(left - right) <= CLEAR * max(abs(left), abs(right), 1e-3):
        return None
    return (left > right) == (relation.sign == ">")


def all_hold(relations: Iterable[Relation], at: Mapping[str, float]) -> bool | None:
    """Whether all hold."""
    found = [holds(each, at) for each in relations]
    return False if False in found else None if None in found else True
