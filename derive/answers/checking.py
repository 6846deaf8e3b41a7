"""The published answers to one question, each entry held against what was derived."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import cached_property
from typing import Any

from derive.algebra.infix import text
from derive.answers.asked import Asked
from derive.answers.branches import Paired, Sets, Solution, angles_among, chosen, written
from derive.answers.comparing import compare
from derive.answers.diagnosing import SHAPE, TRANSPOSED, diagnose
from derive.answers.findings import Check, as_typed
from derive.answers.moved import moved, same, transposed, turned
from derive.answers.points import shown, unknowns
from derive.answers.published import Published
from derive.answers.reading import Reader
from derive.answers.solutions import Solutions, put_in
from derive.answers.spoken import heard, is_spoken
from derive.answers.terms import Finding, Terms, Verdict
from derive.derivation import Branch
from derive.errors import SheetError
from derive.expression import ZERO, Expr, Matrix, Symbol, free_symbols
from derive.expression import replace as replaced
from derive.kinds.problem import TREES

DIAGNOSED = 12  # entries of one answer
SEVERITY: tuple[Verdict, ...] = ("equal", "undecided", "differs")
BORROWED = "it is in terms of {names}, which this derivation defines and the answer does not"
NOTHING = "the answer only names itself"


@dataclass(frozen=True)
class Compared(Asked):
    """The same with its answers read and compared."""

    def checks(self) -> list[Check]:
        """A check for each entry, one at least for each answer. Raises SheetErrors with everything that
        cannot be read."""
        reader = Reader(self.letters, self.locate)
        read = [(name, self._read(name, typed, reader)) for name, typed in self.answer.items()]
        reader.finish()
        return [check for name, value in read for check in self._checked(name, value)]

    def _checked(self, name: str, published: Any) -> list[Check]:
        found = list(self._compared(name, published))
        return found or [self._check(name, (), Finding("equal"), "nothing", "nothing", "")]

    def _read(self, name: str, typed: Any, reader: Reader) -> Any:
        if name not in self.derived:
            message = f"this question has no result '{name}'"
            reader.faults.append(SheetError(message, self.key((name,)), self._hint(name)))
            return None
        result = self.derived[name]
        if _is_branches(result):
            return self._read_solutions(name, typed, reader, result)
        if is_spoken(result):
            return typed
        if not isinstance(result, TREES):
            reader.fault(f"'{name}' is nothing that can be compared", (name,), "leave it out")
            return None
        return reader.answer(typed, (name,))

    def _hint(self, name: str) -> str:
        close = get_close_matches(name, self.derived, n=1, cutoff=0.6)
        close = close or [each for each in self.derived if each.lower() == name.lower()]
        if close:
            return f"did you mean {close[0]}?"
        results = self.derivation.results
        unknown = {key for value in results.values() for branch in _branches(value) for key in branch.values}
        if name in unknown:
            return f"write solutions: [{{{name}: ...}}]"
        return f"its results: {', '.join(results)}"

    def _read_solutions(
        self, name: str, typed: Any, reader: Reader, result: tuple[Branch, ...]
    ) -> list[tuple[Solution, ...]] | None:
        listed = [typed] if isinstance(typed, dict) else typed
        if not isinstance(listed, list) or not all(isinstance(each, dict) for each in listed):
            reader.fault("a list of solutions is wanted here", (name,), "write - {theta1: ...}")
            return None
        names = tuple(dict.fromkeys(key for branch in result for key in branch.values))
        solutions = Solutions(reader, self.letters, names, self.key)
        at = [(name, k) if typed is listed else (name,) for k in range(len(listed))]
        return [
            found for each, route in zip(listed, at, strict=True) for found in solutions.read(each, route)
        ]

    def _compared(self, name: str, published: Any) -> Iterator[Check]:
        result = self.derived[name]
        if _is_branches(result):
            yield from self._solutions(name, published, result)
            return
        if is_spoken(result):
            yield self._check(name, (), heard(published, result), str(published), str(result), "")
            return
        terms = self.terms_of(name)
        if self._is_at_point([published.tree]):
            result, terms = replaced(result, self.point), replace(terms, evaluated=True)
        theirs, ours = alike(published, result)
        if isinstance(theirs.tree, Matrix) and isinstance(ours, Matrix) and theirs.tree.shape == ours.shape:
            yield from self._entries(name, theirs, ours, terms)
        elif isinstance(theirs.tree, Matrix) or isinstance(ours, Matrix):
            yield self._misshapen(name, theirs.tree, ours, terms)
        else:
            yield self._one(name, (), theirs, ours, terms)

    def _is_at_point(self, published: Iterable[Expr]) -> bool:
        """Whether an answer is in numbers at the point the question evaluates: nothing in it depends on what
        has a value there."""
        used = (unknowns(tree, self.terms.published) for tree in published)
        return self.evaluate is not None and not frozenset().union(*used) & set(self.evaluate)

    def terms_of(self, name: str) -> Terms:
        """A step of the working may be in terms of names defined there; a result is not."""
        if name in self.derivation.results:
            return self.terms
        return replace(self.terms, derived=self.terms.published)

    def _one(
        self,
        name: str,
        entry: tuple[int, ...],
        theirs: Published,
        ours: Expr,
        terms: Terms,
        slip: str | None = None,
    ) -> Check:
        """The verdict on one entry; `slip` is what went wrong with the whole, where that is known."""
        told = self._told(theirs, ours, terms)
        if told is None:
            finding = Finding("undecided", note=NOTHING)
            return self._check(
                name, entry, finding, as_typed(theirs.tree), shown(ours, {}, terms.evaluated), ""
            )
        tree, finding = told
        if finding.verdict == "differs" and slip is None:
            slip = diagnose(tree, ours, terms)
        return self._check(name, entry, finding, as_typed(tree), shown(ours, {}, terms.evaluated), slip or "")

    def _told(self, theirs: Published, ours: Expr, terms: Terms) -> tuple[Expr, Finding] | None:
        """The worst that is found about the parts of a chain that say something; None where none does."""
        found = []
        for part in (theirs, *theirs.chain):
            names = self._borrowed(part.tree, ours)
            if isinstance(part.tree, Matrix):
                continue
            if not names:
                found.append((part.tree, read_both_ways(part, ours, terms)))
            elif set(names) != {text(part.tree)} or not theirs.chain:
                listed = ", ".join(sorted(names))
                found.append((part.tree, Finding("undecided", note=BORROWED.format(names=listed))))
        if not found:
            return None
        tree, worst = max(found, key=lambda one: SEVERITY.index(one[1].verdict))
        return tree, replace(worst, note=worst.note or theirs.note)

    def _borrowed(self, tree: Expr, ours: Expr) -> frozenset[str]:
        """Names of the derivation that an answer only repeats: what they stand for is not the answer's."""
        own = self.own | set(self.given.where) | set(self.variables)
        working = {key.name for key in self.definitions if isinstance(key, Symbol)} - own
        return (free_symbols(tree) & working) - free_symbols(ours)

    def _check(
        self, name: str, entry: tuple[int, ...], found: Finding, theirs: str, ours: str, diagnosis: str
    ) -> Check:
        witness = {key: float(value) for key, value in found.witness.items()}
        place = self.key((name,))
        return Check(
            self.problem, self.question, name, entry, found.verdict, theirs, ours, place, witness,
            found.values, diagnosis if found.verdict == "differs" else "", found.note,
        )  # fmt: skip

    def _entries(self, name: str, theirs: Published, ours: Matrix, terms: Terms) -> Iterator[Check]:
        flat = ours.shape[1] == 1 and name not in self.derivation.matrices
        assert isinstance(theirs.tree, Matrix)
        slip = moved(theirs.tree, ours, terms)
        wrong = 0
        for i, row in enumerate(ours.rows):
            for j, right in enumerate(row):
                known = slip or (None if wrong < DIAGNOSED else "")
                entry = (i + 1,) if flat else (i + 1, j + 1)
                check = self._one(name, entry, theirs.entry(i, j), right, terms, known)
                wrong += check.verdict == "differs"
                yield check

    def _misshapen(self, name: str, theirs: Expr, ours: Expr, terms: Terms) -> Check:
        diagnosis, note = SHAPE, ""
        if isinstance(theirs, Matrix) and isinstance(ours, Matrix):
            if turned(theirs, ours, terms):
                diagnosis = TRANSPOSED
            elif theirs.shape[1] == ours.shape[1] and len(theirs.rows) < len(ours.rows):
                zeros = _without_zeros(theirs, ours, terms)
                note = "rows of zeros are missing" if zeros else ""
        finding = Finding("differs", note=note)
        return self._check(name, (), finding, _shape(theirs), _shape(ours), diagnosis)

    def _solutions(
        self, name: str, readings: list[tuple[Solution, ...]], result: tuple[Branch, ...]
    ) -> Iterator[Check]:
        values = [tree for several in readings for each in several for tree in each.values()]
        at_point = self._is_at_point(values)
        derived = [branch.values for branch in result]
        if at_point:
            derived = [{name: replaced(tree, self.point) for name, tree in each.items()} for each in derived]
        known = frozenset(n for each in derived for n in each if self._turns(n))
        sampling = replace(
            self.terms.sampling,
            given=self.reached,
            signed=self.terms.sampling.signed | self.own - self._sizes,
        )
        terms = replace(self.terms, sampling=sampling, evaluated=at_point)
        angles = angles_among([*(each for several in readings for each in several), *derived], known)
        short = () if at_point else tuple(put_in(each.short, each.values) for each in result)
        sets = Sets(chosen(readings, derived, terms, angles), derived, terms, angles, short)
        for k, pair in enumerate(sets.paired(), 1):
            theirs, ours = written(pair.published), written(pair.derived, terms.evaluated)
            yield self._check(name, (k,), self._honest(pair), theirs, ours, pair.diagnosis)

    def _honest(self, pair: Paired) -> Finding:
        """Undecided where a solution is in names of the derivation."""
        theirs, ours = pair.published or {}, pair.derived or {}
        names = [self._borrowed(value, ours.get(name, ZERO)) for name, value in theirs.items()]
        listed = ", ".join(sorted(frozenset().union(*names) - theirs.keys()))
        return Finding("undecided", note=BORROWED.format(names=listed)) if listed else pair.finding

    @cached_property
    def _sizes(self) -> frozenset[str]:
        """Symbols of the problem that are no coordinates: lengths, masses."""
        return self.given.symbols - set(self.variables)

    def _turns(self, unknown: str) -> bool:
        """Whether an unknown is an angle by its name or by its joint."""
        return unknown.lower().startswith(("theta", "phi", "psi", "alpha", "beta", "gamma"))


def read_both_ways(published: Published, ours: Expr, terms: Terms) -> Finding:
    """What is found about a formula; of two ways to read a/b c or 2 s, about the right one."""
    found = compare(published.tree, ours, terms)
    if published.measured is not None and found.verdict != "equal":
        other = compare(published.measured, ours, terms)
        if other.verdict == "equal":
            return other
    if published.tight is None:
        return found
    other = compare(published.tight, ours, terms)
    if found.verdict == "equal":
        return (
            found
            if other.verdict == "equal"
            else replace(found, note=f"{found.note or 'reading a/b c as (a/b) c'}")
        )
    if other.verdict == "equal":
        return replace(other, note=other.note or "reading a/b c as a/(b c)")
    return found if other.verdict == "differs" else replace(other, witness={}, values=None)


def alike(published: Published, derived: Expr) -> tuple[Published, Expr]:
    """Both as scalars where they can be, and a flat list as a row where a row is wanted."""
    theirs, ours = published.each(_scalar), _scalar(derived)
    if isinstance(theirs.tree, Matrix) and isinstance(ours, Matrix):
        count, wanted = theirs.tree.shape, ours.shape
        if wanted[0] == 1 and count == (wanted[1], 1):
            return theirs.each(transposed), ours
    return theirs, ours


def _without_zeros(theirs: Matrix, ours: Matrix, terms: Terms) -> bool:
    """Whether only rows of zeros are missing."""
    kept = list(ours.rows)
    for row in [row for row in ours.rows if all(text(entry) == "0" for entry in row)]:
        if len(kept) > len(theirs.rows):
            kept.remove(row)
    return len(kept) == len(theirs.rows) and same(theirs, Matrix(tuple(kept)), terms)


def _scalar(tree: Expr) -> Expr:
    return tree.rows[0][0] if isinstance(tree, Matrix) and tree.shape == (1, 1) else tree


def _shape(tree: Expr) -> str:
    return f"{len(tree.rows)} by {len(tree.rows[0])}" if isinstance(tree, Matrix) else "a scalar"


def _is_branches(result: Any) -> bool:
    return isinstance(result, tuple) and all(isinstance(part, Branch) for part in result)


def _branches(result: Any) -> tuple[Branch, ...]:
    return result if _is_branches(result) else ()
