"""The solutions as a page counts them: the choices that make each, by their signs, and what it is called."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from derive.derivation import Cell, Condition, Phrase, Said, Table
from derive.expression import Product, Relation, number
from derive.kinds.robot._inverse.postures import Posture
from derive.kinds.robot._inverse.subproblem import Solved, Taken


@dataclass(frozen=True)
class Choices:
    """The sub-problems with two values, and of each solution what was `chosen` at them; the `postures` that
    have names."""

    two: Sequence[Solved]
    chosen: Sequence[Taken]
    postures: Sequence[Posture]

    @cached_property
    def signs(self) -> tuple[Mapping[int, int], ...]:
        """Of each solution the sign at each sub-problem, by number."""
        return signs_of(self.two, self.chosen)

    @cached_property
    def table(self) -> Table | None:
        """Which choices make each solution, where there are several: by the sign of what the condition is
        about, and by name."""
        if len(self.two) < 2:
            return None
        signs = [self._heading(each) for each in self.two]
        headings = (Phrase("solution"), *signs, *(Phrase(each.part) for each in self.postures))
        return Table(headings, tuple(map(self._row, range(len(self.chosen)))))

    def _row(self, k: int) -> tuple[Cell, ...]:
        signs = (self._cell(each, k) for each in self.two)
        return (str(k + 1), *signs, *(Phrase(each.sides[k]) for each in self.postures))

    def _heading(self, solved: Solved) -> Cell:
        when = self.chosen[0][solved.number].when
        return (
            when.left if isinstance(when, Relation) and not isinstance(when.left, Relation) else solved.head
        )

    def _cell(self, solved: Solved, k: int) -> Phrase:
        choice = self.chosen[k][solved.number]
        if isinstance(choice.when, Relation):
            return Phrase("plus" if choice.when.sign == ">" else "minus")
        return Phrase("first" if choice.sign > 0 else "second")

    def told(self, k: int) -> Iterator[tuple[Relation, str]]:
        """The conditions of a solution that stand in the table, with the key of what stands there."""
        assert self.table is not None
        for place, each in enumerate(self.two, 1):
            when, cell = self.chosen[k][each.number].when, self.table.rows[k][place]
            if isinstance(when, Relation) and isinstance(cell, Phrase):
                yield when, cell.key

    @property
    def count(self) -> Phrase:
        """How many solutions there are, and why."""
        if not self.two:
            return Phrase("unique")
        if len(self.two) == 1:
            one, other = (self._either(k) for k in (0, 1))
            return Phrase("two-solutions", {"one": one, "other": other})
        heads = tuple(each.head for each in self.two)
        product = Relation(Product((number(2),) * len(self.two)), "=", number(len(self.chosen)))
        return Phrase("together", {"chosen": heads, "product": product})

    def _either(self, k: int) -> Said:
        """One of two solutions: `elbow up (theta2 < 0)`."""
        (solved,) = self.two
        when = self.chosen[k][solved.number].when
        assert when is not None
        named = [each.said(k) for each in self.postures]
        about: dict[str, Said] = {"posture": named[0], "when": when} if named else {"when": when}
        return Phrase("posture-where" if named else "one-with", about)

    def called(self, branches: Sequence[int]) -> Cell:
        """What a solution at a pose is called, by the branches (from 0) that meet in it: their numbers in the
        table, or what is said of them all."""
        if self.table:
            return ", ".join(str(k + 1) for k in branches)
        shared = [self._conditions(k) for k in branches]
        found = tuple(each for each in shared[0] if all(each in other for other in shared[1:]))
        return found or (Phrase("both") if self.two else "")

    def _conditions(self, k: int) -> tuple[Condition, ...]:
        named = tuple(each.said(k) for each in self.postures)
        return named or tuple(c.when for c in self.chosen[k].values() if c.when)


def signs_of(two: Sequence[Solved], chosen: Sequence[Taken]) -> tuple[Mapping[int, int], ...]:
    """Of each solution the sign at each sub-problem with two values, by number."""
    return tuple({each.number: taken[each.number].sign for each in two} for taken in chosen)
