"""The solutions as a page counts them: the choices that make each, by their signs, and what it is called."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from derive.derivation import Cell, Condition, Phrase, Said, Table
from derive.expression import Expr, Product, Relation, Symbol, number
from derive.kinds.robot._inverse.postures import Posture
from derive.kinds.robot._inverse.signs import leaves
from derive.kinds.robot._inverse.subproblem import Solved, Taken

LONG = 6  # names and numbers in a heading


@dataclass(frozen=True)
class Choices:
    """The sub-problems with two values, and of each solution what was `chosen` at them; the `postures` that
    have names."""

    two: Sequence[Solved]
    chosen: Sequence[Taken]
    postures: Sequence[Posture]
    free_name: Callable[[str], str]
    root: str = ""  # of a polynomial, that is one more name in the solutions

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

    @cached_property
    def names(self) -> Mapping[Expr, Symbol]:
        """What the table calls conditions that are too long for a heading."""
        long = [each for each in map(self._condition, self.two) if each and leaves(each) > LONG]
        return {
            each: Symbol(self.free_name("sigma" if len(long) == 1 else f"sigma_{k}"))
            for k, each in enumerate(long, 1)
        }

    def _row(self, k: int) -> tuple[Cell, ...]:
        signs = (self._cell(each, k) for each in self.two)
        return (str(k + 1), *signs, *(Phrase(each.sides[k]) for each in self.postures))

    def _heading(self, solved: Solved) -> Cell:
        condition = self._condition(solved)
        return solved.head if condition is None else self.names.get(condition, condition)

    def _condition(self, solved: Solved) -> Expr | None:
        """What is positive for the first value, and negative for the second."""
        return self.chosen[0][solved.number].signed

    def _cell(self, solved: Solved, k: int) -> Phrase:
        positive = self.chosen[k][solved.number].sign > 0
        if self._condition(solved) is None:
            return Phrase("first" if positive else "second")
        return Phrase("plus" if positive else "minus")

    def told(self, k: int) -> Iterator[tuple[Expr, str]]:
        """Of a solution what has its sign in the table, with the key of what stands there."""
        assert self.table is not None
        for place, each in enumerate(self.two, 1):
            condition, cell = self._condition(each), self.table.rows[k][place]
            if condition is not None and isinstance(cell, Phrase):
                yield condition, cell.key

    @property
    def count(self) -> Phrase:
        """How many solutions there are, and why."""
        about: dict[str, Said] = {"root": Symbol(self.root)} if self.root else {}
        if not self.two:
            return Phrase("unique-each" if self.root else "unique", about)
        if len(self.two) == 1:
            one, other = (self._either(k) for k in (0, 1))
            key = "two-solutions-each" if self.root else "two-solutions"
            return Phrase(key, {**about, "one": one, "other": other})
        heads = tuple(each.head for each in self.two)
        product = Relation(Product((number(2),) * len(self.two)), "=", number(len(self.chosen)))
        about |= {"chosen": heads, "product": product}
        if not self.names:
            return Phrase("together", about)
        names = tuple(Relation(name, "=", condition) for condition, name in self.names.items())
        return Phrase("together-named", {**about, "names": names})

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
        return named or tuple(c.when for c in self.chosen[k].values() if c.when and c.sign)


def signs_of(two: Sequence[Solved], chosen: Sequence[Taken]) -> tuple[Mapping[int, int], ...]:
    """Of each solution the sign at each sub-problem with two values, by number."""
    return tuple({each.number: taken[each.number].sign for each in two} for taken in chosen)
