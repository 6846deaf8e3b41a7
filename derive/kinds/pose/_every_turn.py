"""Every axis and angle that make a rotation: the opposite turn, and the singular cases of any rotation."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from derive.derivation import Branch, Phrase, Record, Said, Step
from derive.expression import (
    MINUS_ONE,
    ONE,
    ZERO,
    Expr,
    Matrix,
    Relation,
    Symbol,
    column,
    replace,
    sin,
    sqrt,
    transpose,
)
from derive.expression import number as exact
from derive.kinds.pose._given import Given, diagonal
from derive.kinds.pose._numbers import fixed_angle


class Half(Record):
    """Half a turn about an axis whose first components vanish."""

    axis: str  # a step
    where: tuple[Relation, ...]


class Singular(Record):
    """What is left where the sine vanishes: the trace of R where nothing is turned, and of half a turn."""

    none: Relation
    half: Relation
    angles: tuple[Expr, Expr]
    outer: tuple[Expr, Expr]  # k k^T of half a turn
    cases: tuple[Half, ...]


@dataclass(frozen=True, slots=True)
class EveryTurn:
    """The turns of a rotation, by the names of its angle and its axis."""

    given: Given
    angle: Symbol
    axis: Symbol

    def branches(self, angle: Expr, axis: Matrix, half: bool) -> tuple[Branch, ...]:
        """The turn that was found and the opposite one, which of half a turn is by the same angle; then the
        singular ones of any rotation."""
        back = angle if half else -angle
        found = tuple(
            Branch({"angle": by, "axis": along}, () if half else (Relation(sin(self.angle), sign, ZERO),))
            for by, along, sign in ((angle, axis, ">"), (back, opposite(axis), "<"))
        )
        return (*found, *self._singular()) if self.given.named else found

    def nothing(self) -> Branch:
        """Where nothing is turned."""
        about: dict[str, Said] = {"at": self._typed(self.facts().none), "axis": self.axis}
        return Branch({"angle": ZERO}, (Phrase("any-axis", about),))

    def _singular(self) -> Iterator[Branch]:
        """No turn; then each case of half a turn with its opposite."""
        yield self.nothing()
        by = fixed_angle(Fraction(1), self.given.problem)
        for k, case in enumerate(self.facts().cases):
            columns, size = half_axis(k)
            unit = (each / size if each != ZERO else ZERO for each in columns)
            axis = column(replace(each, self.given.entries) for each in unit)
            when = tuple(map(self._typed, (self.facts().half, *case.where)))
            for along in (axis, opposite(axis)):
                yield Branch({"angle": by, "axis": along}, when)

    def _typed(self, told: Relation) -> Relation:
        """A condition in the names of the sheet, where the entries are names."""
        if not self.given.named or isinstance(told.left, Relation):
            return told
        return Relation(replace(told.left, self.given.entries), told.sign, told.right)

    def steps(self) -> Iterator[Step]:
        """The axes of half a turn."""
        for k, case in enumerate(self.facts().cases):
            columns, size = half_axis(k)
            yield Step(
                case.axis, (self.axis, column(columns) if size == ONE else ONE / size * column(columns))
            )

    def facts(self) -> Singular:
        """What the words read."""
        one, two, _ = ends = [Relation(entry(i, i), "=", MINUS_ONE) for i in (1, 2, 3)]
        first, second = (Relation(end.left, ">", MINUS_ONE) for end in ends[:2])
        cases = ((first,), (one, second), (one, two))
        return Singular(
            none=Relation(diagonal(), "=", exact(3)),
            half=Relation(diagonal(), "=", MINUS_ONE),
            angles=(ZERO, fixed_angle(Fraction(1), self.given.problem)),
            outer=(self.axis * transpose(self.axis), (self.given.rotation + Symbol("I")) / 2),
            cases=tuple(Half(axis=f"axis_{k}", where=where) for k, where in enumerate(cases, 1)),
        )


def opposite(axis: Matrix) -> Matrix:
    """The unit vector the other way."""
    return column(-each if each != ZERO else ZERO for (each,) in axis.rows)


def half_axis(k: int) -> tuple[tuple[Expr, ...], Expr]:
    """Along the axis of half a turn whose first k components vanish, and the next is positive: that column of
    R + 1 (twice k k^T); and its length."""
    if k == 2:
        return (ZERO, ZERO, ONE), ONE
    j = k + 1
    rows = (1 + entry(j, j) if i == j else entry(i, j) for i in (1, 2, 3))
    return tuple(ZERO if i < k else row for i, row in enumerate(rows)), sqrt(2 * (1 + entry(j, j)))


def entry(row: int, col: int) -> Symbol:
    """r_32."""
    return Symbol(f"r_{row}{col}")
