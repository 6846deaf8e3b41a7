"""The signs in a table that a page gives, against those of what was typed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, TypeAlias, get_args

from derive.derivation import Cell
from derive.expression import Degrees, Expr, Matrix, Measured, Number, children, every, negate

TREES = get_args(Expr)
Entries: TypeAlias = tuple[Expr, ...]
Key: TypeAlias = Expr | tuple[bool, float]  # of a number whether it is in degrees, and its value


def mistabled(rows: Sequence[Sequence[Cell]], typed: Any) -> bool:
    """Whether a cell stands in a table more often than it was typed, and with other signs was typed too; or
    rows are not numbered from 0 or 1 on."""
    cells = [_plain(cell) for row in rows for cell in row if isinstance(cell, TREES)]
    vectors, columns = Counter(_vectors(typed)), Counter(children(cell) for cell in cells if _is_column(cell))
    shown = Counter(key for cell in cells if (key := _key(cell)))
    counts = Counter(key for part in every(typed) if (key := _key(_plain(part))))
    return (
        any(n > vectors[each] and _is_turned(each, vectors) for each, n in columns.items())
        or any(n > counts[key] and counts[_opposite(key)] for key, n in shown.items())
        or not _is_numbered([row[0] for row in rows])
    )


def _is_column(cell: Expr) -> bool:
    return isinstance(cell, Matrix) and cell.shape[1] == 1


def _is_turned(entries: Entries, vectors: Iterable[Entries]) -> bool:
    """Whether a column is typed that has the opposite of some of these entries."""
    alike = (each for each in vectors if len(each) == len(entries) and each != entries)
    return any(all(a in (b, negate(b)) for a, b in zip(entries, each, strict=True)) for each in alike)


def _is_numbered(cells: Sequence[Cell]) -> bool:
    """Whether the first cells, where their sizes are numbers in a row, are these numbers."""
    numbers = [int(cell.value) for cell in cells if isinstance(cell, Number) and cell.value.denominator == 1]
    sizes = list(map(abs, numbers))
    in_order = any(sizes == list(range(first, first + len(cells))) for first in (0, 1))
    return not in_order or numbers == sizes


def _plain(tree: Any) -> Any:
    return _plain(tree.value) if isinstance(tree, Measured) else tree


def _key(tree: Any) -> Key | None:
    """Of all but zero, and columns."""
    if isinstance(tree, Number | Degrees):
        return (isinstance(tree, Degrees), float(tree.value)) if tree.value else None
    return tree if isinstance(tree, TREES) and not isinstance(tree, Matrix) else None


def _opposite(key: Key) -> Key:
    return (key[0], -key[1]) if isinstance(key, tuple) else negate(key)


def _vectors(value: Any) -> Iterator[Entries]:
    """Rows of formulas, and columns of one."""
    for part in every(value):
        if isinstance(part, Matrix):
            yield from part.rows
            yield from zip(*part.rows, strict=True)
        elif isinstance(part, tuple | list) and part and all(isinstance(each, TREES) for each in part):
            yield tuple(map(_plain, part))
