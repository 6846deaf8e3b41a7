"""Solutions compared as sets: a published one is proved equal to a derived one, or none of them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import islice

from flint import arb

from derive.answers.comparing import AGREES, proved, unproved
from derive.answers.diagnosing import diagnose
from derive.answers.points import Names, Point, apart, distance, shown, turning, unknowns, value_at
from derive.answers.regions import proved_around
from derive.answers.rounding import ROUNDED, digits_note, room
from derive.answers.terms import ENOUGH, TRIED, Finding, Solution, Terms
from derive.expression import PI, Call, Degrees, Expr, Symbol, free_symbols, walk

Numbers = Mapping[str, arb]
INVERSE = ("atan2", "atan", "acos", "asin")
FEW = 2  # points, of formulas so long that
MOST_NODES = 100_000  # of all of them would take too long
ABSENT = "a solution is missing"


@dataclass(frozen=True)
class Paired:
    """A published solution (None where one is missing), the derived one it is, or is held against."""

    published: Solution | None
    derived: Solution | None
    finding: Finding
    diagnosis: str = ""


@dataclass(frozen=True)
class Sample:
    """The values of every solution at one point; None where one of them is not real."""

    point: Point
    published: tuple[Numbers | None, ...]
    derived: tuple[Numbers | None, ...]


@dataclass(frozen=True)
class Sets:
    """Two sets of solutions; `angles` are the unknowns that count up to whole turns. `short` are the derived
    ones with values in terms of each other, empty where they are not written so."""

    published: Sequence[Solution]
    derived: Sequence[Solution]
    terms: Terms
    angles: frozenset[str]
    short: Sequence[Solution] = ()

    def paired(self) -> list[Paired]:
        """Every published solution with its verdict, then derived ones that nobody published."""
        partners: dict[int, int] = {}
        found = []
        for k, solution in enumerate(self.published):
            j, finding = self.match(k, frozenset(partners))
            if j is None:
                found.append(self._unmatched(k, [i for i in range(len(self.derived)) if i not in partners]))
                continue
            if j in partners and finding.verdict == "equal":
                finding = replace(finding, note=f"the same as solution {partners[j] + 1}")
            partners.setdefault(j, k)
            found.append(Paired(solution, self.derived[j], finding))
        wrong = sum(pair.finding.verdict == "differs" for pair in found)
        return [*found, *self._missing(partners)[wrong:]]

    def match(self, k: int, taken: frozenset[int] = frozenset()) -> tuple[int | None, Finding]:
        """The derived solution that a published one is, none of the `taken` ones if there is another; None
        where it is none of them."""
        possible = [j for j, ours in enumerate(self.derived) if self.published[k].keys() <= ours.keys()]
        possible.sort(key=lambda j: j in taken)
        compared = [j for j in possible if self._both(k, j)]
        agreeing = [j for j in compared if all(self._same(k, j, sample) for sample in self._both(k, j))]
        for j in agreeing + [j for j in possible if j not in compared]:
            if self._proved(k, j):
                return j, Finding("equal")
        findings = [(j, self._by_values(k, j)) for j in agreeing]
        equal = ((j, finding) for j, finding in findings if finding.verdict == "equal")
        return next(equal, findings[0] if findings else (None, Finding("undecided")))

    # -- by formulas ------------------------------------------------------------------------------

    @cached_property
    def own(self) -> tuple[Names, ...]:
        """What the unknowns of each published solution stand for in it."""
        return tuple(map(_definitions, self.published))

    @cached_property
    def ours(self) -> tuple[Names, ...]:
        """What the unknowns of each derived solution stand for in it."""
        return tuple(map(_definitions, self.derived))

    def _proved(self, k: int, j: int) -> bool:
        """By normal form, against the short formulas first."""
        names = tuple(self.published[k])
        for short in (True, False) if j < len(self.short) and self.short[j] else (False,):
            ours = self.short[j] if short else self.derived[j]
            known = _definitions(ours) if short else self.ours[j]
            if all(proved(self.published[k][n], ours[n], self._terms(n, k, known)) for n in names):
                return True
        return False

    def _terms(self, name: str, k: int, ours: Names) -> Terms:
        """A value may be in terms of other unknowns of its own solution."""
        return replace(
            self.terms,
            published={**self.terms.published, **self.own[k]},
            derived={**self.terms.derived, **ours},
            own=self.own[k],
            angle=name in self.angles,
        )

    def _by_values(self, k: int, j: int) -> Finding:
        """What can be said of solutions that agree wherever it was tried: proved around the points, right to
        the digits given, or nothing more than that."""
        theirs, ours = self.published[k], self.derived[j]
        points = [sample.point for sample in self._both(k, j)]
        rounded = ""
        for name, value in theirs.items():
            terms = self._terms(name, k, self.ours[j])
            if proved(value, ours[name], terms):
                continue
            if proved_around(value, ours[name], terms.names, points, terms.angle):
                continue
            note = digits_note(value, terms) or unproved(value, ours[name], terms)
            if note != ROUNDED:
                return Finding("undecided", note=note)
            rounded = note
        return Finding("equal", note=rounded)

    # -- by numbers -------------------------------------------------------------------------------

    @cached_property
    def samples(self) -> list[Sample]:
        """Values at points until enough of them give a derived solution; of long formulas fewer do."""
        size = sum(
            1 for each in (*self.published, *self.derived) for tree in each.values() for _ in walk(tree)
        )
        enough = max(FEW, min(ENOUGH, MOST_NODES // (1 + size)))
        found: list[Sample] = []
        for point in islice(self._points(), TRIED):
            theirs = tuple(map(partial(_numbers, point), self.published, self._known(self.own, 0)))
            ours = tuple(map(partial(_numbers, point), self.derived, self._known(self.ours, 1)))
            if any(ours):
                found.append(Sample(point, theirs, ours))
            if len(found) == enough:
                break
        return found

    def _known(self, own: Sequence[Names], side: int) -> list[Names]:
        return [{**self.terms.names[side], **each} for each in own]

    def _both(self, k: int, j: int) -> list[Sample]:
        """Where two solutions are real."""
        return [sample for sample in self.samples if sample.published[k] and sample.derived[j]]

    def _same(self, k: int, j: int, sample: Sample) -> bool:
        theirs, ours = sample.published[k], sample.derived[j]
        if not theirs or not ours or not theirs.keys() <= ours.keys():
            return False
        return not any(self._apart(name, k, j, sample) for name in theirs)

    def _different(self, k: int, j: int, sample: Sample) -> list[str]:
        """The unknowns that differ by more than rounding explains."""
        theirs, ours = sample.published[k] or {}, sample.derived[j] or {}
        return [name for name in theirs if name in ours and self._apart(name, k, j, sample)]

    def _apart(self, name: str, k: int, j: int, sample: Sample) -> bool:
        theirs, ours = (sample.published[k] or {})[name], (sample.derived[j] or {})[name]
        if not apart(theirs, ours, name in self.angles, rounded=True):
            return False
        most = room(self.published[k][name], theirs, self._terms(name, k, self.ours[j]), sample.point)
        return distance(theirs, ours, name in self.angles) > most * 1.000001

    def _points(self) -> Iterable[Point]:
        """An unknown of one solution may be free in another."""
        free, signed = set[str](), self.terms.sampling.signed
        sides = (self.published, self._known(self.own, 0)), (self.derived, self._known(self.ours, 1))
        for solutions, known in sides:
            for solution, names in zip(solutions, known, strict=True):
                free = free.union(*(unknowns(tree, names) for tree in solution.values()))
                signed |= turning(solution.values(), names)
        return replace(self.terms.sampling, signed=signed).usual(free, TRIED)

    # -- what is told -----------------------------------------------------------------------------

    def _unmatched(self, k: int, spare: Sequence[int]) -> Paired:
        """With the derived solution that is nearest to it, and what would repair it."""
        solution = self.published[k]
        choice = list(spare) or list(range(len(self.derived)))
        if not choice:
            return Paired(solution, None, Finding("differs", note="there is no solution"))
        nearest = max(choice, key=lambda j: (self._agreeing(k, j), -self._gap(k, j)))
        finding = next((found for sample in self.samples if (found := self._shown(k, nearest, sample))), None)
        ours = self.derived[nearest]
        if finding is None:
            return Paired(solution, ours, Finding("undecided", note=self._why(k)))
        return Paired(solution, ours, finding, self._diagnosis(k, nearest))

    def _gap(self, k: int, j: int) -> float:
        """How far two solutions are apart where both are real."""
        for sample in self.samples:
            theirs, ours = sample.published[k], sample.derived[j]
            if theirs and ours:
                return sum(distance(theirs[n], ours[n], n in self.angles) for n in theirs if n in ours)
        return math.inf

    def _shown(self, k: int, nearest: int, sample: Sample) -> Finding | None:
        """A point at which it is none of the solutions, with an unknown that differs from the nearest one and
        both values."""
        theirs, ours = sample.published[k], sample.derived[nearest]
        if not theirs or any(self._same(k, j, sample) for j in range(len(self.derived))):
            return None
        different = self._different(k, nearest, sample)
        if not ours or not different:
            return Finding("differs", sample.point)
        name = different[0]
        values = float(theirs[name].mid()), float(ours[name].mid())
        return Finding("differs", sample.point, values, f"in {name}")

    def _why(self, k: int) -> str:
        if any(sample.published[k] for sample in self.samples):
            return AGREES
        return "no point was found where it has real values"

    def _agreeing(self, k: int, j: int) -> int:
        """How many unknowns are surely right."""
        theirs, ours = self.published[k], self.derived[j]
        both = self._both(k, j)
        right = [n for n in theirs if n in ours and not any(self._apart(n, k, j, sample) for sample in both)]
        return sum(proved(theirs[n], ours[n], self._terms(n, k, self.ours[j])) for n in right)

    def _diagnosis(self, k: int, j: int) -> str:
        ours = self.derived[j]
        for name, value in self.published[k].items():
            terms = self._terms(name, k, self.ours[j])
            if name not in ours or proved(value, ours[name], terms):
                continue
            if found := diagnose(value, ours[name], terms):
                return f"{name}: {found}"
        return ""

    def _missing(self, partners: Mapping[int, int]) -> list[Paired]:
        """Derived solutions that are none of the published ones at some point."""
        found = []
        special = [_is_special(solution) for solution in self.derived]
        for j, solution in enumerate(self.derived):
            if j in partners or (special[j] and not all(special)):
                continue
            for sample in self.samples:
                if sample.derived[j] and not any(
                    self._same(k, j, sample) for k in range(len(self.published))
                ):
                    found.append(Paired(None, solution, Finding("differs", sample.point), ABSENT))
                    break
        return found


def chosen(
    readings: Sequence[Sequence[Solution]], derived: Sequence[Solution], terms: Terms, angles: frozenset[str]
) -> list[Solution]:
    """Of every solution that can be read in several ways the first that is right, or the first."""
    found = []
    for several in readings:
        sets = Sets(several, derived, terms, angles)
        right = (k for k in range(len(several)) if sets.match(k)[1].verdict == "equal")
        found.append(several[next(right, 0)] if len(several) > 1 else several[0])
    return found


def angles_among(solutions: Iterable[Solution], known: frozenset[str]) -> frozenset[str]:
    """The unknowns that are angles: `known` ones, and those with pi or an inverse function in a value."""
    found = set(known)
    for solution in solutions:
        found |= {name for name, value in solution.items() if any(map(_is_angular, walk(value)))}
    return frozenset(found)


def written(solution: Solution | None, evaluated: bool = False) -> str:
    """theta1 = ..., theta2 = ...; in numbers where the question asks for numbers."""
    values = solution or {}
    names = _definitions(values) if evaluated else {}
    return ", ".join(f"{name} = {shown(value, names, evaluated)}" for name, value in values.items())


def _is_angular(node: Expr) -> bool:
    return isinstance(node, Degrees) or node == PI or (isinstance(node, Call) and node.function in INVERSE)


def _numbers(point: Point, solution: Solution, names: Names) -> Numbers | None:
    """The values at a point; None where one of them is not real."""
    found = {name: value_at(value, names, point) for name, value in solution.items()}
    kept = {name: value for name, value in found.items() if value is not None}
    return kept if len(kept) == len(found) else None


def _is_special(solution: Solution) -> bool:
    """Whether it leaves an unknown free, as at a singularity; nobody has to publish that."""
    return any(name in free_symbols(value) for name, value in solution.items())


def _definitions(solution: Solution) -> dict[Expr, Expr]:
    """The unknowns by their values, those that are free left out."""
    return {Symbol(name): value for name, value in solution.items() if name not in free_symbols(value)}
