"""What is said in words, and what fills their fields; records that the words read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias, dataclass_transform

from derive.expression import Expr, Relation


@dataclass_transform(frozen_default=True, kw_only_default=True, field_specifiers=(field,))
@dataclass(frozen=True)
class Record:
    """Plain values that the words read: a subclass lists them with their types and is frozen."""

    def __init_subclass__(cls) -> None:
        dataclass(frozen=True, kw_only=True)(cls)


@dataclass(frozen=True, slots=True)
class Phrase:
    """Something said in words: their key in `templates/words/`, and what fills their fields."""

    key: str
    about: Mapping[str, Said] = field(default_factory=dict)

    def __hash__(self) -> int:
        return hash(self.key)


Condition: TypeAlias = Relation | Phrase
Label: TypeAlias = "Phrase | Expr | Relation | str"
Cell: TypeAlias = Expr | Condition | tuple[Condition, ...] | str
Said: TypeAlias = "Phrase | Relation | Expr | str | int | tuple[Said, ...]"  # texts as they stand


@dataclass(frozen=True, slots=True)
class Table:
    """Rows under headings; an entry is mathematics, something said in words, or a text as it stands."""

    headings: tuple[Cell, ...]
    rows: tuple[tuple[Cell, ...], ...]

    def __post_init__(self) -> None:
        if any(len(row) != len(self.headings) for row in self.rows):
            raise ValueError("each row of a table has a cell under each heading")
