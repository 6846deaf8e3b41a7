"""What an auditor is given, an answer as it leaves the house and its records, and what it says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeAlias

import sympy

from derive.audit.points import Point, Value
from derive.audit.text import Json, Names, Unreadable, sympy_of_text
from derive.audit.trees import names_of, sympy_of
from derive.expression import Expr


@dataclass(frozen=True)
class Asked:
    """One question and our answer to it. `subject` is the frozen record of the sheet's subject, `options` the
    question's own; `results` and `evaluated` are the JSON, texts and floats."""

    subject_name: str
    kind: str
    subject: Any
    options: Any
    results: Mapping[str, Json]
    evaluated: Mapping[str, Json] = field(default_factory=dict)
    evaluate: Mapping[str, Expr] | None = None
    where: Mapping[str, Expr] = field(default_factory=dict)
    assumptions: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def names(self) -> Names:
        """The values of `where`."""
        return names_of(self.where)

    def formula(self, tree: Expr) -> sympy.Expr:
        """A formula of the records, names of `where` replaced."""
        return sympy_of(tree, self.names)

    def read(self, text: Json) -> Any:
        """A text, or nested lists of texts, of the answer as SymPy expressions. Raises Unreadable."""
        if isinstance(text, list | tuple):
            return [self.read(part) for part in text]
        if isinstance(text, str):
            return sympy_of_text(text, self.names)
        if isinstance(text, int | float):
            return sympy.Float(text) if isinstance(text, float) else sympy.Integer(text)
        raise Unreadable(f"{text!r} is no formula")

    @cached_property
    def _read(self) -> dict[str, Any]:
        return {}

    def result(self, name: str) -> Any:
        """A result as SymPy expressions, read once. Raises Unreadable, KeyError."""
        if name not in self._read:
            self._read[name] = self.read(self.results[name])
        return self._read[name]

    def ours(self, name: str, point: Point) -> Value:
        """The value of one of our results at a point."""
        return point.each(self.result(name))


@dataclass(frozen=True, slots=True)
class Same:
    """What the result of this name should be at the point, in the shape it has in the JSON."""

    name: str
    theirs: Value


@dataclass(frozen=True, slots=True)
class Holds:
    """What must be true of a result; `said` is told where it is not."""

    name: str
    holds: bool
    said: str


@dataclass(frozen=True, slots=True)
class Beyond:
    """A result that this auditor cannot judge, and why."""

    name: str
    reason: str


Test: TypeAlias = Same | Holds | Beyond
