"""The signs in a table that a page gives, against those of what was typed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, TypeAlias, get_args

from pydantic import BaseModel

from derive.derivation import Cell, Phrase
from derive.expression import Degrees, Expr, Matrix, Measured, Number, children, negate

TREES = get_args(Expr)
Entries: TypeAlias = tuple[Expr, ...]
Key: TypeAlias = tuple[bool, float]  # whether it is in degrees, its value


def mistabled(rows: Sequence[Sequence[Cell]], typed: Any) -> bool:
    """Whether a column is a typed one with other signs, or a number stands in more cells than it was typed
    and its opposite was typed; or a row has a negative number."""
    cells = [_plain(cell) for row in rows for cell in row if isinstance(cell, TREES)]
    vectors = {*_vectors(typed)}
    shown = Counter(key for cell in cells if (key := _key(cell)))
    counts = Counter(key for tree in _trees(typed) if (key := _key(tree)))
    return (
        any(_is_turned(children(cell), vectors) for cell in cells if isinstance(cell, Matrix))
        or any(n > counts[key] and counts[_opposite(key)] for key, n in shown.items())
        or any(key and key[1] < 0 and not counts[key] for row in rows for key in (_key(row[0]),))
    )


def _is_turned(entries: Entries, vectors: set[Entries]) -> bool:
    """Whether only columns are typed that have the opposite of some of these entries."""
    if entries in vectors:
        return False
    alike = (each for each in vectors if len(each) == len(entries))
    return any(all(a in (b, negate(b)) for a, b in zip(entries, each, strict=True)) for each in alike)


def _plain(tree: Any) -> Any:
    return _plain(tree.value) if isinstance(tree, Measured) else tree


def _key(tree: Any) -> Key | None:
    """Of a number other than zero."""
    value = float(tree.value) if isinstance(tree, Number | Degrees) else 0.0
    return (isinstance(tree, Degrees), value) if value else None


def _opposite(key: Key) -> Key:
    return key[0], -key[1]


def _trees(value: Any) -> Iterator[Expr]:
    if isinstance(value, TREES):
        yield value
    for part in _parts(value):
        yield from _trees(part)


def _vectors(value: Any) -> Iterator[Entries]:
    """Rows of formulas, and columns of one."""
    if isinstance(value, Matrix):
        yield from value.rows
        yield from zip(*value.rows, strict=True)
    elif isinstance(value, tuple | list) and value and all(isinstance(each, TREES) for each in value):
        yield tuple(map(_plain, value))
    for part in _parts(value):
        yield from _vectors(part)


def _parts(value: Any) -> Iterable[Any]:
    match value:
        case Phrase() | str() | bytes() | type():
            return ()
        case _ if isinstance(value, TREES):
            return (value.value,) if isinstance(value, Measured) else ()
        case Mapping():
            return (*value.keys(), *value.values())
        case BaseModel():
            return (each for _, each in value)
        case _ if is_dataclass(value):
            return (getattr(value, each.name) for each in fields(value))
    return value if isinstance(value, Iterable) else ()
