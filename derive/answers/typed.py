"""The answer to a question as its author typed it, read name by name: formulas, solutions, words."""

from __future__ import annotations

import re
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any, TypeGuard

from derive.answers.asked import Asked
from derive.answers.reading import Reader
from derive.answers.solutions import Solutions
from derive.answers.terms import Finding, Solution
from derive.derivation import Branch
from derive.errors import SheetError
from derive.expression import ONE, ZERO, Expr, Matrix
from derive.kinds.problem import TREES

DIGITS = re.compile(r"[01]{2,}")
AS_THEY_STAND = "words are compared as they stand"


def read_typed(asked: Asked) -> dict[str, Any]:
    """What was typed under each name: a Published, of branches a list of solutions with their readings, words
    as they stand. Raises SheetErrors with everything that cannot be read."""
    reader = Reader(asked.letters, asked.locate)
    found = {name: _Named(asked, reader, name).read(typed) for name, typed in asked.answer.items()}
    reader.finish()
    return found


def _is_code(result: Expr | Matrix) -> bool:
    """Whether a result is a column of digits 0 and 1."""
    return isinstance(result, Matrix) and all(row in ((ZERO,), (ONE,)) for row in result.rows)


def is_branches(result: Any) -> TypeGuard[tuple[Branch, ...]]:
    """Whether a result is a set of solutions."""
    return isinstance(result, tuple) and all(isinstance(part, Branch) for part in result)


@dataclass(frozen=True, slots=True)
class _Named:
    """One name of an answer."""

    asked: Asked
    reader: Reader
    name: str

    def read(self, typed: Any) -> Any:
        if self.name not in self.asked.derived:
            message = f"this question has no result '{self.name}'"
            self.reader.faults.append(SheetError(message, self.asked.key((self.name,)), self._hint()))
            return None
        result = self.asked.derived[self.name]
        if is_branches(result):
            return self._solutions(typed, result)
        if is_spoken(result):
            return typed
        if not isinstance(result, TREES):
            self.reader.fault(f"'{self.name}' is nothing that can be compared", (self.name,), "leave it out")
            return None
        if isinstance(typed, str) and DIGITS.fullmatch(typed) and _is_code(result):
            typed = [*typed]  # a code is written in one word
        return self.reader.answer(typed, (self.name,))

    def _hint(self) -> str:
        derived, results = self.asked.derived, self.asked.derivation.results
        close = get_close_matches(self.name, derived, n=1, cutoff=0.6)
        close = close or [each for each in derived if each.lower() == self.name.lower()]
        if close:
            return f"did you mean {close[0]}?"
        sets = [result for result in results.values() if is_branches(result)]
        if any(self.name in branch.values for result in sets for branch in result):
            return f"write solutions: [{{{self.name}: ...}}]"
        return f"its results: {', '.join(results)}"

    def _solutions(self, typed: Any, result: tuple[Branch, ...]) -> list[tuple[Solution, ...]] | None:
        name, listed = self.name, [typed] if isinstance(typed, dict) else typed
        if not isinstance(listed, list) or not all(isinstance(each, dict) for each in listed):
            self.reader.fault("a list of solutions is wanted here", (name,), "write - {theta1: ...}")
            return None
        names = tuple(dict.fromkeys(key for branch in result for key in branch.values))
        solutions = Solutions(self.reader, self.asked.letters, names, self.asked.key)
        at = [(name, k) if typed is listed else (name,) for k in range(len(listed))]
        return [
            found for each, route in zip(listed, at, strict=True) for found in solutions.read(each, route)
        ]


def is_spoken(result: Any) -> TypeGuard[str | tuple[str, ...]]:
    """Whether a result is a text or a list of texts."""
    return isinstance(result, str) or (
        isinstance(result, tuple) and bool(result) and all(isinstance(part, str) for part in result)
    )


def heard(published: Any, derived: str | tuple[str, ...]) -> Finding:
    """Equal where the texts are the same; one word that is another differs, and more is not judged."""
    theirs, ours = _words(published), _words(derived)
    if theirs == ours:
        return Finding("equal")
    single = len(ours) == len(theirs) == 1 and " " not in ours[0] + theirs[0]
    return Finding("differs" if single else "undecided", note="" if single else AS_THEY_STAND)


def _words(spoken: Any) -> list[str]:
    listed = spoken if isinstance(spoken, list | tuple) else [spoken]
    return sorted(" ".join(str(text).lower().split()) for text in listed)
