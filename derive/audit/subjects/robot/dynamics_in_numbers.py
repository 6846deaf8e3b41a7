"""Dynamics told in numbers alone: at the point of their author, where letters were too many."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import mpmath
import numpy as np

from derive.audit.asked import Asked, Holds, Test
from derive.audit.equations import is_system
from derive.audit.linear import inverse, product, solve, transposed
from derive.audit.points import Irrational, Number, Point, shown
from derive.audit.subjects.robot.arm import numbers
from derive.audit.subjects.robot.bodies import Mechanics
from derive.audit.subjects.robot.task import Task

NEAR = mpmath.mpf(10) ** -9


def is_in_numbers(asked: Asked) -> bool:
    """Whether D and what follows from it are told without a letter."""
    ends = [asked.results[name] for name in ("qddot", "Lambda") if name in asked.results]
    if "D" not in asked.results or not asked.evaluated or any(map(is_system, ends)):
        return False
    return not any(entry.free_symbols for row in asked.result("D") for entry in row)


def there(asked: Asked, point: Point) -> Mechanics:
    """The arm at the author's point. Raises Irrational at a point in fractions."""
    if point.exact:
        raise Irrational
    fixed = {name: asked.formula(value) for name, value in (asked.evaluate or {}).items()}
    return Mechanics(asked, Point(point.seed, False, point.angles, point.assumptions, fixed))


def moved(asked: Asked, point: Point) -> Iterator[Test]:
    """D, h and the accelerations."""
    arm = there(asked, point)
    D, rest = numbers(arm.D), arm.rest.tolist()
    yield from _same(asked, "D", D)
    yield from _same(asked, "h", rest)
    forces = [[force] for force in arm.torques - arm.rest]
    yield from _same(asked, "qddot", [row[0] for row in solve(D, forces)])


def shown_at_the_hand(asked: Asked, point: Point) -> Iterator[Test]:
    """J, D and the inverse of J D^-1 J^T."""
    arm = there(asked, point)
    J, D = Task(arm).J, numbers(arm.D)
    yield from _same(asked, "J", J)
    yield from _same(asked, "D", D)
    yield from _same(asked, "Lambda", inverse(product(J, solve(D, transposed(J)))))


def _same(asked: Asked, name: str, theirs: Sequence[Any]) -> Iterator[Test]:
    for told in (name, f"evaluated {name}"):
        pairs = list(zip(_flat(asked.result(told)), _flat(theirs), strict=True))
        size = max(1, *(abs(b) for _, b in pairs))
        for ours, other in pairs:
            yield Holds(told, abs(mpmath.mpf(str(ours)) - other) < NEAR * size, f"it has {shown(other)}")


def _flat(values: Any) -> list[Number]:
    return list(np.array(values, dtype=object).ravel())
