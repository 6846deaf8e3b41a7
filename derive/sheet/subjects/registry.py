"""Subjects are found by walking this folder, as kinds are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from types import ModuleType

from derive.algebra.normal import Names, normal
from derive.algebra.signs import sign_of
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol

NOT_SUBJECTS = frozenset(
    {"__init__", "registry", "moves", "link", "screws", "quaternions", "orientation", "parameters"}
)


@dataclass(frozen=True, slots=True)
class Known:
    """What the sheet has said before: values of names, and assumptions about them."""

    where: Mapping[str, Expr] = field(default_factory=dict)
    assumptions: Mapping[str, str] = field(default_factory=dict)

    @property
    def names(self) -> frozenset[str]:
        """The declared names."""
        return frozenset(self.where) | frozenset(self.assumptions)

    @property
    def values(self) -> Names:
        """What the names of `where` stand for."""
        return {Symbol(name): value for name, value in self.where.items()}

    @property
    def positive(self) -> frozenset[str]:
        """The names that are said to be positive."""
        return frozenset(name for name, said in self.assumptions.items() if said == "positive")

    def sign(self, value: Expr) -> int | None:
        """1, 0 or -1; None where it is not known."""
        try:
            return sign_of(normal(value, self.values), self.positive)
        except (NotDerivable, ZeroDivisionError):
            return None


def subjects() -> tuple[str, ...]:
    """The names of the subjects, in alphabetical order."""
    stems = (path.stem for path in Path(__file__).parent.glob("*.py"))
    return tuple(sorted(stem for stem in stems if stem not in NOT_SUBJECTS))


def load(name: str) -> ModuleType:
    """The module of a subject."""
    return import_module(f"derive.sheet.subjects.{name}")
