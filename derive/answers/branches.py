"""Solutions compared as sets: a published one is proved equal to a derived one, or none of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice

from flint import arb

from derive.algebra.text import text
from derive.answers.comparing import ENOUGH, TRIED, Finding, Terms, proved
from derive.answers.diagnosing import diagnose
from derive.answers.points import Point, apart, turning, unknowns, value_at
from derive.expression import PI, Call, Degrees, Expr, Symbol, walk

Solution = Mapping[str, Expr]
INVERSE = ("atan2", "atan", "acos", "asin")
ABSENT = "a solution is missing"


@dataclass(frozen=True)
class Paired:
    """A published solution (None where one is missing), the derived one it is, or is held against."""

    published: Solution | None
    derived: Solution | None
    finding: Finding
    diagnosis: str = ""


@dataclass(frozen=True)
class Sets:
    """Two sets of solutions; `angles` are the unknowns that count up to whole turns."""

    published: Sequence[Solution]
    derived: Sequence[Solution]
    terms: Terms
    angles: frozenset[str]

    def paired(self) -> list[Paired]:
        """Every published solution with its verdict, then derived ones that nobody published."""
        partner = self._partners()
        left = [k for k in range(len(self.published)) if k not in partner]
        spare = [j for j in range(len(self.derived)) if j not in partner.values()]
        judged = self._judged(left, spare) if left or spare else {}
        found = []
        for k, solution in enumerate(self.published):
            if k in partner:
                found.append(Paired(solution, self.derived[partner[k]], Finding("equal")))
            else:
                found.append(self._unmatched(solution, spare, judged.get(k, Finding("undecided"))))
        return [*found, *self._missing(spare, judged)]

    def _partners(self) -> dict[int, int]:
        """Which derived solution each published one is, by normal form."""
        partner: dict[int, int] = {}
        for k, solution in enumerate(self.published):
            for j, ours in enumerate(self.derived):
                if j not in partner.values() and self._proved(solution, ours):
                    partner[k] = j
                    break
        return partner

    def _proved(self, theirs: Solution, ours: Solution) -> bool:
        return all(
            proved(value, ours[name], self._terms(name, theirs, ours)) for name, value in theirs.items()
        )

    def _terms(self, name: str, theirs: Solution, ours: Solution) -> Terms:
        """A value may be in terms of other unknowns of its own solution."""
        angle = name in self.angles
        return replace(
            self.terms,
            published={**self.terms.published, **_definitions(theirs)},
            derived={**self.terms.derived, **_definitions(ours)},
            angle=angle,
        )

    # -- by numbers -------------------------------------------------------------------------------

    def _judged(self, left: Sequence[int], spare: Sequence[int]) -> dict[int, Finding]:
        """For each solution (published by its number, derived by -1 - its number) what points tell."""
        found: dict[int, Finding] = {}
        compared = 0
        for point in islice(self._points(), TRIED):
            theirs = [self._numbers(s, self.terms.published, point) for s in self.published]
            ours = [self._numbers(s, self.terms.derived, point) for s in self.derived]
            if not any(ours):
                continue
            compared += 1
            for k in left:
                if theirs[k] and not any(self._same(theirs[k], other) for other in ours):
                    found.setdefault(k, self._shown(point, theirs[k] or {}, [ours[j] for j in spare] or ours))
            for j in spare:
                known = ours[j] and not _is_special(self.derived[j])
                if known and not any(self._same(other, ours[j]) for other in theirs):
                    found.setdefault(-1 - j, Finding("differs", point))
            if compared == ENOUGH:
                break
        return found

    def _shown(
        self, point: Point, theirs: Mapping[str, arb], ours: Sequence[Mapping[str, arb] | None]
    ) -> Finding:
        """The unknown that differs from the nearest derived solution, and both values."""
        real = [each for each in ours if each and self._different(theirs, each)]
        if not real:
            return Finding("differs", point)
        nearest = min(real, key=lambda each: len(self._different(theirs, each)))
        name = self._different(theirs, nearest)[0]
        values = float(theirs[name].mid()), float(nearest[name].mid())
        return Finding("differs", point, values, f"in {name}")

    def _different(self, theirs: Mapping[str, arb], ours: Mapping[str, arb]) -> list[str]:
        common = [name for name in theirs if name in ours]
        return [n for n in common if apart(theirs[n], ours[n], n in self.angles, rounded=True)]

    def _points(self) -> Iterable[Point]:
        trees = [*_values(self.published), *_values(self.derived)]
        names = {**self.terms.published, **self.terms.derived}
        for solution in (*self.published, *self.derived):
            names.update(_definitions(solution))
        free = frozenset().union(*(unknowns(tree, names) for tree in trees)) if trees else frozenset()
        sampling = self.terms.sampling
        return replace(sampling, signed=sampling.signed | turning(trees, names)).usual(free, TRIED)

    def _numbers(self, solution: Solution, names: Mapping[Expr, Expr], point: Point) -> dict[str, arb] | None:
        """The values at a point; None where one of them is not real."""
        known = {**names, **_definitions(solution)}
        found = {name: value_at(value, known, point) for name, value in solution.items()}
        kept = {name: value for name, value in found.items() if value is not None}
        return kept if len(kept) == len(found) else None

    def _same(self, theirs: Mapping[str, arb] | None, ours: Mapping[str, arb] | None) -> bool:
        if theirs is None or ours is None:
            return False
        return not self._different(theirs, ours)

    # -- what is told -----------------------------------------------------------------------------

    def _unmatched(self, solution: Solution, spare: Sequence[int], finding: Finding) -> Paired:
        """With the derived solution that is nearest to it, and what would repair it."""
        if not self.derived:
            return Paired(solution, None, finding)
        choice = spare or range(len(self.derived))
        if finding.verdict != "differs":
            return Paired(solution, self.derived[choice[0]], finding)
        nearest = max((self.derived[j] for j in choice), key=lambda ours: self._agreeing(solution, ours))
        diagnosis = self._diagnosis(solution, nearest) if finding.verdict == "differs" else ""
        return Paired(solution, nearest, finding, diagnosis)

    def _agreeing(self, theirs: Solution, ours: Solution) -> int:
        return sum(proved(value, ours[n], self._terms(n, theirs, ours)) for n, value in theirs.items())

    def _diagnosis(self, theirs: Solution, ours: Solution) -> str:
        for name, value in theirs.items():
            terms = self._terms(name, theirs, ours)
            if not proved(value, ours[name], terms) and (found := diagnose(value, ours[name], terms)):
                return f"{name}: {found}"
        return ""

    def _missing(self, spare: Sequence[int], judged: Mapping[int, Finding]) -> list[Paired]:
        absent = [j for j in spare if -1 - j in judged]
        wrong = sum(k >= 0 and finding.verdict == "differs" for k, finding in judged.items())
        return [Paired(None, self.derived[j], judged[-1 - j], ABSENT) for j in absent[wrong:]]


def angles_among(solutions: Iterable[Solution], known: frozenset[str]) -> frozenset[str]:
    """The unknowns that are angles: `known` ones, and those with pi or an inverse function in a value."""
    found = set(known)
    for solution in solutions:
        found |= {name for name, value in solution.items() if any(map(_is_angular, walk(value)))}
    return frozenset(found)


def written(solution: Solution | None) -> str:
    """theta1 = ..., theta2 = ..."""
    return ", ".join(f"{name} = {text(value)}" for name, value in (solution or {}).items())


def _is_angular(node: Expr) -> bool:
    return isinstance(node, Degrees) or node == PI or (isinstance(node, Call) and node.function in INVERSE)


def _is_special(solution: Solution) -> bool:
    """Whether it leaves an unknown free, as at a singularity; nobody has to publish that."""
    return any(Symbol(name) in walk(value) for name, value in solution.items())


def _definitions(solution: Solution) -> dict[Expr, Expr]:
    """The unknowns by their values, those that are free left out."""
    return {Symbol(n): value for n, value in solution.items() if Symbol(n) not in walk(value)}


def _values(solutions: Iterable[Solution]) -> list[Expr]:
    return [value for solution in solutions for value in solution.values()]
