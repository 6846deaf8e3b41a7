"""An array of Routh as it stands on the page, with the conditions that are concluded from it."""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from derive.algebra.numbers.floats import number
from derive.derivation import Step
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Matrix, Relation, Symbol, free_symbols
from derive.kinds.fields import TREES
from derive.kinds.system._stability_facts import Facts

TRIED, LARGEST = 40, 6.0  # points, and the largest value of a symbol there
FAR = (-2, 3)  # powers of ten of which some are drawn, for conditions as K < 30
SOUGHT, SIZES = 300, (-3, 2)  # points, and powers of ten, where a stable loop is sought
NOWHERE = (ValueError, ZeroDivisionError, OverflowError, NotDerivable)


@dataclass(frozen=True)
class Printed:
    """What stands on the page: the array as a result, the conditions, the steps, and what the words are
    told."""

    routh: Matrix
    conditions: tuple[Relation, ...]
    steps: Sequence[Step]
    told: Facts
    positive: frozenset[str]
    letter: str  # of the entries
    epsilon: Symbol | None  # the small number, where it takes the place of an entry

    @cached_property
    def symbols(self) -> list[str]:
        """Those the array is made of, without the small number."""
        sides = [side for each in self.conditions for side in (each.left, each.right)]
        trees = [
            *(entry for row in self.routh.rows for entry in row),
            *(t for t in sides if isinstance(t, TREES)),
        ]
        found = frozenset[str]().union(*map(free_symbols, trees))
        small = {self.epsilon.name} if self.epsilon else frozenset[str]()
        return sorted(found - {"pi"} - small)

    @property
    def degree(self) -> int:
        """Of the polynomial: the array has one row more."""
        return len(self.routh.rows) - 1

    @property
    def coefficients(self) -> tuple[Expr, ...]:
        """Of the polynomial, highest power first: the first two rows in turn, as the second was before it was
        mended."""
        first, second = self.routh.rows[:2]
        if self.first_mended == 2:
            second = (ZERO, *second[1:]) if second[0] == self.epsilon else (ZERO,) * len(second)
        both = [entry for pair in zip(first, second, strict=True) for entry in pair]
        return tuple(both[: self.degree + 1])

    @property
    def first_mended(self) -> int:
        """The first row that was mended; the one after the last where none was."""
        small = (i for i, row in enumerate(self.routh.rows, 1) if row[0] == self.epsilon)
        rows = (int(s.name.rsplit("_", 1)[-1]) for s in self.steps if s.rule == "auxiliary")
        return min((*small, *rows), default=self.degree + 2)

    def points(self) -> Iterator[tuple[dict[str, float], list[float]]]:
        """Values of the symbols and the polynomial there; every second point has negative ones, every third
        small and large ones. Points where it is not real, or of lower degree, are passed over."""
        draw = random.Random(" ".join(self.symbols))
        for k in range(TRIED if self.symbols else 1):
            at = {
                name: (draw.uniform(0.05, LARGEST) if k % 3 else 10 ** draw.uniform(*FAR))
                * (1 if name in self.positive or k % 2 else draw.choice((1, -1)))
                for name in self.symbols
            }
            yield from self._there(at)

    def far_and_near(self) -> Iterator[tuple[dict[str, float], list[float]]]:
        """Many values of every size, and the polynomial there: a region of stable loops may be small."""
        draw = random.Random(" ".join(self.symbols))
        for k in range(SOUGHT if self.symbols else 0):
            sizes = {name: 10 ** draw.uniform(*SIZES) for name in self.symbols}
            yield from self._there(
                {
                    name: size if name in self.positive or k % 2 else draw.choice((1, -1)) * size
                    for name, size in sizes.items()
                }
            )

    def _there(self, at: dict[str, float]) -> Iterator[tuple[dict[str, float], list[float]]]:
        try:
            found = [number(each, at) for each in self.coefficients]
        except NOWHERE:
            return
        if found[0]:
            yield at, found
