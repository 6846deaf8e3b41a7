"""Stationary points held to the function itself: lines by differences, each point, and what is said of it, by
the lie of the land around it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, islice, permutations
from random import Random
from typing import TYPE_CHECKING, Any

from derive.algebra.numbers.floats import Point, completed, number
from derive.derivation import Branch, Claim, Phrase, Said, Step, Table
from derive.expression import Call, Derivative, Expr, Relation, Symbol, add, multiply
from derive.kinds.checks import close, law, random_points, route
from derive.kinds.fields import TREES
from derive.kinds.function._landscape import Landscape, Lie
from derive.kinds.meanings import Chain, Names, farthest, told
from derive.kinds.problem import Problem

if TYPE_CHECKING:
    from numpy.typing import NDArray

TRIED, EACH = 60, 2  # points at which a solution need not be real, and those looked at
CLOSE = 1e-6
SAMPLES, SPREAD = 12, 3.0  # places compared with the highest and the lowest
UNREAL = (ValueError, ZeroDivisionError, OverflowError)
LOCAL: Mapping[str, Lie] = {
    "local-maximum": "maximum", "local-minimum": "minimum", "saddle-point": "saddle",
    "undecided": "undecided", "isolated-point": "isolated", "singular-point": "singular",
}  # fmt: skip
GLOBAL = {"global-maximum": (1,), "global-minimum": (-1,), "global-extremes": (1, -1)}


@dataclass(frozen=True, slots=True)
class PointsTold:
    """What is told: the name of f and of what is stationary, the multipliers, the points and their table."""

    land: Landscape
    problem: Problem
    name: Symbol
    goal: Symbol
    multipliers: tuple[Symbol, ...]
    branches: tuple[Branch, ...]
    table: Table

    # -- the lines ---------------------------------------------------------------------------------

    def lines(self, steps: Sequence[Step]) -> Claim:
        """Derivatives and determinants by differences, anywhere."""
        chains: list[Chain] = [step.chain for step in steps]
        for step in steps:
            head = step.chain[0]
            if step.rule == "dependent" and isinstance(head, Call):
                chains.append((Symbol(step.name), head.arguments[0]))
        names = {*self.problem.symbols, *self.land.variables, *(each.name for each in self.multipliers)}
        return told(chains, self._meant, names, self.problem.where)

    def _meant(self, at: Point) -> Names:
        import numpy as np

        land, goal = self.land, self._goal()
        found: dict[Expr, Any] = {self.name: number(land.f, at), self.goal: number(goal, at)}
        names = (*land.variables, *(each.name for each in self.multipliers))
        for name, value in zip(names, land.gradient(goal, at, names), strict=True):
            found[Derivative(self.goal, Symbol(name))] = float(value)
        border = land.border(at)
        rows = np.vstack([land.gradient(land.f, at)[None], border])
        columns = combinations(range(len(land.variables)), len(rows))
        for k, kept in enumerate(columns, 1):
            found[Symbol(f"determinant_{k}")] = rows[:, kept]
        return {**found, Symbol("H"): self._bordered(at)}

    def _goal(self) -> Expr:
        """f - lambda g."""
        return add(
            self.land.f, *(-multiply(name, g) for name, g in zip(self.multipliers, self.land.g, strict=True))
        )

    def _bordered(self, at: Point) -> NDArray[Any]:
        import numpy as np

        border, m = self.land.border(at), len(self.land.g)
        return np.block([[np.zeros((m, m)), border], [border.T, self.land.curvature(self._goal(), at)]])

    # -- the points --------------------------------------------------------------------------------

    def points(self) -> Iterator[Claim]:
        """Each is stationary, with the value and the minors of the table, and is what it is said to be."""
        met = [(k, at) for k, branch in enumerate(self.branches) for at in islice(self._places(branch), EACH)]
        if met:
            yield route("stationary", (self.land.is_stationary(at) for _, at in met))
            yield route("as-listed", (self._listed(k, at) for k, at in met))
            yield route("what-it-is", (self._is_said(k, at) for k, at in met))

    def tests(self, said: Sequence[Phrase], flat: Phrase | None) -> Claim:
        """The rules by which points are told apart are those for so many variables and constraints."""
        n, m = len(self.land.variables), len(self.land.g)
        free, several, odd = not m, n - m > 1, m % 2 == 1
        rule = {  # by the sign of the last minor at a minimum, (-1)^m
            (True, True, False): "minors", (True, False, False): "curvature",
            (False, True, True): "odd-minors", (False, True, False): "even-minors",
            (False, False, True): "odd-determinant", (False, False, False): "even-determinant",
        }[free, several, odd]  # fmt: skip
        border = "by-the-border-of-one" if m == 1 else "by-the-border"
        keys = ["by-the-hessian" if free else border, rule]
        counted = all(each.about.get("count", n - m) == n - m for each in said)
        along = flat is None or flat.key == ("flat" if free else "flat-along")
        return route("tests", ([each.key for each in said] in ([], keys), counted, along))

    def greatest_and_smallest(self, reach: Phrase | None) -> Iterator[Claim]:
        """The value that is told to be the greatest, or the smallest, is that of a point, and no other point
        nor a sample has one beyond it."""
        if reach is None:
            return
        values = ((reach.about.get("greatest"), 1), (reach.about.get("smallest"), -1))
        told_of = [(tree, sign) for tree, sign in values if isinstance(tree, TREES)]
        one = "compact-of-one" if len(self.land.g) == 1 else "compact"
        yield law("said", reach.key in (one, "falls", "grows"))
        signs = {"compact": [1, -1], "compact-of-one": [1, -1], "falls": [1], "grows": [-1]}[reach.key]
        yield route("which", ([sign for _, sign in told_of] == signs, reach.about["name"] == self.name))
        names = self.problem.symbols | {*self.land.variables}
        there = [completed(at, self.problem.where) for at in random_points(names, TRIED)]
        if told_of:  # at some of these places the point in question is real
            reached = (any(self._is_reached(tree, sign, at) for at in there) for tree, sign in told_of)
            yield route("greatest", reached)

    def _is_reached(self, tree: Expr, sign: int, at: Point) -> bool:
        try:
            value = number(tree, at)
        except UNREAL:
            return False
        found = [place for branch in self.branches if (place := self._there(branch, at)) is not None]
        here = [place for place in found if close(number(self.land.f, place), value, CLOSE)]
        return any(self._is_best(sign, place) for place in here)

    def _places(self, branch: Branch) -> Iterator[dict[str, float]]:
        """Points of the parameters where the solution is real, with its coordinates as they are told."""
        names = self.problem.symbols | {*self.land.variables}
        for point in random_points(names, TRIED):
            at = completed(point, self.problem.where)
            try:
                values = {
                    name: number(tree, at) for name, tree in branch.values.items() if name != self.name.name
                }
            except UNREAL:
                continue
            yield {**at, **values}

    def _listed(self, k: int, at: Point) -> bool:
        """The value of f, and the row of the table."""
        branch, row = self.branches[k], self.table.rows[k]
        own = self.name.name
        names: dict[Expr, Any] = {Symbol(name): value for name, value in at.items()}
        names[self.name] = number(self.land.f, at)
        chains: list[Chain] = [(self.name, branch.values[own])]
        pairs = list(zip(self.table.headings, row, strict=True))
        listed = len(self.land.variables) + len(self.multipliers) + 1
        for heading, cell in pairs[:listed]:
            if isinstance(cell, TREES) and isinstance(heading, Symbol):
                chains.append((heading, cell))
        minors = [number(cell, at) for _, cell in pairs[listed:-1] if isinstance(cell, TREES)]
        return farthest(chains, names) < CLOSE and (not minors or self._has_minors(minors, at))

    def _has_minors(self, minors: Sequence[float], at: Point) -> bool:
        """Whether they are the leading principal minors, the variables in some order."""
        import numpy as np

        m, H = len(self.land.g), self._bordered(at)
        for order in permutations(range(m, len(H))):
            kept = [*range(m), *order]
            turned = H[np.ix_(kept, kept)]
            sizes = range(len(H) - len(minors) + 1, len(H) + 1)
            if close([float(np.linalg.det(turned[:size, :size])) for size in sizes], list(minors), CLOSE):
                return True
        return False

    def _is_said(self, k: int, at: Point) -> bool:
        """By the land around it; whether it is the highest or lowest, by all the points and by samples."""
        lie, phrases = self.land.lie(at), [self._plain(each, at) for each in self.branches[k].when]
        said = {each.key: each for each in phrases if each is not None}
        if None in phrases or (lie == "singular") != ("singular-point" in said):
            return False
        right = [LOCAL[key] == lie for key in said if key in LOCAL]
        right += [self._is_so_if(each, lie, at) for key, each in said.items() if key == "it-is-if"]
        right += [self._is_best(sign, at) for key in said for sign in GLOBAL.get(key, ())]
        return bool(right) and all(right)

    def _is_so_if(self, said: Phrase, lie: Lie, at: Point) -> bool:
        what = said.about["said"]
        return isinstance(what, Phrase) and _holds(said, at) == (lie == LOCAL[what.key])

    def _plain(self, said: Said, at: Point) -> Phrase | None:
        """What is said where the point is real; None where it is said not to be."""
        while isinstance(said, Phrase) and said.key == "where":
            need = said.about["need"]
            if not isinstance(need, Relation) or isinstance(need.left, Relation):
                return None
            if number(need.left, at) < number(need.right, at) - CLOSE:
                return None
            said = said.about["said"]
        return said if isinstance(said, Phrase) else None

    def _is_best(self, sign: int, at: Point) -> bool:
        """Whether no other point and no sample is higher (times `sign`)."""
        here = sign * number(self.land.f, at)
        draw = Random(len(self.branches))
        others = [place for branch in self.branches if (place := self._there(branch, at)) is not None]
        low = {
            x: 0.1 if self.problem.assumptions.get(x) == "positive" else -SPREAD for x in self.land.variables
        }
        starts = ({**at, **{x: draw.uniform(low[x], SPREAD) for x in low}} for _ in range(SAMPLES))
        samples = [place for start in starts if (place := self.land.brought(start)) is not None]
        allowed = (place for place in (*others, *samples) if all(place[x] > 0 for x in low if low[x] > 0))
        return all(sign * number(self.land.f, place) <= here + CLOSE * (1 + abs(here)) for place in allowed)

    def _there(self, branch: Branch, at: Point) -> dict[str, float] | None:
        try:
            return {**at, **{x: number(branch.values[x], at) for x in self.land.variables}}
        except UNREAL:
            return None


def _holds(said: Phrase, at: Point) -> bool:
    needs = said.about["needs"]
    return isinstance(needs, tuple) and all(
        isinstance(need, Relation)
        and not isinstance(need.left, Relation)
        and ((number(need.left, at) > number(need.right, at)) == (need.sign == ">"))
        for need in needs
    )
