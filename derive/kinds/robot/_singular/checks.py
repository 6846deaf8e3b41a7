"""That singular sets are what is said of them, in numbers: the matrix and its determinant by another route,
the rank on each set, what the arm looks like there, and that a search finds no other."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import chain, combinations
from typing import Any

from derive.algebra.infix import text
from derive.algebra.numbers import floats as numeric
from derive.algebra.numbers.arrays import arrays
from derive.algebra.numbers.compiled import compiled
from derive.algebra.numbers.floats import Point
from derive.derivation import Branch, Claim, Phrase, Step
from derive.errors import NotDerivable
from derive.expression import ONE, Expr, Symbol
from derive.kinds.checks import close, random_points, route
from derive.kinds.fields import TREES
from derive.kinds.robot._singular.descent import fallen_to
from derive.kinds.robot._singular.facts import CaseTold, Facts
from derive.kinds.robot._singular.minors import Way
from derive.kinds.robot._singular.search import (
    SMALL,
    Values,
    inside,
    placed,
    put,
    rank_at,
    singular_values,
    zeros_along,
)
from derive.kinds.robot._singular.sets import Analysed, Block, Case
from derive.mechanics.zeros import Zero

DIFFERENCES = 1e-6
POINTS, TRIES = 3, 60
IN_A_SET = 1, 36  # lines along which lower ranks are sought, and places on each
SETS = ("on-the-set", "inside-larger-sets")


@dataclass(frozen=True)
class InNumbers:
    """A matrix of joint variables in numbers, by a route that knows nothing of its sets: `symbols` are all
    names it depends on, `completed` adds what a sheet says of others; `slides` are the variables that are
    lengths; `whole` and `block` give it and a part of it, `posture` whether an arm looks as it is said."""

    variables: tuple[str, ...]
    slides: tuple[str, ...]
    symbols: frozenset[str]
    completed: Callable[[Point], Point]
    whole: Callable[[Values], Any]
    block: Callable[[Block, Values], Any]
    posture: Callable[[Block, Phrase, Values], bool]
    small: float = SMALL  # a singular value that may be zero, relative to the largest

    @property
    def points(self) -> Iterator[Values]:
        return (dict(self.completed(at)) for at in random_points(self.symbols, TRIES))

    def places(self, zeros: Sequence[Zero]) -> list[Values]:
        """Some points of a set."""
        return list(placed({zero.variable: zero.value for zero in zeros}, self.points, POINTS))


@dataclass(frozen=True)
class Checked:
    """A Jacobian with its singular sets, and the same as results and as `told` in words."""

    J: InNumbers
    way: Way
    sets: Sequence[Analysed]
    solutions: Sequence[Branch]
    told: Facts

    def claims(self) -> Iterator[Claim]:
        """About the lines, the sets, and what is said of each."""
        some = [at for _, at in zip(range(POINTS), self.J.points, strict=False)]
        yield route("jacobian-seen", (self._seen(part.block, at) for part in self.way.parts for at in some))
        determined = (each for at in some for each in self._determined(at))
        yield route("determinant-seen", chain(determined, self._kinds_of_rows(self.J.whole(some[0]))))
        yield route("full-rank", (rank_at(J := self.J.whole(at)) == min(J.shape) for at in some))
        for branch, each, case in self._listed():
            yield from self._of_branch(branch, each, case)
            if case is not None and case.J is not None:
                names = ", ".join(zero.variable for zero in case.zeros)
                yield route("spaces", _spaces(self.J, each, case), names=names)
        if said := [*self._words()]:
            yield route("looks-in-words", said)
        if spaces := [*self._spaces_told()]:
            yield route("spaces-told", spaces)
        if self.way.complete and (found := [*self._found(some[0])]):
            yield route("all-found", found)
        one_of_each = {id(each): branch for branch, each, _ in self._listed() if not each.inner}
        if lower := [*self._inner([*one_of_each.values()], some[0])]:
            yield route("inner-found", lower)

    def _listed(self) -> Iterator[tuple[Branch, Analysed, Case | None]]:
        """Each result with the set, and the choice of values in it, that it tells."""
        cases = ((each, case) for each in self.sets for case in (each.cases or (None,)))
        return ((branch, *pair) for branch, pair in zip(self.solutions, cases, strict=True))

    def _seen(self, block: Block, at: Values) -> bool:
        """The Jacobian as it is printed, seen from its frame."""
        printed = numeric.numbers(self.way.work[Symbol(block.name)], at)
        return close(printed, self.J.block(block, at), DIFFERENCES)

    def _determined(self, at: Values) -> Iterator[bool]:
        """det J, or that of the smaller of J J^T and J^T J, and what its line says without other names."""
        import numpy as np

        J = self.J.whole(at)
        m, n = J.shape
        gram = J if m == n else J @ J.T if m < n else J.T @ J
        det = float(np.linalg.det(gram))
        yield close(numeric.number(self.way.det, at), det, DIFFERENCES)
        blocks = {part.block.name: self.J.block(part.block, at) for part in self.way.parts}
        whole = {"J": J} if len(blocks) > 1 else {}
        for expr in self._line("det").chain:
            with suppress(KeyError, NotDerivable):
                yield close(arrays(expr, {**at, **whole, **blocks}), det, DIFFERENCES)

    def _line(self, name: str) -> Step:
        return next(step for step in self.way.work.steps if step.name == name)

    def _of_branch(self, branch: Branch, each: Analysed, case: Case | None) -> Iterator[Claim]:
        """The rank there, and what is said of it; of a set that is told by equations without values, the
        search says it."""
        there = list(placed(branch.values, self.J.points)) if case else self._sampled(each)
        if not there and case is None:
            return
        names = ", ".join(branch.values) or ", ".join(map(text, each.equations))
        exact, rank = "rank" in branch.facts, branch.facts.get("rank", branch.facts.get("rank_at_most"))
        ranks = [rank_at(self.J.whole(here)) for here in there]
        yield route("rank", (r == rank if exact else r <= rank for r in ranks), rank=rank, names=names)
        yield route("on-it", (inside(branch, here, self.J.slides) for here in there), names=names)
        looks = [when for when in branch.when if isinstance(when, Phrase) and when.key not in SETS]
        if looks:
            seen = (self.J.posture(each.block, look, here) for look in looks for here in there)
            yield route("looks", seen, names=names)

    @property
    def _cases(self) -> Iterator[tuple[Block, CaseTold, Values]]:
        """Each case that is told in words, at places with the values that stand beside it."""
        outer = [each for each in self.sets if not each.inner]
        for each, told in zip(outer, self.told.sets, strict=True):
            for case in told.cases:
                values = {name.name: value for name, value in case.places if isinstance(name, Symbol)}
                yield from ((each.block, case, here) for here in placed(values, self.J.points))

    def _words(self) -> Iterator[bool]:
        """What is said of each case in words."""
        for block, case, here in self._cases:
            yield from (self.J.posture(block, look, here) for look in case.looks)

    def _kinds_of_rows(self, J: Any) -> Iterator[bool]:
        """Whether a matrix is said to be wide or tall, and its rows those of rotations, as they are."""
        import numpy as np

        m, n = J.shape
        gram = self.told.taken.about.get("gram") if self.told.taken else None
        if self.told.taken and isinstance(gram, TREES):
            size = arrays(gram, {self.way.parts[0].block.name: np.ones((m, n))}).shape
            yield m != n and size == (min(m, n),) * 2
            yield self.told.taken.key == ("more-columns" if m < n else "more-rows")
        for part, said in zip(self.way.parts, self.told.parts, strict=True):
            rates = tuple(Symbol(f"{name}_dot") for name in part.block.variables)
            yield said.about["frame"] == part.block.frame and said.about.get("rates", rates) == rates
        outer = (each for each in self.sets if not each.inner)
        for each, told in zip(outer, self.told.sets, strict=True):
            yield told.frame == each.block.frame
            yield told.angular == (not any(row.startswith("v") for row in each.block.rows))

    def _spaces_told(self) -> Iterator[bool]:
        """The matrices of each case as they are printed."""
        import numpy as np

        for block, case, here in self._cases:
            J = self.J.block(block, here)
            size = SMALL * max(1.0, float(np.abs(J).max()))
            told = (
                [arrays(chain[-1], here) for chain in each]
                for each in (case.J, case.null, case.lost, case.range)
            )
            printed, null, lost, spanned = told
            yield from (close(each, J, DIFFERENCES) for each in printed)
            yield from (bool(np.abs(J @ N).max() <= size * max(1.0, np.abs(N).max())) for N in null)
            yield from (bool(np.abs(U.T @ J).max() <= size * max(1.0, np.abs(U).max())) for U in lost)
            rows, columns = J.shape
            yield from (rank_at(N) == N.shape[1] == columns - case.rank for N in null)
            yield from (rank_at(U) == U.shape[1] == rows - case.rank for U in lost)
            moved = [{**here, **dict(zip(block.rows, map(float, column), strict=True))} for column in J.T]
            sums = (numeric.number(each[0], there) for each in case.satisfied for there in moved)
            yield from (abs(each) <= size for each in sums)
            yield len(case.missing) == len(case.satisfied)
            beyond = (
                np.array([_components(each, here).get(row, 0.0) for row in block.rows])
                for each in case.missing
            )
            yield from (rank_at(np.column_stack([J, w])) > case.rank for w in beyond)
            yield from (rank_at(np.hstack([J, R])) == rank_at(R) == case.rank for R in spanned)

    def _found(self, at: Values) -> Iterator[bool]:
        """Whether every configuration that a search finds is singular and lies in a set that is told."""
        names, slides = self.J.variables, self.J.slides
        m, n = self.J.whole(at).shape
        fallen = fallen_to(self.J.whole, at, names, slides) if m != n else ()
        for here in (*zeros_along(compiled(self.way.det), at, names, slides), *fallen):
            told = any(inside(branch, here, self.J.slides) for branch in self.solutions)
            yield told and rank_at(J := self.J.whole(here)) < min(J.shape)

    def _inner(self, branches: Sequence[Branch], at: Values) -> Iterator[bool]:
        """What a search finds in the sets, and where two of them cross if all is decided of each."""
        decided = all("rank" in branch.facts for branch in self.solutions)
        for branch in branches:
            rank = branch.facts.get("rank")
            if isinstance(rank, int) and branch.values:
                yield from self._lower(branch.values, rank, at)
        for one, other in combinations(branches, 2) if decided else ():
            both = {**one.values, **other.values}
            crossing = put(both, at) if len(both) == len(one.values) + len(other.values) > 1 else None
            if crossing is not None and one.values and other.values:
                yield from self._lower(both, rank_at(self.J.whole(crossing)), at)

    def _lower(self, own: Mapping[str, Expr], rank: int, at: Values) -> Iterator[bool]:
        """Whether each configuration with these values in which the rank is less, as a search along a line
        finds, lies in a set that is told to have that rank."""

        def height(there: Values) -> float:
            here = put(own, there)
            return 1.0 if here is None else float(singular_values(self.J.whole(here))[rank - 1]) ** 2

        free = [name for name in self.J.variables if name not in own]
        for there in zeros_along(height, at, free, self.J.slides, *IN_A_SET) if rank and free else ():
            if (here := put(own, there)) is not None:
                J = self.J.whole(here)
                if not self._falls(J, rank):
                    continue
                lower = rank_at(J)
                around = [each for each in self.solutions if inside(each, here, self.J.slides)]
                yield lower in [each.facts.get("rank", each.facts.get("rank_at_most")) for each in around]

    def _falls(self, J: Any, rank: int) -> bool:
        """Whether the rank is less as surely as can be seen: near a zero that is touched it may look so."""
        values = singular_values(J)
        return bool(values[rank - 1] <= self.J.small * max(1.0, values[0]))

    def _sampled(self, each: Analysed) -> list[Values]:
        """Some places of a set that is told by its equations."""
        return [here for zeros in each.places for here in self.J.places(zeros)]


def _spaces(numbers: InNumbers, each: Analysed, case: Case) -> Iterator[bool]:
    """J x = 0 and u J = 0 of the block in numbers, and its rank."""
    import numpy as np

    for here in numbers.places(case.zeros):
        J = numbers.block(each.block, here)
        size = max(1.0, float(np.abs(J).max()))
        yield rank_at(J) == case.rank
        for vectors, matrix in ((case.null, J), (case.lost, J.T)):
            for vector in vectors:
                v = np.array(numeric.matrix_numbers(vector, here))
                longest = max(1.0, float(np.abs(v).max()))
                yield bool(np.abs(matrix @ v).max() <= SMALL * size * longest)


def _components(told: Phrase, here: Values) -> dict[str, float]:
    """Those of a motion that is told to be lost, by the names of the rows."""
    names, values = told.about["names"], told.about.get("coefficients", (ONE,))
    found: dict[str, float] = {}
    if isinstance(names, tuple) and isinstance(values, tuple):
        for name, value in zip(names, values, strict=True):
            if isinstance(name, Symbol) and isinstance(value, TREES):
                found[name.name] = float(arrays(value, here))
    return found
