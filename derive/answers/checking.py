"""The published answers to one question, each entry held against what was derived."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import cached_property
from typing import Any

from derive.algebra.text import text
from derive.answers.asked import Asked
from derive.answers.branches import Sets, Solution, angles_among, written
from derive.answers.comparing import Finding, Terms, compare, proved
from derive.answers.diagnosing import SHAPE, TRANSPOSED, diagnose
from derive.answers.findings import Check, as_typed
from derive.answers.reading import Reader, Route
from derive.derivation import Branch
from derive.errors import SheetError
from derive.expression import Expr, Matrix
from derive.kinds.problem import TREES

DIAGNOSED = 12  # entries of one answer


@dataclass(frozen=True)
class Compared(Asked):
    """The same with its answers read and compared."""

    def checks(self) -> list[Check]:
        """A check for each entry. Raises SheetErrors with everything that cannot be read."""
        reader = Reader(self.letters, self.locate)
        read = [(name, self._read(name, typed, reader)) for name, typed in self.answer.items()]
        reader.finish()
        return [check for name, value in read for check in self._compared(name, value)]

    def _read(self, name: str, typed: Any, reader: Reader) -> Any:
        if name not in self.derived:
            message = f"this question has no result '{name}'"
            reader.faults.append(SheetError(message, self.key((name,)), self._hint(name)))
            return None
        result = self.derived[name]
        if _is_branches(result):
            return self._read_solutions(name, typed, reader, result)
        if not isinstance(result, TREES):
            reader.fault(f"'{name}' is nothing that can be compared", (name,), "leave it out")
            return None
        return reader.tree(typed, (name,))

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
    ) -> list[Solution] | None:
        listed = [typed] if isinstance(typed, dict) else typed
        if not isinstance(listed, list) or not all(isinstance(each, dict) for each in listed):
            reader.fault("a list of solutions is wanted here", (name,), "write - {theta1: ...}")
            return None
        names = [key for branch in result for key in branch.values]
        letters = replace(self.letters, known=self.letters.known | set(names))
        inner = replace(reader, letters=letters)
        at = [(name, k) if typed is listed else (name,) for k in range(len(listed))]
        return [self._read_one(each, route, inner, names) for each, route in zip(listed, at, strict=True)]

    def _read_one(self, typed: dict[str, Any], route: Route, reader: Reader, names: list[str]) -> Solution:
        found = {}
        for key, value in typed.items():
            unknown = key if key in names else self.letters.find(key)
            if key == "when":
                continue
            if unknown not in names:
                close = get_close_matches(key, names, n=1, cutoff=0.5)
                hint = (
                    f"did you mean {close[0]}?"
                    if close
                    else f"the unknowns: {', '.join(dict.fromkeys(names))}"
                )
                message = f"'{key}' is no unknown of this question"
                reader.faults.append(SheetError(message, self.key((*route, key)), hint))
            elif (tree := reader.scalar(value, (*route, key))) is not None:
                found[unknown] = tree
        if not typed:
            reader.fault("this solution is empty", route)
        return found

    def _compared(self, name: str, published: Any) -> Iterator[Check]:
        result = self.derived[name]
        if _is_branches(result):
            yield from self._solutions(name, published, result)
            return
        theirs, ours = alike(published, result)
        if isinstance(theirs, Matrix) and isinstance(ours, Matrix) and theirs.shape == ours.shape:
            yield from self._entries(name, theirs, ours)
        elif isinstance(theirs, Matrix) or isinstance(ours, Matrix):
            yield self._misshapen(name, theirs, ours)
        else:
            yield self._one(name, (), theirs, ours)

    def terms_of(self, name: str) -> Terms:
        """A step of the working may be in terms of names defined there; a result is not."""
        if name in self.derivation.results:
            return self.terms
        return replace(self.terms, derived=self.terms.published)

    def _one(
        self, name: str, entry: tuple[int, ...], theirs: Expr, ours: Expr, diagnosis: str | None = None
    ) -> Check:
        terms = self.terms_of(name)
        finding = compare(theirs, ours, terms)
        if finding.verdict == "differs" and diagnosis is None:
            diagnosis = diagnose(theirs, ours, terms)
        return self._check(name, entry, finding, as_typed(theirs), text(ours), diagnosis or "")

    def _check(
        self, name: str, entry: tuple[int, ...], found: Finding, theirs: str, ours: str, diagnosis: str
    ) -> Check:
        witness = {key: float(value) for key, value in found.witness.items()}
        place = self.key((name,))
        return Check(
            self.problem, self.question, name, entry, found.verdict, theirs, ours, place, witness,
            found.values, diagnosis if found.verdict == "differs" else "", found.note,
        )  # fmt: skip

    def _entries(self, name: str, theirs: Matrix, ours: Matrix) -> Iterator[Check]:
        turned = self._is_transposed(name, theirs, ours)
        flat = ours.shape[1] == 1 and name not in self.derivation.matrices
        wrong = 0
        for i, (row, right) in enumerate(zip(theirs.rows, ours.rows, strict=True), 1):
            for j, (one, other) in enumerate(zip(row, right, strict=True), 1):
                known = TRANSPOSED if turned else None if wrong < DIAGNOSED else ""
                check = self._one(name, (i,) if flat else (i, j), one, other, known)
                wrong += check.verdict == "differs"
                yield check

    def _is_transposed(self, name: str, theirs: Matrix, ours: Matrix) -> bool:
        turned = Matrix(tuple(zip(*theirs.rows, strict=True)))
        return turned.shape == ours.shape and turned != theirs and self._same(name, turned, ours)

    def _same(self, name: str, theirs: Matrix, ours: Matrix) -> bool:
        """Whether matrices of one shape are equal in every entry."""
        terms = self.terms_of(name)
        pairs = zip(sum(theirs.rows, ()), sum(ours.rows, ()), strict=True)
        return all(proved(one, other, terms) for one, other in pairs)

    def _misshapen(self, name: str, theirs: Expr, ours: Expr) -> Check:
        diagnosis, note = SHAPE, ""
        if isinstance(theirs, Matrix) and isinstance(ours, Matrix):
            if self._is_transposed(name, theirs, ours):
                diagnosis = TRANSPOSED
            elif theirs.shape[1] == ours.shape[1] and len(theirs.rows) < len(ours.rows):
                zeros = self._without_zeros(name, theirs, ours)
                note = "rows of zeros are missing" if zeros else ""
        finding = Finding("differs", note=note)
        return self._check(name, (), finding, _shape(theirs), _shape(ours), diagnosis)

    def _without_zeros(self, name: str, theirs: Matrix, ours: Matrix) -> bool:
        """Whether only rows of zeros are missing."""
        kept = list(ours.rows)
        for row in [row for row in ours.rows if all(text(entry) == "0" for entry in row)]:
            if len(kept) > len(theirs.rows):
                kept.remove(row)
        return len(kept) == len(theirs.rows) and self._same(name, theirs, Matrix(tuple(kept)))

    def _solutions(self, name: str, published: list[Solution], result: tuple[Branch, ...]) -> Iterator[Check]:
        derived = [branch.values for branch in result]
        known = frozenset(n for n in derived[0] if self._turns(n)) if derived else frozenset()
        sampling = replace(
            self.terms.sampling,
            given=self.reached,
            signed=self.terms.sampling.signed | self.own - self._sizes,
        )
        terms = replace(self.terms, sampling=sampling)
        sets = Sets(published, derived, terms, angles_among([*published, *derived], known))
        for k, pair in enumerate(sets.paired(), 1):
            theirs, ours = written(pair.published), written(pair.derived)
            yield self._check(name, (k,), pair.finding, theirs, ours, pair.diagnosis)

    @cached_property
    def _sizes(self) -> frozenset[str]:
        """Symbols of the problem that are no coordinates: lengths, masses."""
        return self.given.symbols - set(self.variables)

    def _turns(self, unknown: str) -> bool:
        """Whether an unknown is an angle by its name or by its joint."""
        return unknown.lower().startswith(("theta", "phi", "psi", "alpha", "beta", "gamma"))


def alike(published: Expr, derived: Expr) -> tuple[Expr, Expr]:
    """Both as scalars where they can be, and a flat list as a row where a row is wanted."""
    theirs, ours = _scalar(published), _scalar(derived)
    if isinstance(theirs, Matrix) and isinstance(ours, Matrix):
        count, wanted = theirs.shape, ours.shape
        if wanted[0] == 1 and count == (wanted[1], 1):
            return Matrix(tuple(zip(*theirs.rows, strict=True))), ours
    return theirs, ours


def _scalar(tree: Expr) -> Expr:
    return tree.rows[0][0] if isinstance(tree, Matrix) and tree.shape == (1, 1) else tree


def _shape(tree: Expr) -> str:
    return f"{len(tree.rows)} by {len(tree.rows[0])}" if isinstance(tree, Matrix) else "a scalar"


def _is_branches(result: Any) -> bool:
    return isinstance(result, tuple) and all(isinstance(part, Branch) for part in result)


def _branches(result: Any) -> tuple[Branch, ...]:
    return result if _is_branches(result) else ()
