"""What was found about one entry of an answer, ready to be told."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from derive.algebra.infix import text
from derive.answers.terms import Verdict
from derive.errors import Place
from derive.expression import MINUS_ONE, Expr, Number, Product, Symbol, replace, walk


@dataclass(frozen=True, slots=True)
class Check:
    """One entry compared. `entry` counts from 1 and is empty for a scalar; `witness` is a point where the
    two differ and `values` what they are there (None: no real value)."""

    problem: int
    question: int
    name: str
    entry: tuple[int, ...]
    verdict: Verdict
    published: str
    derived: str
    place: Place
    witness: Mapping[str, float] = field(default_factory=dict)
    values: tuple[float | None, float | None] | None = None
    diagnosis: str = ""
    note: str = ""

    def plain(self) -> dict[str, Any]:
        """The same as JSON, in the shape the sheet language promises."""
        found: dict[str, Any] = {"problem": self.problem, "question": self.question, "name": self.name}
        if self.entry:
            found["entry"] = list(self.entry)
        found |= {"verdict": self.verdict, "published": self.published, "derived": self.derived}
        if self.verdict == "differs":
            if self.values is not None:
                found["witness"] = dict(self.witness)
            if self.diagnosis:
                found["diagnosis"] = self.diagnosis
        return {**found, "note": self.note} if self.note else found


def as_typed(tree: Expr) -> str:
    """A published formula in SymPy's syntax, its decimals as decimals."""
    decimals = [node for node in walk(tree) if isinstance(node, Number) and node.decimal]
    return text(replace(tree, {node: _decimal(node) for node in decimals}))


def _decimal(number: Number) -> Expr:
    digits = Symbol(f"{float(abs(number.value)):.15g}")
    return Product((MINUS_ONE, digits)) if number.value < 0 else digits
