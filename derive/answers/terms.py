"""On what terms two scalars are compared, what is found, and the points at which both are looked at."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal, TypeAlias

from flint import arb

from derive.answers.points import Names, Point, Sampling, turning, unknowns, value_at
from derive.expression import Expr

Verdict: TypeAlias = Literal["equal", "differs", "undecided"]
Solution: TypeAlias = Mapping[str, Expr]  # the value of each unknown
TRIED = 60  # points, until
ENOUGH = 8  # of them give real values


@dataclass(frozen=True)
class Terms:
    """On what terms two scalars are compared: what names stand for in each, and where to look."""

    published: Names
    derived: Names
    sampling: Sampling = field(default_factory=Sampling)
    angle: bool = False  # up to whole turns
    evaluated: bool = False  # in numbers, at a point of the sheet's
    own: Names = field(default_factory=dict)  # those names that the published solution gives a value itself

    @property
    def names(self) -> tuple[Names, Names]:
        """What names stand for in the published scalar, and in the derived one."""
        return self.published, self.derived

    def points(self, left: Expr, right: Expr, odd: bool = False) -> Iterator[Point]:
        """Points for what two scalars depend on; at `odd` ones all that may be negative is."""
        names = unknowns(left, self.published) | unknowns(right, self.derived)
        signed = turning((left,), self.published) | turning((right,), self.derived)
        sampling = replace(self.sampling, signed=self.sampling.signed | signed)
        yield from (sampling.odd if odd else sampling.usual)(names, TRIED)


@dataclass(frozen=True)
class Finding:
    """A verdict; where it differs a point, and the values there (None where there is none)."""

    verdict: Verdict
    witness: Point = field(default_factory=dict)
    values: tuple[float | None, float | None] | None = None
    note: str = ""


def values(
    published: Expr, derived: Expr, terms: Terms, odd: bool = False
) -> Iterator[tuple[Point, arb | None, arb | None]]:
    """Values at points until enough have both."""
    both = 0
    for point in terms.points(published, derived, odd):
        theirs = value_at(published, terms.published, point)
        ours = value_at(derived, terms.derived, point)
        yield point, theirs, ours
        both += theirs is not None and ours is not None
        if both == ENOUGH:
            return


def where_both_are(published: Expr, derived: Expr, terms: Terms) -> list[Point]:
    """The points at which both have values."""
    found = values(published, derived, terms)
    return [point for point, theirs, ours in found if theirs is not None and ours is not None]
