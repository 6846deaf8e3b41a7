"""Which solutions keep every joint in its range."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from derive.algebra.numbers.floats import number
from derive.derivation import Claim, Phrase
from derive.expression import Expr, Relation
from derive.kinds.checks import route
from derive.kinds.fields import Place
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.evaluated import Evaluated
from derive.kinds.robot._ranges import ranges_told
from derive.kinds.values_at import point_of

EDGE = 1e-9  # radians or metres: a joint at the end of its range is in it
Limits = Mapping[str, tuple[float, float]]


@dataclass(frozen=True, slots=True)
class Ranges:
    """The `limits` of joints, those in `slides` in metres, the others in radians up to full turns, where it
    `turns`; None where they rest on letters that have no value."""

    told: tuple[Relation, ...]
    limits: Limits | None
    slides: frozenset[str]
    turns: bool

    @staticmethod
    def of(problem: Problem, place: Place | None) -> Ranges:
        robot = problem.subject
        slides = frozenset(link.variable for link in robot.links if link.joint == "prismatic")
        turns = bool(robot.ranges.keys() - slides)
        return Ranges(ranges_told(robot), _limits(robot.ranges, problem, place), slides, turns)

    def judged(self, found: Evaluated) -> Evaluated:
        """Each solution with whether it is `feasible`; where a joint is free nothing is said."""
        if not self._decides(found):
            return found
        solutions = [
            {**each, "feasible": self._keeps(each)} if _is_one(each) else each
            for each in found.values["solutions"]
        ]
        return replace(found, values={**found.values, "solutions": solutions})

    @property
    def said(self) -> Phrase | None:
        """Which solutions count; nothing where no joint has a range."""
        if not self.told:
            return None
        return Phrase("feasible-by-turns" if self.turns else "feasible", {"ranges": self.told})

    @property
    def of_angles(self) -> Limits:
        """In radians, those of joints that turn."""
        return {name: ends for name, ends in (self.limits or {}).items() if name not in self.slides}

    def claims(self, found: Evaluated) -> Iterator[Claim]:
        """A joint turns within its range where it is no further from the middle than the ends are, and slides
        there where it is no further from each end than the other one."""
        if self._decides(found):
            real = [each for each in found.values["solutions"] if _is_one(each)]
            yield route("ranges", [*map(self._is_judged, real)] or [True])

    def _decides(self, found: Evaluated) -> bool:
        return bool(self.told) and self.limits is not None and found.numbers is not None

    def _keeps(self, entry: Mapping[str, Any]) -> bool:
        return all(self.within(name, entry[name]) for name in self.limits or {})

    def within(self, name: str, value: float) -> bool:
        """Whether a joint that has limits is between them, or could be by full turns."""
        low, high = (self.limits or {})[name]
        if name not in self.slides:
            value += math.tau * math.ceil((low - EDGE - value) / math.tau)
        return low - EDGE <= value <= high + EDGE

    def _is_judged(self, entry: Mapping[str, Any]) -> bool:
        inside = []
        for name, (low, high) in (self.limits or {}).items():
            off, half = entry[name] - (low + high) / 2, (high - low) / 2
            if name not in self.slides:
                off = math.atan2(math.sin(off), math.cos(off))
            inside.append(abs(off) <= half + EDGE)
        return all(inside) == bool(entry["feasible"])


def _limits(ranges: Mapping[str, Sequence[Expr]], problem: Problem, place: Place | None) -> Limits | None:
    """In numbers, at the place."""
    point = dict(point_of(dict(place or ()), problem.where))
    try:
        return {name: (number(low, point), number(high, point)) for name, (low, high) in ranges.items()}
    except KeyError:
        return None


def _is_one(entry: Mapping[str, Any]) -> bool:
    """Whether it has a value for each joint."""
    return bool(entry.get("real", True)) and "free" not in entry
