"""The published answers to one question, each entry held against what was derived."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from derive.algebra.infix import text
from derive.algebra.values import MATRIX_FUNCTIONS
from derive.answers.asked import Asked
from derive.answers.branches import Paired, Sets, angles_among, chosen, written
from derive.answers.comparing import compare
from derive.answers.diagnosing import SHAPE, TRANSPOSED, diagnose
from derive.answers.findings import Check, as_typed
from derive.answers.moved import moved, same, transposed, turned
from derive.answers.points import shown, unknowns
from derive.answers.published import Published
from derive.answers.solutions import put_in
from derive.answers.terms import Finding, Solution, Terms, Verdict
from derive.answers.typed import heard, is_branches, is_spoken, read_typed
from derive.derivation import Branch
from derive.expression import ZERO, Call, Expr, Matrix, Number, Symbol, free_symbols
from derive.expression import replace as replaced

ANGLES = ("theta", "phi", "psi", "alpha", "beta", "gamma")  # unknowns called so are angles
DIAGNOSED = 12  # entries of one answer
SEVERITY: tuple[Verdict, ...] = ("equal", "undecided", "differs")
BORROWED = "it is in terms of {names}, which this derivation defines and the answer does not"
NOTHING = "the answer only names itself"


def checks(asked: Asked) -> list[Check]:
    """A check for each entry of the answer to a question, one at least for each of its names.

    Raises SheetErrors with everything that cannot be read."""
    compared = Compared(asked)
    return [check for name, typed in read_typed(asked).items() for check in compared.checks(name, typed)]


@dataclass(frozen=True, slots=True)
class Compared:
    """What was read of an answer, held against what was derived for its question."""

    asked: Asked

    def checks(self, name: str, published: Any) -> list[Check]:
        """A check for each entry of what was published under a name."""
        result = self.asked.derived[name]
        if is_branches(result):
            found = list(self._solutions(name, published, result))
        elif is_spoken(result):
            found = [self._check(name, (), heard(published, result), str(published), str(result))]
        else:
            found = list(self._formula(name, published, result))
        return found or [self._check(name, (), Finding("equal"), "nothing", "nothing")]

    # -- formulas and matrices --------------------------------------------------------------------

    def _formula(self, name: str, published: Published, result: Expr) -> Iterator[Check]:
        terms = self.asked.terms_of(name)
        if self._is_at_point([published.tree]):
            result, terms = replaced(result, self.asked.point), replace(terms, evaluated=True)
        theirs, ours = alike(published, result)
        if isinstance(theirs.tree, Matrix) and isinstance(ours, Matrix) and theirs.tree.shape == ours.shape:
            yield from self._entries(name, theirs, theirs.tree, ours, terms)
        elif isinstance(theirs.tree, Matrix) or isinstance(ours, Matrix):
            yield self._misshapen(name, theirs.tree, ours, terms)
        else:
            yield self._one(name, (), theirs, ours, terms)

    def _is_at_point(self, published: Iterable[Expr]) -> bool:
        """Whether an answer is in numbers at the point the question evaluates: nothing in it depends on what
        has a value there."""
        used = (unknowns(tree, self.asked.terms.published) for tree in published)
        return self.asked.evaluate is not None and not frozenset().union(*used) & set(self.asked.evaluate)

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
        tree, finding = self._told(theirs, ours, terms) or (theirs.tree, Finding("undecided", note=NOTHING))
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
            elif not _is_name(part.tree) or not theirs.chain:
                found.append((part.tree, _borrows(names)))
        if not found:
            return None
        tree, worst = max(found, key=lambda one: SEVERITY.index(one[1].verdict))
        return tree, replace(worst, note=worst.note or theirs.note)

    def _borrowed(self, tree: Expr, ours: Expr) -> frozenset[str]:
        """Names of the derivation that an answer only repeats: what they stand for is not the answer's."""
        asked = self.asked
        own = asked.own | set(asked.given.where) | set(asked.variables)
        working = {key.name for key in asked.definitions if isinstance(key, Symbol)} - own
        return (free_symbols(tree) & working) - free_symbols(ours)

    def _entries(
        self, name: str, theirs: Published, matrix: Matrix, ours: Matrix, terms: Terms
    ) -> Iterator[Check]:
        flat = ours.shape[1] == 1 and name not in self.asked.derivation.matrices
        slip = moved(matrix, ours, terms)
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

    # -- solutions --------------------------------------------------------------------------------

    def _solutions(
        self, name: str, readings: list[tuple[Solution, ...]], result: tuple[Branch, ...]
    ) -> Iterator[Check]:
        asked = self.asked
        every = [each for several in readings for each in several]
        at_point = self._is_at_point(tree for each in every for tree in each.values())
        derived = [branch.values for branch in result]
        if at_point:
            derived = [{name: replaced(tree, asked.point) for name, tree in each.items()} for each in derived]
            if any(free_symbols(tree) - each.keys() for each in derived for tree in each.values()):
                derived = self._in_numbers(derived)  # in the root of a polynomial, which is a number there
        known = frozenset(n for each in derived for n in each if n.lower().startswith(ANGLES))
        coordinates = asked.own - (asked.given.symbols - set(asked.variables))  # no lengths, no masses
        sampling = asked.terms.sampling
        sampling = replace(sampling, given=asked.reached, signed=sampling.signed | coordinates)
        terms = replace(asked.terms, sampling=sampling, evaluated=at_point)
        angles = angles_among([*every, *derived], known)
        short = () if at_point else tuple(put_in(each.short, each.values) for each in result)
        sets = Sets(chosen(readings, derived, terms, angles), derived, terms, angles, short)
        for k, pair in enumerate(sets.paired(), 1):
            theirs, ours = written(pair.published), written(pair.derived, at_point)
            yield self._check(name, (k,), self._honest(pair), theirs, ours, pair.diagnosis)

    def _in_numbers(self, derived: list[Solution]) -> list[Solution]:
        """The solutions as they are evaluated."""
        found = self.asked.derivation.evaluated.get("solutions", ())
        names = derived[0].keys()
        return [
            {name: Number(Fraction(each[name]), decimal=True) for name in names}
            for each in found
            if each.get("real", True)
        ]

    def _honest(self, pair: Paired) -> Finding:
        """Undecided where a solution is in names of the derivation."""
        theirs, ours = pair.published or {}, pair.derived or {}
        names = [self._borrowed(value, ours.get(name, ZERO)) for name, value in theirs.items()]
        borrowed = frozenset().union(*names) - theirs.keys()
        return _borrows(borrowed) if borrowed else pair.finding

    def _check(
        self, name: str, entry: tuple[int, ...], found: Finding, theirs: str, ours: str, diagnosis: str = ""
    ) -> Check:
        witness = {key: float(value) for key, value in found.witness.items()}
        asked = self.asked
        return Check(
            asked.problem, asked.question, name, entry, found.verdict, theirs, ours, asked.key((name,)),
            witness, found.values, diagnosis if found.verdict == "differs" else "", found.note,
        )  # fmt: skip


def _borrows(names: Iterable[str]) -> Finding:
    return Finding("undecided", note=BORROWED.format(names=", ".join(sorted(names))))


def _is_name(tree: Expr) -> bool:
    r"""Whether a tree is what one calls something and says nothing of it: J, \det J, J^T."""
    match tree:
        case Call(function, (inner,)) if function in MATRIX_FUNCTIONS:
            return _is_name(inner)
    return isinstance(tree, Symbol)


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
        clear = other.verdict == "equal"
        return found if clear else replace(found, note=found.note or "reading a/b c as (a/b) c")
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
