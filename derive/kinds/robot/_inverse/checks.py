"""Every branch put back through the forward kinematics in numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce

from derive.algebra.numbers.compiled import compiled
from derive.algebra.numbers.floats import Point
from derive.derivation import Claim, Condition, Phrase
from derive.expression import Expr
from derive.kinds.checks import SECOND_ROUTE
from derive.kinds.robot._inverse.branches import Solutions
from derive.kinds.robot._inverse.target import SAME, Target


@dataclass(frozen=True, slots=True)
class Tried:
    """What came of putting branches back at poses the arm reaches: whether each always reached them, and
    whether the joint values they came from were always found. `spare` says that the arm has fewer joints than
    what is given has coordinates, so that a branch has to fulfil more equations than it is made from."""

    reached: tuple[bool, ...]
    found: bool
    spare: bool

    @property
    def partial(self) -> bool:
        """Whether some branches are solutions at some poses only."""
        return self.spare and not all(self.reached)

    def claims(self, solutions: Solutions, point: Mapping[str, float]) -> Iterator[Claim]:
        """What has to hold; of a branch nothing where it need not reach."""
        for when, holds in zip(solutions.conditions, self.reached, strict=True):
            if holds or not self.spare:
                yield reaches(when, holds)
        yield Claim("pose-found", SECOND_ROUTE, self.found)
        yield Claim("as-printed", SECOND_ROUTE, _as_printed(solutions, point))


def reaches(when: Sequence[Condition], holds: bool) -> Claim:
    """That the branch with these conditions brings the end-effector to its place."""
    if not when:
        return Claim("only-branch-reaches", SECOND_ROUTE, holds)
    first, *rest = when
    whole = reduce(lambda done, then: Phrase("also", {"first": done, "then": then}), rest, first)
    return Claim("branch-reaches", SECOND_ROUTE, holds, {"when": whole})


def tried(solutions: Solutions, target: Target, points: Sequence[Mapping[str, float]]) -> Tried:
    """Every branch at every point."""
    reached = [True] * len(solutions.chosen)
    found = True
    for point in points:
        branches = solutions.at(point)
        there = [values is None or target.reached(point, values) for values in branches]
        reached = [before and now for before, now in zip(reached, there, strict=True)]
        found &= any(values is not None and target.same(values, point) for values in branches)
    return Tried(tuple(reached), found, target.spare)


def _as_printed(solutions: Solutions, point: Mapping[str, float]) -> bool:
    """Both with everything put in and in short formulas."""
    given = {name: value for name, value in point.items() if name not in solutions.joints}
    for branch, values in zip(solutions.branches, solutions.at(point), strict=True):
        if values is None:
            continue
        turn = [name for name in branch.short if name in values]
        for formulas, names in ((branch.values, turn or list(values)), (branch.short, list(branch.short))):
            found = _in_turn(formulas, names, given)
            if names and any(abs(found[n] - v) > SAME * max(1.0, abs(v)) for n, v in values.items()):
                return False
    return True


def _in_turn(formulas: Mapping[str, Expr], names: Sequence[str], given: Point) -> dict[str, float]:
    """The values of formulas, each put into those after it. Raises as `compiled` does."""
    known = dict(given)
    for name in names:
        known[name] = compiled(formulas[name])(known)
    return known
