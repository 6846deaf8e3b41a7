"""What the facts of a derivation give its words to say: mathematics, phrases and tables.

What is given is said; what a page has no use for, a kind leaves out of its facts. So a condition in the words
that leaves something out, or takes another way, does not go unnoticed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields
from typing import Any, TypeAlias, get_args

from derive.derivation import Derivation, PageFacts, Phrase, Record, Table
from derive.expression import Expr, Relation

Sayable: TypeAlias = Expr | Relation | Phrase | Table
SAYABLE = (*get_args(Expr), Relation, Phrase, Table)
CHOOSING = frozenset(  # kinds whose words still choose among what they are given
    ("regressor",)
)  # fmt: skip
NOT_FOR_WORDS = frozenset(field.name for field in fields(PageFacts))


def sayable(derivation: Derivation) -> Iterator[tuple[str, Sayable]]:
    """What the facts of a derivation and of its steps hold that can be said, with the names of the fields."""
    if derivation.kind in CHOOSING:
        return
    for record in (derivation.facts, *(step.facts for step in derivation.all_steps())):
        yield from _in_record(record, "")


def parts(value: Any) -> Iterator[Sayable]:
    """What can be said in a value, and in what fills its phrases and cells."""
    for _, said in _in_value(value, ""):
        yield said
        match said:
            case Phrase(about=about):
                yield from (part for filled in about.values() for part in parts(filled))
            case Table(headings, rows):
                yield from (part for row in (headings, *rows) for part in parts(row))


def _in_record(record: Record, name: str) -> Iterator[tuple[str, Sayable]]:
    for field in fields(record):
        if field.name not in NOT_FOR_WORDS:
            yield from _in_value(getattr(record, field.name), f"{name}{field.name}")


def _in_value(value: Any, name: str) -> Iterator[tuple[str, Sayable]]:
    match value:
        case Record():
            yield from _in_record(value, f"{name}.")
        case Mapping():
            yield from (said for part in value.values() for said in _in_value(part, name))
        case tuple() | list():
            yield from (said for part in value for said in _in_value(part, name))
        case _ if isinstance(value, SAYABLE):
            yield name, value
