"""Where an arm is singular: an angle that its equations leave open is chosen, and the others follow from it.

There the determinant of the two equations an angle was found by vanishes. Any other two equations that
hold it alone, with what is known by then, will do; where there are none it is free, and zero is taken.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations

from derive.algebra.angles import Form
from derive.algebra.compiled import compiled
from derive.algebra.numeric import Point, scalar_number
from derive.kinds.robot._inverse.branches import Solutions
from derive.kinds.robot._inverse.moves import Definition, Move, Option
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.knowledge import Knowledge
from derive.mechanics.inverse.plan import Plan, learned
from derive.mechanics.inverse.search import Stage
from derive.mechanics.inverse.trigonometric import Row, TwoEquations

VANISHING = 1e-7  # of a determinant: below, the equations leave the angle open
USABLE = 1e-4  # above, two others determine it
Found = dict[str, float]


@dataclass(frozen=True, slots=True)
class Singularity:
    """The moves once more, each pair of equations looked at in numbers before it is used."""

    solutions: Solutions
    chain: Chain
    plan: Plan

    def tries(self, values: Found | None, taken: Mapping[int, Option], point: Point) -> Iterator[Found]:
        """The values of a branch, and those with free angles chosen."""
        for found in (values, self._again(taken, dict(point))):
            if found is not None:
                yield found

    def _again(self, taken: Mapping[int, Option], known: Found) -> Found | None:
        """The branch with free angles zero; None where none is free, or a value is not real."""
        forms: list[Form] = []
        values: list[float] = []
        knowledge: dict[int, Knowledge] = {}
        free = False
        try:
            for item in self.solutions.items:
                if isinstance(item, Definition):
                    known[item.name.name] = compiled(item.value)(known)
                    continue
                stage, found = self.plan.found[item.number]
                before = knowledge.get(id(stage)) or Knowledge.of(self.chain, stage.joints)
                value = self._open(stage, found, before, known)
                free |= value is not None
                value = compiled(taken[item.number].value)(known) if value is None else value
                known |= self._learned(item, value, forms, values)
                knowledge[id(stage)] = learned(before, found)
        except (ValueError, ZeroDivisionError):
            return None
        return {name: known[name] for name in self.solutions.joints} if free else None

    def _learned(self, move: Move, value: float, forms: list[Form], values: list[float]) -> Found:
        if isinstance(move.of, str):
            return {move.of: value}
        forms.append(move.of)
        values.append(value)
        return self.solutions.angles(forms, values)

    def _open(self, stage: Stage, found: object, before: Knowledge, known: Found) -> float | None:
        """The angle by two other equations, or zero, where its own leave it open; None elsewhere."""
        if not isinstance(found, TwoEquations):
            return None
        if abs(scalar_number(found.determinant, known)) > VANISHING:
            return None
        rows = [_numbers(row, known) for row in stage.rows(before, found.angle)]
        best = max(combinations(rows, 2), key=_determinant, default=None)
        if best is None or _determinant(best) < USABLE:
            return 0.0
        (a1, b1, c1), (a2, b2, c2) = best
        D = a1 * b2 - a2 * b1
        return math.atan2((a1 * c2 - a2 * c1) / D, (c1 * b2 - c2 * b1) / D)


Numbers = tuple[float, float, float]


def _numbers(row: Row, known: Found) -> Numbers:
    a, b, c = (scalar_number(value, known) for value in (row.a, row.b, row.c))
    return a, b, c


def _determinant(pair: tuple[Numbers, Numbers]) -> float:
    (a1, b1, _), (a2, b2, _) = pair
    return abs(a1 * b2 - a2 * b1)
