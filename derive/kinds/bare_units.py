"""Which units were typed with data that stand in formulas as numbers alone."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, get_args

from derive.derivation import Derivation
from derive.expression import Expr, Number, every, walk
from derive.kinds.problem import Problem
from derive.kinds.robot._lengths import unit_of_lengths
from derive.mechanics.fitting import PointPairs
from derive.mechanics.frames import Frames
from derive.mechanics.paths import Path
from derive.mechanics.robot import Robot

TREES = get_args(Expr)


def bare_units(problem: Problem) -> frozenset[str]:
    """Meters where lengths of an arm, of frames, of measured points or of a path were typed in them,
    kilograms where masses of an arm were, seconds where times of a path were."""
    if isinstance(problem.subject, Robot):
        weighed = any(unit.startswith("kg") for unit in _units(problem.subject))
        return frozenset(filter(None, (unit_of_lengths(problem), "kg" if weighed else "")))
    if isinstance(problem.subject, Path):
        return meters_and_seconds((problem.subject, *problem.where.values()))
    if isinstance(problem.subject, PointPairs | Frames):
        return frozenset({"m"} & {*_units((problem.subject, *problem.where.values()))})
    return frozenset()


def meters_and_seconds(data: Any) -> frozenset[str]:
    """Which of them were typed with data, alone or in a velocity."""
    units = "/".join(_units(data)).split("/")
    return frozenset(unit[0] for unit in units if unit and unit[0] in "ms")


def bare_in_lines(answers: Sequence[Derivation]) -> frozenset[str]:
    """Newtons, where a force was typed in them that stands in a line; seconds, where a motion over
    time is told with sizes that were typed in them, alone or in a velocity."""
    found = frozenset({"N"} & {*_units(_lines(answers))})
    moving = tuple(each.facts for each in answers if "s" in each.units.values())
    units = "/".join(_units(moving)).split("/")
    return found | {"s"} if any(unit[:1] == "s" for unit in units) else found


def _lines(answers: Iterable[Derivation]) -> tuple[tuple[Expr, ...], ...]:
    return tuple(step.chain for answer in answers for step in answer.steps)


def _units(value: Any) -> Iterator[str]:
    """Those of all numbers in a record."""
    for part in every(value):
        if isinstance(part, TREES):
            yield from (node.unit for node in walk(part) if isinstance(node, Number))
