"""A published solution read: a value for each unknown, one solution for each sign of plus-minus."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from typing import Any

from derive.answers.chains import writable
from derive.answers.latex.letters import Letters
from derive.answers.published import Published
from derive.answers.reading import Reader, Route
from derive.answers.terms import Solution
from derive.errors import FormulaError, Place, SheetError
from derive.expression import Expr, Symbol
from derive.expression import replace as replaced

REMARKS = frozenset(
    {"when", "order", "true_at", "feasible", "rank", "real"}
)  # beside the values in our own JSON
_SIGNS = re.compile(r"\\pm(?![A-Za-z])|\\mp(?![A-Za-z])|\u00b1|\u2213|\+/-")
_WORD = re.compile(r"[A-Za-z_]\w*")


@dataclass(frozen=True)
class Solutions:
    """Reads solutions in terms of `names`, the unknowns of the question."""

    reader: Reader
    letters: Letters
    names: tuple[str, ...]
    key: Callable[[Route], Place]

    def read(self, typed: dict[str, Any], route: Route) -> Iterator[tuple[Solution, ...]]:
        """One solution, or two where signs of plus-minus stand in it: all the upper ones, all the lower ones.
        Each in one reading, or in two where it has an a/b c."""
        values = {key: value for key, value in typed.items() if key not in REMARKS or key in self.names}
        if not values:
            self.reader.fault("this solution is empty", route)
        several = any(isinstance(value, str) and _SIGNS.search(value) for value in values.values())
        for upper in (True, False) if several else (True,):
            yield self._one({key: _signed(value, upper) for key, value in values.items()}, route)

    def _one(self, typed: dict[str, Any], route: Route) -> tuple[Solution, ...]:
        unknowns = {key: self._unknown(key) for key in typed}
        helpers = {key for key, name in unknowns.items() if not name and _is_used(key, typed)}
        known = self.letters.known | set(self.names) | helpers
        letters = replace(self.letters, known=known, own=self.letters.own | helpers | set(self.names))
        reader = replace(self.reader, letters=letters)
        found: dict[str, Published] = {}
        for key, value in typed.items():
            name = unknowns[key] or (key if key in helpers else "")
            if not name:
                self.reader.faults.append(self._no_unknown(key, route))
            elif (read := reader.scalar(value, (*route, key))) is not None:
                found[name] = read
        loose = {name: read.tree for name, read in found.items()}
        tight = {name: read.tight or read.tree for name, read in found.items()}
        try:
            several = [self._written_out(values) for values in (loose, tight)]
        except FormulaError as error:
            reader.fault(error.message, route)
            return (loose,)
        return tuple(several[: 1 + (tight != loose)])

    def _written_out(self, solution: Solution) -> Solution:
        own = {name: value for name, value in solution.items() if name not in self.names}
        if own:
            writable(solution.values(), own)
        return put_in(solution, self.names)

    def _unknown(self, key: str) -> str:
        name = key if key in self.names else self.letters.find(key)
        return name if name in self.names else ""

    def _no_unknown(self, key: str, route: Route) -> SheetError:
        close = get_close_matches(key, self.names, n=1, cutoff=0.5)
        hint = f"did you mean {close[0]}?" if close else f"the unknowns: {', '.join(self.names)}"
        return SheetError(f"'{key}' is no unknown of this question", self.key((*route, key)), hint)


def put_in(solution: Solution, unknowns: Collection[str]) -> Solution:
    """The values of the unknowns, with the other names that a solution defines replaced by what they stand
    for."""
    found = dict(solution)
    for helper in [name for name in solution if name not in unknowns]:
        value: dict[Expr, Expr] = {Symbol(helper): found.pop(helper)}
        found = {name: replaced(tree, value) for name, tree in found.items()}
    return found


def _signed(value: Any, upper: bool) -> Any:
    """A text with one of the signs for each plus-minus, as long as it was."""
    if not isinstance(value, str):
        return value

    def sign(found: re.Match[str]) -> str:
        minus = found[0].lstrip("\\") in ("mp", "\u2213")
        return ("+" if minus != upper else "-").ljust(len(found[0]))

    return _SIGNS.sub(sign, value)


def _is_used(key: str, typed: Mapping[str, Any]) -> bool:
    """Whether a name stands in a value of its own solution."""
    others = (value for name, value in typed.items() if name != key and isinstance(value, str))
    return any(key in _WORD.findall(value) for value in others)
