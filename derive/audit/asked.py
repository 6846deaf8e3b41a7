"""What an auditor is given, an answer as it leaves the house and its records, and what it says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeAlias

import sympy

from derive.audit.equations import is_system, solution
from derive.audit.points import Point, Value
from derive.audit.text import Json, Names, Unreadable, sympy_of_text
from derive.audit.trees import names_of, sympy_of
from derive.expression import Expr

EVALUATED = "evaluated "


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
        if is_system(text):
            return self.read(text["unknowns"])
        if isinstance(text, list | tuple):
            return [self.read(part) for part in text]
        if isinstance(text, str):
            return sympy_of_text(text, self.names)
        if isinstance(text, int | float):
            return sympy.Float(text) if isinstance(text, float) else sympy.Integer(text)
        raise Unreadable(f"{text!r} is no formula")

    @cached_property
    def here(self) -> Point:
        """Where the author wants numbers; a name without a value there is drawn."""
        fixed = {name: self.formula(value) for name, value in (self.evaluate or {}).items()}
        return Point(0, False, (), self.assumptions, fixed)

    def place_of(self, name: str, point: Point) -> Point:
        """Where a result is tried: at the point, but one in numbers where the author wants them."""
        return self.here if name.startswith(EVALUATED) else point

    def answered(self, name: str) -> bool:
        """Whether there is a result of this name."""
        return name in self.results or name.removeprefix(EVALUATED) in self.evaluated

    def objects(self, name: str) -> list[Mapping[str, Any]]:
        """A result that is a list of objects, branches of a solution. Raises Unreadable."""
        numbers = name.startswith(EVALUATED)
        told = self.evaluated.get(name.removeprefix(EVALUATED)) if numbers else self.results.get(name)
        if not isinstance(told, list) or not all(isinstance(each, Mapping) for each in told):
            raise Unreadable(f"{name} is no list of objects")
        return told

    @cached_property
    def _read(self) -> dict[str, Any]:
        return {}

    def result(self, name: str) -> Any:
        """A result (`evaluated J` is one in numbers) as SymPy expressions, read once. Raises Unreadable,
        KeyError."""
        if name not in self._read:
            self._read[name] = self.read(self._told(name))
        return self._read[name]

    def _told(self, name: str) -> Json:
        if name.startswith(EVALUATED):
            return self.evaluated[name.removeprefix(EVALUATED)]
        return self.results[name]

    def ours(self, name: str, point: Point) -> Value:
        """The value of one of our results at a point; what solves it where equations are told."""
        told, place = self._told(name), self.place_of(name, point)
        if is_system(told):
            return solution(told, self.names, place)
        return place.each(self.result(name))


@dataclass(frozen=True, slots=True)
class Same:
    """What the result of this name should be at the point, in the shape it has in the JSON; of `evaluated J`
    at the point that the author gave."""

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
