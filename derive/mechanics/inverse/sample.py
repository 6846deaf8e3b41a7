"""Poses an arm reaches, in numbers: where an equation holds nothing by chance, it holds nothing here."""

from __future__ import annotations

import math
import random
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from derive.algebra.numbers.floats import Point, scalar_number
from derive.algebra.scalar import Scalar

NEARLY_ZERO = 1e-9


@dataclass(frozen=True, slots=True)
class Samples:
    """Values for every name: parameters, joint variables, and what is given of the end-effector."""

    points: tuple[Point, ...]

    def vanishes(self, *values: Scalar) -> bool:
        """Whether all of these are zero at every pose, though their polynomials may not be."""
        return all(abs(scalar_number(v, point)) < NEARLY_ZERO for v in values for point in self.points)


def configurations(
    parameters: Iterable[str],
    turning: Sequence[str],
    slides: Mapping[str, bool],
    count: int,
    seed: int = 1,
) -> Iterator[dict[str, float]]:
    """Random values of parameters (0.2 to 1.9), angles (a whole turn) and displacements, which are positive
    where that is said of them."""
    draw = random.Random(seed)
    names = sorted(set(parameters) - {*turning, *slides})
    for _ in range(count):
        point = {name: draw.uniform(0.2, 1.9) for name in names}
        point |= {name: draw.uniform(-math.pi, math.pi) for name in turning}
        for name, positive in slides.items():
            point[name] = draw.uniform(0.2, 1.9) * (1 if positive else draw.choice((1, -1)))
        yield point
