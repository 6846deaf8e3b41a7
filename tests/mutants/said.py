"""What can be said wrong in a line, a sentence or a table: each version that differs in one place."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeAlias

from derive.derivation import Phrase, Step, Table
from derive.expression import ZERO, Approximate, Relation, negate
from tests.kinds.planting import TREES, turned

Version: TypeAlias = tuple[str, str, Any]  # what it is called, the field, what it holds instead
Versions: TypeAlias = Callable[[Mapping[str, Any]], Iterator[Version]]

FLIPPED = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "=": "!=", "!=": "="}


def of_line(step: Mapping[str, Any]) -> Iterator[Version]:
    """The end of the chain with a wrong sign."""
    chain = tuple(step.get("chain", ()))
    last = turned(chain[-1]) if chain and chain[-1] != ZERO else None
    if last is not None:
        yield step["name"], "chain", (*chain[:-1], last)


def of_sentence(phrase: Mapping[str, Any]) -> Iterator[Version]:
    """Each field with a wrong sign, another count, or a relation the other way round."""
    about = dict(phrase.get("about") or {})
    for name, said in about.items():
        for k, wrong in enumerate(_wrong(said)):
            yield f"{phrase['key']}.{name}.{k}", "about", {**about, name: wrong}


def of_table(table: Mapping[str, Any]) -> Iterator[Version]:
    """Each cell likewise."""
    rows = tuple(map(tuple, table["rows"]))
    for i, row in enumerate(rows):
        for j, cell in enumerate(row):
            for wrong in _wrong(cell):
                yield f"{i}.{j}", "rows", (*rows[:i], (*row[:j], wrong, *row[j + 1 :]), *rows[i + 1 :])


MADE: Mapping[str, tuple[type, Versions]] = {
    "lines": (Step, of_line), "sentences": (Phrase, of_sentence), "tables": (Table, of_table)
}  # fmt: skip


def _wrong(said: Any) -> Iterator[Any]:
    """A phrase within has versions of its own."""
    match said:
        case bool() | str() | Phrase():
            return
        case int():
            yield said + 1
        case tuple():
            for i, part in enumerate(said):
                yield from ((*said[:i], wrong, *said[i + 1 :]) for wrong in _wrong(part))
        case Relation(left, sign, right):
            yield from (Relation(left, sign, wrong) for wrong in _wrong(right))
            if isinstance(left, Relation):
                yield from (Relation(wrong, sign, right) for wrong in _wrong(left))
            if sign in FLIPPED:
                yield Relation(left, FLIPPED[sign], right)
        case Approximate():
            yield negate(said)
        case _ if isinstance(said, TREES) and (wrong := turned(said)) is not None:
            yield wrong
